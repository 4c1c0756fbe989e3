#!/usr/bin/env python3
"""Compresses the spatial modes of materials in blocks (BC4), and prints the texture memory and the S/E that it costs.

    docs/material_blocks.py RAW MATERIAL.nook [RAW MATERIAL.nook ...]

The materials are those of `nook bake material --bits 16`, the raw ones those of `--keep-raw`. A block of 4 x 4 texels has two ends of
eight bits and an index of three bits for each texel, half of what integers take. The S/E is that of the fitted views and lights,
without view maps and light maps. Besides all modes, those are compressed of which the cheapest together cost 0.2 dB of the half floats'.
"""
import pathlib
import struct
import sys

import numpy

from markdown_table import table
from material_rounding import Btf, sections, texture_scales

CELLS = 64 * 64  # of the view map and of the light map


def bytes_beside_modes(material, texels):
    """Bytes for each texel of the coefficients, memberships and light map of a file of K-CTA, and of the VOTF in integers."""
    files = sections(material)
    total = 0.0
    for name in ("BTF_", "VOTF"):
        if name not in files:
            continue
        w, h, light, view, _, _, clusters = struct.unpack_from("<7H", files[name], 0)
        terms = files[name][14]
        total += CELLS * (2 * terms * view + 8) / texels
        total += CELLS * 3 * light / texels if name == "BTF_" else clusters * view * 4 / 3
    return total


def blocks_of(images, width, height):
    """Images of texels x * height + y as blocks x 16."""
    return images.reshape(-1, width // 4, 4, height // 4, 4).transpose(0, 1, 3, 2, 4).reshape(-1, 16)


def images_of(blocks, width, height):
    return blocks.reshape(-1, width // 4, height // 4, 4, 4).transpose(0, 1, 3, 2, 4).reshape(-1, width * height)


def coded(blocks):
    """Blocks of numbers from -1 to 1 after BC4: ends of least squares for the nearest indices, four rounds."""
    low, high = blocks.min(1), blocks.max(1)
    best = numpy.full(len(blocks), numpy.inf)
    result = numpy.zeros_like(blocks)
    for _ in range(4):
        low, high = (numpy.round(numpy.clip(end, -1, 1) * 127) / 127 for end in (low, high))
        span = numpy.where(high > low, high - low, 1)
        share = numpy.clip(numpy.round((blocks - low[:, None]) / span[:, None] * 7), 0, 7) / 7
        values = low[:, None] + share * (high - low)[:, None]
        error = numpy.square(values - blocks).sum(1)
        better = error < best
        best[better], result[better] = error[better], values[better]
        # The normal equations of the two ends.
        a, b, c = numpy.square(1 - share).sum(1), (share * (1 - share)).sum(1), numpy.square(share).sum(1)
        p, q = ((1 - share) * blocks).sum(1), (share * blocks).sum(1)
        det = a * c - b * b
        sound = det > 1e-9
        safe = numpy.where(sound, det, 1)
        low, high = numpy.where(sound, (c * p - b * q) / safe, low), numpy.where(sound, (a * q - b * p) / safe, high)
    return result


def measured(raw, material):
    btf = Btf(raw, material)
    images = btf.images()
    clusters, light, view, texels = images.shape
    width, height = struct.unpack_from("<2H", sections(material)["BTF_"], 0)
    p, r = texture_scales(images, btf.light)
    scales = (r[None, :, None] * p[:, None, :])[..., None]
    unit = numpy.clip(images / scales, -1, 1)
    integers = (numpy.round(unit * 127) / 127 * scales).astype(numpy.float32)
    packed = (images_of(coded(blocks_of(unit, width, height)), width, height).reshape(images.shape) * scales).astype(numpy.float32)
    beside, mode = bytes_beside_modes(material, texels), 4 / 3
    whole, plain = btf.error_db(images), btf.error_db(integers)
    yield "integers", clusters * light * view * mode + beside, plain - whole
    yield "blocks", clusters * light * view * mode / 2 + beside, btf.error_db(packed) - whole
    # The weight of an image's error: the squares of its coefficients over the views.
    weight = numpy.zeros((clusters, view))
    for row, members in zip(btf.rows, btf.members):
        for term, cluster in zip(row, members):
            weight[cluster] += numpy.square(term)
    cost = numpy.square(packed - images).sum(-1) * weight[:, None, :]
    order = numpy.argsort(cost, axis=None)
    low, high = 0, len(order)
    while high - low > 1:
        middle = (low + high) // 2
        some = integers.copy().reshape(-1, texels)
        some[order[:middle]] = packed.reshape(-1, texels)[order[:middle]]
        loss = btf.error_db(some.reshape(images.shape)) - whole
        low, high = (middle, high) if loss > -0.2 else (low, middle)
        if low == middle:
            kept = loss
    if 0 < low < len(order) - 1:
        yield f"blocks for {100 * low / len(order):.0f} % of the modes", (len(order) - low / 2) * mode + beside, kept


def main():
    if len(sys.argv) < 3 or len(sys.argv) % 2 == 0:
        raise SystemExit(__doc__)
    rows = [[pathlib.Path(material).stem, form, f"{size:.0f}", f"{loss:.2f}"]
            for raw, material in zip(sys.argv[1::2], sys.argv[2::2]) for form, size, loss in measured(raw, material)]
    print(table(["material", "modes", "GPU, bytes for each texel", "S/E, dB, less half floats"], rows))


if __name__ == "__main__":
    main()
