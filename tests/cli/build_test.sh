#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A film becomes a pack; what stands is not done again; what a person changed is taken up.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" circle "a film.mp4" 240 || fail make_film

expect 0 vsprite build "a film.mp4" -o c.vsp --json
is_json /stages/0/name /stages/4/seconds /stages/4/peak_rss_mb /stages/4/skipped /frames /duplicates \
  /samples /clips /pairs /accepted /transitions /directions/7/name /directions/7/reachable \
  /directions/7/tracking_error_deg /pack_bytes
no_temporaries
for file in sprites/000000.png samples.csv classifier.toml transitions.bin values.bin manifest.json contact.png; do
  [ -s "c.work/$file" ] || fail "c.work/$file is missing"
done
[ "$(head -1 c.work/samples.csv)" = "sample,clip,frame,left,top,width,height,anchor_x,anchor_y,velocity_x,velocity_y,area,source,tag,duration,scale,mirror_of" ] ||
  fail "samples.csv has other columns"
first=$(sum c.vsp)

# A look before the build.
expect 0 vsprite segment "a film.mp4" --preview 4 --json
is_json /background /sheet /rows/3/frame /rows/3/area
[ -s "a film.preview.png" ] || fail "no preview was written"
expect 0 vsprite segment "a film.mp4" --preview 2 --background "a film.preview.png" -o p.png
[ -s p.png ] || fail "no preview over a picture was written"
expect 66 vsprite segment "a film.mp4" --preview 2 --background absent.png
says "absent.png"; one_sentence
[ -e "a film.work" ] && fail "a preview made a work folder"
expect 0 vsprite doctor "a film.mp4" --json
is_json /ok /film/usable_seconds /film/heading_seconds/left /film/camera_shift_px /findings/0/name
prints '"name": "motion"'

# The four corrections: neutral values change no byte, others do, and a value out of range is refused.
expect 0 vsprite segment "a film.mp4" --work n.work --max-size 64 --clip-black 0 --clip-white 1 --edge 0 --despill 1
diff -rq c.work/sprites n.work/sprites >/dev/null || fail "neutral corrections change a sprite"
for change in "--clip-black 0.3" "--clip-white 0.7" "--edge -1" "--edge 1.5"; do
  # shellcheck disable=SC2086
  expect 0 vsprite segment "a film.mp4" --work n.work --max-size 64 $change
  grep -q "segment: up to date" stderr && fail "$change: nothing was done"
  diff -rq c.work/sprites n.work/sprites >/dev/null && fail "$change changes no sprite"
done
expect 0 vsprite segment "a film.mp4" --work n.work --max-size 64 --despill 0
grep -q "segment: up to date" stderr && fail "--despill 0: nothing was done"
expect 0 vsprite segment "a film.mp4" --preview 2 --edge -1 -o p.png
prints "next: vsprite build 'a film.mp4' --edge -1.0"
for bad in "--edge -8.1" "--edge 4.1" "--edge wide" "--clip-black 1" "--clip-white 0" "--despill 2.1"; do
  # shellcheck disable=SC2086
  expect 2 vsprite segment "a film.mp4" $bad
  says "${bad% *}"; one_sentence
done
expect 2 vsprite segment "a film.mp4" --work n.work --clip-black 0.5 --clip-white 0.4
says "--clip-white"; one_sentence

# A draft: half the samples, each for two frames; small; the full build follows it in its place.
expect 0 vsprite build "a film.mp4" -o d.vsp --draft --mirror --max-size 64 --json
prints '"frames": 240'; prints '"samples": 240'
[ "$(cut -d, -f15 d.work/samples.csv | sort -u | head -1)" = 2 ] || fail "a draft's samples do not last two frames"
[ -e d.work/sprites/000119.png ] && [ ! -e d.work/sprites/000120.png ] || fail "mirrored samples have pictures, or others have none"
expect 0 vsprite validate d.vsp
expect 0 vsprite build "a film.mp4" -o d.vsp
[ "$(sum d.vsp)" = "$first" ] || fail "a build after a draft differs from one without"

# A sprite retouched by hand stays; what depends on it is made again, and its return undoes it.
cp c.work/sprites/000007.png kept.png
ffmpeg -v error -y -i kept.png -vf lutrgb=r=40:b=220 -pix_fmt rgba c.work/sprites/000007.png
edited=$(sum c.work/sprites/000007.png)
expect 0 vsprite build "a film.mp4" -o c.vsp
grep -q "segment: up to date" stderr || fail "a retouched sprite was cut again"
[ "$(sum c.work/sprites/000007.png)" = "$edited" ] || fail "a retouched sprite is lost"
[ "$(sum c.vsp)" != "$first" ] || fail "a retouched sprite is not in the pack"
cp kept.png c.work/sprites/000007.png
expect 0 vsprite build "a film.mp4" -o c.vsp
[ "$(sum c.vsp)" = "$first" ] || fail "undoing a retouch gives another pack"

# A smaller pack of the same folder; too small a one is refused and leaves what there was.
expect 0 vsprite pack --work c.work -o whole.vsp
size=$(stat -c %s whole.vsp)
for percent in 90 70 60; do
  expect 0 vsprite pack --work c.work -o small.vsp --json --budget "$(awk "BEGIN {print $size * $percent / 1e8}")"
  [ "$(stat -c %s small.vsp)" -le $((size * percent / 100)) ] || fail "more than $percent % of the pack"
done
is_json /pack_bytes /budget/whole/turn_median /budget/fitted/bytes
expect 0 vsprite validate small.vsp
expect 3 vsprite pack --work c.work -o tiny.vsp --budget 0.001; says "raise --budget"; one_sentence
[ ! -e tiny.vsp ] || fail "a refused budget leaves a pack"
no_temporaries
expect 2 vsprite pack --work c.work -o tiny.vsp --budget -1; one_sentence
expect 0 vsprite build "a film.mp4" -o c.vsp
[ "$(sum c.vsp)" = "$first" ] || fail "a small pack has changed the large one"

expect 0 vsprite build "a film.mp4" -o c.vsp
[ "$(grep -c 'up to date' stderr)" = 5 ] || fail "a second run did something"
prints "next: vsprite play c.vsp"
for stage in train transitions solve pack; do
  expect 0 vsprite $stage --work c.work --force $stage
  prints "next: vsprite"
done
[ "$(sum c.vsp)" = "$first" ] || fail "stages run one by one make another pack"
rm c.vsp
expect 0 vsprite pack c.vsp
[ "$(sum c.vsp)" = "$first" ] || fail "a lost pack is not made again as it was"

expect 0 vsprite info c.vsp --json
is_json /version /samples /clips /tags /transitions /fps /size/1 /modes/0/mode /modes/0/tables /alpha \
  /w1 /cap /residual /error_bound /bytes /sections/0/name
expect 0 vsprite validate c.vsp
[ "$(tail -1 stdout)" = OK ] || fail "the last line of validate is not OK"
expect 0 vsprite steer c.vsp --keys "0 right; 2 down" --frames 100 --json --trace t.csv
is_json /frames /states_hash /frames_to_turn/median /transition_cost/p99 /jumps_per_second /freezes /unfinished
[ "$(wc -l <t.csv)" = 101 ] || fail "the trace has not one line a tick"
grep -qE '"states_hash": "[0-9a-f]{16}"' stdout || fail "states_hash is not 16 hex digits"
mv stdout once
expect 0 vsprite steer c.vsp --keys "0 right; 2 down" --frames 100 --json
diff -q once stdout >/dev/null || fail "the same keys give other states"
expect 2 vsprite steer c.vsp --mode sideways
expect 0 vsprite report c.vsp -o c.html --json
is_json /mode /turns /rose/15/seconds /unused /film_next/0 /page
grep -q "</html>" c.html || fail "the page is not whole"
cp t.csv t.vsp
expect 3 vsprite report t.vsp
for what in samples labels features distances transitions values; do
  expect 0 vsprite dump --work c.work --what $what --format npy -o d.npy
  expect 0 vsprite dump c.vsp --what $what --format csv -o d.csv --json
  is_json /shape/0
  [ "$(head -c 6 d.npy | tail -c 5)" = NUMPY ] || fail "$what is no npy file"
done
expect 0 vsprite doctor --work c.work --json
is_json /ok /findings/0/state

# An option of a stage is part of the stage's key, or a changed setting would leave the old result.
options() { vsprite help "$1" | sed -n 's/^ \{2,6\}\(-., \)\?--\([a-z0-9-]*\).*/\2/p' | sort; }
keys=$(awk '/"settings": \{/ { on = 1 } on { print } /\}/ { on = 0 }' c.work/manifest.json)
for stage in segment train transitions solve; do
  for option in $(comm -23 <(options $stage) <(options pack)); do
    case $option in preview | background | window | headless | frames | record | threshold | save) continue ;; esac  # looked at only, or kept in the file
    echo "$keys" | grep -q "\"$option\":" || fail "--$option is no part of the key of $stage"
  done
done

# A flipped byte and another version.
cp c.vsp bad.vsp
printf '\377' | dd of=bad.vsp bs=1 seek=$(($(stat -c %s c.vsp) / 2)) conv=notrunc 2>/dev/null
expect 3 vsprite validate bad.vsp --json
is_json /valid /issues/0/code /issues/0/section /issues/0/offset
head -c 1000 c.vsp >cut.vsp
expect 3 vsprite info cut.vsp
says "cut.vsp"; one_sentence

# What a person changed is taken up by the next stage and survives.
cp c.work/sprites/000007.png c.work/sprites/000008.png 2>/dev/null
expect 3 vsprite build "a film.mp4" -o c.vsp --max-size 64
says "edited by hand"; says "--force segment"; one_sentence
sed -i '4s/,0,/,x,/' c.work/samples.csv
expect 3 vsprite train --work c.work
says "samples.csv:4:"; one_sentence
expect 3 vsprite doctor --work c.work
expect 0 vsprite build "a film.mp4" -o c.vsp --force segment
[ "$(sum c.vsp)" = "$first" ] || fail "a segmentation made anew differs"
sed -i 's/^speed = .*/sped = 1/' c.work/classifier.toml
expect 3 vsprite transitions --work c.work
says "did you mean \`speed\`"
expect 0 vsprite train --work c.work --force train
head -c 100 c.work/transitions.bin >t.bin && mv t.bin c.work/transitions.bin
expect 3 vsprite solve --work c.work
says "transitions.bin"; one_sentence
expect 0 vsprite build "a film.mp4" -o c.vsp
[ "$(sum c.vsp)" = "$first" ] || fail "a damaged table was not made again as it was"
rm c.work/sprites/000003.png
expect 3 vsprite doctor c.work
prints "000003.png"
expect 3 vsprite train --work c.work
says "000003.png"
finish
