"""Finds out which vertex in Blender each vertex of a glTF file is.

A file splits a vertex if its corners differ in normal or UV, and stores the vertices in another order.
Positions alone are ambiguous, because the two sides of a cloth or the shells of hair may have the same
positions. Each vertex in the file therefore stores its index in Blender as an attribute. A float represents
integers up to 2^24 exactly. All corners of a vertex have the same attribute value, so it does not split
vertices.
"""
import json
import struct

import numpy as np

from .faults import Fault

NAME = "NOOK_VERTEX"
# The key in the file's `extras` that identifies the character to which the file belongs.
KEY = "nook_character"
LARGEST = 1 << 24
GLB_MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FORMATS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
TRIANGLES, TRIANGLE_FAN = 4, 6


def read_glb(data):
    """Returns the JSON and the binary chunk of a .glb file."""
    chunks, at = {}, 12
    if len(data) < 12 or struct.unpack_from("<I", data)[0] != GLB_MAGIC:
        raise Fault("the exported file is not a .glb file")
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        chunks[kind] = data[at + 8:at + 8 + length]
        at += 8 + length
    return json.loads(chunks.get(JSON_CHUNK, b"{}")), chunks.get(BINARY_CHUNK, b"")


def read_scalars(document, binary, accessor_number):
    """Returns the values of a scalar accessor."""
    accessor = document["accessors"][accessor_number]
    view = document["bufferViews"][accessor["bufferView"]]
    kind = np.dtype(FORMATS[accessor["componentType"]])
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize)
    return np.ndarray((accessor["count"],), kind, binary, begin, (stride,))


def read_vertex_numbers(data):
    """Returns the Blender indices of a file's vertices, in Nook's order. The mesh nodes are in the order of
    the file, and the primitives of a mesh follow one after another."""
    document, binary = read_glb(data)
    numbers = []
    for node in document.get("nodes", []):
        if "mesh" not in node:
            continue
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            if not TRIANGLES <= primitive.get("mode", TRIANGLES) <= TRIANGLE_FAN:
                continue
            # Exporters put one or two underscores before the names of custom attributes.
            found = [a for name, a in primitive["attributes"].items() if name.strip("_").upper() == NAME]
            if not found:
                raise Fault(f"the exported file has no attribute {NAME}; this glTF exporter does not write attributes, so use the exporter of Blender 3.4 or newer")
            numbers.append(np.rint(read_scalars(document, binary, found[0])).astype(np.int64))
    if not numbers:
        raise Fault("the exported file has no triangles")
    return np.concatenate(numbers)


def read_key(path):
    """Returns the key of the character to which a .glb file belongs. Returns None if the add-on did not write
    the file, or if it does not exist."""
    try:
        with open(path, "rb") as file:
            head = file.read(20)
            if len(head) < 20 or struct.unpack_from("<I", head)[0] != GLB_MAGIC:
                return None
            extras = json.loads(file.read(struct.unpack_from("<I", head, 12)[0])).get("asset", {}).get("extras")
    except (OSError, ValueError):
        return None
    return extras.get(KEY) if isinstance(extras, dict) else None
