#!/usr/bin/env python3
"""bakers/lab/tables/nnao_scenes.py on a repository of its own: a clone and a mirror give the same scene, and wrong bytes are refused.

The second check reads docs/nnao_views.json itself: every number that the script and `nook-lab evaluate nnao` read is there.
"""
import base64
import hashlib
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "bakers/lab/tables/nnao_scenes.py"


def require(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


def tiny_gltf():
    """A triangle in centimetres with z up, under a node that moves it by 100."""
    data = struct.pack("<9f", 0, 0, 0, 100, 0, 0, 0, 0, 200)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
        "nodes": [{"translation": [100, 0, 0], "children": [1]}, {"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": uri}]}).encode()


def make_repository(folder):
    """Returns the commit of a repository that holds tiny.gltf."""
    def git(*words):
        return subprocess.run(["git", "-C", str(folder), "-c", "user.name=n", "-c", "user.email=n@n", *words],
                              check=True, capture_output=True, text=True).stdout.strip()
    folder.mkdir(parents=True)
    git("init", "-q")
    for option in ("uploadpack.allowFilter", "uploadpack.allowAnySHA1InWant"):
        git("config", option, "true")
    (folder / "models").mkdir()
    (folder / "models/tiny.gltf").write_bytes(tiny_gltf())
    git("add", ".")
    git("commit", "-q", "-m", "tiny")
    return git("rev-parse", "HEAD")


def run(views, *words):
    return subprocess.run([sys.executable, str(SCRIPT), "--views", str(views), *map(str, words)],
                          capture_output=True, text=True)


def positions(path):
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    return struct.unpack_from("<9f", data, 28 + size)


def test_fetch():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        commit = make_repository(folder / "mirrors/someone/models")
        source = {"name": "source", "repository": (folder / "mirrors/someone/models").as_uri(), "commit": commit,
                  "scenes": [{"name": "tiny", "metres_per_unit": 0.01, "up": "z", "radius": 0.5, "cameras": [],
                              "files": [{"path": "models/tiny.gltf", "sha256": hashlib.sha256(tiny_gltf()).hexdigest()}]}]}
        views = folder / "views.json"
        views.write_text(json.dumps({"sources": [source]}))
        for place, words in (("cloned", []), ("mirrored", ["--mirrors", folder / "mirrors"])):
            done = run(views, folder / place, *words)
            require(done.returncode == 0, f"{place}: {done.stderr}")
            found = positions(folder / place / "tiny.glb")
            wanted = (1, 0, 0, 2, 0, 0, 1, 2, 0)
            require(all(abs(a - b) < 1e-6 for a, b in zip(found, wanted)), f"{place}: {found}")
        require((folder / "cloned/tiny.glb").read_bytes() == (folder / "mirrored/tiny.glb").read_bytes(), "the same bytes")
        source["scenes"][0]["files"][0]["sha256"] = "0" * 64
        views.write_text(json.dumps({"sources": [source]}))
        refused = run(views, folder / "refused", "--mirrors", folder / "mirrors")
        require(refused.returncode == 1 and "SHA-256" in refused.stderr, "wrong bytes are refused")
        require(not list((folder / "refused").iterdir()), "nothing is written of them")


def test_list():
    document = json.loads((ROOT / "docs/nnao_views.json").read_text())
    names, views = set(), 0
    for source in document["sources"]:
        for key in ("name", "kind", "author", "licence", "page"):
            require(source[key], f"{source['name']} has {key}")
        require(("repository" in source) == ("commit" in source), f"{source['name']}: a repository has a commit")
        for scene in source["scenes"]:
            require(scene["name"] not in names, f"{scene['name']} is there once")
            names.add(scene["name"])
            require(scene["metres_per_unit"] > 0 and scene["up"] in "yz", scene["name"])
            require(all(len(f["sha256"]) == 64 for f in scene["files"]), f"{scene['name']} has checksums")
            require(len({c["name"] for c in scene["cameras"]}) == len(scene["cameras"]) > 0, f"{scene['name']}'s cameras")
            views += len(scene["cameras"])
    require(views >= 30 and len(document["sources"]) >= 6, "30 views of 6 sources")


if __name__ == "__main__":
    test_fetch()
    test_list()
