#!/usr/bin/env python3
"""Runs the stranger on synthetic rigs and on shared characters.

  stranger_test.py rigs FOLDER --program STRANGER --unfitted WRITE_UNFITTED [NAME...]
  stranger_test.py bakes FOLDER --program STRANGER --tool NOOK [NAME...]
  stranger_test.py characters FOLDER --program STRANGER --unfitted WRITE_UNFITTED --assets ASSETS

rigs: models without a bake, so that two rigs of a body have the same model but for rounding. Their AO equals the plain rig's in every frame, the check of poses passes what is right, and names what is wrong. bakes: each rig has a model
of its own, whose AO is compared with ray tracing. characters: the checks alone, on real files.
"""
import argparse
import array
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import rigs  # noqa: E402

# A rig whose body or skeleton differs from the plain one's has a rig of its own to compare with.
BASE = {"no_inverse_bind": "one_place", "prop": "prop_skinned", "quadruped_blender": "quadruped",
        "one_place": None, "prop_skinned": None, "quadruped": None, "segments": None, "plain": None}
# AO of a byte has steps of 1/255; this is an eighth of one.
LARGEST_RMS = 5e-4
# A quick fit.
BAKE = ["--preset", "draft", "--poses", "clips", "--samples-per-clip", "10", "--rays", "32", "--steps", "300", "--spheres", "60",
        "--key-points", "150", "--threads", "1", "--quiet"]
# Such fits reach 0.018; AO that was baked at rest has 0.075 on the plain rig, and a wrong pose has more.
LARGEST_MSE = 0.022
# Joints that lie at one place do not tell the baker where the body bends: 0.031.
LARGEST_MSE_OF = {"one_place": 0.045, "no_inverse_bind": 0.045}
# The lines of the documents are for one mesh under one skin.
SEVERAL_PARTS = ["two_skins", "prop", "prop_skinned"]
# Drawn by the passes on OpenGL; the others have the same casters but for rounding.
DRAWN = ["plain", "two_skins", "prop"]


class Runner:
    def __init__(self):
        self.failed = 0

    def run(self, name, command):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        for line in (done.stdout + done.stderr).splitlines():
            print(f"{name}: {line}")
        if done.returncode == 77 and os.environ.get("NOOK_REQUIRE_GL") != "1":
            print(f"{name}: SKIPPED: {command[1]} needs an OpenGL 3.3 context")
        elif done.returncode != 0:
            self.fail(name, f"{pathlib.Path(command[0]).name} {command[1]} ended with {done.returncode}")
        return done.returncode == 0

    def fail(self, name, text):
        self.failed += 1
        print(f"{name}: FAILED: {text}")


def prepared(runner, folder, name):
    """Writes the rig and what an engine reads from it."""
    character, flat = folder / f"{name}.gltf", folder / f"{name}.engine"
    runner.run(name, [sys.executable, HERE / "rigs.py", folder, name])
    runner.run(name, [sys.executable, HERE / "flatten.py", character, flat, "--all-keys"])
    return character, flat


def rms_of(path, other):
    values = [array.array("f", p.read_bytes()) for p in (path, other)]
    if len(values[0]) != len(values[1]) or not values[0]:
        return float("inf")
    return (sum((a - b) ** 2 for a, b in zip(*values)) / len(values[0])) ** 0.5


def run_rigs(runner, options, names):
    ao = {}
    for name in names:
        character, flat = prepared(runner, options.folder, name)
        model = options.folder / f"{name}.unfitted.nook"
        runner.run(name, [options.unfitted, character, model])
        ao[name] = options.folder / f"{name}.ao"
        runner.run(name, [options.program, "layouts", model, flat, ao[name]])
        runner.run(name, [options.program, "checks", model, flat])
        runner.run(name, [options.program, "mistakes", model, flat])
        if name not in SEVERAL_PARTS:
            runner.run(name, [options.program, "documents", model, flat])
        base = BASE.get(name, "plain")
        if base in ao and ao[name].exists():
            rms = rms_of(ao[name], ao[base])
            print(f"{name}: AO differs from that of {base} by {rms:.1e} rms")
            if not rms <= LARGEST_RMS:
                runner.fail(name, f"AO differs from that of {base} by {rms} rms, above {LARGEST_RMS}")


def run_bakes(runner, options, names):
    for name in names:
        character, flat = prepared(runner, options.folder, name)
        model = options.folder / f"{name}.nook"
        if runner.run(name, [options.tool, "bake", "character", character, "-o", model, *BAKE]):
            runner.run(name, [options.program, "truth", model, flat, LARGEST_MSE_OF.get(name, LARGEST_MSE),
                                rigs.rigs()[name].unit])
            if name in DRAWN:
                runner.run(name, [options.program, "pictures", model, flat])


def run_characters(runner, options):
    files = sorted((options.assets / "characters").glob("*.glb"))
    for file in files:
        model, flat = options.folder / f"{file.stem}.unfitted.nook", options.folder / f"{file.stem}.engine"
        if runner.run(file.stem, [sys.executable, HERE / "flatten.py", file, flat]) and \
                runner.run(file.stem, [options.unfitted, file, model]):
            runner.run(file.stem, [options.program, "checks", model, flat])
            runner.run(file.stem, [options.program, "mistakes", model, flat])
    return len(files)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", choices=["rigs", "bakes", "characters"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    for option in ("--program", "--unfitted", "--tool", "--assets"):
        parser.add_argument(option, type=pathlib.Path)
    options = parser.parse_intermixed_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    runner = Runner()
    names = options.names or list(rigs.rigs())
    if options.part == "characters":
        count = run_characters(runner, options)
        if count == 0:
            print(f"SKIPPED: {options.assets} has no characters/*.glb; set NOOK_ASSETS when you configure")
            return 77
    else:
        (run_rigs if options.part == "rigs" else run_bakes)(runner, options, names)
        count = len(names)
    print(f"{count} files, {runner.failed} failed")
    return 1 if runner.failed or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
