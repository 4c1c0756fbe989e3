#!/usr/bin/env python3
"""stored_choice_test.py FOLDER TOOL: the choice of meshes of a bake (--mesh, --without) is in its file, and commands that read the
file with the character again take it and say so.

A column has a copy of itself, which is left out. Without the choice, the character has twice as many vertices and fits no model."""
import json
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
from write_gltf import column, Gltf, U16  # noqa: E402

SMALL = ["--preset", "draft", "--auto-poses", "8", "--samples-per-clip", "4", "--rays", "16", "--steps", "20", "--spheres", "8",
         "--key-points", "12"]
SAID = 'was baked with --without "copy"; this command reads the same meshes'


def with_copy(path):
    file = column()
    attributes = file.document["meshes"][0]["primitives"][0]["attributes"]
    attributes["TEXCOORD_0"] = file.add([x for v in range(160) for x in (v % 4 / 4, v / 160)], "VEC2")
    file.document["nodes"].append({"name": "copy", "mesh": 0, "skin": 0})
    file.document["nodes"][0]["children"].append(4)
    file.write(path)


def box(low, high, inwards):
    """Corners and indices of a box."""
    corners = [(high if i >> axis & 1 else low)[axis] for i in range(8) for axis in range(3)]
    index = [0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6]
    return corners, index if not inwards else index[::-1]


def write_hall(path):
    """A hall of 6 m with a crate."""
    file = Gltf()
    nodes, meshes = [{"name": "hall", "children": [1, 2]}], []
    for name, low, high in (("walls", (-3, 0, -3), (3, 3, 3)), ("crate", (-1.5, 0, -1.5), (1, 1.2, 0.5))):
        corners, index = box(low, high, name == "walls")
        primitive = {"attributes": {"POSITION": file.add(corners, "VEC3")}, "indices": file.add(index, "SCALAR", U16)}
        nodes.append({"name": name, "mesh": len(meshes)})
        meshes.append({"primitives": [primitive]})
    file.document |= {"nodes": nodes, "meshes": meshes}
    file.write(path)


class Test:
    def __init__(self, folder, tool):
        self.folder, self.tool, self.faults = folder, tool, []

    def run(self, code, words, *arguments, without=()):
        run = subprocess.run([self.tool, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        text = run.stdout + run.stderr
        missing = [word for word in words if word not in text] + [f"no {word}" for word in without if word in text]
        if run.returncode != code or missing:
            self.faults.append(f"{' '.join(map(str, arguments))}: exit code {run.returncode} (need {code}), missing {missing}\n{text}")

    def character(self):
        glb, model = self.folder / "hero.glb", self.folder / "hero.nook"
        with_copy(glb)
        self.run(0, [], "bake", "character", glb, "-o", model, *SMALL, "--without", "copy", "--quiet")
        self.run(0, ["meshes_without", "copy"], "inspect", model)
        measured = ["--max-poses", "4", "--rays", "16"]
        self.run(0, [SAID], "evaluate", "character", glb, model, *measured)
        self.run(0, [], "evaluate", "character", glb, model, *measured, "--quiet", without=[SAID])
        self.run(0, [SAID], "evaluate", "world", glb, model, *measured, "--points", "50")
        self.run(0, [SAID], "report", model, glb, "-o", self.folder / "hero.html")
        self.run(0, [SAID], "bake", "clips", glb, model, "-o", self.folder / "clips.nook")
        self.run(0, [SAID], "bake", "bent", glb, model, "-o", self.folder / "bent.nook", "--rays", "16")
        # A choice of one's own counts, also where it is wrong.
        self.run(3, ["--mesh, --without"], "evaluate", "character", glb, model, *measured, "--mesh", "*", without=[SAID])

    def transfer(self):
        glb, baked = self.folder / "hero.glb", self.folder / "transfer.nook"
        self.run(0, [], "bake", "transfer", glb, "-o", baked, "--lobes", "42", "--without", "copy", "--quiet")
        self.run(0, ["meshes_without", "copy"], "inspect", baked)
        self.run(0, [SAID], "report", baked, glb, "-o", self.folder / "transfer.html")

    def scene(self):
        hall = self.folder / "hall.glb"
        write_hall(hall)
        composite = ["evaluate", "world", self.folder / "hero.glb", self.folder / "hero.nook", "--composite", "--scene", hall,
                     "--views", "1", "--figures", "1", "--rays", "8", "--max-poses", "2", "--report", self.folder / "room.json"]
        errors = []
        for more in ([], ["--scene-without", "crate"], ["--scene-mesh", "walls"]):
            self.run(0, [], *composite, *more)
            rows = json.loads((self.folder / "room.json").read_text())["rows"]
            errors.append([row["mse"] for row in rows if row["scene"] == "hall"])
        if errors[0] == errors[1] or errors[1] != errors[2]:
            self.faults.append(f"the crate is left out of no room, or of one: {errors}")
        alone = composite[:4] + composite[5:7]
        self.run(2, ["--scene names a room, but rooms are measured only with --composite, or with --light and --images"], *alone)
        self.run(2, ["--scene-metres has 2 values for 1 of --scene"], *composite, "--scene-metres", "1", "2")
        self.run(2, ['no mesh and no node with a mesh is named "Crate"'], *composite, "--scene-without", "Crate")


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    test = Test(folder, sys.argv[2])
    test.character()
    test.transfer()
    test.scene()
    print("\n".join(test.faults) or "every command takes the stored choice")
    return 1 if test.faults else 0


if __name__ == "__main__":
    sys.exit(main())
