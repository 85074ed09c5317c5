# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# feet.py WORK : how far the anchor of every sprite of a work folder lies from its feet, px of the sprite. Fails where that
# is more than one. The feet are the lowest place at which the coverage of a column falls below a half: thin ones have no
# full pixel.
import csv, struct, sys, zlib


def alphas(path):
    """The rows of a PNG of 8-bit RGBA, alpha alone."""
    data, at, packed = open(path, "rb").read(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, form = struct.unpack(">IIBB", body[:10])
            assert (depth, form) == (8, 6), path
        if kind == b"IDAT":
            packed += body
        at += size + 12
    raw, stride, above, rows = zlib.decompress(packed), 4 * width, bytearray(4 * width), []
    for y in range(height):
        way, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            left = line[x - 4] if x >= 4 else 0
            corner = above[x - 4] if x >= 4 else 0
            guess = left + above[x] - corner
            nearest = min((left, above[x], corner), key=lambda v: abs(guess - v))
            line[x] = line[x] + (0, left, above[x], (left + above[x]) // 2, nearest)[way] & 255
        rows.append(line[3::4])
        above = line
    return rows


def feet_of(rows):
    lowest = 0
    for column in zip(*rows):
        last = max((y for y, a in enumerate(column) if a > 127), default=None)
        if last is not None:
            below = column[last + 1] if last + 1 < len(column) else 0
            lowest = max(lowest, last + 0.5 + (column[last] - 127.5) / (column[last] - below))
    return lowest


worst, count = (0, None), 0
for row in csv.DictReader(open(sys.argv[1] + "/samples.csv")):
    if int(row["mirror_of"]) >= 0:
        continue
    rows = alphas("%s/sprites/%06d.png" % (sys.argv[1], int(row["sample"])))
    feet = feet_of(rows)
    anchor = (float(row["anchor_y"]) - float(row["top"])) * float(row["scale"])
    worst = max(worst, (abs(feet - anchor), row["sample"]))
    count += 1
print("%d sprites, anchor at most %.2f px off the feet (sample %s)" % (count, *worst))
sys.exit(count == 0 or worst[0] > 1)
