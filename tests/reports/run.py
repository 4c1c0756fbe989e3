#!/usr/bin/env python3
"""Runs every command of the tool, the samples and other programs at small settings, and keeps what they report and write.

    tests/reports/run.py BUILD_DIR OUT_DIR [--assets DIR] [--only PATTERN]
    tests/reports/compare.py BEFORE AFTER

A change of structure must not change a number. This script writes one JSON report for each command into OUT_DIR, and the
hashes of the other files that the command wrote, such as pictures, pages and tables, into written_COMMAND.json; compare.py
lists where two such folders differ beyond times, memory and paths. The cells of times and memory in tables and pages are
left out of the hashes.

What it covers:

- `bake` of every kind: characters by each kernel and fit, bent normals, clips, levels of detail, probes by each method and
  basis, grids with walls and each kind of direct light, materials from each source but .btf files and by each method,
  synthesis, transfer in both forms.
- `evaluate` of every kind, with its pictures: character, casters, contact, bent, clips, lods, world (alone, --composite,
  --light), probe (maps, --glossy, grids), grid, material, transfer, and nnao (scenes, --views, --frame, --temporal, --mover,
  --bent-normals, --tune, a trained network).
- `train`, `export`, `report` and `inspect` of every kind of file.
- The samples that draw without a window, at both tiers of OpenGL and on Vulkan, with their pictures and recorded frames.
- The results of the CPU half by every instruction set (cpu_results), the values for the page in a browser, and the
  instructions of every shader (nook_gpu_cost).

What it does not cover: .btf files, windows, the hosts, the web page itself, the Blender add-on, the Python package, bakes through the C ABI other than in the samples, and nook_gpu_time, whose numbers are all times.

A command is looked for in nook, then in nook-lab; a program is looked for in the whole build folder, and one that was not
built is left out. The reports are comparable when both runs have the same processor and drivers: the kernels choose their
instruction set at start by what the processor has, and Embree does as well; neither has an option. The flags of the
processor are kept in machine.json, and compare.py refuses folders whose flags differ. Every command runs on one thread with
seed 1; the samples, which have no such option, give the same on any number of threads.

Without --assets the inputs are the built-in mannequin and what inputs.py writes. --assets adds characters/fox_CC-BY.glb,
scenes/CornellBox-Sphere.glb and hdr/potsdamer_platz_1k.hdr of that folder. A command whose reports are there already is not
run again, so an interrupted run goes on; remove OUT_DIR to begin anew. --only takes reports whose inputs are there already.
Do not run two at once into one OUT_DIR. The whole takes about five minutes of one core.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # a run leaves no trace in the source tree
import inputs
import program_cases as programs
import tool_cases as tool
from runner import Runner


def machine():
    text = pathlib.Path("/proc/cpuinfo").read_text()
    field = lambda key: re.search(rf"^{key}\s*: (.*)$", text, re.M)
    flags = field("flags").group(1).split() if field("flags") else []
    return {"processor": field("model name").group(1) if field("model name") else "unknown",
            "instruction_sets": sorted(f for f in flags if re.match(r"sse|ssse|avx|fma|f16c|bmi", f))}


def built_in(run, assets):
    """Everything that needs no assets. Paths are relative to OUT_DIR/files, so that no report depends on OUT_DIR."""
    body, sky = "mannequin.glb", "sky.hdr"
    model = tool.mannequin(run, body, sky)
    tool.darkened_world(run, body, model, sky)
    tool.bent_normals(run, body, model, sky)
    tool.baked_clips(run, body, model)
    tool.levels(run, body, model)
    tool.maps(run, "sky", sky)
    tool.grid(run, "mannequin", body, sky)
    tool.look_ups(run, body, sky)
    weave = tool.material(run, "weave")
    tool.other_materials(run)
    tool.synthesis(run, weave)
    programs.shapes(run)
    tool.transfer(run, "knot.glb", "hills.gltf", weave, sky)
    recording = programs.room(run)
    tool.screen_space(run, body, recording, [assets / "scenes/CornellBox-Sphere.glb"] if assets else [])
    tool.pages(run, body, recording)
    programs.crowd(run, body, model, sky, "sky_default.nook")
    programs.other_samples(run, body, model, "sky_default.nook", [weave, "weave_neural.nook"])
    programs.library(run, model)
    programs.gpu_counts(run)


def with_assets(run, assets):
    map_file, cornell = assets / "hdr/potsdamer_platz_1k.hdr", assets / "scenes/CornellBox-Sphere.glb"
    tool.character(run, "fox", assets / "characters/fox_CC-BY.glb", "--poses", "single-joint")
    tool.maps(run, "potsdamer", map_file)
    tool.grid(run, "cornell", cornell, map_file, "--max-bounces", 3)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("build", type=pathlib.Path, help="a build folder with nook and the sample mannequin")
    parser.add_argument("out", type=pathlib.Path, help="the folder for the reports")
    parser.add_argument("--assets", type=pathlib.Path, help="a folder with characters/, scenes/ and hdr/")
    parser.add_argument("--only", default="", help="run the reports whose names match this regular expression")
    options = parser.parse_args()
    build, out = options.build.resolve(), options.out.resolve()
    (out / "files").mkdir(parents=True, exist_ok=True)
    (out / "machine.json").write_text(json.dumps(machine(), indent=2) + "\n")
    # One thread in the software renderer as well, and no shader cache of an earlier run.
    os.environ.update({"LP_NUM_THREADS": "1", "MESA_SHADER_CACHE_DISABLE": "true"})

    run = Runner(build, out, options.only)
    inputs.write_all(out / "files", lambda path: subprocess.run([run.program_path("mannequin"), path], check=True,
                                                                stdout=subprocess.DEVNULL))
    built_in(run, options.assets.resolve() if options.assets else None)
    if options.assets:
        with_assets(run, options.assets.resolve())
    print(f"{sum(run.times.values()):6.1f} s  in all", flush=True)
    if run.failed:
        sys.exit(f"run.py: {len(run.failed)} commands failed: {', '.join(run.failed)}")


main()
