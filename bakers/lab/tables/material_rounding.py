#!/usr/bin/env python3
"""Rounds the parts of materials to 8 bits in several ways, one part at a time and all together. Prints the
loss of each way in dB.

    bakers/lab/tables/material_rounding.py RAW MATERIAL.nook [RAW MATERIAL.nook ...]

Make the materials with `nook bake material --bits 16`, and the raw materials with `--keep-raw`. The S/E is
measured at the fitted views and lights, without view maps and light maps.
"""
import pathlib
import struct
import sys

import numpy

from markdown_table import table


def sections(path):
    """Returns the sections of a .nook file, by name."""
    data = pathlib.Path(path).read_bytes()
    entries = [struct.unpack_from("<4sIQQ", data, 40 + 24 * i) for i in range(struct.unpack_from("<I", data, 32)[0])]
    return {name.decode(): data[offset:offset + size] for name, _, offset, size in entries}


class Numbers:
    """Reads packed half floats, in the format of sdk/src/material/packed_numbers.h."""

    def __init__(self, data, at):
        self.data, self.at = data, at

    def floats(self, *shape):
        count = int(numpy.prod(shape))
        exponent, = struct.unpack_from("<b", self.data, self.at)
        values = numpy.frombuffer(self.data, numpy.float16, count, self.at + 1).astype(numpy.float32) * 2.0 ** exponent
        self.at += 1 + 2 * count
        return values.reshape(shape).astype(numpy.float32)

    def indices(self, *shape):
        count = int(numpy.prod(shape))
        values = numpy.frombuffer(self.data, numpy.uint8, count, self.at).astype(int).reshape(shape)
        self.at += count
        return values


class Btf:
    """Reads the cores, bases, rows and light basis of a material, and its raw data."""

    def __init__(self, raw, material):
        files = sections(material)
        lights, views = struct.unpack_from("<2H", files["HEAD"], 0)
        w, h, light, view, x, y, clusters = struct.unpack_from("<7H", files["BTF_"], 0)
        terms = files["BTF_"][14]
        numbers = Numbers(files["BTF_"], 15)
        self.cores = numbers.floats(clusters, light, view, x, y)
        self.x = numbers.floats(clusters, w, x) if x < w else numbers.floats(0)
        self.y = numbers.floats(clusters, h, y) if y < h else numbers.floats(0)
        self.members = numbers.indices(views, terms) if clusters > 1 else numpy.zeros((views, terms), int)
        self.rows = numbers.floats(views, terms, view)
        self.light = Numbers(files["LGHT"], 0).floats(3 * lights, light)
        self.raw = numpy.frombuffer(sections(raw)["BTF_"], numpy.float16).reshape(3 * lights, views, w * h)

    def images(self, cores=None, x=None, y=None):
        """Returns the images S_c[a, b], clusters x light modes x view modes x texels."""
        images = self.cores if cores is None else cores
        x, y = self.x if x is None else x, self.y if y is None else y
        if x.size:
            images = numpy.einsum("cabpq,cxp->cabxq", images, x, optimize=True)
        if y.size:
            images = numpy.einsum("cabxq,cyq->cabxy", images, y, optimize=True)
        return images.reshape(*images.shape[:3], -1)

    def error_db(self, images, rows=None, light=None):
        rows, light = self.rows if rows is None else rows, self.light if light is None else light
        signal = error = 0.0
        for view in range(self.raw.shape[1]):
            modes = sum(numpy.tensordot(rows[view, k], images[c], (0, 1)) for k, c in enumerate(self.members[view]))
            truth = self.raw[:, view].astype(numpy.float32)
            signal += float(numpy.square(truth, dtype=float).sum())
            error += float(numpy.square(truth - light @ modes, dtype=float).sum())
        return 10 * numpy.log10(signal / error)


def rounded(values, axes, power=1.0, steps=127):
    """Rounds values to `steps` steps on each side of 0. All values along `axes` share one scale. A power
    below 1 makes the steps finer near 0."""
    scale = numpy.abs(values).max(axis=axes, keepdims=True)
    scale = numpy.where(scale > 0, scale, 1)
    unit = values / scale
    unit = numpy.round(numpy.sign(unit) * numpy.abs(unit) ** power * steps) / steps
    return (numpy.sign(unit) * numpy.abs(unit) ** (1 / power) * scale).astype(numpy.float32)


def texture_scales(images, light):
    """Returns the scales p_c[b] and r[a] of sdk/src/material/tables.cpp."""
    largest = numpy.abs(images).max(-1)
    r = largest.mean((0, 2))
    p = (largest / r[None, :, None]).max(1)
    r = (largest / p[:, None, :]).max((0, 2))
    r = numpy.sqrt(r) / numpy.sqrt(numpy.abs(light).max(0))
    return (largest / r[None, :, None]).max(1), r


def losses(btf):
    """Yields the name of each way to round, and the S/E that it loses."""
    images, whole = btf.images(), btf.error_db(btf.images())
    p, r = texture_scales(images, btf.light)
    scales = (r[None, :, None] * p[:, None, :])[..., None]
    textures = (numpy.round(images / scales * 127) / 127 * scales).astype(numpy.float32)
    light = (rounded(btf.light * r, (0, 1)) / r).astype(numpy.float32)
    slices = (3, 4)
    yield "S/E of half floats", whole
    for name, axes in (("images, one scale", (0, 1, 2, 3)), ("images, each cluster", (1, 2, 3)), ("images, each image", 3)):
        yield name, btf.error_db(rounded(images, axes)) - whole
    yield "images, each image, square root", btf.error_db(rounded(images, 3, 0.5)) - whole
    yield "images, p_c[b] r[a]", btf.error_db(textures) - whole
    yield "light, one scale", btf.error_db(images, light=rounded(btf.light, (0, 1))) - whole
    yield "light, times r[a], one scale", btf.error_db(images, light=light) - whole
    yield "coefficients, one scale", btf.error_db(images, rows=rounded(btf.rows, (0, 1, 2))) - whole
    yield "textures: images and light", btf.error_db(textures, light=light) - whole
    yield "cores, each cluster", btf.error_db(btf.images(rounded(btf.cores, (1, 2, 3, 4)))) - whole
    yield "cores, each slice", btf.error_db(btf.images(rounded(btf.cores, slices))) - whole
    yield "cores, each slice, square root", btf.error_db(btf.images(rounded(btf.cores, slices, 0.5))) - whole
    if btf.x.size and btf.y.size:
        bases = rounded(btf.x, (1, 2)), rounded(btf.y, (1, 2))
        yield "bases of x and y, each cluster", btf.error_db(btf.images(None, *bases)) - whole


def main():
    if len(sys.argv) < 3 or len(sys.argv) % 2 == 0:
        raise SystemExit(__doc__)
    files = list(zip(sys.argv[1::2], sys.argv[2::2]))
    found = [dict(losses(Btf(*pair))) for pair in files]
    names = list(dict.fromkeys(name for one in found for name in one))
    columns = ["", *(pathlib.Path(material).stem for _, material in files)]
    print(table(columns, [[name, *(f"{one[name]:.3f}" if name in one else "-" for one in found)] for name in names]))


if __name__ == "__main__":
    main()
