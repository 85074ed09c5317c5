#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A subject that walks toward the camera and away, on a floor whose perspective is known: it becomes
# one size and one speed, and is drawn at the right size wherever it stands.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" floor floor.mp4 300 || fail "make_film"
expect 0 vsprite build floor.mp4 -o floor.vsp --horizon fit --focal 160 --json
cp stdout built.json
expect 0 vsprite validate floor.vsp; prints OK

# It stands where its feet are, on every frame: far and near, and seen from the side.
python3 "$(dirname "$0")/feet.py" floor.work || fail "the feet are not at the anchor"
film=walking.mp4; "$BIN/make_film" walk $film 60 || fail "make_film"
expect 0 vsprite segment $film --work flat.work --anchor ground
python3 "$(dirname "$0")/feet.py" flat.work || fail "the feet are not at the anchor"

# make_film: horizon at y = 30; 70 px of the line y = 110 around, once in 150 of 25 frames a second.
python3 - <<'END' || fail "not the floor of the film"
import csv, json, statistics, sys
floor = json.load(open("floor.work/manifest.json"))
def find(node):
    if isinstance(node, dict):
        if "floor" in node: return node["floor"]
        node = list(node.values())
    if isinstance(node, list):
        for each in node:
            found = find(each)
            if found: return found
floor = find(floor)
rows = list(csv.DictReader(open("floor.work/samples.csv")))
number = lambda key: [float(r[key]) for r in rows]
# On the film's own line, whatever line was taken as the nearest feet.
to_line = 80 / (floor["ground_line"] - floor["horizon"])
heights = [h * to_line for h in number("height")]
speeds = [(x * x + y * y) ** 0.5 * to_line for x, y in zip(number("velocity_x"), number("velocity_y"))]
due = 2 * 3.14159265 * 70 * 25 / 150
spread = lambda v: (max(v) - min(v)) / statistics.median(v)
near = sorted(range(len(rows)), key=lambda k: float(rows[k]["anchor_y"]))
far_half, near_half = near[:len(near) // 2], near[len(near) // 2:]
far = statistics.median(heights[k] for k in far_half)
close = statistics.median(heights[k] for k in near_half)
print("horizon %.1f, line %.1f; heights far %.1f, near %.1f; speed %.1f of %.1f" % (
    floor["horizon"], floor["ground_line"], far, close, statistics.median(speeds), due))
sys.exit(not (abs(floor["horizon"] - 30) < 3 and abs(far / close - 1) < 0.06 and
              abs(statistics.median(speeds) / due - 1) < 0.06 and len({r["scale"] for r in rows}) == 1))
END

# Drawn: the figure's height in the picture, against where its feet are.
# circle X Y RADIUS : on the ground, as the film goes round.
circle() { seq 0 11 | awk -v x="$1" -v y="$2" -v r="$3" '{ f = 1.5708 + $1 * 0.5236; print x + r * cos(f), y + r * sin(f) }'; }
# seen HORIZON LINE MIDDLE : points on the ground as a camera of 160 px sees them.
seen() { awk -v h="$1" -v l="$2" -v c="$3" '{ s = 160 / (160 - $2); print c + s * $1, h + (l - h) * s }'; }
circle 0 -80 70 | seen 30 110 80 >round.txt
expect 0 vsprite path floor.vsp --script round.txt --size 160x120 --beam 2000 -o round.mkv
expect 0 vsprite path floor.vsp --script round.txt --size 160x120 --beam 2000 -o round.json
ffmpeg -v error -y -i round.mkv -vf alphaextract -f rawvideo -pix_fmt gray alpha.raw || fail "no alpha"
python3 - <<'END' || fail "not drawn at the size of its place"
import json, sys
ticks = json.load(open("round.json"))["ticks"]
raw = open("alpha.raw", "rb").read()
sizes = []
for k, tick in enumerate(ticks):
    frame = raw[k * 19200:(k + 1) * 19200]
    rows = [y for y in range(120) if max(frame[160 * y:160 * y + 160]) > 127]
    if not rows: continue
    feet, height = rows[-1] + 1, rows[-1] + 1 - rows[0]
    sizes.append((feet, height, height / (feet - 30)))
    if abs(feet - tick["y"]) > 4: sys.exit("frame %d: feet at %d, said %.1f" % (k, feet, tick["y"]))
far, near = min(sizes), max(sizes)
print("far: feet %d, %d px high; near: feet %d, %d px high" % (far[:2] + near[:2]))
sys.exit(not (near[1] > 1.3 * far[1] and abs(far[2] / near[2] - 1) < 0.15))
END
# The same path given on the ground; another floor in the picture; none.
expect 0 vsprite path floor.vsp --script round.txt --plane none --beam 5000
circle 0 -62 65 >ground.txt
circle 0 -62 65 | seen 60 208 160 >other.txt
expect 0 vsprite path floor.vsp --script ground.txt --plane ground --size 160x120 --beam 2000 -o ground.mp4
expect 0 vsprite path floor.vsp --script other.txt --size 320x240 --horizon 60 --ground-line 208 \
  --focal 160 --beam 2000 -o other.mp4

# What cannot be.
expect 2 vsprite build floor.mp4 -o x.vsp --horizon low; says "fit or a number"; one_sentence
expect 3 vsprite segment floor.mp4 --work y.work --horizon 100; says "at the horizon"; one_sentence
"$BIN/make_film" line flat.mp4 150
expect 3 vsprite segment flat.mp4 --work z.work --horizon fit; says "or --horizon Y"; one_sentence
expect 2 vsprite path floor.vsp --script round.txt --horizon 20; says "--ground-line"; one_sentence
expect 2 vsprite path floor.vsp --script round.txt --horizon fit --size 160x120; one_sentence
expect 3 vsprite path floor.vsp --script round.txt --size 160x120 --horizon 95 --ground-line 120; says "above the horizon"; one_sentence
finish
