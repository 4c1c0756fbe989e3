#!/usr/bin/env python3
"""materials_visibility_picture.py RAW.png BINARY.png DISTANCES.png: writes docs/materials_visibility.png from
two pictures of samples/material with 960 x 540 pixels each. The vases of both pictures are side by side, at
twice their size. Below each vase is one of its holes, at six times its size.

docs/lab/materials.md has the commands that make the pictures.
"""
import pathlib
import sys

from png_lines import DOCS, read, write

# For each part: left, top, width and height, and the enlargement factor.
PARTS = (((630, 120, 180, 275), 2), ((693, 203, 60, 50), 6))
GAP = b"\xff" * (3 * 6)


def part(lines, box, scale):
    left, top, width, height = box
    for y in range(top, top + height):
        line = b"".join(bytes(lines[y][3 * x:3 * x + 3]) * scale for x in range(left, left + width))
        for _ in range(scale):
            yield line


def main():
    pictures = [read(pathlib.Path(path))[1] for path in sys.argv[1:4]]
    lines = []
    for box, scale in PARTS:
        lines += [GAP.join(row) for row in zip(*(part(picture, box, scale) for picture in pictures))]
    write(DOCS / "materials_visibility.png", len(lines[0]) // 3, lines)


if __name__ == "__main__":
    main()
