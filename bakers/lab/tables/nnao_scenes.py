#!/usr/bin/env python3
"""Fetches the scenes of docs/nnao_views.json into a folder, as .glb files for `nook-lab evaluate nnao --views`.

Each source names a git repository and a commit. Its files are read from a partial clone, so that only these
files are downloaded, or from the folder of git directories that you give with --mirrors. Files without a
repository are read from --assets. The SHA-256 of every file is checked before use. Each scene becomes one
mesh in metres, with y up. It does not have materials, because the measurement reads only geometry. This
script reads glTF itself. It converts other formats with `assimp export` (Debian: assimp-utils).
"""
import argparse
import array
import base64
import hashlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import urllib.parse

VIEWS = pathlib.Path(__file__).resolve().parents[3] / "docs/nnao_views.json"
IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)  # column-major, as in glTF
COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}
# Component types of glTF: the format code of `struct`, and the divisor of normalised integers.
TYPES = {5120: ("b", 127), 5121: ("B", 255), 5122: ("h", 32767), 5123: ("H", 65535), 5125: ("I", 1), 5126: ("f", 1)}


class Unusable(Exception):
    """Raised if a file is missing, differs from its checksum or cannot be read. The text names the file."""


class Gltf:
    """Reads the geometry of a glTF 2.0 file: the triangles of the default scene, in world space."""

    def __init__(self, path):
        data = path.read_bytes()
        self.folder, self.chunk = path.parent, b""
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            self.json = json.loads(data[20:20 + size])
            if len(data) > 28 + size:
                self.chunk = data[28 + size:28 + size + struct.unpack_from("<I", data, 20 + size)[0]]
        else:
            self.json = json.loads(data)
        packed = {"KHR_draco_mesh_compression", "EXT_meshopt_compression"} & set(self.json.get("extensionsRequired", []))
        if packed:
            raise Unusable(f"{path}: compressed with {', '.join(packed)}, which this script does not read")
        self.buffers = [self._buffer(b) for b in self.json.get("buffers", [])]

    def _buffer(self, buffer):
        uri = buffer.get("uri")
        if uri is None:
            return self.chunk
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (self.folder / urllib.parse.unquote(uri)).read_bytes()

    def values(self, index):
        """Reads the elements of an accessor. They are tuples, or numbers if the accessor is scalar."""
        accessor = self.json["accessors"][index]
        if "sparse" in accessor:
            raise Unusable("sparse accessors are not read")
        view = self.json["bufferViews"][accessor["bufferView"]]
        code, most = TYPES[accessor["componentType"]]
        width = COMPONENTS[accessor["type"]]
        element = struct.Struct(f"<{width}{code}")
        stride = view.get("byteStride", element.size)
        first = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        data = self.buffers[view["buffer"]]
        values = [element.unpack_from(data, first + i * stride) for i in range(accessor["count"])]
        if accessor.get("normalized"):
            values = [tuple(max(c / most, -1) for c in v) for v in values]
        return [v[0] for v in values] if width == 1 else values

    def triangles(self):
        """Returns positions in world space, and indices of triangles."""
        nodes = self.json["nodes"]
        world, shown = {}, []
        roots = self.json["scenes"][self.json.get("scene", 0)]["nodes"]
        open_nodes = [(n, IDENTITY) for n in roots]
        while open_nodes:
            n, parent = open_nodes.pop()
            world[n] = product(parent, local_matrix(nodes[n]))
            shown.append(n)
            open_nodes += [(child, world[n]) for child in nodes[n].get("children", [])]
        positions, indices = [], []
        for n in sorted(shown):
            if "mesh" not in nodes[n]:
                continue
            bones = self._bones(nodes[n]["skin"], world) if "skin" in nodes[n] else None
            for primitive in self.json["meshes"][nodes[n]["mesh"]]["primitives"]:
                self._append(primitive, world[n], bones, positions, indices)
        return positions, indices

    def _bones(self, skin, world):
        skin = self.json["skins"][skin]
        inverse = self.values(skin["inverseBindMatrices"])
        return [product(world[joint], m) for joint, m in zip(skin["joints"], inverse)]

    def _append(self, primitive, matrix, bones, positions, indices):
        mode, attributes = primitive.get("mode", 4), primitive["attributes"]
        if mode not in (4, 5, 6) or "POSITION" not in attributes:
            return
        first, places = len(positions), self.values(attributes["POSITION"])
        if bones and "JOINTS_0" in attributes:
            joints, weights = self.values(attributes["JOINTS_0"]), self.values(attributes["WEIGHTS_0"])
            positions += [skinned(p, j, w, bones) for p, j, w in zip(places, joints, weights)]
        else:
            positions += [transformed(matrix, p) for p in places]
        order = self.values(primitive["indices"]) if "indices" in primitive else range(len(places))
        order = [first + i for i in order]
        if mode == 5:
            order = [i for k in range(len(order) - 2) for i in order[k:k + 3]]
        elif mode == 6:
            order = [i for k in range(1, len(order) - 1) for i in (order[0], order[k], order[k + 1])]
        indices += order


def product(a, b):
    return tuple(sum(a[4 * k + row] * b[4 * column + k] for k in range(4)) for column in range(4) for row in range(4))


def transformed(m, p):
    return tuple(m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r] for r in range(3))


def skinned(place, joints, weights, bones):
    total = sum(weights) or 1
    parts = [(w / total, transformed(bones[j], place)) for j, w in zip(joints, weights) if w]
    return tuple(sum(w * p[r] for w, p in parts) for r in range(3))


def local_matrix(node):
    if "matrix" in node:
        return tuple(node["matrix"])
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    sx, sy, sz = node.get("scale", (1, 1, 1))
    rotation = (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),
                2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))
    columns = [[s * c for c in rotation[3 * i:3 * i + 3]] for i, s in enumerate((sx, sy, sz))]
    return (*columns[0], 0, *columns[1], 0, *columns[2], 0, *node.get("translation", (0, 0, 0)), 1)


def write_glb(path, positions, indices):
    """Writes one mesh. Unused vertices are kept, so that the bytes depend only on the source."""
    places = array.array("f", [c for p in positions for c in p])
    corners = array.array("I", indices)
    if sys.byteorder == "big":
        places.byteswap()
        corners.byteswap()
    low = [min(places[i::3]) for i in range(3)]
    high = [max(places[i::3]) for i in range(3)]
    size = 4 * len(places)
    document = {
        "asset": {"version": "2.0", "generator": "bakers/lab/tables/nnao_scenes.py"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": size},
                        {"buffer": 0, "byteOffset": size, "byteLength": 4 * len(corners)}],
        "buffers": [{"byteLength": size + 4 * len(corners)}]}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary = places.tobytes() + corners.tobytes()
    head = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
    part = path.with_name(f"{path.name}.nook-part-{os.getpid()}")
    part.write_bytes(head + struct.pack("<I4s", len(text), b"JSON") + text +
                     struct.pack("<I4s", len(binary), b"BIN\0") + binary)
    part.rename(path)
    return low, high


def as_gltf(path):
    """Returns the path of a glTF file with the same geometry. Converts the file if necessary."""
    if path.suffix in (".gltf", ".glb"):
        return path
    if not shutil.which("assimp"):
        raise Unusable(f"{path.name}: needs assimp's command-line tool (Debian: assimp-utils)")
    converted = path.with_suffix(".assimp.glb")
    run = subprocess.run(["assimp", "export", str(path), str(converted)], capture_output=True, text=True)
    if run.returncode != 0 or not converted.exists():
        raise Unusable(f"{path.name}: assimp export failed: {run.stdout[-400:]}{run.stderr[-400:]}")
    return converted


def convert(scene, source_file, target):
    """Converts a scene to metres, with y up. Returns the bounds and the number of triangles."""
    positions, indices = Gltf(as_gltf(source_file)).triangles()
    scale = scene.get("metres_per_unit", 1)
    turn = {"y": lambda p: p, "z": lambda p: (p[0], p[2], -p[1])}[scene.get("up", "y")]
    positions = [turn(tuple(scale * c for c in p)) for p in positions]
    low, high = write_glb(target, positions, indices)
    return low, high, len(indices) // 3


def git(folder, *words):
    run = subprocess.run(["git", "--git-dir", str(folder), *words], capture_output=True)
    if run.returncode != 0:
        raise Unusable(run.stderr.decode(errors="replace").strip()[-400:])
    return run.stdout


def mirror_of(mirrors, repository):
    """Returns the git directory of a repository in the folder of mirrors. It is named owner+name or
    owner/name, and may be bare or have a work tree."""
    owner, name = repository.removesuffix(".git").split("/")[-2:]
    for base in (mirrors / f"{owner}+{name}", mirrors / owner / name):
        for tail in ("repo/.git", "repo", ".git", ""):
            if (base / tail / "HEAD").exists():
                return base / tail
    raise Unusable(f"{mirrors} has no copy of {repository}")


def partial_clone(repository, commit, folder):
    """Makes a git directory that has the commit and downloads files one by one, on demand."""
    subprocess.run(["git", "init", "-q", "--bare", str(folder)], check=True)
    git(folder, "remote", "add", "origin", repository)
    git(folder, "config", "remote.origin.promisor", "true")
    git(folder, "config", "remote.origin.partialclonefilter", "blob:none")
    git(folder, "fetch", "-q", "--depth", "1", "--filter=blob:none", "origin", commit)
    return folder


class Files:
    """Reads the files of a source and checks them."""

    def __init__(self, source, options, scratch):
        self.source, self.options, self.scratch = source, options, scratch
        self.directory = None

    def _git_directory(self):
        if self.directory is None:
            url, commit = self.source["repository"], self.source["commit"]
            if self.options.mirrors:
                self.directory = mirror_of(self.options.mirrors, url)
            else:
                self.directory = partial_clone(url, commit, self.scratch / f"{self.source['name']}.git")
        return self.directory

    def read(self, file):
        if self.source.get("repository"):
            data = git(self._git_directory(), "cat-file", "blob", f"{self.source['commit']}:{file['path']}")
        elif self.options.assets and (self.options.assets / file["path"]).exists():
            data = (self.options.assets / file["path"]).read_bytes()
        else:
            raise Unusable(f"{file['path']}: not public as a file; give its folder with --assets ({self.source['page']})")
        found = hashlib.sha256(data).hexdigest()
        if found != file["sha256"]:
            raise Unusable(f"{file['path']}: SHA-256 is {found}, not {file['sha256']}")
        return data


def make_scene(scene, files, scratch, folder):
    base = pathlib.PurePosixPath(scene["files"][0]["path"]).parent
    for file in scene["files"]:
        place = scratch / scene["name"] / pathlib.PurePosixPath(file["path"]).relative_to(base)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(files.read(file))
    main = scratch / scene["name"] / pathlib.PurePosixPath(scene["files"][0]["path"]).name
    low, high, count = convert(scene, main, folder / f"{scene['name']}.glb")
    bounds = " ".join(f"{a:.2f}..{b:.2f}" for a, b in zip(low, high))
    print(f"{scene['name']}: {count} triangles, {bounds} m")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="write the .glb files into this folder")
    parser.add_argument("--views", type=pathlib.Path, default=VIEWS, help="read the list of scenes and their sources from this file; default docs/nnao_views.json")
    parser.add_argument("--mirrors", type=pathlib.Path, help="read the files from this folder instead of the network; it contains a git directory named owner+name for each repository")
    parser.add_argument("--assets", type=pathlib.Path, help="folder that contains the files that no repository has")
    parser.add_argument("--only", action="append", help="make only the scene with this name; you can repeat the option")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    failures = 0
    with tempfile.TemporaryDirectory() as scratch:
        for source in json.loads(options.views.read_text())["sources"]:
            files = Files(source, options, pathlib.Path(scratch))
            for scene in source["scenes"]:
                if options.only and scene["name"] not in options.only:
                    continue
                try:
                    make_scene(scene, files, pathlib.Path(scratch), options.folder)
                except (Unusable, OSError, KeyError, ValueError) as fault:
                    print(f"{scene['name']}: {fault}", file=sys.stderr)
                    failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
