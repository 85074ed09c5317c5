#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# actions_test.sh GAME PACK - a key script plays actions in a game, and one that the pack does not
# have is refused. PACK: `tiny_pack FILE acting`.
set -eu
game=$1 pack=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_DATA_HOME=$work
run() { "$game" "$pack" --headless --frames 8 --keys "$1" --record "$work/$2.png" >"$work/$2.txt" 2>&1; }
run "0 right" without
run "0 right; 0.1 play wave 0" with
run "0 right; 0.1 play wave 0" again
if cmp -s "$work/without.png" "$work/with.png"; then echo "the action was not heard"; exit 1; fi
cmp "$work/with.png" "$work/again.png"
code=0
run "0 play fly" unknown || code=$?
[ "$code" = 2 ] || { echo "exit $code, 2 is due"; exit 1; }
grep -q 'error: key script: no action "fly", the pack has idle, .*wave$' "$work/unknown.txt"
