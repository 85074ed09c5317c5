#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# How packs answer, beside the best of the paper's mode: the table and the floors of README.
#     assets/scripts/answers.sh BIN [PACK...] [-- options of `vsprite steer`]
# BIN holds `vsprite` and `madefilm`. Two made films are always among them; ANSWERS_WORK=DIR keeps
# them for the next time, and each pack's curve as DIR/NAME.svg.
set -eu
bin=$1
shift
packs=() options=(--seed 77)
while [ $# -gt 0 ] && [ "$1" != -- ]; do packs+=("$1"); shift; done
[ $# -gt 0 ] && shift && options=("$@")
work=${ANSWERS_WORK:-$(mktemp -d)}
[ -n "${ANSWERS_WORK:-}" ] || trap 'rm -rf "$work"' EXIT
for kind in walker sparse; do
  [ -d "$work/$kind" ] || "$bin/madefilm" "$kind" "$work/$kind"
  "$bin/vsprite" build "$work/$kind" -o "$work/$kind.vsp" --progress none >"$work/$kind.log" 2>&1
  packs+=("$work/$kind.vsp")
done
for pack in "${packs[@]}"; do
  name=$(basename "$pack" .vsp)
  "$bin/vsprite" steer "$pack" --bench --json --quiet --progress none -o "$work/$name.svg" "${options[@]}" >"$work/$name.json"
done
cat >"$work/table.py" <<'END'
import json, sys
names = [p.split('/')[-1][:-5] for p in sys.argv[1:]]
data = [json.load(open(p)) for p in sys.argv[1:]]
def row(title, cells):
    print('| ' + ' | '.join([title] + cells) + ' |')
def turns(p):
    return '%g and %g' % (p['frames_to_turn']['median'], p['frames_to_turn']['p95'])
def along(p):
    return '%.0f %%' % (100 * p['travel_share']['fast'])
def cost(p, key):
    return round(p['transition_cost'][key], 3)
def ours(d):
    return next(p for p in d['curves'] if p['mode'] == 'responsive' and p['default'])
# The paper's settings that keep to the direction and cost no more than ours.
def rivals(d, keys):
    return [p for p in d['curves'] if p['mode'] == 'paper' and p['tracking_error_deg']['worst'] <= 45
            and all(cost(p, k) <= cost(ours(d), k) for k in keys)]
def best(d, keys):
    found = rivals(d, keys)
    if not found:
        return 'no setting'
    fast = min(found, key=lambda p: (p['frames_to_turn']['median'], p['frames_to_turn']['p95']))
    return turns(fast) + '; ' + along(max(found, key=lambda p: p['travel_share']['fast']))
row('', names)
row('---', ['---'] * len(names))
row('responsive, as built: cap, worst direction',
    ['%g, %.1f degrees' % (ours(d)['settings']['cap'], ours(d)['tracking_error_deg']['worst']) for d in data])
row('frames to turn, median and 95 %', [turns(ours(d)) for d in data])
row('first picture that differs, median and 95 %',
    ['%g and %g' % (ours(d)['first_change']['median'], ours(d)['first_change']['p95']) for d in data])
row('transition cost, mean and 99 %', ['%.3f, %.3f' % (cost(ours(d), 'mean'), cost(ours(d), 'p99')) for d in data])
row('jumps a second', ['%.1f' % ours(d)['jumps_per_second'] for d in data])
row('travel along the command, goals changing every 0.3-0.7 s', [along(ours(d)) for d in data])
row('paper at no higher cost: frames to turn; best travel', [best(d, ['mean', 'p99']) for d in data])
row('paper at no higher 99 %: frames to turn; best travel', [best(d, ['p99']) for d in data])
row('paper at any cost: best travel', [along(max(rivals(d, []), key=lambda p: p['travel_share']['fast']))
                                       if rivals(d, []) else 'no setting' for d in data])
print()
caps = [f['cap'] for f in data[0]['floor'] if round(100 * f['cap']) in (50, 60, 70, 75, 80, 90, 100)]
row('cap', ['%g' % c for c in caps])
row('---', ['---'] * len(caps))
for name, d in zip(names, data):
    at = {f['cap']: f['median'] for f in d['floor']}
    row(name, ['never' if at[c] is None else '%g' % at[c] for c in caps])
END
files=()
for pack in "${packs[@]}"; do files+=("$work/$(basename "$pack" .vsp).json"); done
python3 "$work/table.py" "${files[@]}"
