#!/usr/bin/env python3
"""Writes two light maps for docs/lab/world.md. street.hdr has a sky with a low sun, and hall.hdr a hall with
windows and lamps.

    bakers/lab/tables/world_maps.py FOLDER
"""
import math
import pathlib
import struct
import sys

WIDTH, HEIGHT = 512, 256
WALL, FLOOR, SKY = (0.05, 0.045, 0.04), (0.08, 0.06, 0.05), (3.0, 4.0, 6.0)


def direction(row, column):
    polar, around = (row + 0.5) / HEIGHT * math.pi, (column + 0.5) / WIDTH * 2 * math.pi - math.pi
    return math.sin(polar) * math.cos(around), math.cos(polar), math.sin(polar) * math.sin(around)


def angle(a, b):
    return math.acos(max(-1, min(1, sum(x * y for x, y in zip(a, b)))))


def street(d):
    """Returns the radiance of a clear sky over dark ground, with houses on both sides, and a sun with a glow
    at 25 degrees above the horizon."""
    sun = (math.cos(math.radians(25)) * 0.8, math.sin(math.radians(25)), math.cos(math.radians(25)) * 0.6)
    off = math.degrees(angle(d, sun))
    if off < 0.5:
        return 9000.0, 8000.0, 6500.0
    if d[1] < 0:
        return FLOOR
    if abs(d[2]) > 1.2 * d[1] and d[2] < 0:  # houses in shade
        return 0.12, 0.11, 0.11
    glow, haze = 6 * math.exp(-off / 8), math.exp(-4 * d[1])
    return 0.3 + 0.7 * haze + glow, 0.5 + 0.6 * haze + 0.9 * glow, 1.0 + 0.4 * haze + 0.7 * glow


def hall(d):
    """Returns the radiance of a hall. It has three high windows in one wall, two lamps at the ceiling, and a
    doorway at the other end."""
    x, y, z = d
    if x > 0.3 and 0.05 < y / x < 1.1 and any(abs(z / x - middle) < 0.18 for middle in (-0.8, 0.0, 0.8)):
        return SKY
    if any(angle(d, lamp) < math.radians(4) for lamp in ((-0.3, 0.9, 0.316), (-0.3, 0.9, -0.316))):
        return 30.0, 22.0, 14.0
    if z < -0.5 and abs(x / z) < 0.2 and -0.4 < y / -z < 0.5:
        return 1.5, 1.4, 1.2
    return FLOOR if y < -0.3 else WALL


def rgbe(rgb):
    exponent = math.frexp(max(rgb))[1]
    return struct.pack("4B", *(min(255, int(math.ldexp(c, 8 - exponent))) for c in rgb), exponent + 128)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for light in (street, hall):
        texels = b"".join(rgbe(light(direction(row, column))) for row in range(HEIGHT) for column in range(WIDTH))
        head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n"
        (folder / f"{light.__name__}.hdr").write_bytes(head.encode() + texels)


if __name__ == "__main__":
    main()
