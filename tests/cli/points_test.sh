#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Control points without a window: from an SVG, by a script, and what is none.
. "$(dirname "$0")/lib.sh"
expect 0 "$BIN/draw_puppets" art
cp art/face.toml art/kept.toml
before=$(sum art/kept.toml)
expect 0 vsprite points art/kept.toml
prints "in 5 views"
[ "$(sum art/kept.toml)" = "$before" ] || fail "a look at a file has changed it"

# From nothing but pictures to a pack: the drawing's nodes, then a script.
cat >art/mine.toml <<'END'
# my face
[[parameter]]
name = "turn"

[[view]]
file = "face_1.png"   # from the front
at = [0]

[[view]]
file = "face_2.png"
at = [1]
END
size=$(file -b art/face_1.png | sed 's/.*, \([0-9]*\) x \([0-9]*\),.*/\1 \2/')
set -- $size
cat >front.svg <<END
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 $1 $2" width="$1" height="$2">
  <path d="M60 40 h200 v280 H60 Z"/><path d="M160 180 c1 1 2 2 20 30"/>
</svg>
END
expect 0 vsprite points art/mine.toml --import front.svg --json
is_json /points /views /faces /saved /fault
grep -q '^points = \[\[60, 40\], \[260, 40\], \[260, 320\], \[60, 320\], \[160, 180\], \[180, 210\]\]$' art/mine.toml ||
  fail "the nodes of the drawing are not in the file"
grep -q '^# my face' art/mine.toml && grep -q '# from the front' art/mine.toml || fail "comments are gone"
printf 'move 2 5 150 182\nadd 1 200 100\nmesh\n' >edits.txt
expect 0 vsprite points art/mine.toml --script edits.txt
prints "7 control points in 2 views"; prints "those of the file"
grep -q '^triangles = ' art/mine.toml || fail "the mesh was not kept"
expect 0 vsprite fit art/mine.toml -o mine.vsp
expect 0 vsprite validate mine.vsp
no_temporaries

# Bad input: the file stays as it was.
before=$(sum art/mine.toml)
refused() { [ "$(sum art/mine.toml)" = "$before" ] || fail "a refused edit changed the file"; one_sentence; }
echo 'move 9 1 1 1' >bad.txt
expect 3 vsprite points art/mine.toml --script bad.txt; says "bad.txt:1: there are 2 views"; refused
echo '<svg><path d="M1 1 L"/></svg>' >bad.svg
expect 3 vsprite points art/mine.toml --import bad.svg; says '`L` needs 2 numbers'; refused
expect 3 vsprite points art/mine.toml --import art/face_1.png; says "no XML"; refused
sed 's/ c1 1 2 2 20 30//' front.svg >few.svg
expect 3 vsprite points art/mine.toml --import few.svg; says "5 points, the views have 7"; refused
expect 66 vsprite points art/mine.toml --import absent.svg; refused
expect 2 vsprite points art/mine.toml --view 3; says "--view 3"; refused
expect 66 vsprite points absent.toml; one_sentence
expect 3 vsprite points art/face_1.png; says "a text is due"; one_sentence
expect 2 vsprite points; one_sentence
expect 3 vsprite points edits.txt; one_sentence
# A limb's points keep their links.
echo 'add 1 10 10' >limb.txt
expect 3 vsprite points art/arm.toml --script limb.txt; says "belong to their links"; one_sentence
# Views of other numbers of points.
sed '/face_2.png/,/^$/s/^points = \[\[[^]]*\], /points = [/' art/face.toml >art/uneven.toml
expect 3 vsprite points art/uneven.toml; says "every view needs all of them"; one_sentence

# What a fit would refuse may be opened, to be mended, and is told.
mend() {
  expect 0 vsprite points "$1" --json; says "not to be fitted yet: $2"; is_json /fault
}
sed 's/^at = \[36, 0\]/at = [0, 0]/' art/face.toml >art/same.toml
mend art/same.toml "face_2.png: has the same parameters as face_1.png"
sed 's/^at = \[36, 0\]/at = [50, 0]/' art/face.toml >art/outside.toml
mend art/outside.toml "face_2.png: rotation = 50 lies outside 0 to 36"
sed 's/^points = \[\([^]]*\]\), \[[^]]*\]/points = [\1, \1/' art/face.toml >art/meet.toml
mend art/meet.toml "face_1.png: control points 1 and 2 lie at the same place"
awk '/\[\[view\]\]/ { n++ } n < 2' art/face.toml >art/one.toml
mend art/one.toml "face: 1 view: at least two are due"
sed 's/face_3.png/john.png/' art/face.toml >art/sizes.toml
mend art/sizes.toml "john.png: "
printf '[[parameter]]\nname = "t"\n' >art/line.toml
for at in 0 1; do
  printf '[[view]]\nfile = "face_1.png"\nat = [%d]\npoints = [[9, 9], [20, 20], [%d, 40]]\n' $at $((40 + 30 * at))
done >>art/line.toml
mend art/line.toml "face_1.png: all control points lie on one line"
{ echo 'triangles = [[1, 2, 3]]'; sed 's/\[40, 40\]/[30, 70]/' art/line.toml; } >art/fold.toml
mend art/fold.toml "face_1.png: face 1 is folded over or flat here"
sed 's/\[9, 9\]/[nan, 9]/' art/line.toml >art/nan.toml
expect 3 vsprite points art/nan.toml; says "art/nan.toml:6: points: control point 1 is no place"; one_sentence
awk 'BEGIN { for (i = 0; i < 10000; ++i) printf "add 1 %d.5 %d\n", i % 300 + 1, int(i / 300) * 9 + i % 7 + 1 }' >many.txt
cp art/mine.toml art/many.toml
expect 0 timeout 30 "$BIN/vsprite" points art/many.toml --script many.txt
prints "10007 control points"

# A window without a person.
expect 0 vsprite points art/kept.toml --window --headless --frames 5 --record shot.png --json
is_json /saved
[ "$(file -b shot.png | cut -d, -f2)" = " 1280 x 760" ] || fail "no picture of the window"
DISPLAY= expect 1 env -u DISPLAY -u WAYLAND_DISPLAY "$BIN/vsprite" points art/kept.toml --window
says "no display"
finish
