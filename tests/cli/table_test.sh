#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Transitions that somebody edited, the sum set right: named, or solved as they are and played.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" circle c.mp4 200 || fail make_film
expect 0 vsprite build c.mp4 --max-size 64
samples=$(($(wc -l <c.work/samples.csv) - 1))
cp c.work/transitions.bin good.bin
edit() {
  cp good.bin c.work/transitions.bin
  "$BIN/edit_transitions" c.work/transitions.bin "$samples" "$1" || fail "edit_transitions $1"
}

edit absent
expect 3 vsprite solve --work c.work
says "c.work/transitions.bin: sample "; says " leads to sample $samples where 0 to $((samples - 1)) are due"
says "make it again with \`vsprite transitions --force transitions\`"; one_sentence
edit nan
expect 3 vsprite solve --work c.work
says " at a cost of nan where 0 or more is due"; one_sentence
expect 3 vsprite pack --work c.work -o c.vsp
says " at a cost of nan where 0 or more is due"; one_sentence

# A sprite in one of two parts, or in one that has no way back, goes where that part goes.
for what in islands sink; do
  edit $what
  expect 0 vsprite solve --work c.work
  prints "the kept samples fall into 2 parts, without a way from each to every other"
  expect 0 vsprite pack --work c.work -o $what.vsp --json
  is_json /directions/0/reachable /directions/7/reachable
  grep -q '"reachable": true' stdout || fail "$what: no direction is served"
  expect 0 vsprite info $what.vsp
  prints "serves "
  for seed in 1 2; do
    expect 0 timeout 60 "$BIN/vsprite" steer $what.vsp --frames 500 --seed $seed --json \
      --keys "0 right; 3 left; 6 up; 9 down; 12 rest; 15 none"
    grep -q '"freezes": 0' stdout || fail "$what: the sprite freezes"
    is_json /states_hash
  done
done
cp good.bin c.work/transitions.bin
expect 0 vsprite solve --work c.work
grep -q "fall into" stdout && fail "a good table is said to fall apart"
no_temporaries
finish
