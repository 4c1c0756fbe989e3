#!/usr/bin/env python3
"""Bakes the fox with bad and with good settings, and writes docs/faults.png. The picture shows faults of
a bake beside their cure.

    bakers/lab/tables/fault_picture.py --nook build/bakers/tool/nook --keep FOLDER fox_CC-BY.glb

All panels show the same pose from the front. The first panel is ray traced. Each bake then has two panels,
its AO above and its error below. Models and pictures are kept in FOLDER. Files that already exist there are
not made again. The script needs python3-pil and fonts-dejavu-core of Debian.
"""
import argparse
import json
import pathlib
import subprocess

from PIL import Image, ImageDraw, ImageFont

DOCS = pathlib.Path(__file__).resolve().parents[3] / "docs"
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"
# Pictures of `nook evaluate character` are rows of panels with this width: ray traced, model, error.
PANEL_PX, TITLE_PX, GAP_PX = 420, 64, 4
# The AO error at the end of the colour scale.
ERROR_END = 0.25
# The colours of viridis, with which the tool draws errors, from the end to the beginning of the scale.
VIRIDIS = [(253, 231, 37), (181, 222, 43), (110, 206, 88), (53, 183, 121), (31, 158, 137), (38, 130, 142), (49, 104, 142),
           (62, 73, 137), (72, 40, 120), (68, 1, 84)]
# For each bake: its name, its options, and what is wrong or right with it.
BAKES = (("fox_auto", ["--poses", "auto"], "fault: no clips fitted"),
         ("fox_few", ["--poses", "all", "--spheres", "4", "--key-points", "24"], "fault: 4 spheres"),
         ("fox_all", ["--poses", "all"], "cure: clips fitted,\ndefault spheres"))


def measured(nook, fox, name, options, folder):
    """Makes a draft bake with these options. Returns its error divided by the error of a static
    bake, and the picture of a pose."""
    model, report, images = folder / f"{name}.nook", folder / f"{name}.json", folder / f"img_{name}"
    if not model.exists():
        subprocess.run([nook, "bake", "character", fox, "--preset", "draft", *options, "-o", model, "--quiet"], check=True)
    if not report.exists():
        subprocess.run([nook, "evaluate", "character", fox, model, "--rays", "64", "--max-poses", "30", "--images", images,
                        "--report", report, "--quiet"], check=True)
    return json.loads(report.read_text())["rows"][0]["ratio_to_static_visible"], Image.open(images / "pose_0.png")


def panel(picture, index, words):
    out = Image.new("RGB", (PANEL_PX, picture.height + TITLE_PX), "white")
    out.paste(picture.crop((index * PANEL_PX, 0, (index + 1) * PANEL_PX, picture.height)), (0, TITLE_PX))
    ImageDraw.Draw(out).text((8, 4), words, font=ImageFont.truetype(FONT, 22), fill="black", spacing=4)
    return out


def colour_bar(height, colours):
    """Draws the colour scale of the errors. `colours` are the tool's colours from the end to the beginning of
    the scale."""
    out = Image.new("RGB", (PANEL_PX, height), "white")
    draw, font = ImageDraw.Draw(out), ImageFont.truetype(FONT, 22)
    top, bottom = TITLE_PX + 40, height - 60
    for y in range(top, bottom):
        draw.line((40, y, 90, y), fill=colours[(y - top) * (len(colours) - 1) // (bottom - 1 - top)])
    draw.text((110, top - 12), f"{ERROR_END} of the light\nor more", font=font, fill="black")
    draw.text((110, bottom - 14), "0: right", font=font, fill="black")
    draw.text((8, 4), "error", font=font, fill="black")
    return out


def between(colours, count):
    """Returns `count` colours, interpolated along a list of colours."""
    out = []
    for i in range(count):
        at = i * (len(colours) - 1) / (count - 1)
        first = min(int(at), len(colours) - 2)
        out.append(tuple(round(a + (b - a) * (at - first)) for a, b in zip(colours[first], colours[first + 1])))
    return out


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--nook", required=True, help="path of the program nook")
    parser.add_argument("--keep", type=pathlib.Path, required=True, help="keep models and pictures in this folder; files that it already contains are not made again")
    parser.add_argument("fox", help="the fox, a .glb file")
    args = parser.parse_args()
    above, below = [], []
    for name, options, words in BAKES:
        ratio, pose = measured(args.nook, args.fox, name, options, args.keep)
        if not above:
            above.append(panel(pose, 0, "ray traced"))
            below.append(colour_bar(above[0].height, between(VIRIDIS, 256)))
        above.append(panel(pose, 1, words))
        below.append(panel(pose, 2, f"{ratio:.2f} of a static\nbake's error"))
        print(name, ratio)
    width = len(above) * (PANEL_PX + GAP_PX) - GAP_PX
    sheet = Image.new("RGB", (width, 2 * above[0].height), "white")
    for y, panels in enumerate((above, below)):
        for x, each in enumerate(panels):
            sheet.paste(each, (x * (PANEL_PX + GAP_PX), y * above[0].height))
    sheet.save(DOCS / "faults.png", optimize=True)


if __name__ == "__main__":
    main()
