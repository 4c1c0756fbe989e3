#!/usr/bin/env python3
"""measure_folder.py TOOL FOLDER: what `nook inspect` says of each glTF file below a folder, for measuring with the files of others.

Meant for glTF-Asset-Generator and glTF-Sample-Assets, which are not part of this repository. Files whose path contains "Negative"
must be refused or give a warning; all others must be read, or refused because they show no triangles. Prints each file that is not right, and the counts."""
import pathlib
import subprocess
import sys


def answer(tool, path):
    """Exit code and warnings."""
    try:
        run = subprocess.run([tool, "inspect", str(path)], capture_output=True, text=True, errors="replace", timeout=300)
        return run.returncode, run.stderr.strip()
    except subprocess.TimeoutExpired:
        return -1, "no answer in 300 s"


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        return 2
    tool, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    counts = {"right": 0, "wrong": 0}
    for path in sorted([*folder.rglob("*.gltf"), *folder.rglob("*.glb")]):
        code, text = answer(tool, path)
        is_negative = "Negative" in path.parts
        refused = code == 3 or "cannot be baked as a character: " in text
        # Asset-Generator/Compatibility has files that ask for a newer reader.
        asks_for_more = "minVersion" in text or "the file requires" in text
        # Points and lines, and scenes of cameras and lights, have no AO.
        asks_for_more = asks_for_more or "cannot be baked as a character: no triangles" in text
        right = refused or text != "" if is_negative else code == 0 and not refused or asks_for_more
        counts["right" if right else "wrong"] += 1
        if not right:
            print(f"{path.relative_to(folder)}: exit code {code}: {text[:300]}")
    print(counts)
    return 1 if counts["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
