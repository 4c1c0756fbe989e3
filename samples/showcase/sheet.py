#!/usr/bin/env python3
"""Combines the pictures of the program showcase into one picture, SHEET. The whole stage is at the top, split by lines into parts
without occlusion, with Nook and ray traced. Details are below.

  sheet.py FOLDER SHEET

FOLDER contains a folder for each camera (whole, feet and hands) with the files off.png, nook.png, traced.png and report.json
that showcase --out wrote. The script needs the Debian packages python3-pil and fonts-dejavu-core.
"""
import json
import pathlib
import sys

from PIL import Image, ImageDraw

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))
from animations import MAX_BYTES, label  # white words on a dark plate

KINDS = (("off", "No occlusion"), ("nook", "Nook"), ("traced", "Ray traced"))
SAMPLES_ACROSS = 4  # for the edges of split lines
# Where the split lines cross the middle of the picture, as shares of its width, and how far they lean, as
# shares of its height.
SPLITS, LEAN = (0.335, 0.735), 0.12
GAP = 6


def pictures(folder, shot):
    return [Image.open(folder / shot / f"{kind}.png").convert("RGB") for kind, _ in KINDS]


def named_with_errors(folder):
    """Returns the names of the pictures, with the mean squared error against the ray-traced picture."""
    errors = {row["picture"]: row["mse"] for row in json.loads((folder / "whole/report.json").read_text())["rows"]}
    return [f"{words}, mse {errors[kind]:.4f}" if kind in errors else words for kind, words in KINDS]


def split_x(split, y, size):
    return split * size[0] + LEAN * (size[1] / 2 - y)


def behind_lines(layers):
    """Shows the first layer left of the first line, the next one between the lines, and the last one right
    of the second line."""
    size = layers[0].size
    large = tuple(SAMPLES_ACROSS * n for n in size)
    sheet = layers[0].copy()
    for split, layer in zip(SPLITS, layers[1:]):
        top, bottom = split_x(split, 0, large), split_x(split, large[1], large)
        mask = Image.new("L", large, 0)
        ImageDraw.Draw(mask).polygon([(top, 0), (large[0], 0), large, (bottom, large[1])], fill=255)
        sheet.paste(layer, (0, 0), mask.resize(size, Image.LANCZOS))
        line = Image.new("L", large, 0)
        ImageDraw.Draw(line).line([(top, 0), (bottom, large[1])], fill=255, width=4 * SAMPLES_ACROSS)
        sheet.paste(Image.new("RGB", size, "white"), (0, 0), line.resize(size, Image.LANCZOS))
    return sheet


def details(folder, shots, width):
    """Puts the shots beside each other, each three times."""
    tiles = [(picture, words) for shot in shots for picture, (_, words) in zip(pictures(folder, shot), KINDS)]
    tile_width = (width - GAP * (len(tiles) - 1)) // len(tiles)
    row = Image.new("RGB", (width, round(tile_width * tiles[0][0].height / tiles[0][0].width)), "white")
    for i, (picture, words) in enumerate(tiles):
        # The last tile of a row is wider by the remainder of the division.
        right = width if i + 1 == len(tiles) else i * (tile_width + GAP) + tile_width
        tile = picture.resize((right - i * (tile_width + GAP), row.height), Image.LANCZOS)
        label(tile, 6, 6, words, 18)
        row.paste(tile, (i * (tile_width + GAP), 0))
    return row


def save(sheet, path):
    for quality in (92, 88, 84, 80, 76, 70):
        sheet.save(path, quality=quality, method=6)
        if path.stat().st_size <= MAX_BYTES:
            print(f"{path.name}: {sheet.width} x {sheet.height}, quality {quality}, {path.stat().st_size / 1e6:.2f} MB")
            return
    sys.exit(f"{path} is larger than {MAX_BYTES} bytes")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    whole = behind_lines(pictures(folder, "whole"))
    for left, words in zip((0, *SPLITS), named_with_errors(folder)):
        label(whole, round(left * whole.width + (LEAN * whole.height / 2 if left else 0)) + 18, 16, words, 28)
    shots = [shot for shot in ("feet", "hands") if (folder / shot).is_dir()]
    row = details(folder, shots, whole.width)
    sheet = Image.new("RGB", (whole.width, whole.height + GAP + row.height), "white")
    sheet.paste(whole, (0, 0))
    sheet.paste(row, (0, whole.height + GAP))
    save(sheet, pathlib.Path(sys.argv[2]))


if __name__ == "__main__":
    main()
