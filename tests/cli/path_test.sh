#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Scripted motion: what is written, and every way to write a script wrong.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" circle ring.mp4 200 || fail "make_film"
expect 0 vsprite build ring.mp4 -o ring.vsp --max-size 64
printf '20 20\n120 20  # right\n120 80\n' >corner.txt
path() { vsprite path ring.vsp --script "$1" "${@:2}"; }

expect 0 path corner.txt --beam 2000 --trace a.csv --json
is_json /frames /cost /deviation_px/p95 /deviation_body/max /seconds /realtime_factor
head -1 a.csv | grep -qx 'frame,sample,x,y,segment,cost' || fail "the trace's head"
expect 0 path corner.txt --beam 2000 --trace b.csv --jobs 1
cmp -s a.csv b.csv || fail "the result depends on the threads"
[ "$(tail -n +2 a.csv | wc -l)" -gt 10 ] || fail "a trace without ticks"
expect 0 path corner.txt --beam 500 -o film.mp4
expect 0 path corner.txt --beam 500 -o clear.mkv
expect 0 path corner.txt --beam 500 -o places.json
expect 0 path corner.txt --beam 500 -o pictures/
[ "$(ls pictures/frame-*.png | wc -l)" -gt 10 ] || fail "no pictures"
expect 0 path corner.txt --beam 500 --backdrop pictures/frame-00000.png -o backed.mp4
[ "$(ffprobe -v error -show_entries stream=pix_fmt -of csv=p=0 clear.mkv)" = bgra ] || fail "no alpha"
ticks=$(($(wc -l <a.csv) - 1))
for ending in webm apng gif; do
  expect 0 path corner.txt --beam 2000 -o film.$ending
  frames=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 film.$ending)
  [ "$frames" = "$ticks" ] || fail "film.$ending: $frames frames, $ticks are due"
done
[ "$(ffprobe -v error -show_entries stream_tags=alpha_mode -of csv=p=0 film.webm)" = 1 ] || fail "webm without alpha"
[ "$(ffprobe -v error -show_entries stream=codec_name -of csv=p=0 film.mp4)" = h264 ] || fail "no H.264"

expect 2 vsprite path ring.vsp; says "--script FILE is due"; one_sentence
expect 2 vsprite path --script corner.txt; one_sentence
expect 66 path absent.txt; one_sentence
expect 66 vsprite path absent.vsp --script corner.txt
expect 2 path corner.txt -o film.avi; says ".mp4, .mkv, .webm, .apng or .gif"; one_sentence
expect 2 path corner.txt --size 100; says "WxH"; one_sentence
expect 2 path corner.txt --beam 0
expect 73 path corner.txt --beam 500 -o absent/film.mp4; one_sentence
expect 73 path corner.txt --beam 500 --trace absent/x.csv; one_sentence
[ -e /dev/full ] && { path corner.txt --beam 500 --json >/dev/full 2>/dev/null; [ $? = 74 ] || fail "a full stdout"; }
# A full disk while the film is written: the limit on a file's size stands for it.
small() { (trap '' XFSZ; ulimit -f 40; path "$@"); }
printf '20 20\n420 20\n420 380\n' >far.txt
expect 74 small far.txt --beam 5000 -o full.mkv; says "full.mkv"; one_sentence
ls full.mkv* 2>/dev/null && fail "a film that is not whole was left behind"
bad() { printf "$1" >bad.txt; expect 3 path bad.txt "${@:3}"; says "$2"; one_sentence; }
bad '' "bad.txt: a path of 0 points"
bad '5 5\n' "a path of 1 point:"
bad '5 5\n5 5\n' "zero length"
bad '5 5\nnan 5\n' "bad.txt:2: \`nan 5\`"
bad '5 5\n5\n' "bad.txt:2: \`5\`"
bad '5 5\n1e6 5\n' "30000 px"
bad '500 5\n600 5\n' "outside the picture" --size 100x100
bad '5 5\n29000 5\n' "at most 16384 px a side" -o film.mp4
seq 0 10000 | awk '{ t = $1 / 10000; print 200 * t + 20, 20 + 40 * t * (1 - t) }' >long.txt
expect 0 path long.txt --beam 500

# A film behind it, looped; an interrupt leaves nothing.
expect 0 path corner.txt --beam 500 --backdrop ring.mp4 -o looped.mp4
probe() { ffprobe -v error -show_entries "stream=$1" -of csv=p=0 "$2"; }
[ "$(probe width,height looped.mp4)" = "$(probe width,height ring.mp4)" ] || fail "not the backdrop's size"
expect 66 path corner.txt --beam 500 --backdrop absent.png; one_sentence
expect 3 path corner.txt --beam 500 --backdrop corner.txt; one_sentence
for target in stopped.mkv stopped/; do
  "$BIN/vsprite" path ring.vsp --script far.txt --beam 5000 -o $target --progress none 2>stop.txt & pid=$!
  for _ in $(seq 200); do ls $target* 2>/dev/null | grep -q . && break; sleep 0.05; done
  kill -INT $pid; wait $pid; [ $? = 130 ] || fail "an interrupted film's exit code: $target"
  ls -d stopped* 2>/dev/null && fail "an interrupted film left something: $target"
done

# Kept in the pack.
expect 0 path corner.txt --beam 500 -o with.vsp --clip corner
expect 0 vsprite validate with.vsp; prints OK
expect 0 vsprite path with.vsp --script corner.txt --beam 500 -o with.vsp --clip again
expect 0 vsprite validate with.vsp; prints OK
[ "$(stat -c %s with.vsp)" -gt "$(stat -c %s ring.vsp)" ] || fail "no clip in the pack"

# Scenes.
cat >scene.toml <<'END'
seconds = 3
[[sprite]]
name = "a"
start = [50, 50]
[[sprite.term]]
kind = "location"
at = [90, 50]
from = 2
[[sprite.term]]
kind = "clear"
with = "b"
distance = 20
[[sprite]]
name = "b"
start = [150, 50]
END
expect 0 path scene.toml --proposals 2000 --trace s1.csv -o s1.json --json
is_json /frames /cost /seconds /curve/0/cost /terms/0/worst
expect 0 path scene.toml --proposals 2000 --trace s2.csv --jobs 1
cmp -s s1.csv s2.csv || fail "a scene of one seed and count differs"
cost() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["cost"])' "$1"; }
expect 0 path scene.toml --proposals 500 --seed 3 --resume s1.json -o s3.json
[ "$(printf '%s\n%s\n' "$(cost s3.json)" "$(cost s1.json)" | sort -g | head -1)" = "$(cost s3.json)" ] ||
  fail "a resumed search came out dearer"
expect 0 path scene.toml --seconds 0.3 -o scene.mp4
[ "$(probe nb_frames scene.mp4)" = 90 ] || [ "$(probe nb_frames scene.mp4)" = 75 ] || fail "frames of a scene"
"$BIN/vsprite" path ring.vsp --script scene.toml --seconds 1000 -o best.json >stop.txt 2>&1 & pid=$!
sleep 1; kill -INT $pid; wait $pid; [ $? = 130 ] || fail "an interrupted scene's exit code"
[ -s best.json ] || fail "an interrupted scene gives no best so far"
expect 2 path scene.toml --seconds 0; one_sentence
expect 3 path scene.toml --proposals 9 --resume corner.txt; one_sentence
expect 3 path scene.toml --proposals 9 --search beam; says "one sprite"; one_sentence
printf 'for = "mouse"\n' | cat - scene.toml >other.toml
expect 3 path other.toml; says 'written for the pack `mouse`'; one_sentence
sed 's/distance = 20/distance = nan/' scene.toml >nan.toml
expect 3 path nan.toml; says "nan.toml:12: distance:"; one_sentence
sed 's/at = \[90/at = [900/' scene.toml >unmet.toml
expect 0 path unmet.toml --proposals 500; says "is not met"
grep -Eq 'a, term 1 \(location\) is not met: [0-9]+\.[0-9] px off at [0-9.]+ s' stderr || fail "not said by how much and when"
finish
