# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
#
# Reads exports of one character back with programs that are not ours, and compares them.
#
#     export_read.py PNG-SEQ SHEET PACKER [--films APNG GIF WEBM MKV]
#
# All pictures are put together anew from the folder that `--to png-seq` wrote (the pack's own
# pixels); Pillow reads pages, APNG and GIF, ffmpeg the films.
import json, math, subprocess, sys
from pathlib import Path
from PIL import Image, ImageChops, ImageStat


def load(folder, name):
    return json.loads((folder / name).read_text())


def same(a, b, what):
    if a.size != b.size or a.tobytes() != b.tobytes():
        sys.exit(f"{what}: other pixels than the pack's")


def over(picture, grey):
    return Image.alpha_composite(Image.new("RGBA", picture.size, (grey, grey, grey, 255)), picture)


def psnr(a, b):
    """Of what is seen over black and over white, the worse of both."""
    worst = 99.0
    for grey in (0, 255):
        parts = ImageStat.Stat(ImageChops.difference(over(a, grey).convert("RGB"),
                                                     over(b, grey).convert("RGB"))).sum2
        error = sum(parts) / (3 * a.width * a.height)
        worst = min(worst, 10 * math.log10(255 * 255 / error) if error else 99.0)
    return worst


def sheet_runs(folder):
    """name -> [(canvas picture, ms, velocity)], and loops, of an Aseprite sheet."""
    runs = {}
    for name in sorted(folder.glob("page-*.json")):
        page = load(folder, name.name)
        image = Image.open(folder / page["meta"]["image"]).convert("RGBA")
        assert list(image.size) == [page["meta"]["size"]["w"], page["meta"]["size"]["h"]]
        for tag in page["meta"]["frameTags"]:
            assert tag["direction"] == "forward"
            run = runs.setdefault(tag["name"], [])
            for frame in page["frames"][tag["from"]:tag["to"] + 1]:
                run.append((picture_of(image, frame), frame["duration"], frame["velocity"]))
    return runs


def picture_of(image, frame):
    assert not frame["rotated"] and frame["trimmed"]
    r, at, size = frame["frame"], frame["spriteSourceSize"], frame["sourceSize"]
    assert (r["w"], r["h"]) == (at["w"], at["h"])
    assert 0 <= at["x"] and at["x"] + at["w"] <= size["w"]
    assert 0 <= at["y"] and at["y"] + at["h"] <= size["h"]
    canvas = Image.new("RGBA", (size["w"], size["h"]))
    canvas.paste(image.crop((r["x"], r["y"], r["x"] + r["w"], r["y"] + r["h"])), (at["x"], at["y"]))
    return canvas


def check_sheet_against_pack(sheet, pack):
    """Every picture of the sheet is one of the pack's, its anchor at the canvas's centre."""
    character = load(pack, "character.json")
    due = {}
    for s in character["samples"]:
        picture = Image.open(pack / s["file"]).convert("RGBA")
        due.setdefault((picture.size, picture.tobytes()), s)
    count = 0
    for run in sheet_runs(sheet).values():
        for canvas, ms, velocity in run:
            box = canvas.getchannel("A").point(lambda a: 255 if a else 0).getbbox()
            found = [s for (size, pixels), s in due.items()
                     if abs(canvas.width / 2 - s["anchor_x"]) + size[0] <= canvas.width + 1
                     and velocity == {"x": s["velocity_x"], "y": s["velocity_y"]}
                     and canvas.crop((at := (half(canvas.width, s["anchor_x"]),
                                             half(canvas.height, s["anchor_y"])))
                                     + (at[0] + size[0], at[1] + size[1])).tobytes() == pixels]
            assert box is None or found, "a picture that is not the pack's"
            count += 1
    print(f"{count} frames of the sheet are the pack's")


def half(side, anchor):
    return math.floor(side / 2 - anchor + 0.5)


def check_packer(folder, runs):
    """TexturePacker's pages hold the same runs; names are unique over the pages."""
    names, count = set(), len(list(folder.glob("page-*.json")))
    found = {}
    for number in range(count):
        page = load(folder, f"page-{number}.json")
        assert len(page["meta"].get("related_multi_packs", [])) == count - 1
        image = Image.open(folder / page["meta"]["image"]).convert("RGBA")
        assert not names & set(page["frames"]), "a name twice"
        names |= set(page["frames"])
        for name, order in page["animations"].items():
            found[name] = [picture_of(image, page["frames"][frame]) for frame in order]
    fps = page["meta"]["fps"]
    assert found.keys() == runs.keys()
    for name, run in runs.items():
        due = [p for p, ms, _ in run for _ in range(round(ms * fps / 1000))]
        assert len(due) == len(found[name])
        for a, b in zip(found[name], due):
            same(a, b, f"{folder}: {name}")
    print(f"{len(names)} frames of TexturePacker's form are the sheet's")


def film_frames(path, size, decoder=()):
    raw = subprocess.run(["ffmpeg", "-v", "error", *decoder, "-i", str(path), "-f", "rawvideo",
                          "-pix_fmt", "rgba", "-vsync", "0", "-"],
                         check=True, stdout=subprocess.PIPE).stdout
    step = 4 * size[0] * size[1]
    assert len(raw) % step == 0, f"{path}: not {size}"
    return [Image.frombytes("RGBA", size, raw[k:k + step]) for k in range(0, len(raw), step)]


def pillow_frames(path):
    """(picture, ms) of every frame."""
    image, out = Image.open(path), []
    for k in range(getattr(image, "n_frames", 1)):
        image.seek(k)
        out.append((image.convert("RGBA"), image.info.get("duration", 0)))
    assert len(out) == 1 or image.info.get("loop") == 0, f"{path}: does not loop for ever"
    return out


def seen(picture):
    """Without the colour of what is clear."""
    return Image.composite(picture, Image.new("RGBA", picture.size),
                           picture.getchannel("A").point(lambda a: 255 if a else 0))


def check_films(folders, runs):
    apng, gif, webm, mkv = folders
    worst = {"gif": 99.0, "webm": 99.0}
    for folder in folders:
        text = load(folder, "runs.json")
        assert [r["name"] for r in text["runs"]] == list(runs), f"{folder}: other runs"
        size = (text["width"], text["height"])
        for run in text["runs"]:
            due = [p for (p, _, _), ticks in zip(runs[run["name"]], run["durations"])
                   for _ in range(ticks)]
            path = folder / run["file"]
            if folder == mkv:
                got = film_frames(path, size)
            elif folder == webm:
                got = film_frames(path, size, ("-c:v", "libvpx-vp9"))
            else:
                shown = pillow_frames(path)
                ticks = [max(1, round(ms * text["fps"] / 1000)) for _, ms in shown]
                got = [p for (p, _), n in zip(shown, ticks) for _ in range(n)]
            assert len(got) == len(due), f"{path}: {len(got)} frames, {len(due)} are due"
            for a, b in zip(got, due):
                if folder in (apng, mkv):
                    same(seen(a), seen(b), path)
                elif folder == webm:
                    worst["webm"] = min(worst["webm"], psnr(a, b))
                else:
                    hard = b.copy()
                    hard.putalpha(b.getchannel("A").point(lambda v: 255 if v >= 128 else 0))
                    assert a.getchannel("A").tobytes() == hard.getchannel("A").tobytes(), path
                    worst["gif"] = min(worst["gif"], psnr(a, hard))
    print("PSNR at worst: " + ", ".join(f"{k} {v:.1f} dB" for k, v in worst.items()))
    assert worst["webm"] >= 30 and worst["gif"] >= 28


def main():
    folders = [Path(a) for a in sys.argv[1:] if a != "--films"]
    pack, sheet, packer = folders[:3]
    runs = sheet_runs(sheet)
    check_sheet_against_pack(sheet, pack)
    check_packer(packer, runs)
    if "--films" in sys.argv:
        check_films(folders[3:], runs)


main()
