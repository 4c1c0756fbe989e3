#!/usr/bin/env python3
"""Reads a rigged glTF file as an engine does, and writes what the engine has as a flat file for stranger.

  flatten.py FILE OUT [--all-keys]

It reads the default scene: nodes, skins, triangles, clips (glTF 2.0, sections 3.5, 3.7 and 3.11), and needs no package.
The frames are the default pose and three times of each of up to three clips; with --all-keys the keys of the first clip.
The flat file is little-endian: see read_engine in engine.c.
"""
import base64
import bisect
import json
import math
import pathlib
import struct
import sys

import matrix

WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
LETTER = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
NORMALIZED = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}


class File:
    def __init__(self, path):
        data = path.read_bytes()
        embedded = b""
        if data[:4] == b"glTF":
            length, = struct.unpack_from("<I", data, 12)
            self.json = json.loads(data[20:20 + length])
            embedded = data[20 + length + 8:]
        else:
            self.json = json.loads(data)
        self.buffers = [self.bytes_of(b, embedded, path.parent) for b in self.json["buffers"]]

    @staticmethod
    def bytes_of(buffer, embedded, folder):
        uri = buffer.get("uri")
        if uri is None:
            return embedded
        if uri.startswith("data:"):
            return base64.b64decode(uri[uri.index(",") + 1:])
        return (folder / uri).read_bytes()

    def read(self, index):
        """A list of tuples."""
        accessor = self.json["accessors"][index]
        if "sparse" in accessor:
            sys.exit("flatten.py: the file has sparse accessors, which it does not read")
        view = self.json["bufferViews"][accessor["bufferView"]]
        component = accessor["componentType"]
        one = struct.Struct(f"<{WIDTH[accessor['type']]}{LETTER[component]}")
        stride = view.get("byteStride", one.size)
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        data = self.buffers[view["buffer"]]
        out = [one.unpack_from(data, at + stride * i) for i in range(accessor["count"])]
        if accessor.get("normalized"):
            out = [tuple(max(x / NORMALIZED[component], -1.0) for x in v) for v in out]
        return out


def parents_of(nodes):
    parents = [-1] * len(nodes)
    for n, node in enumerate(nodes):
        for child in node.get("children", []):
            parents[child] = n
    return parents


def local_of(node, moved):
    """moved: what a clip gives for the node, path to values."""
    if "matrix" in node and not moved:
        return matrix.of_columns(node["matrix"])
    place = moved.get("translation", node.get("translation", (0, 0, 0)))
    turn = moved.get("rotation", node.get("rotation", (0, 0, 0, 1)))
    scale = moved.get("scale", node.get("scale", (1, 1, 1)))
    return matrix.chain(matrix.translation(*map(float, place)), matrix.of_quaternion(*turn), matrix.scaling(*map(float, scale)))


def worlds(nodes, parents, moved):
    out = [None] * len(nodes)

    def world(n):
        if out[n] is None:
            own = local_of(nodes[n], moved.get(n, {}))
            out[n] = own if parents[n] < 0 else matrix.product(world(parents[n]), own)
        return out[n]

    for n in range(len(nodes)):
        world(n)
    return out


def slerp(a, b, t):
    dot = sum(x * y for x, y in zip(a, b))
    if dot < 0:
        b, dot = tuple(-x for x in b), -dot
    if dot > 0.9999:
        return tuple(x * (1 - t) + y * t for x, y in zip(a, b))
    angle = math.acos(dot)
    return tuple((x * math.sin((1 - t) * angle) + y * math.sin(t * angle)) / math.sin(angle) for x, y in zip(a, b))


class Clip:
    def __init__(self, file, animation):
        self.channels = []
        for channel in animation["channels"]:
            target, sampler = channel["target"], animation["samplers"][channel["sampler"]]
            if "node" in target and target["path"] != "weights":
                times = [t[0] for t in file.read(sampler["input"])]
                mode = sampler.get("interpolation", "LINEAR")
                self.channels.append((target["node"], target["path"], times, file.read(sampler["output"]), mode))
        self.start = min(c[2][0] for c in self.channels)
        self.end = max(c[2][-1] for c in self.channels)

    @staticmethod
    def value(path, times, values, mode, time):
        last = len(times) - 1
        k = max(0, min(bisect.bisect_right(times, time) - 1, last))
        t = 0.0 if k == last or time <= times[0] else (time - times[k]) / (times[k + 1] - times[k])
        if mode == "CUBICSPLINE":
            if t == 0:
                return values[3 * k + 1]
            step = times[k + 1] - times[k]
            shares = 2 * t**3 - 3 * t**2 + 1, step * (t**3 - 2 * t**2 + t), -2 * t**3 + 3 * t**2, step * (t**3 - t**2)
            parts = values[3 * k + 1], values[3 * k + 2], values[3 * k + 4], values[3 * k + 3]
            return tuple(sum(s * p[i] for s, p in zip(shares, parts)) for i in range(len(parts[0])))
        if mode == "STEP" or t == 0:
            return values[k]
        if path == "rotation":
            return slerp(values[k], values[k + 1], t)
        return tuple(x * (1 - t) + y * t for x, y in zip(values[k], values[k + 1]))

    def moved(self, time):
        out = {}
        for node, path, times, values, mode in self.channels:
            out.setdefault(node, {})[path] = self.value(path, times, values, mode, time)
        return out


def frames_of(file, parents, all_keys):
    nodes = file.json["nodes"]
    frames = [worlds(nodes, parents, {})]
    for animation in file.json.get("animations", [])[:1 if all_keys else 3]:
        clip = Clip(file, animation)
        length = clip.end - clip.start
        times = clip.channels[0][2][1:] if all_keys else [clip.start + share * length for share in (0.25, 0.55, 0.85)]
        frames += [worlds(nodes, parents, clip.moved(time)) for time in times]
    return frames


def shown_nodes(document, parents):
    roots = set(document["scenes"][document.get("scene", 0)]["nodes"])
    out = []
    for n in range(len(parents)):
        top = n
        while parents[top] >= 0:
            top = parents[top]
        if top in roots and "mesh" in document["nodes"][n]:
            out.append(n)
    return out


class Writer:
    def __init__(self):
        self.parts = []

    def numbers(self, letter, values):
        values = list(values)
        self.parts.append(struct.pack(f"<{len(values)}{letter}", *values))

    def text(self, text):
        data = text.encode()
        self.numbers("I", [len(data)])
        self.parts.append(data)


def write_part(out, file, node, skin, primitive):
    attributes = primitive["attributes"]
    positions = file.read(attributes["POSITION"])
    influences = 0
    sets = []
    while skin >= 0 and f"JOINTS_{influences // 4}" in attributes:
        sets.append((file.read(attributes[f"JOINTS_{influences // 4}"]), file.read(attributes[f"WEIGHTS_{influences // 4}"])))
        influences += 4
    indices = [v[0] for v in file.read(primitive["indices"])] if "indices" in primitive else list(range(len(positions)))
    out.numbers("i", [node, skin])
    out.numbers("I", [len(positions), influences, len(indices)])
    for v in positions:
        out.numbers("f", v)
    for v in range(len(positions)):
        for joints, _ in sets:
            out.numbers("I", joints[v])
        for _, weights in sets:
            out.numbers("f", weights[v])
    out.numbers("I", indices)


def main():
    file = File(pathlib.Path(sys.argv[1]))
    document = file.json
    nodes = document["nodes"]
    parents = parents_of(nodes)
    frames = frames_of(file, parents, "--all-keys" in sys.argv)
    skins = document.get("skins", [])
    parts = [(n, nodes[n].get("skin", -1), primitive) for n in shown_nodes(document, parents)
             for primitive in document["meshes"][nodes[n]["mesh"]]["primitives"]]
    out = Writer()
    out.numbers("I", [0x54534b4e, len(nodes), len(skins), len(parts), len(frames)])
    for n, node in enumerate(nodes):
        out.text(node.get("name", ""))
    for skin in skins:
        out.numbers("I", [len(skin["joints"])])
        out.numbers("I", skin["joints"])
        binds = file.read(skin["inverseBindMatrices"]) if "inverseBindMatrices" in skin else None
        for j in range(len(skin["joints"])):
            out.numbers("f", binds[j] if binds else matrix.columns(matrix.identity()))
    for part in parts:
        write_part(out, file, *part)
    for frame in frames:
        for world in frame:
            out.numbers("f", matrix.columns(world))
    pathlib.Path(sys.argv[2]).write_bytes(b"".join(out.parts))


if __name__ == "__main__":
    main()
