#!/usr/bin/env python3
"""nook build with many small assets: what runs after which change, and how long nothing takes.

  many_assets.py TOOL [COUNT [DISTINCT]]

makes COUNT skinned tubes (default 24) of DISTINCT forms (default 3), bakes one of each form into a cache, from which the others
come, and prints the seconds of a build in which nothing changed and of a fresh checkout: new times, no build folder, no outputs, a full
cache. Then it changes a texture, an unrelated file, a clip and a vertex, and counts the bakes. It also checks the schema of
manifests against the tool: both know the same keys. Exit code 0: every count is as it must be.
"""
import json
import math
import os
import pathlib
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCHEMA = ROOT / "docs/guide/nook.schema.json"
RINGS, SEGMENTS = 6, 6
SMALL = {"preset": "draft", "auto-poses": 8, "samples-per-clip": 2, "rays": 4, "steps": 4, "spheres": 2, "key-points": 4}


class Buffer:
    """Arrays of one glTF buffer, with a view and an accessor for each."""

    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def add(self, form, rows, kind, component):
        data = b"".join(struct.pack(f"<{len(row)}{form}", *row) for row in rows)
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        limits = {"min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]} if form == "f" else {}
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "count": len(rows), "type": kind, **limits})
        return len(self.accessors) - 1


def tube(name, radius, bend, moved=0.0):
    """A .gltf file, its buffer and its texture: two joints along x and one clip that bends the second."""
    buffer, corners, weights, joints, triangles = Buffer(), [], [], [], []
    for r in range(RINGS):
        for s in range(SEGMENTS):
            x, angle = r / (RINGS - 1), 2 * math.pi * s / SEGMENTS
            tip = min(max((x - 0.4) / 0.2, 0.0), 1.0)
            corners.append((x + (moved if r == s == 0 else 0), radius * math.cos(angle), radius * math.sin(angle)))
            weights.append((1 - tip, tip, 0, 0))
            joints.append((0, 1, 0, 0))
            if r + 1 < RINGS:
                a, b = r * SEGMENTS + s, r * SEGMENTS + (s + 1) % SEGMENTS
                triangles += [(i,) for i in (a, b, a + SEGMENTS, b, b + SEGMENTS, a + SEGMENTS)]
    unit = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]
    attributes = {"POSITION": buffer.add("f", corners, "VEC3", 5126), "JOINTS_0": buffer.add("B", joints, "VEC4", 5121),
                  "WEIGHTS_0": buffer.add("f", weights, "VEC4", 5126),
                  "TEXCOORD_0": buffer.add("f", [(c[0], 0.0) for c in corners], "VEC2", 5126)}
    indices = buffer.add("H", triangles, "SCALAR", 5123)
    bind = buffer.add("f", [unit + [0, 0, 0, 1], unit + [-0.5, 0, 0, 1]], "MAT4", 5126)
    times = buffer.add("f", [(0,), (1,)], "SCALAR", 5126)
    turns = buffer.add("f", [(0, 0, 0, 1), (0, 0, math.sin(bend), math.cos(bend))], "VEC4", 5126)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "skin": 0, "name": "body"}, {"name": "root", "children": [2]},
                  {"name": "tip", "translation": [0.5, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": f"{name}.png"}],
        "skins": [{"joints": [1, 2], "inverseBindMatrices": bind}],
        "animations": [{"name": "bend", "samplers": [{"input": times, "output": turns}],
                        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]}],
        "buffers": [{"byteLength": len(buffer.bytes), "uri": f"{name}.bin"}], "bufferViews": buffer.views,
        "accessors": buffer.accessors}
    return {f"{name}.gltf": json.dumps(document).encode(), f"{name}.bin": buffer.bytes, f"{name}.png": b"not read"}


def write(folder, files):
    for name, data in files.items():
        (folder / name).write_bytes(data)


def processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def require(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


class Project:
    def __init__(self, tool, folder, count, distinct):
        self.tool, self.folder, self.count = tool, pathlib.Path(folder), count
        self.assets = self.folder / "characters"
        self.assets.mkdir()
        self.distinct = distinct
        self.add(range(distinct))
        rules = [{"match": "characters/**/*.gltf", "options": SMALL}]
        (self.folder / "nook.json").write_text(json.dumps({"rules": rules}))

    def add(self, numbers):
        for i in numbers:
            write(self.assets, tube(f"asset_{i:04}", 0.1 + 0.01 * (i % self.distinct), 0.5))

    def build(self):
        """Returns (up to date, from the cache, run), and the seconds by the clock and of processor time as text."""
        began, used = time.perf_counter(), processor_s()
        done = subprocess.run([self.tool, "build", self.folder / "nook.json", "--cache", self.folder / "cache", "--isa", "native"],
                              capture_output=True, text=True)
        seconds = f"{time.perf_counter() - began:.2f} s, {processor_s() - used:.2f} s of processor time"
        require(done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:])
        numbers = re.search(r"(\d+) up to date, (\d+) from the cache, (\d+) to run", done.stdout)
        return tuple(map(int, numbers.groups())), seconds

    def fresh(self):
        for name in ("nook-build", "baked"):
            shutil.rmtree(self.folder / name)
        for file in self.assets.iterdir():
            os.utime(file)


def check_changes(project):
    first, second, third = (project.assets / f"asset_{i:04}" for i in range(3))
    first.with_suffix(".png").write_bytes(b"another picture")
    require(project.build()[0][2] == 0, "a texture bakes nothing")
    (project.folder / "notes.txt").write_text("unrelated")
    (project.assets / "notes.txt").write_text("unrelated")
    require(project.build()[0][2] == 0, "an unrelated file bakes nothing")
    write(project.assets, tube(second.name, 0.11, 0.7))
    require(project.build()[0][2] == 1, "a clip bakes one asset")
    write(project.assets, tube(third.name, 0.12, 0.5, moved=0.01))
    require(project.build()[0][2] == 1, "a vertex bakes one asset")
    require(project.build()[0] == (project.count, 0, 0), "then nothing is left to do")


def keys_of_tool(tool, folder, manifest):
    """The keys that the tool lists when it refuses an unknown one."""
    path = pathlib.Path(folder) / "keys.json"
    path.write_text(json.dumps(manifest))
    done = subprocess.run([tool, "plan", path, "--isa", "native"], capture_output=True, text=True)
    return set(re.search(r"the keys here are ([^.\n]*)", done.stderr).group(1).strip().split(", "))


def check_schema(tool, folder):
    schema = json.loads(SCHEMA.read_text())
    rule, part = schema["definitions"]["rule"]["properties"], schema["definitions"]["part"]["properties"]
    unknown = {"unknown": 1}
    require(keys_of_tool(tool, folder, unknown) == set(schema["properties"]), "the schema has the keys of a manifest")
    require(keys_of_tool(tool, folder, {"rules": [{"match": "*", **unknown}]}) == set(rule), "the schema has the keys of a rule")
    for name, keys in (("lods", rule["lods"]["properties"]), ("bent", part), ("clips", part)):
        listed = keys_of_tool(tool, folder, {"rules": [{"match": "*", name: unknown}]})
        require(listed == set(keys), f"the schema has the keys of {name}")
    try:
        import jsonschema
    except ImportError:
        print("python3-jsonschema is not installed: the examples were not validated")
        return
    page = (ROOT / "docs/guide/pipeline.md").read_text(encoding="utf-8")
    examples = [json.loads(text) for text in re.findall(r"^```json\n(.*?)^```", page, re.M | re.S)]
    require(examples, "docs/guide/pipeline.md has a manifest")
    for example in examples:
        jsonschema.validate(example, schema)
    for wrong in ({}, {"rules": []}, {"rules": [{"match": []}]}, {"rules": [{"match": "*", "bake": "cake"}]}, {"rules": [{}], "x": 1}):
        require(list(jsonschema.Draft7Validator(schema).iter_errors(wrong)), f"the schema refuses {wrong}")


def main():
    tool = pathlib.Path(sys.argv[1]).resolve()
    count, distinct = int((sys.argv[2:] or ["24"])[0]), int((sys.argv[3:] or ["3"])[0])
    require(distinct <= count and count >= 3, "COUNT is 3 or more, and DISTINCT at most COUNT")
    with tempfile.TemporaryDirectory(prefix="nook many ") as folder:
        check_schema(tool, folder)
        if not shutil.which("ninja"):
            print("there is no ninja; nothing was built")
            return
        project = Project(tool, folder, count, distinct)
        counts, seconds = project.build()
        require(counts == (0, 0, distinct), "the first build bakes everything")
        print(f"{distinct} bakes: {seconds}")
        project.add(range(distinct, count))
        counts, seconds = project.build()
        require(counts == (distinct, count - distinct, 0), "assets that equal others come from the cache")
        print(f"{count - distinct} more assets of the same forms: {seconds}")
        project.build()
        counts, seconds = project.build()
        require(counts == (count, 0, 0), "nothing changed, and nothing runs")
        print(f"warm: {seconds}")
        project.fresh()
        counts, seconds = project.build()
        require(counts == (0, count, 0), "a fresh checkout bakes nothing")
        print(f"fresh checkout: {seconds}")
        check_changes(project)


if __name__ == "__main__":
    main()
