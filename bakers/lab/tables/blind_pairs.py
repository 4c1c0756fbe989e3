#!/usr/bin/env python3
"""Makes pairs of pictures without names, in random order, from the sheets of `nook-lab evaluate nnao`, and counts
which picture of each pair was chosen. Each pair has Nook's default preset and another method, on one part of a view.

    nook-lab evaluate nnao --views docs/nnao_views.json --folder SCENES --size 1280x720 --rays 16 --no-raw \\
      --methods nnao:9,xegtao:18,hbao:16,gtao:16 --images SHEETS
    blind_pairs.py make SHEETS PAIRS          # 60 pictures, PAIRS/01.png and so on, and PAIRS/key.json
    blind_pairs.py count PAIRS ANSWERS...     # a file for each person, with lines such as `07 A`

A rule chooses the views: the first camera of every scene of the list, then second cameras, until there are 20. The
part is the 480 x 400 pixels with the largest spread of traced AO. Each picture shows the lit scene times AO, at
twice its size. People see no names, no reference and no key. Debian: python3-pil, python3-numpy.
"""
import argparse
import json
import math
import pathlib
import random

import numpy
from PIL import Image, ImageDraw, ImageFont

VIEWS = pathlib.Path(__file__).resolve().parents[3] / "docs/nnao_views.json"
WIDTH, HEIGHT, GAP, COLUMNS = 1280, 720, 4, 3  # of a panel and of the sheet (view_pictures.cpp)
PANELS = ["scene", "traced", "nnao", "xegtao", "hbao", "gtao"]
NAMES = {"xegtao": "XeGTAO High, tuned denoiser", "hbao": "HBAO 16, tuned blur", "gtao": "GTAO 16, tuned denoiser"}
VIEW_COUNT, PART, STEP = 20, (480, 400), 40
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"


def chosen_views():
    """Returns the names of pictures: the first camera of every scene, then the second one of each, and so on."""
    scenes = [scene for source in json.loads(VIEWS.read_text())["sources"] for scene in source["scenes"]]
    names = []
    for camera in range(max(len(scene["cameras"]) for scene in scenes)):
        names += [f"{scene['name']}_{scene['cameras'][camera]['name']}" for scene in scenes if camera < len(scene["cameras"])]
    return names[:VIEW_COUNT]


def read_panels(path):
    if not path.exists():
        raise SystemExit(f"{path} does not exist; draw the sheets with the command that --help shows")
    sheet = numpy.asarray(Image.open(path).convert("L"), dtype=numpy.float32) / 255
    panels = {}
    for i, name in enumerate(PANELS):
        left, top = i % COLUMNS * (WIDTH + GAP), i // COLUMNS * (HEIGHT + GAP)
        panels[name] = sheet[top:top + HEIGHT, left:left + WIDTH]
        if panels[name].shape != (HEIGHT, WIDTH):
            raise SystemExit(f"{path} has no panel of {WIDTH} x {HEIGHT} pixels for {name}; see the command in --help")
    return panels


def part_of(traced):
    """Returns the left and top pixel of the part with the largest spread of AO."""
    corners = [(x, y) for y in range(0, HEIGHT - PART[1] + 1, STEP) for x in range(0, WIDTH - PART[0] + 1, STEP)]
    return max(corners, key=lambda c: traced[c[1]:c[1] + PART[1], c[0]:c[0] + PART[0]].std())


def pair_picture(panels, left_method, right_method):
    x, y = part_of(panels["traced"])
    halves = []
    for method in (left_method, right_method):
        shaded = (panels["scene"] * panels[method])[y:y + PART[1], x:x + PART[0]]
        # The square root approximates the sRGB curve.
        grey = Image.fromarray(numpy.uint8(255 * numpy.sqrt(shaded.clip(0, 1)) + 0.5))
        halves.append(grey.resize((2 * PART[0], 2 * PART[1]), Image.NEAREST))
    picture = Image.new("L", (4 * PART[0] + 20, 2 * PART[1] + 60), 255)
    draw, font = ImageDraw.Draw(picture), ImageFont.truetype(FONT, 40)
    for i, half in enumerate(halves):
        picture.paste(half, (i * (2 * PART[0] + 20), 60))
        draw.text((i * (2 * PART[0] + 20) + PART[0], 8), "AB"[i], 0, font)
    return picture


def make(options):
    options.pairs.mkdir(parents=True, exist_ok=True)
    rng = random.Random(options.seed)
    pairs = [(view, peer) for view in chosen_views() for peer in NAMES]
    rng.shuffle(pairs)
    key = {}
    for number, (view, peer) in enumerate(pairs, 1):
        nook = rng.choice("AB")
        panels = read_panels(options.sheets / f"{view}_pairs.png")
        sides = ("nnao", peer) if nook == "A" else (peer, "nnao")
        pair_picture(panels, *sides).save(options.pairs / f"{number:02}.png")
        key[f"{number:02}"] = {"view": view, "peer": peer, "nook": nook}
    (options.pairs / "key.json").write_text(json.dumps(key, indent=1) + "\n")
    print(f"{len(key)} pairs in {options.pairs}; show the pictures, but not key.json")


def read_answers(path, key):
    answers = {}
    for line in filter(None, map(str.strip, path.read_text().splitlines())):
        number, _, side = line.partition(" ")
        if number not in key or side not in ("A", "B"):
            raise SystemExit(f"{path}: '{line}' is not an answer; each line is the number of a pair and A or B, such as 07 A")
        answers[number] = side
    if len(answers) != len(key):
        raise SystemExit(f"{path} answers {len(answers)} of {len(key)} pairs; need all")
    return answers


def bounds(chosen, count):
    """Returns Wilson's 95 % bounds of a share."""
    z, share = 1.96, chosen / count
    middle, spread = share + z * z / (2 * count), z * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return (middle - spread) / (1 + z * z / count), (middle + spread) / (1 + z * z / count)


def count(options):
    path = options.pairs / "key.json"
    if not path.exists():
        raise SystemExit(f"{path} does not exist; give the folder into which `make` wrote the pairs")
    key = json.loads(path.read_text())
    people = [read_answers(path, key) for path in options.answers]
    print("| Nook beside | chosen | of | share | 95 % bounds | each person |\n|---|---|---|---|---|---|")
    for peer, name in [*NAMES.items(), (None, "all")]:
        numbers = [n for n, pair in key.items() if peer in (None, pair["peer"])]
        each = [sum(answers[n] == key[n]["nook"] for n in numbers) for answers in people]
        chosen, total = sum(each), len(numbers) * len(people)
        low, high = bounds(chosen, total)
        print(f"| {name} | {chosen} | {total} | {chosen / total:.2f} | {low:.2f} to {high:.2f} | {', '.join(map(str, each))} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser("make", help="make the pairs")
    command.add_argument("sheets", type=pathlib.Path, help="folder of nook-lab's --images")
    command.add_argument("pairs", type=pathlib.Path, help="folder to write the pairs into")
    command.add_argument("--seed", type=int, default=1, help="seed of the order and the sides; default 1")
    command.set_defaults(run=make)
    command = commands.add_parser("count", help="count the answers")
    command.add_argument("pairs", type=pathlib.Path, help="folder of the pairs")
    command.add_argument("answers", type=pathlib.Path, nargs="+", help="file of one person's answers")
    command.set_defaults(run=count)
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
