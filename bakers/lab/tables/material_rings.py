#!/usr/bin/env python3
"""Writes a tile of chain mail for `nook bake material --meso`. It has rings of two metals that lean against
each other.

    bakers/lab/tables/material_rings.py rings.glb
"""
import json
import pathlib
import struct
import sys

import numpy

ACROSS, AROUND, TUBE = 4, 32, 10
RADIUS, THICKNESS, LEAN = 0.145, 0.032, 0.45  # tiles, tiles, radians
METALS = ((0.55, 0.32, 0.18, 1), (0.34, 0.36, 0.4, 1))


def ring(column, row):
    """Returns positions, normals and triangles of one ring. Rows of rings lean to alternating sides."""
    a, b = numpy.meshgrid(2 * numpy.pi * numpy.arange(AROUND) / AROUND, 2 * numpy.pi * numpy.arange(TUBE) / TUBE, indexing="ij")
    out = numpy.stack([numpy.cos(a), 0 * a, numpy.sin(a)], -1)
    normal = numpy.cos(b)[..., None] * out + numpy.sin(b)[..., None] * numpy.array([0, 1, 0])
    lean = LEAN * (1 if row % 2 else -1)
    turn = numpy.array([[1, 0, 0], [0, numpy.cos(lean), -numpy.sin(lean)], [0, numpy.sin(lean), numpy.cos(lean)]])
    middle = numpy.array([column + 0.5 + 0.5 * (row % 2), 0, row + 0.5]) / ACROSS
    position = (RADIUS * out + THICKNESS * normal) @ turn.T + middle
    i, j = numpy.meshgrid(numpy.arange(AROUND), numpy.arange(TUBE), indexing="ij")
    at = lambda p, q: (p % AROUND) * TUBE + q % TUBE
    quads = numpy.stack([at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)], -1)
    return position.reshape(-1, 3), (normal @ turn.T).reshape(-1, 3), quads.reshape(-1)


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    parts, views, accessors, primitives = [], [], [], []

    def add(values, kind, component):
        data = values.tobytes()
        views.append({"buffer": 0, "byteOffset": sum(map(len, parts)), "byteLength": len(data)})
        parts.append(data)
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(values), "type": kind})
        if kind == "VEC3":
            accessors[-1].update(min=values.min(0).tolist(), max=values.max(0).tolist())
        return len(accessors) - 1

    for metal in range(2):
        rings = [ring(column, row) for row in range(metal, ACROSS, 2) for column in range(ACROSS)]
        positions, normals = (numpy.concatenate([r[n] for r in rings]).astype(numpy.float32) for n in (0, 1))
        indices = numpy.concatenate([r[2] + n * AROUND * TUBE for n, r in enumerate(rings)]).astype(numpy.uint32)
        primitives.append({"attributes": {"POSITION": add(positions, "VEC3", 5126), "NORMAL": add(normals, "VEC3", 5126)},
                           "indices": add(indices, "SCALAR", 5125), "material": metal})
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": primitives}], "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": sum(map(len, parts))}],
                "materials": [{"pbrMetallicRoughness": {"baseColorFactor": colour}} for colour in METALS]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(parts)
    pathlib.Path(sys.argv[1]).write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body)) + struct.pack("<I4s", len(text), b"JSON") + text +
                                          struct.pack("<I4s", len(body), b"BIN\0") + body)


if __name__ == "__main__":
    main()
