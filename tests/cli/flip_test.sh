#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A film that goes one way only: alone it is steered where it goes; mirrored it turns round.
. "$(dirname "$0")/lib.sh"

"$BIN/make_film" line line.mp4 240 || fail make_film
expect 0 vsprite build line.mp4 -o one.vsp --json
grep -q '"flips": false' stdout || fail "it flips without mirror images"
expect 0 vsprite steer one.vsp --keys "0 left; 3 right; 5 up; 6 left; 7 right" --frames 250 --json
grep -q '"freezes": 0' stdout || fail "it freezes where it cannot go"
expect 2 vsprite transitions --work one.work --flip cut
says "use --mirror with it"; one_sentence

expect 0 vsprite build line.mp4 -o two.vsp --mirror --json
grep -q '"flips": true' stdout || fail "a film without a turn does not flip"
expect 0 vsprite steer two.vsp --keys "0 right; 2 left; 4 right; 5 left; 6 right" --frames 200 --trace t.csv --json
grep -q '"unfinished": 0' stdout || fail "it does not turn round"
# Two ticks after the key to the left, x falls.
awk -F, '$5 == "left" && before == "right" { key = $1 }
  key && $1 == key + 1 { turns++; late += $3 >= x }
  { before = $5; x = $3 }
  END { exit !(turns == 2 && late == 0) }' t.csv || fail "it takes more than two frames to turn round"

expect 0 vsprite build line.mp4 -o film.vsp --mirror --flip film --json
grep -q '"flips": false' stdout || fail "--flip film flips"
finish
