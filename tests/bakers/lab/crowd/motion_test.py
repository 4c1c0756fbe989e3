#!/usr/bin/env python3
"""nook-lab-motion draws three pictures of each frame, and Nook's picture is near the ray-traced one.

  motion_test.py PROGRAM MODEL FOLDER
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "bakers/lab/tables"))
from png_lines import read  # noqa: E402

# With Nook, a picture has less than this share of the error that a picture without occlusion has. The scenes have 0.12 and
# 0.13 of it, and the walk 0.10 with more rays and pixels. The rest is room for other compilers and drivers.
MOST = 0.3


def pixels(folder, kind):
    _, lines = read(folder / f"{kind}_body_0000.png")
    return [value for line in lines for value in line]


def mse(one, other):
    return sum((a - b) ** 2 for a, b in zip(one, other)) / len(one)


def main():
    program, model, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    faults = []
    for scene in ("walk", "together"):
        out = folder / scene
        subprocess.run([program, model, "--scene", scene, "--frames", "1", "--width", "96", "--rays", "16", "--quiet", "--out",
                        str(out)], check=True)
        traced = pixels(out, "traced")
        share = mse(pixels(out, "nook"), traced) / mse(pixels(out, "off"), traced)
        print(f"{scene}: {share:.3f} of the error without occlusion")
        if share > MOST:
            faults.append(f"{scene}: got {share:.3f} of the error without occlusion, need at most {MOST}")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
