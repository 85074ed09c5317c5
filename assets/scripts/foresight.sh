#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# What replacement search gains by looking ahead, on falling.toml: its cost against time for three
# seeds, beside beams of three widths over the same sum.
#     assets/scripts/foresight.sh VSPRITE PACK [SECONDS] [BEAMS] >curve.svg     the points go to stderr
set -eu
here=$(dirname "$0") vsprite=$1 pack=$2 seconds=${3:-10} beams=${4:-500 5000 50000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
run() { "$vsprite" path "$pack" --script "$here/falling.toml" --json --progress none --quiet "${@:2}" >"$work/$1.json"; }
for seed in 1 2 3; do run "replace $seed" --seconds "$seconds" --seed "$seed"; done
for beam in $beams; do run "beam $beam" --search beam --beam "$beam"; done
python3 - "$work" <<'END'
import json, math, pathlib, sys
runs = {p.stem: json.load(open(p)) for p in sorted(pathlib.Path(sys.argv[1]).glob("*.json"))}
print("run,seconds,cost", file=sys.stderr)
for name, run in runs.items():
    for p in run["curve"]:
        print("%s,%.3f,%.3f" % (name, p["seconds"], p["cost"]), file=sys.stderr)
left, top, width, height = 60, 46, 420, 260
t_low, t_high = 0.01, max(p["seconds"] for r in runs.values() for p in r["curve"])
c_low, c_high = 10, max(1000, max(p["cost"] for r in runs.values() for p in r["curve"]))
x = lambda t: left + width * math.log(max(t, t_low) / t_low) / math.log(t_high / t_low)
y = lambda c: top + height * (1 - math.log(max(c, c_low) / c_low) / math.log(c_high / c_low))
out = ["<svg xmlns='http://www.w3.org/2000/svg' width='640' height='370' viewBox='0 0 640 370' font-family='sans-serif' font-size='12' fill='#333'>",
       "<rect width='640' height='370' fill='#fff'/>",
       "<text x='60' y='22' font-size='15' font-weight='bold'>Gone before it falls: cost against seconds of search</text>"]
for c in (10, 20, 50, 100, 200, 500, 1000):
    out.append("<path d='M%d %.1fh%d' stroke='#ddd'/><text x='%d' y='%.1f' text-anchor='end'>%d</text>" % (left, y(c), width, left - 6, y(c) + 4, c))
for t in (0.01, 0.1, 1, 10, 100):
    if t <= t_high:
        out.append("<path d='M%.1f %dv%d' stroke='#ddd'/><text x='%.1f' y='%d' text-anchor='middle'>%g s</text>" % (x(t), top, height, x(t), top + height + 16, t))
for name, run in runs.items():
    points = [(p["seconds"], p["cost"]) for p in run["curve"]]
    if name.startswith("beam"):
        t, c = points[-1]
        out.append("<circle cx='%.1f' cy='%.1f' r='4' fill='#b4472c'/><text x='%.1f' y='%.1f' fill='#b4472c'>%s: %.0f</text>" % (x(t), y(c), x(t) + 8, y(c) + 4, name, c))
        continue
    path = "M%.1f %.1f" % (x(points[0][0]), y(points[0][1]))
    for t, c in points[1:]:
        path += "H%.1fV%.1f" % (x(t), y(c))
    out.append("<path d='%s' fill='none' stroke='#1f6fb4' stroke-width='1.5'/>" % path)
best = min(r["cost"] for n, r in runs.items() if n.startswith("replace"))
out.append("<text x='%d' y='%.1f' fill='#1f6fb4'>replacement, three seeds: %.1f at best</text>" % (left + 230, y(best) + 16, best))
print("\n".join(out) + "</svg>")
END
