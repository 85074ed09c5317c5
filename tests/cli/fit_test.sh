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

# views POINTS POINTS... : small.toml, a view of the face's picture for each list of points.
views() {
  printf '[[parameter]]\nname = "t"\nlow = 0\nhigh = 10\n' >art/small.toml
  local at=0 each
  for each; do
    printf '[[view]]\nfile = "face_%d.png"\nat = [%d]\npoints = [%s]\n' $((at % 5 + 1)) $at "$each"
    at=$((at + 1))
  done >>art/small.toml
}
refused() { expect 3 vsprite fit art/small.toml -o bad.vsp; says "art/small.toml: "; says "$1"; one_sentence; }
square='[10, 10], [60, 10], [60, 60], [10, 60]'
faces='triangles = [[1, 2, 3], [1, 3, 4]]'
views "$square" '[10, 10], [60, 10], [60, 60], [10, 70]'
expect 0 vsprite fit art/small.toml -o small.vsp
views "$square" '[10, 10], [20, 20], [30, 30], [60, 60]'
refused 'face_2.png: all control points lie on one line'
views "$square" "$(tr ' ' '\n' <<<"$square" | head -4 | tr '\n' ' ')"
refused 'face_2.png: 2 control points, the first view has 4: every view needs all of them'
views '[10, 10], [60, 10]' '[10, 10], [60, 10]'
refused '2 control points, at least 3 are due'
# The fourth corner crosses over to the other side of the diagonal: a fold, unless it is meant.
views "$square" '[10, 10], [60, 10], [60, 60], [70, 20]'
sed -i "1i $faces" art/small.toml
refused 'face_2.png: face 2 is folded over or flat here'
sed -i '1i allow_folds = true' art/small.toml
expect 0 vsprite fit art/small.toml -o small.vsp
sed -i 's/1, 3, 4/1, 3, 9/' art/small.toml
refused 'face 2 has control point 9 of 4'
views "$square" '[10, 10], [60, 10], [60, inf], [10, 60]'
expect 3 vsprite fit art/small.toml -o bad.vsp
says 'art/small.toml:12: points: control point 3 is no place'; one_sentence
# 10,000 points are no trouble.
many() { awk -v by="$1" 'BEGIN { for (i = 0; i < 10000; ++i)
  printf "%s[%d.%d, %d]", i ? ", " : "", i % 100 * 3 + by, i * 7 % 10, int(i / 100) * 3 + i * 13 % 3 }'; }
views "$(many 1)" "$(many 4)"
expect 0 timeout 20 "$BIN/vsprite" fit art/small.toml -o many.vsp
prints "10000 control points"
expect 0 vsprite validate many.vsp

# HyperBF: fewer centres than views, the same bytes again.
sed '1i centers = 3\ntraining = "random"\nsteps = 200\nseed = 4' art/john.toml >art/few.toml
expect 0 vsprite fit art/few.toml -o few.vsp
prints ", 3 centers"; prints "its points miss the views by"
expect 0 vsprite fit art/few.toml -o again.vsp --json
is_json /fit_error /puppets/0/centers
[ "$(sum few.vsp)" = "$(sum again.vsp)" ] || fail "the same seed gave other bytes"
sed -i 's/seed = 4/seed = 5/' art/few.toml
expect 0 vsprite fit art/few.toml -o other.vsp
[ "$(sum few.vsp)" = "$(sum other.vsp)" ] && fail "another seed gave the same bytes"
few() {
  sed "1i $1" art/john.toml >art/bad.toml
  expect 3 vsprite fit art/bad.toml -o bad.vsp; says "$2"; one_sentence
}
few 'centers = 6' 'centers: a whole number from 1 to 5 is due'
few 'steps = 10' 'steps: centers, the number of movable centres, is due beside it'
few 'centers = 2\ntraining = "slow"' '`slow`: gradient or random is due'
few 'centers = 2\ntemperature = -1' 'temperature: 0 or more is due'
few 'centers = 2\nsteps = 1e9' 'steps: a number from 0 to 1000000 is due'

# Example sets: two views of the same parameter, each in its own.
views "$square" '[20, 10], [70, 10], [70, 60], [20, 60]' '[20, 90], [70, 90], [70, 140], [20, 140]' \
  '[40, 90], [90, 90], [90, 140], [40, 140]'
sed -i 's/^at = \[2\]/at = [1]/' art/small.toml
cp art/small.toml art/two.toml
printf '[[set]]\nname = "up"\nviews = [1, 2]\njoins = ["down"]\n[[set]]\nname = "down"\nviews = [3, 4]\njoins = ["up"]\n' >>art/two.toml
refused 'has the same parameters as face_2.png'
expect 0 vsprite fit art/two.toml -o two.vsp
prints "2 sets of views"
expect 0 vsprite validate two.vsp
expect 0 vsprite info two.vsp --json
is_json /puppets/0/sets
sets() {
  sed "$1" art/two.toml >art/small.toml
  expect 3 vsprite fit art/small.toml -o bad.vsp; says "$2"; one_sentence
}
sets 's/joins = \["down"\]/joins = ["under"]/' 'joins: `under` is no other set'
sets 's/views = \[3, 4\]/views = [3, 5]/' 'views: whole numbers from 1 to 4 are due'
sets 's/views = \[3, 4\]/views = [4]/' 'set down: at least two views are due'
sets 's/views = \[1, 2\]/views = [1, 2, 3]/' 'has the same parameters as face_2.png'
sets '/^joins = \["down"\]/,$d' 'sets of views: 1, none or 2 to 64 are due'
finish
