#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# --shadow: the shadow as pictures of the work folder and as a section of the pack.
# shadow_test.sh FOLDER_OF_THE_PROGRAMS
. "$(dirname "$0")/lib.sh"

"$BIN/make_film" shadow walk.mp4 150 || exit 77
sections() { vsprite info "$1" --json | tr -d ' \n' | grep -o '"name":"[A-Z]*"' | tr '\n' ' '; }

# Without the option there is nothing of it.
expect 0 vsprite build walk.mp4 -o plain.vsp
[ ! -e plain.work/shadows ] && [ ! -e plain.work/shadows.csv ] || fail "shadows without --shadow"
sections plain.vsp | grep -q SHDW && fail "a section SHDW without --shadow"

expect 0 vsprite build walk.mp4 -o shade.vsp --shadow --jobs 2
sections shade.vsp | grep -q SHDW || fail "no section SHDW"
expect 0 vsprite validate shade.vsp
shadows=$(($(wc -l <shade.work/shadows.csv) - 1))
samples=$(($(wc -l <shade.work/samples.csv) - 1))
[ "$(wc -l <plain.work/samples.csv)" = $((samples + 1)) ] || fail "other samples with --shadow"
[ "$shadows" -ge $((samples * 9 / 10)) ] || fail "$shadows shadows of $samples samples"
[ "$(ls shade.work/shadows | wc -l)" = "$shadows" ] || fail "shadows.csv and its folder differ"
no_temporaries

# The same bytes at another number of threads, and nothing to do a second time.
expect 0 vsprite build walk.mp4 -o other.vsp --shadow --jobs 1
[ "$(sum shade.vsp)" = "$(sum other.vsp)" ] || fail "--jobs changes the pack"
expect 0 vsprite build walk.mp4 -o shade.vsp --shadow
says "segment: up to date"; says "pack: up to date"

# A retouched shadow stays, and the pack alone is made again.
cp shade.work/shadows/"$(ls shade.work/shadows | sed -n 9p)" nine.png
size() { od -An -j16 -N8 -tx1 "$1"; }
for picture in shade.work/shadows/*.png; do
  [ "$(size "$picture")" = "$(size nine.png)" ] && [ "$(sum "$picture")" != "$(sum nine.png)" ] && break
done
if [ "$(size "$picture")" = "$(size nine.png)" ]; then
  cp nine.png "$picture"
  before=$(sum shade.vsp)
  expect 0 vsprite build walk.mp4 -o shade.vsp --shadow
  says "segment: up to date"; says "solve: up to date"
  [ "$(sum shade.vsp)" != "$before" ] || fail "a retouched shadow does not reach the pack"
  cmp -s nine.png "$picture" || fail "a retouched shadow was lost"
fi

# Another size, a missing picture, a bad table: each one sentence.
cp shade.work/sprites/000001.png "$picture"
expect 3 vsprite pack --work shade.work -o bad.vsp; one_sentence; says "keep the size when retouching"
rm "$picture"
expect 3 vsprite pack --work shade.work -o bad.vsp; one_sentence; says "is missing"
echo "7,no,2,1,1" >>shade.work/shadows.csv
expect 3 vsprite pack --work shade.work -o bad.vsp; one_sentence; says "five numbers are due"

# Mirrored samples have theirs; a smaller pack keeps those of its samples.
expect 0 vsprite build walk.mp4 -o mirror.vsp --shadow --mirror
expect 0 vsprite validate mirror.vsp
expect 0 vsprite build walk.mp4 -o small.vsp --shadow --budget 0.4
sections small.vsp | grep -q SHDW || fail "no section SHDW within a budget"
expect 0 vsprite validate small.vsp

# A cast: each clip's own, in the set's scale.
cat >cast.toml <<'TOML'
[[clip]]
file = "walk.mp4"
tag = "a"
frames = [0, 80]
[[clip]]
file = "walk.mp4"
tag = "b"
frames = [60, 149]
TOML
expect 0 vsprite build cast.toml -o cast.vsp --shadow
expect 0 vsprite validate cast.vsp
sections cast.vsp | grep -q SHDW || fail "no section SHDW in a cast"

# A film that brings its own coverage has no background that a shadow darkens.
expect 0 vsprite segment walk.mp4 --key none --min-clip 2 --work none.work --shadow
prints "warning: shadow: nothing is keyed"
finish
