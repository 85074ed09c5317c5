#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A cast of clips as a generator makes them: one character, no tag lost, every join priced.
. "$(dirname "$0")/lib.sh"
film() { "$BIN/make_film" "$@" || fail "make_film $*"; }

# connected: from sample 0 every tagged sample is reached, and from each of them sample 0.
connected() {
  vsprite dump --work "$1" --what samples --format csv -o samples.csv >/dev/null 2>&1 || fail "dump samples"
  vsprite dump --work "$1" --what transitions --format csv -o transitions.csv >/dev/null 2>&1 || fail "dump transitions"
  awk -F, 'FNR == 1 { file++; next }
    file == 1 { n++; next }
    { to[$1] = to[$1] " " $2; from[$2] = from[$2] " " $1 }
    function flood(ways, seen,   stack, top, at, next_, k, count) {
      stack[top = 1] = 0; seen[0] = 1
      while (top > 0) {
        at = stack[top--] + 0; count = split(ways[at], next_, " ")
        for (k = 1; k <= count; k++) if (!(next_[k] in seen)) { seen[next_[k]] = 1; stack[++top] = next_[k] }
      }
    }
    END { flood(to, forth); flood(from, back)
      for (i = 0; i < n; i++) if (!(i in forth) || !(i in back)) { print "sample " i " is cut off"; exit 1 } }' \
    samples.csv transitions.csv || fail "$1: a tag is out of reach"
}

# Each of another size, exposure and frame rate; the screen is a green near no key, and changes.
film idle idle.mp4 48 1 1 24
film walk walk.mp4 60 0.8 0.8 30
film run run.mp4 40 1.2 1.1 30
film jump jump.mp4 24 1 0.9 24
cat >hero.toml <<END
[[clip]]
file = "idle.mp4"
tag = "idle"
key = "#30b048"
[[clip]]
file = "walk.mp4"
tag = "walk"
velocity = [60, 0]
mirror = true
[[clip]]
file = "run.mp4"
tag = "run"
velocity = [130, 0]
mirror = true
[[clip]]
file = "jump.mp4"
frames = [0, 23]
tag = "jump"
END
expect 0 vsprite build hero.toml -o hero.vsp
prints "matched walk (walk.mp4): scale x 1."
prints "30 to 24 frames a second"
prints "idle -> run joined at "
prints " x the threshold: film idle going over into run"
connected hero.work
expect 0 vsprite info hero.vsp --json
is_json /tags/0 /tags/1 /tags/2 /tags/3
for tag in idle walk run jump; do
  grep -q "\"$tag\"" "$room/stdout" || fail "info does not name the tag $tag"
done
expect 0 vsprite validate hero.vsp
expect 0 vsprite steer hero.vsp --keys "0 right" --frames 120 --trace right.csv
awk -F, 'NR == 2 { x = $3 } END { exit !($3 - x > 60) }' right.csv || fail "the figure does not go to the right"
expect 0 vsprite steer hero.vsp --keys "0 left" --frames 120 --trace left.csv
awk -F, 'NR == 2 { x = $3 } END { exit !($3 - x < -60) }' left.csv || fail "the figure does not go to the left"

# What has not changed is not done again; the same cast gives the same bytes.
first=$(sum hero.vsp)
expect 0 vsprite build hero.toml -o hero.vsp --json
is_json /stages/0/skipped /joins/0/cost /cast/1/scale
[ "$(grep -c '"skipped": true' "$room/stdout")" = 5 ] || fail "a stage ran again although nothing had changed"
expect 0 vsprite build hero.toml -o again.vsp --jobs 1
[ "$(sum again.vsp)" = "$first" ] || fail "the same cast gives other bytes"

# A box of one's own for a tag: nothing else changes. Pictures for the GPU: half the bytes.
sed 's/^tag = "run"/&\nbody = [-7, -30.5, 8, 0]/' hero.toml >boxed.toml
cp -r hero.work boxed.work
expect 0 vsprite build boxed.toml -o boxed.vsp --work boxed.work
expect 0 vsprite info boxed.vsp
prints "body of run: [-7, -30.5, 8, 0] px from the anchor"
grep "body of walk" stdout >boxed.txt
expect 0 vsprite info hero.vsp
grep -qxFf boxed.txt stdout || fail "another tag's box changed too"
expect 0 vsprite build boxed.toml -o gpu.vsp --work boxed.work --pictures gpu --json
is_json /stages/0/name
expect 0 vsprite validate gpu.vsp; prints OK
expect 0 vsprite info gpu.vsp --json
is_json /loss/colour_psnr_db /loss/alpha_psnr_db /bodies/3/box/3
expect 0 vsprite info gpu.vsp
prints "pictures for the GPU: colour "
[ "$(stat -c %s gpu.vsp)" -lt "$(stat -c %s boxed.vsp)" ] || fail "pictures for the GPU take more"
expect 0 vsprite steer gpu.vsp --keys "0 right" --frames 120 --trace gpu.csv
cmp -s gpu.csv right.csv || fail "pictures for the GPU steer otherwise"
expect 2 vsprite build boxed.toml -o gpu.vsp --work boxed.work --pictures bc7; says "exact|gpu"
sed -i 's/\[130, 0\]/[120, 0]/' hero.toml
expect 0 vsprite segment hero.toml --work hero.work --verbose
[ "$(sum hero.work/clips/01-walk/samples.csv)" = "$(sum again.work/clips/01-walk/samples.csv)" ] || fail "a clip changed with its neighbour"

# A tagged loop of ten frames closes.
film run ten.mp4 10 1 1 15
printf '[[clip]]\nfile = "idle.mp4"\ntag = "idle"\n[[clip]]\nfile = "ten.mp4"\ntag = "run"\nvelocity = [100, 0]\n' >ten.toml
expect 0 vsprite build ten.toml
connected ten.work
awk -F, '$1 >= 52 && $2 >= 48 && $2 < $1 { closes = 1 } END { exit !closes }' transitions.csv || fail "a loop of ten frames does not close"

# A folder of clips in natural order: two films and a folder of pictures; no tags, nothing matched.
mkdir -p clips/take_10
film circle clips/take_2.mp4 120
film circle clips/take_1.mp4 60
ffmpeg -nostdin -v error -i clips/take_1.mp4 clips/take_10/%03d.png || fail "ffmpeg"
expect 0 vsprite build clips --fps 25 --json
is_json /cast/2/file
awk -F, 'NR > 1 && $13 != last { order = order " " $13; last = $13 } END { exit order != " take_1.mp4 take_2.mp4 take_10" }' \
  clips.work/samples.csv || fail "the clips are not in natural order"
[ -s clips.vsp ] || fail "no pack"
expect 0 vsprite doctor clips --fps 25
prints "take_10"; prints "segment: up to date"
expect 2 vsprite segment clips --matte walk.mp4
says "the mattes of a cast stand with its clips"; one_sentence

# A clip may have its matte beside it: nothing is keyed.
ffmpeg -nostdin -v error -i walk.mp4 -vf "format=gbrp,geq=r=0:g=0:b=0,drawbox=50:40:40:50:white:fill" -c:v ffv1 walk_matte.mkv || fail "ffmpeg"
printf '[[clip]]\nfile = "walk.mp4"\nmatte = "walk_matte.mkv"\ntag = "walk"\nvelocity = [60, 0]\n' >matte.toml
expect 0 vsprite segment matte.toml --json
is_json /cast/0/background
grep -q 'nothing is keyed' "$room/stdout" || fail "the clip was keyed although its matte stands beside it"
rm walk_matte.mkv
expect 66 vsprite segment matte.toml
says "walk_matte.mkv: no such file; matte.toml:1 names it"; one_sentence

# Bad casts: one sentence each.
bad() {  # CODE TEXT SAYS
  printf "$2" >bad.toml
  expect "$1" vsprite build bad.toml
  says "$3"; one_sentence
}
expect 66 vsprite build absent.toml
says "absent.toml: no such file"; one_sentence
bad 3 '' "bad.toml: a cast lists its clips"
bad 3 '[[clip]\n' "bad.toml:1:8: not TOML"
bad 3 '[[clip]]\nfile = "walk.mp4"\ntga = "walk"\n' 'bad.toml:3:1: unknown key `tga`; did you mean `tag`?'
bad 66 '[[clip]]\nfile = "gone.mp4"\n' "gone.mp4: no such file; bad.toml:1 names it"
bad 3 '[[clip]]\nfile = "walk.mp4"\nframes = [500, 600]\n' "walk.mp4: "
bad 3 '[[clip]]\nfile = "bad.toml"\n' "bad.toml:2:8: file: a film is due, bad.toml is a cast"
echo "this is no film" >text.mp4
bad 3 '[[clip]]\nfile = "text.mp4"\ntag = "idle"\n[[clip]]\nfile = "walk.mp4"\ntag = "walk"\n' "text.mp4: no film"
[ -s bad.work/clips/01-walk/samples.csv ] || fail "a clip that can be used did not go on"
expect 3 vsprite segment hero.toml --preview 3
says "hero.toml"; one_sentence
no_temporaries
finish
