#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Views to puppets: packs that validate, and views that are none.
. "$(dirname "$0")/lib.sh"
expect 0 "$BIN/draw_puppets" art
for name in face john jump arm; do
  expect 0 vsprite fit art/$name.toml -o $name.vsp
  expect 0 vsprite validate $name.vsp
  prints OK
done
expect 0 vsprite fit art/john.toml -o again.vsp --json
is_json /puppets/0/name /puppets/1/points /puppets/0/parameters/0/low
expect 0 vsprite info john.vsp
prints "puppet john: 80 control points"; prints "puppet jayne: "
expect 0 vsprite info face.vsp --json
is_json /puppets/0/parameters/1/name
[ "$(sum john.vsp)" = "$(sum again.vsp)" ] || fail "the same views gave other bytes"

expect 66 vsprite fit absent.toml -o x.vsp
one_sentence
expect 3 vsprite fit art/face_1.png -o x.vsp
says "a text is due that names the views"; one_sentence
expect 2 vsprite fit art/face.toml
says "-o PACK"; one_sentence
# bad SED TEXT: face.toml, spoilt so, is refused with exit 3 and these words.
bad() {
  sed "$1" art/face.toml >art/bad.toml
  expect 3 vsprite fit art/bad.toml -o bad.vsp
  says "$2"; one_sentence
  [ -e bad.vsp ] && fail "a pack was made of bad views"
}
bad 's/^name = "face"/name = 7/' 'art/bad.toml:1: name: a text in quotes is due'
bad 's/^name = "face"/kernl = "linear"/' 'is `kernel` meant?'
bad 's/^name = "face"/kernel = "cubic"/' '`cubic`: linear, gaussian, thin-plate or multiquadric is due'
bad 's/^name = "face"/kernel = "thin-plate"\ndegree = 0/' 'kernel thin-plate needs a polynomial of degree 1'
bad 's/^at = \[36, 0\]/at = [50, 0]/' 'rotation = 50 lies outside 0 to 36'
bad 's/^at = \[36, 0\]/at = [nan, 0]/' 'at: a number is due'
bad 's/^at = \[36, 0\]/at = [0, 0]/' 'has the same parameters as face_1.png'
bad 's/^points = \[\[[^]]*\]/points = [[nan, 3]/' 'control point 1 is no place'
bad 's/^points = \[\([^]]*\]\), \[[^]]*\]/points = [\1, \1/' 'control points 1 and 2 lie at the same place'
bad '/face_2.png/,/^$/s/^points = \[\[[^]]*\], /points = [/' 'every view needs all of them'
# One view only, and views of different sizes.
awk '/\[\[view\]\]/ { n++ } n < 2' art/face.toml >art/one.toml
expect 3 vsprite fit art/one.toml -o bad.vsp
says "at least two are due"; one_sentence
sed 's/face_3.png/john.png/' art/face.toml >art/sizes.toml
expect 3 vsprite fit art/sizes.toml -o bad.vsp
says "views of one size are due"; one_sentence
finish
