#!/usr/bin/env python3
"""Writes a raw (uncompressed) material, which `nook bake material --raw` compresses.

    raw_material.py hills.raw [--directions 25] [--texels 32]

Run as a program, it writes an example: matt hills, without shadows. To write your own material, import this file and call its
function write(). docs/materials.md describes the format. The script needs only numpy. It computes checksums faster if the Python
module xxhash or the library libxxhash is installed.
"""
import argparse
import ctypes
import ctypes.util
import os
import shutil
import struct

import numpy


def spiral_directions(count, max_tilt_deg=75):
    """Returns the same directions as `nook bake material`: on a spiral from the normal, each with about the same solid angle."""
    i = numpy.arange(count)
    z = 1 - (1 - numpy.cos(numpy.radians(max_tilt_deg))) * i / (count - 1)
    radius, azimuth = numpy.sqrt(1 - z**2), numpy.pi * (3 - numpy.sqrt(5)) * i
    return numpy.stack([radius * numpy.cos(azimuth), radius * numpy.sin(azimuth), z], 1)


P1, P2, P3 = 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9
P4, P5, MASK = 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5, 2**64 - 1


def _turned(v, bits):
    return (v << bits | v >> 64 - bits) & MASK


def _round(lane, word):
    return _turned(lane + word * P2 & MASK, 31) * P1 & MASK


def _plain_xxh64(data):
    """Computes XXH64 with seed 0 by its specification, in a few tenths of a second per megabyte."""
    whole = len(data) & ~31
    if whole:
        lanes = [(P1 + P2) & MASK, P2, 0, -P1 & MASK]
        for words in struct.iter_unpack("<4Q", memoryview(data)[:whole]):
            lanes = [_round(lane, word) for lane, word in zip(lanes, words)]
        value = sum(_turned(lane, bits) for lane, bits in zip(lanes, (1, 7, 12, 18))) & MASK
        for lane in lanes:
            value = ((value ^ _round(0, lane)) * P1 + P4) & MASK
    else:
        value = P5
    value = (value + len(data)) & MASK
    at = whole
    while at + 8 <= len(data):
        value ^= _round(0, int.from_bytes(data[at:at + 8], "little"))
        value = (_turned(value, 27) * P1 + P4) & MASK
        at += 8
    if at + 4 <= len(data):
        value ^= int.from_bytes(data[at:at + 4], "little") * P1 & MASK
        value = (_turned(value, 23) * P2 + P3) & MASK
        at += 4
    for byte in data[at:]:
        value = _turned(value ^ byte * P5 & MASK, 11) * P1 & MASK
    value = (value ^ value >> 33) * P2 & MASK
    value = (value ^ value >> 29) * P3 & MASK
    return value ^ value >> 32


def checksum(data):
    """Computes XXH64 with seed 0, by a library if one is installed."""
    try:
        import xxhash
        return xxhash.xxh64_intdigest(data)
    except ImportError:
        name = ctypes.util.find_library("xxhash")
    if not name:
        return _plain_xxh64(data)
    library = ctypes.CDLL(name)
    library.XXH64.restype = ctypes.c_uint64
    return library.XXH64(data, ctypes.c_size_t(len(data)), ctypes.c_uint64(0))


def _container(sections):
    offset, table = 40 + 24 * len(sections), b""
    for name, body in sections:
        table += struct.pack("<4sIQQ", name, 0, offset, len(body))
        offset += len(body)
    head = struct.pack("<4sII4sQ", b"NOOK", 0x01020304, 2, b"MRAW", offset)
    rest = struct.pack("<II", len(sections), 0) + table + b"".join(body for _, body in sections)
    return head + struct.pack("<Q", checksum(head + rest)) + rest


def _checked_directions(directions, what):
    directions = numpy.asarray(directions, "<f4")
    if directions.ndim != 2 or directions.shape[1] != 3:
        raise ValueError(f"{what}: got the shape {directions.shape}, need one row of x, y, z for each direction")
    if numpy.any(abs(numpy.linalg.norm(directions, axis=1) - 1) > 1e-3) or numpy.any(directions[:, 2] < 0):
        raise ValueError(f"{what}: every direction must have length 1 and z >= 0")
    return directions


def write(path, name, lights, views, radiance, mask=None):
    """Writes a raw material.

    lights, views: unit vectors, n x 3, that point away from the surface; x and y along it, z out of it
    radiance:      lights x 3 x views x width x height, red, green and blue, linear, for light of irradiance 1 on a
                   plane that faces it: a white matt plane under a light in z has 1 / pi. x and y count along the axes.
    mask:          views x width x height, true where the view meets the surface; None where it always does
    """
    lights, views = _checked_directions(lights, "lights"), _checked_directions(views, "views")
    with numpy.errstate(over="ignore"):  # what is too large becomes infinite and is refused below
        radiance = numpy.asarray(radiance, "<f2")
    if radiance.ndim != 5 or radiance.shape[:3] != (len(lights), 3, len(views)):
        raise ValueError(f"radiance: got the shape {radiance.shape}, need {len(lights)} x 3 x {len(views)} x width x height")
    if not numpy.all(numpy.isfinite(radiance)):
        raise ValueError("radiance: a number is not finite or larger than 65504")
    if mask is not None and numpy.shape(mask) != radiance.shape[2:]:
        raise ValueError(f"mask: got the shape {numpy.shape(mask)}, need {radiance.shape[2:]}")
    text = name.encode()
    head = struct.pack("<6I", len(lights), len(views), *radiance.shape[3:], mask is not None, len(text)) + text
    bits = b"" if mask is None else numpy.packbits(numpy.asarray(mask, bool).ravel(), bitorder="little").tobytes()
    _write_whole(path, _container([(b"HEAD", head), (b"DIRS", lights.tobytes() + views.tobytes()),
                                   (b"BTF_", radiance.tobytes()), (b"MASK", bits)]))


def _write_whole(path, data):
    """Writes a complete file, or leaves the old one. The new file keeps the mode of the file that it
    replaces. Pipes and devices are written to directly."""
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as out:
            out.write(data)
        return
    target = os.path.realpath(path)
    part = f"{target}.nook-part-{os.getpid()}"
    out = open(part, "xb")
    try:
        with out:
            out.write(data)
        if os.path.exists(target):
            shutil.copymode(target, part)
        os.replace(part, target)
    except BaseException:
        os.remove(part)
        raise


def hills(texels, lights):
    """Returns the radiance of matt hills, lights x 3 x texels x texels. The radiance does not depend on the view."""
    turn = 2 * numpy.pi * (numpy.arange(texels) + 0.5) / texels
    x, y = numpy.meshgrid(turn, turn, indexing="ij")
    # Slopes of the height field 0.05 (cos 2 x + cos y). Heights are in tiles.
    slope_x, slope_y = -0.1 * 2 * numpy.pi * numpy.sin(2 * x), -0.05 * 2 * numpy.pi * numpy.sin(y)
    normal = numpy.stack([-slope_x, -slope_y, numpy.ones_like(x)]) / numpy.sqrt(1 + slope_x**2 + slope_y**2)
    irradiance = numpy.clip(numpy.tensordot(lights, normal, 1), 0, None)
    colour = numpy.array([0.6, 0.4, 0.2])
    return irradiance[:, None] * colour[:, None, None] / numpy.pi


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", help="write the raw material to this file")
    parser.add_argument("--directions", type=int, default=25, help="number of view directions, which are also the light directions; default 25")
    parser.add_argument("--texels", type=int, default=32, help="number of texels along a side of the material; default 32")
    options = parser.parse_args()
    directions = spiral_directions(options.directions)
    one_view = hills(options.texels, directions)
    radiance = numpy.repeat(one_view[:, :, None], len(directions), 2)
    write(options.output, "hills", directions, directions, radiance)


if __name__ == "__main__":
    main()
