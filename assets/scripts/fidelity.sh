#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# How well packs follow the four paths of this folder, scaled by the body length of each sprite:
#     assets/scripts/fidelity.sh VSPRITE PACK... [-- options of `vsprite path`]
set -eu
here=$(dirname "$0") vsprite=$1
shift
packs=() options=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do packs+=("$1"); shift; done
[ $# -gt 0 ] && shift
options=("$@")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
drawn_for=144  # px: the body length for which the paths were drawn
echo '| pack | path | seconds | median | 95 % | largest | frames over 45 degrees | jumps/s | found in, s |'
echo '|---|---|---|---|---|---|---|---|---|'
for pack in "${packs[@]}"; do
  body=$("$vsprite" info "$pack" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["body_length"])')
  for path in maze eight square zigzag; do
    awk -v s="$body" -v b="$drawn_for" '!/^#/ { print $1 * s / b, $2 * s / b }' "$here/$path.txt" >"$work/$path.txt"
    "$vsprite" path "$pack" --script "$work/$path.txt" --json --progress none "${options[@]}" |
      python3 -c 'import json, sys
d = json.load(sys.stdin); b = d["deviation_body"]
print("| %s | %s | %.1f | %.2f | %.2f | %.2f | %d of %d | %.1f | %.2f |" % (sys.argv[1], sys.argv[2],
  d["motion_seconds"], b["median"], b["p95"], b["max"], d["over_45_degrees"], d["frames"],
  d["jumps_per_second"], d["seconds"]))' "$(basename "$pack" .vsp)" "$path"
  done
done
