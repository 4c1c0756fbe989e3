"""Writes .glb files. It uses only numpy, so that it can be tested without Blender."""
import json
import struct

import numpy as np

GLB_MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
COMPONENTS = {"float32": 5126, "uint32": 5125, "uint16": 5123}
TYPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


class Glb:
    def __init__(self):
        self.document = {"asset": {"version": "2.0", "generator": "Nook for Blender"}, "accessors": [], "bufferViews": []}
        self._chunks, self._size = [], 0

    def add(self, values, target=None, bounds=False):
        """Adds an accessor for an array and returns the index of the accessor."""
        values = np.ascontiguousarray(values)
        data = values.tobytes()
        view = {"buffer": 0, "byteOffset": self._size, "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        accessor = {"bufferView": len(self.document["bufferViews"]), "componentType": COMPONENTS[values.dtype.name], "count": len(values),
                    "type": TYPES[values.shape[1:]]}
        if bounds:
            rows = values.reshape(len(values), -1)
            accessor["min"], accessor["max"] = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
        self._chunks.append(data + bytes(-len(data) % 4))
        self._size += len(self._chunks[-1])
        self.document["bufferViews"].append(view)
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def to_bytes(self):
        binary = b"".join(self._chunks)
        text = json.dumps({**self.document, "buffers": [{"byteLength": len(binary)}]}, separators=(",", ":"), ensure_ascii=False).encode("utf-8")
        text += b" " * (-len(text) % 4)
        return b"".join((struct.pack("<III", GLB_MAGIC, 2, 28 + len(text) + len(binary)), struct.pack("<II", len(text), JSON_CHUNK), text,
                         struct.pack("<II", len(binary), BINARY_CHUNK), binary))


def to_turns(matrices):
    """Returns the translations, quaternions (x, y, z, w) and scales of an array of 4x4 matrices. Shear is
    lost."""
    scales = np.linalg.norm(matrices[:, :3, :3], axis=1)
    scales[np.linalg.det(matrices[:, :3, :3]) < 0] *= -1
    r = matrices[:, :3, :3] / np.where(scales == 0, 1, scales)[:, None, :]
    # There are four ways to compute a quaternion. The code uses the one with the largest divisor, which is
    # the most precise.
    squares = np.stack([1 + r[:, 0, 0] - r[:, 1, 1] - r[:, 2, 2], 1 - r[:, 0, 0] + r[:, 1, 1] - r[:, 2, 2],
                        1 - r[:, 0, 0] - r[:, 1, 1] + r[:, 2, 2], 1 + r[:, 0, 0] + r[:, 1, 1] + r[:, 2, 2]], axis=1)
    yx, zx, zy = r[:, 1, 0] + r[:, 0, 1], r[:, 2, 0] + r[:, 0, 2], r[:, 2, 1] + r[:, 1, 2]
    wx, wy, wz = r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]
    ways = np.stack([np.stack([squares[:, 0], yx, zx, wx], 1), np.stack([yx, squares[:, 1], zy, wy], 1),
                     np.stack([zx, zy, squares[:, 2], wz], 1), np.stack([wx, wy, wz, squares[:, 3]], 1)], axis=1)
    turns = ways[np.arange(len(r)), squares.argmax(axis=1)]
    turns /= np.maximum(np.linalg.norm(turns, axis=1, keepdims=True), 1e-30)
    return matrices[:, :3, 3].astype(np.float32), turns.astype(np.float32), scales.astype(np.float32)
