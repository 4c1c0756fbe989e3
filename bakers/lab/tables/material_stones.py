#!/usr/bin/env python3
"""Writes the base colour and height maps of a tile for `nook bake material --pbr`. The tile has 36 rounded
stones with joints between them.

    bakers/lab/tables/material_stones.py FOLDER
"""
import pathlib
import sys

import numpy

ACROSS, TEXELS = 6, 192


def write(path, values):
    """Writes a portable pixmap."""
    path.write_bytes(b"P6\n%d %d\n255\n" % (TEXELS, TEXELS) + (numpy.clip(values, 0, 1) * 255 + 0.5).astype(numpy.uint8).tobytes())


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    random, count = numpy.random.default_rng(3), ACROSS * ACROSS
    corners = numpy.stack(numpy.meshgrid(numpy.arange(ACROSS), numpy.arange(ACROSS)), -1).reshape(-1, 2)
    centres = (corners + random.uniform(0.15, 0.85, (count, 2))) / ACROSS
    colours = random.uniform(0.15, 0.6, (count, 1)) * numpy.array([1, 0.9, 0.75]) + random.uniform(-0.04, 0.04, (count, 3))
    along = (numpy.arange(TEXELS) + 0.5) / TEXELS
    x, y = numpy.meshgrid(along, along)
    distances = numpy.stack([numpy.hypot((x - p + 0.5) % 1 - 0.5, (y - q + 0.5) % 1 - 0.5) for p, q in centres])
    first, second = numpy.sort(distances, 0)[:2]
    height = numpy.clip((second - first) * ACROSS / 0.5, 0, 1) ** 0.4
    colour = numpy.where((height > 0.35)[..., None], colours[distances.argmin(0)], 0.12)
    write(folder / "stones_height.ppm", numpy.repeat(height[..., None], 3, 2))
    write(folder / "stones_diffuse.ppm", colour ** (1 / 2.2))


if __name__ == "__main__":
    main()
