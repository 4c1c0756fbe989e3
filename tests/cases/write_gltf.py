"""Writes small glTF files into a folder; the standard library is enough."""
import json
import struct

FLOAT, U8, I8, U16, I16, U32 = 5126, 5121, 5120, 5123, 5122, 5125
FORMATS = {FLOAT: "f", U8: "B", I8: "b", U16: "H", I16: "h", U32: "I"}
SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Gltf:
    """A document and its buffer. `document` may be changed freely before `write`."""

    def __init__(self):
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}]}
        self.data = bytearray()

    def view(self, raw):
        self.data += bytes(-len(self.data) % 4)
        views = self.document.setdefault("bufferViews", [])
        views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)})
        self.data += raw
        return len(views) - 1

    def add(self, values, element, component=FLOAT, **more):
        raw = struct.pack(f"<{len(values)}{FORMATS[component]}", *values)
        accessors = self.document.setdefault("accessors", [])
        accessors.append({"bufferView": self.view(raw), "componentType": component,
                          "count": len(values) // SIZES[element], "type": element, **more})
        return len(accessors) - 1

    def write(self, path, uri=None):
        """A .glb, or a .gltf whose buffer is in the file that `uri` names; the caller writes that file."""
        document = {**self.document, "buffers": [{"byteLength": len(self.data)}]}
        if uri is not None:
            document["buffers"][0]["uri"] = uri
            path.write_text(json.dumps(document))
            return
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + bytes(-len(self.data) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)


def column(rings=40):
    """A closed column of `rings` rings with a skin of two joints, nodes 1 and 2, and a clip that turns node 2.
    Accessors: 0 positions, 1 joints, 2 weights, 3 indices, 4 inverse bind matrices, 5 key times, 6 rotations."""
    sides = ((0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2), (0.2, -0.2))
    position, joints, weights, index = [], [], [], []
    for ring in range(rings):
        y = 2 * ring / (rings - 1)
        tip = min(max(2 * y - 1.5, 0), 1)
        for x, z in sides:
            position += [x, y, z]
            joints += [0, 1, 0, 0]
            weights += [1 - tip, tip, 0, 0]
    for ring in range(rings - 1):
        for side in range(4):
            a, b = 4 * ring + side, 4 * ring + (side + 1) % 4
            index += [a, a + 4, b, b, a + 4, b + 4]
    top = 4 * rings - 4
    index += [0, 1, 2, 0, 2, 3, top, top + 2, top + 1, top, top + 3, top + 2]
    file = Gltf()
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    attributes = {"POSITION": file.add(position, "VEC3"), "JOINTS_0": file.add(joints, "VEC4", U8),
                  "WEIGHTS_0": file.add(weights, "VEC4")}
    primitive = {"attributes": attributes, "indices": file.add(index, "SCALAR", U16)}
    matrices = file.add(identity + identity[:13] + [-1, 0, 1], "MAT4")
    sampler = {"input": file.add([0, 1], "SCALAR"), "output": file.add([0, 0, 0, 1, 0, 0, 0.6, 0.8], "VEC4")}
    file.document |= {
        "nodes": [{"name": "armature", "children": [1, 3]}, {"name": "root", "children": [2]},
                  {"name": "tip", "translation": [0, 1, 0]}, {"name": "body", "mesh": 0, "skin": 0}],
        "meshes": [{"name": "column", "primitives": [primitive]}],
        "skins": [{"joints": [1, 2], "inverseBindMatrices": matrices}],
        "animations": [{"name": "bend", "samplers": [sampler],
                        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]}]}
    return file
