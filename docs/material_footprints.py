#!/usr/bin/env python3
"""Filters the images of a raw material over the pixels of tilted views, and prints the error against supersampling.

    docs/material_footprints.py RAW [RAW ...]

A pixel is as wide as a texel across the view's tilt and 1 / cos(tilt) texels along it. The truth is the mean of 8 x 32 bilinear samples in
it. "isotropic" is one trilinear fetch at the mipmap level of the longer side, as in nook_material_decode; "N along" is the mean of N
fetches along the longer side, each at the level of the larger of the shorter side and an N-th of the longer one. Decoding is linear in the
images, so that filtering these filters the material. The error is the mean square over pixels, lights and the views beyond 60 degrees.
"""
import pathlib
import struct
import sys

import numpy

from markdown_table import table
from material_rounding import sections

PIXELS = 400


def mipmaps(image):
    """Means over 2 x 2 texels, lights x width x height; sides halve without rest as long as levels are needed."""
    levels = [image]
    while min(levels[-1].shape[1:]) % 2 == 0 and min(levels[-1].shape[1:]) > 3:
        levels.append(sum(levels[-1][:, i::2, j::2] for i in (0, 1) for j in (0, 1)) / 4)
    return levels


def bilinear(image, u, v):
    w, h = image.shape[1:]
    x, y = u * w - 0.5, v * h - 0.5
    i, j = numpy.floor(x).astype(int), numpy.floor(y).astype(int)
    s, t = x - i, y - j
    at = lambda a, b: image[:, a % w, b % h]
    return (at(i, j) * (1 - s) + at(i + 1, j) * s) * (1 - t) + (at(i, j + 1) * (1 - s) + at(i + 1, j + 1) * s) * t


def trilinear(levels, u, v, level):
    level = min(max(level, 0.0), len(levels) - 1.0)
    low = min(int(level), len(levels) - 2)
    return bilinear(levels[low], u, v) * (1 - level + low) + bilinear(levels[low + 1], u, v) * (level - low)


def errors(raw, fetches):
    data = sections(raw)
    lights, views, width, height = struct.unpack_from("<4I", data["HEAD"], 0)
    directions = numpy.frombuffer(data["DIRS"], numpy.float32).reshape(-1, 3)[lights:]
    btf = numpy.frombuffer(data["BTF_"], numpy.float16).reshape(3 * lights, views, width, height)
    random = numpy.random.default_rng(1)
    sums = {count: [] for count in fetches}
    for view in numpy.flatnonzero(directions[:, 2] < 0.5):
        levels = mipmaps(btf[:, view].astype(numpy.float32))
        along = directions[view, :2] / numpy.hypot(*directions[view, :2])
        across, long = numpy.array([-along[1], along[0]]), 1 / directions[view, 2]
        u, v = random.random((2, PIXELS))
        place = lambda a, b: (u + (along[0] * a + across[0] * b) / width, v + (along[1] * a + across[1] * b) / height)
        truth = numpy.mean([bilinear(levels[0], *place(((i + 0.5) / 32 - 0.5) * long, (j + 0.5) / 8 - 0.5))
                            for i in range(32) for j in range(8)], axis=0)
        for count in fetches:
            level = numpy.log2(max(1, long / count))
            drawn = numpy.mean([trilinear(levels, *place(((i + 0.5) / count - 0.5) * long, 0), level) for i in range(count)], axis=0)
            sums[count].append(numpy.square(drawn - truth).mean())
    return {count: float(numpy.mean(values)) for count, values in sums.items()}


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    fetches = (1, 2, 3, 4)
    rows = []
    for raw in sys.argv[1:]:
        found = errors(raw, fetches)
        rows.append([pathlib.Path(raw).stem, f"{found[1]:.2e}", *(f"{found[count] / found[1]:.2f}" for count in fetches[1:])])
    print(table(["material", "isotropic, mean square", *(f"{count} along, of it" for count in fetches[1:])], rows))


if __name__ == "__main__":
    main()
