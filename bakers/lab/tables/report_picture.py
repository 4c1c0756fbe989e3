#!/usr/bin/env python3
"""report_picture.py PAGE.html: writes docs/report.png from the pictures of a character's page. The first row
has four of the eight side views. The second row has the first pose: ray traced, from the model, and the
difference.

    nook report ual_mannequin_CC0.nook ual_mannequin_CC0.glb -o page.html && bakers/lab/tables/report_picture.py page.html
"""
import base64
import pathlib
import re
import sys
import tempfile

from png_lines import DOCS, read, write

GREY = bytes((82, 87, 97))
SIDES, POSE = (0, 2, 4, 6), 8


def pictures(page):
    """Returns the width and the lines of each picture on the page."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "picture.png"
        for text in re.findall(r"data:image/png;base64,([A-Za-z0-9+/=]+)", page):
            path.write_bytes(base64.b64decode(text))
            yield read(path)


def main():
    all_pictures = list(pictures(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")))
    sides, (width, pose) = [all_pictures[i] for i in SIDES], all_pictures[POSE]
    full = max(width, sum(side_width for side_width, _ in sides))

    def centred(line):
        left = (full - len(line) // 3) // 2
        return GREY * left + bytes(line) + GREY * (full - left - len(line) // 3)

    lines = [centred(b"".join(bytes(lines[y]) for _, lines in sides)) for y in range(len(sides[0][1]))]
    write(DOCS / "report.png", full, lines + [centred(line) for line in pose])


if __name__ == "__main__":
    main()
