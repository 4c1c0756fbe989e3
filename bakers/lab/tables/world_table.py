#!/usr/bin/env python3
"""Bakes a table (a model without a skin), measures how it darkens other surfaces, and draws
docs/world_table.png.

    bakers/lab/tables/world_table.py [--tool build/bakers/tool/nook] [--out out/world_table]
"""
import argparse
import json
import pathlib
import shutil
import struct
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
# Opposite corners of blocks in metres: the table top and four legs.
LEGS = [([x - 0.035, 0, z - 0.035], [x + 0.035, 0.71, z + 0.035]) for x in (-0.765, 0.765) for z in (-0.415, 0.415)]
BLOCKS = [([-0.8, 0.71, -0.45], [0.8, 0.75, 0.45]), *LEGS]


def block_faces(low, high):
    """Yields four corners and a normal for each face."""
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end, side in ((low, -1), (high, 1)):
            corners = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = [0, 0, 0]
                corner[axis] = end[axis]
                corner[u] = (low, high)[a][u]
                corner[v] = (low, high)[b][v]
                corners.append(corner)
            normal = [0, 0, 0]
            normal[axis] = side
            yield (corners if side > 0 else corners[::-1]), normal


def write_glb(path):
    positions, normals, indices = [], [], []
    for low, high in BLOCKS:
        for corners, normal in block_faces(low, high):
            indices += [len(positions) + i for i in (0, 1, 2, 0, 2, 3)]
            positions += corners
            normals += [normal] * 4
    vectors = [b"".join(struct.pack("<3f", *v) for v in values) for values in (positions, normals)]
    parts = [*vectors, struct.pack(f"<{len(indices)}I", *indices)]
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                  "min": [min(p[i] for p in positions) for i in range(3)],
                  "max": [max(p[i] for p in positions) for i in range(3)]},
                 {"bufferView": 1, "componentType": 5126, "count": len(normals), "type": "VEC3"},
                 {"bufferView": 2, "componentType": 5125, "count": len(indices), "type": "SCALAR"}]
    mesh = {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [mesh], "buffers": [{"byteLength": offset}], "bufferViews": views, "accessors": accessors}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data = b"".join(parts)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=pathlib.Path, default=ROOT / "build/bakers/tool/nook", help="path of the program nook; default build/bakers/tool/nook")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/world_table", help="write the model and reports into this folder; default out/world_table")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    mesh, model, report = (options.out / name for name in ("table.glb", "table.nook", "table.json"))
    write_glb(mesh)
    tool = str(options.tool)
    subprocess.run([tool, "bake", "character", mesh, "-o", model, "--preset", "draft", "--quiet"], check=True)
    subprocess.run([tool, "evaluate", "world", mesh, model, "--max-poses", "12", "--report", report, "--images", options.out,
                    "--image-count", "1", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    for row in json.loads(report.read_text())["rows"]:
        if row["method"] == "nook":
            print(row["surface"], row.get("degrees", ""), f"{row['over_none']:.3f}")
    shutil.copy(options.out / "pose_0.png", ROOT / "docs/world_table.png")


if __name__ == "__main__":
    main()
