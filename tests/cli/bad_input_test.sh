#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Films and packs that are none: one sentence, the right exit code, nothing half made.
. "$(dirname "$0")/lib.sh"
film() { "$BIN/make_film" "$@" || fail "make_film $*"; }

expect 66 vsprite build absent.mp4
says "absent.mp4: no such file"; one_sentence
expect 66 vsprite train --work absent.work
expect 66 vsprite info absent.vsp
expect 66 vsprite validate absent.vsp
expect 66 vsprite doctor absent.mp4

echo "this is no film" >text.mp4
expect 3 vsprite build text.mp4
says "text.mp4"; one_sentence
expect 3 vsprite doctor text.mp4
[ -e text.vsp ] && fail "a pack was made of a text"
expect 3 vsprite doctor text.mp4
prints "-> vsprite build FILM"
mkdir folder && : >empty.mp4 && : >empty.vsp
expect 3 vsprite build folder
says "folder: no film in this folder"; one_sentence
expect 3 vsprite build empty.vsp
says "empty.vsp: is a pack, a film is due: \`vsprite play empty.vsp\`"; one_sentence
expect 3 vsprite build empty.mp4
says "empty.mp4: no film"; one_sentence
expect 3 vsprite info text.mp4
says "text.mp4: "; one_sentence
expect 3 vsprite play text.mp4 --headless
one_sentence
expect 66 vsprite play absent.vsp
says "absent.vsp: no such file"; one_sentence
expect 66 vsprite validate folder
expect 66 vsprite train folder
says "no film has been segmented here"; one_sentence
film blank blank.mp4 100
expect 3 vsprite build blank.mp4
says "blank.mp4"; one_sentence
expect 73 vsprite build blank.mp4 -o nowhere/blank.vsp
says "there is no folder nowhere"; one_sentence
[ -e nowhere ] && fail "a folder was made that nobody asked for"
film two two.mp4 100
expect 3 vsprite build two.mp4
says "two.mp4: several subjects"; says "two.work/subjects.png shows those of frame"; one_sentence
expect 0 vsprite doctor two.mp4
prints "warning: two.work: no film has been segmented here"
[ -s two.work/subjects.png ] || fail "there is no picture of the subjects"
expect 0 vsprite segment two.mp4 --subject 1
prints "look at two.work/contact.png"
first=$(sum two.work/contact.png)
expect 0 vsprite segment two.mp4 --subject 2
[ "$(sum two.work/contact.png)" != "$first" ] || fail "a choice of subject is not on the contact sheet"
expect 0 vsprite segment two.mp4 --subject largest
expect 3 vsprite segment two.mp4 --subject 3
says "--subject 3"; one_sentence
expect 0 vsprite segment two.mp4 --subject largest
says "segment: up to date"  # a refusal leaves what stands
expect 0 vsprite segment two.mp4 --subject 2 --preview 2 -o two.png
says "the preview shows the largest part of each frame: which is number 2"
expect 2 vsprite segment two.mp4 --subject both
film circle circle.mp4 100
# What stands under the output's name and is none of its kind stays.
film_sum=$(sum circle.mp4)
expect 2 vsprite build circle.mp4 -o circle.mp4
says "circle.mp4: is there already, is no pack and stays"; one_sentence
expect 2 vsprite segment circle.mp4 --preview 2 -o circle.mp4
says "circle.mp4: is there already, is no PNG file and stays"; one_sentence
[ "$(sum circle.mp4)" = "$film_sum" ] || fail "the film was overwritten"
# A file whose name begins as an option's.
cp circle.mp4 ./-circle.mp4
expect 2 vsprite segment -circle.mp4
says "no option is called \`-circle.mp4\`: the file is ./-circle.mp4"; one_sentence
expect 0 vsprite segment -- -circle.mp4
prints "next: vsprite train --work ./-circle.work"
expect 0 vsprite segment circle.mp4 --edge -1 --preview 2
prints "next: vsprite build circle.mp4 --edge -1"
# What is wrong with a film that can be used all the same is said without being asked for.
ffmpeg -nostdin -v error -i circle.mp4 -vf tinterlace=interleave_top,setfield=tff -c:v libx264 -preset ultrafast \
  -x264opts tff=1 fields.mp4 || fail "ffmpeg"
expect 0 vsprite segment fields.mp4
prints "warning: the film is interlaced"
expect 0 vsprite segment circle.mp4
grep -q 'warning: ' "$room/stdout" && fail "a warning of a film that is as due"
prints "100 frames -> 100 samples in 1 clip, 0 duplicates"
expect 0 vsprite segment fields.mp4 --json
is_json /warnings/0
# A row of pictures of which one has another size.
mkdir row && ffmpeg -nostdin -v error -i circle.mp4 -frames:v 12 row/%02d.png || fail "ffmpeg"
ffmpeg -nostdin -y -v error -i circle.mp4 -frames:v 1 -vf scale=80:60 row/07.png || fail "ffmpeg"
expect 3 vsprite segment row
says "error: row/07.png: 80 x 60 px, the first 160 x 120; due: one size"; one_sentence
# An option without its value.
expect 2 vsprite segment circle.mp4 --work; one_sentence
says "--work: a value is missing; due: --work DIR"
expect 2 vsprite build circle.mp4 --max-size; one_sentence
says "--max-size: a value is missing; due: --max-size PX, 16..4096, such as --max-size 256"
# Black bars are named, with the way to be rid of them; a subject before black has none.
ffmpeg -nostdin -v error -i circle.mp4 -vf pad=200:160:20:16:black bars.mp4 || fail "ffmpeg"
expect 3 vsprite segment bars.mp4
says "black bars (top 16 px, bottom 24 px, left 20 px, right 20 px)"; says "due: ffmpeg -i FILM -vf crop="; one_sentence
crop=$(grep -o 'crop=[0-9:]*' "$room/stderr")
expect 0 vsprite doctor bars.mp4
prints "warning: bars.mp4: black bars (top 16 px, bottom 24 px, left 20 px, right 20 px)"; prints "-> ffmpeg -i bars.mp4 -vf $crop out.mp4"
ffmpeg -nostdin -v error -i bars.mp4 -vf "$crop" cropped.mp4 || fail "ffmpeg"
expect 0 vsprite segment cropped.mp4
grep -q 'warning: ' "$room/stdout" && fail "a warning of a film that was cropped as told"
ffmpeg -nostdin -v error -i circle.mp4 -vf pad=160:150:0:16:black wide.mp4 || fail "ffmpeg"
expect 0 vsprite segment wide.mp4
prints "warning: black bars (top 16 px, bottom 14 px)"
ffmpeg -nostdin -v error -f lavfi -i color=black:s=160x120:r=25:d=4 \
  -vf "geq=lum='if(lt(abs(X-80-20*sin(T*2)),50)*gt(Y,50),200,16)':cb=128:cr=128" black.mp4 || fail "ffmpeg"
expect 0 vsprite doctor black.mp4
grep -q "black bars" stdout && fail "a subject before black is taken for a picture between bars"
head -c $(($(stat -c %s circle.mp4) / 2)) circle.mp4 >short.mp4
expect 3 vsprite build short.mp4
says "short.mp4"; one_sentence

cp "$BIN/vsprite" binary.vsp
expect 3 vsprite info binary.vsp
expect 3 vsprite validate binary.vsp
prints "INVALID: "
expect 3 vsprite steer binary.vsp
expect 3 vsprite doctor binary.vsp

film circle whole.mp4 100
"$BIN/vsprite" build whole.mp4 >build.text 2>&1 &
victim=$!
for _ in $(seq 200); do [ -e whole.work/keyed/origin ] && break; sleep 0.02; done
kill -INT $victim; wait $victim
[ $? = 130 ] || fail "an interrupted build does not exit with 130"
grep -q "the same command goes on from there" build.text || fail "an interrupted build does not say how to go on"
expect 0 vsprite build whole.mp4
[ -e whole.work/keyed ] && fail "a finished build keeps what it needed to go on"
finish
