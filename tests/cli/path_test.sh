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
[ "$(ffprobe -v error -show_entries stream=codec_name -of csv=p=0 film.mp4)" = h264 ] || fail "no H.264"

expect 2 vsprite path ring.vsp; says "--script FILE is due"; one_sentence
expect 2 vsprite path --script corner.txt; one_sentence
expect 66 path absent.txt; one_sentence
expect 66 vsprite path absent.vsp --script corner.txt
expect 2 path corner.txt -o film.gif; says ".mp4, .mkv"; one_sentence
expect 2 path corner.txt --size 100; says "WxH"; one_sentence
expect 2 path corner.txt --beam 0
expect 73 path corner.txt --beam 500 -o absent/film.mp4; one_sentence
expect 73 path corner.txt --beam 500 --trace absent/x.csv; one_sentence
[ -e /dev/full ] && { path corner.txt --beam 500 --json >/dev/full 2>/dev/null; [ $? = 74 ] || fail "a full stdout"; }
# A full disk while the film is written: the limit on a file's size stands for it.
small() { (trap '' XFSZ; ulimit -f 4; path "$@"); }
expect 74 small corner.txt --beam 500 -o full.mkv; says "full.mkv"; one_sentence
ls full.mkv* 2>/dev/null && fail "a film that is not whole was left behind"
bad() { printf "$1" >bad.txt; expect 3 path bad.txt "${@:3}"; says "$2"; one_sentence; }
bad '' "bad.txt: a path of 0 points"
bad '5 5\n' "a path of 1 point:"
bad '5 5\n5 5\n' "zero length"
bad '5 5\nnan 5\n' "bad.txt:2: \`nan 5\`"
bad '5 5\n5\n' "bad.txt:2: \`5\`"
bad '5 5\n1e6 5\n' "30000 px"
bad '500 5\n600 5\n' "outside the picture" --size 100x100
finish
