#!/usr/bin/env python3
"""Runs every `nook evaluate` command, and the bakes that it needs, at small settings, and keeps their reports.

    tests/reports/run.py BUILD_DIR OUT_DIR [--assets DIR] [--only PATTERN]
    tests/reports/compare.py BEFORE AFTER

A change of structure must not change a number. This script writes one JSON report for each command into OUT_DIR;
compare.py lists where two such folders differ beyond times, memory and paths. It covers bakes of characters, probes,
grids, materials and networks, `inspect` of every file, and `evaluate` character (unseen clips, training poses, baselines),
casters, probe (maps, grids), material (baselines, seeding, sweep, unseen views) and nnao (scenes, a trained network,
tuning).

The reports are comparable when both runs have the same processor: the kernels choose their instruction set at start by
what the processor has, and Embree does as well; neither has an option. The flags of the processor are kept in
machine.json, and compare.py refuses folders whose flags differ. Every command runs on one thread with seed 1.

Without --assets the inputs are the built-in mannequin and an environment map that this script writes. --assets adds
characters/fox_CC-BY.glb, scenes/CornellBox-Sphere.glb and hdr/potsdamer_platz_1k.hdr of that folder. A command whose
reports are there already is not run again, so an interrupted run goes on; remove OUT_DIR to begin anew. The whole
takes about four minutes of one core.
"""
import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import time

common = ["--threads", "1", "--seed", "1", "--quiet"]


def find_tool(build):
    for path in ("bakers/tool/nook", "bakers/cli/nook"):
        if (build / path).is_file():
            return build / path
    sys.exit(f"run.py: {build} holds no nook; build the targets nook and mannequin there")


def write_map(path):
    """A sky with a sun over a dark ground, 64 x 32 texels, as uncompressed RGBE."""
    width, height = 64, 32
    texels = bytearray()
    for y in range(height):
        for x in range(width):
            sky = 1.5 - y / height if y < height // 2 else 0.2
            sun = 80.0 if (x, y) in ((12, 6), (13, 6), (12, 7)) else 0.0
            rgb = (0.8 * sky + sun, 0.9 * sky + sun, sky + 0.8 * sun + 0.3 * (x / width))
            mantissa, exponent = math.frexp(max(rgb))
            texels += bytes(int(c * mantissa * 256 / max(rgb)) for c in rgb) + bytes([exponent + 128])
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + bytes(texels))


class Runner:
    def __init__(self, build, out, only):
        self.tool, self.out, self.only = find_tool(build), out, re.compile(only)
        self.times = {}

    def report(self, name, *arguments):
        """Runs one command; its report becomes NAME.json."""
        target = self.out / f"{name}.json"
        if target.exists() or not self.only.search(name):
            return
        began = time.monotonic()
        command = [str(self.tool), *map(str, arguments), *common, "--report", str(target)]
        result = subprocess.run(command, cwd=self.out / "files", capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"run.py: {name}: {' '.join(command)}\n{result.stderr}")
        self.times[name] = round(time.monotonic() - began, 1)
        print(f"{self.times[name]:6.1f} s  {name}", flush=True)

    def bake(self, name, kind, *arguments):
        """Bakes files/NAME.nook and inspects it."""
        model = f"{name}.nook"
        self.report(f"bake_{name}", *kind.split(), *arguments, "-o", model)
        self.report(f"inspect_{name}", "inspect", model)
        return model


def characters(run, name, glb, *bake_options):
    model = run.bake(name, "bake character", glb, "--preset", "draft", "--rays", 16, "--auto-poses", 24,
                     "--samples-per-clip", 3, "--steps", 60, "--split", "half", *bake_options)
    run.report(f"evaluate_{name}_clips", "evaluate", "character", glb, model, "--rays", 16, "--samples-per-clip", 4)
    run.report(f"evaluate_{name}_casters", "evaluate", "casters", glb, model, "--rays", 16, "--bearings", 2,
               "--poses", 2)
    run.report(f"evaluate_{name}_world", "evaluate", "world", glb, model, "--rays", 32, "--points", 60, "--max-poses", 4)
    return model


def mannequin(run, glb):
    model = characters(run, "mannequin", glb)
    run.report("evaluate_mannequin_training", "evaluate", "character", glb, model, "--rays", 16, "--poses",
               "training", "--max-poses", 8)
    run.report("evaluate_mannequin_baselines", "evaluate", "character", glb, model, "--rays", 16,
               "--samples-per-clip", 3, "--peers")
    small = ["--preset", "draft", "--rays", 8, "--auto-poses", 6, "--samples-per-clip", 2, "--steps", 2, "--spheres",
             8, "--key-points", 16]
    run.bake("mannequin_paper", "bake character", glb, *small, "--kernel", "paper", "--fit", "paper")
    run.bake("mannequin_learned", "bake character", glb, *small, "--kernel", "rational", "--gamma", "learned",
             "--poses", "auto")


def maps(run, name, sky):
    forms = {"default": [],
             "moments": ["--method", "moments", "--sharpness", 6],
             "least_squares": ["--method", "least-squares", "--ambient", "--packing", "half"],
             "average": ["--method", "running-average", "--samples", 20000, "--sharpness", 4],
             "non_negative": ["--method", "non-negative-least-squares", "--hemisphere", "--packing", "rgb9e5"],
             "harmonics": ["--basis", "harmonics", "--order", 3, "--method", "least-squares"],
             "dice": ["--basis", "dice", "--method", "least-squares"]}
    models = [run.bake(f"{name}_{form}", "bake probe", sky, *options) for form, options in forms.items()]
    run.report(f"evaluate_{name}", "evaluate", "probe", sky, *models, "--seeds", 2)
    run.report(f"evaluate_{name}_lobes_5", "evaluate", "probe", sky, "--seeds", 1, "--lobes", 5)


def grid(run, name, scene, sky, *options):
    model = run.bake(f"{name}_grid", "bake probe", scene, "--light", sky, "--grid", "3x2x2", "--samples", 1024,
                     *options)
    run.report(f"evaluate_{name}_grid", "evaluate", "probe", "--scene", scene, "--light", sky, model, "--points", 128,
               "--paths", 128, *options)


def material(run, name):
    raw, unseen = f"{name}.raw", f"{name}_unseen.raw"
    trace = ["--meso", name, "--texels", 16, "--samples", 1, "--bounce-rays", 16]
    ranks = ["--ranks", "6,16,8,8", "--votf-ranks", "8,8"]
    model = run.bake(name, "bake material", *trace, *ranks, "--directions", 24, "--keep-raw", raw)
    run.bake(f"{name}_unseen", "bake material", *trace, *ranks, "--directions", 20, "--lights", 24, "--keep-raw",
             unseen)
    run.bake(f"{name}_auto", "bake material", "--raw", raw, "--ranks", "auto", "--threshold", 0.05, "--votf", "binary")
    run.bake(f"{name}_cta", "bake material", "--raw", raw, *ranks, "--method", "cta", "--view-map", 0)
    run.bake(f"{name}_n_svd", "bake material", "--raw", raw, *ranks, "--method", "n-svd", "--votf", "none")
    run.report(f"inspect_{name}_raw", "inspect", raw)
    run.report(f"evaluate_{name}", "evaluate", "material", raw, model, "--peers", "--compare-seeding", "--sweep",
               "8,16", "--unseen", unseen)


def screen_space(run, assets):
    small = ["--size", "96x64", "--rays", 16, "--cameras", 1]
    train = ["--scenes", 20, "--views", 24, "--points", 40, "--rays", 16, "--epochs", 2, "--batch", 32]
    horizon = run.bake("network_horizon", "train nnao", *train)
    paper = run.bake("network_paper", "train nnao", *train, "--form", "paper")
    run.report("evaluate_nnao_thin", "evaluate", "nnao", "--thin", *small, "--network", paper)
    scenes = [assets / "scenes/CornellBox-Sphere.glb"] if assets else []
    run.report("evaluate_nnao_network", "evaluate", "nnao", "--thin", *scenes, *small, "--network", horizon,
               "--methods", "nnao,nnao_file,gtao", "--max-radius-px", 20)
    run.report("evaluate_nnao_tune", "evaluate", "nnao", "--tune", "ssao")


def machine():
    text = pathlib.Path("/proc/cpuinfo").read_text()
    field = lambda key: re.search(rf"^{key}\s*: (.*)$", text, re.M)
    flags = field("flags").group(1).split() if field("flags") else []
    return {"processor": field("model name").group(1) if field("model name") else "unknown",
            "instruction_sets": sorted(f for f in flags if re.match(r"sse|ssse|avx|fma|f16c|bmi", f))}


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

    body, sky = out / "files/mannequin.glb", out / "files/sky.hdr"
    if not body.exists():
        subprocess.run([build / "samples/mannequin/mannequin", body], check=True, stdout=subprocess.DEVNULL)
    write_map(sky)
    run = Runner(build, out, options.only)
    assets = options.assets.resolve() if options.assets else None
    mannequin(run, body)
    maps(run, "sky", sky)
    grid(run, "mannequin", body, sky)
    material(run, "weave")
    run.bake("roughhole", "bake material", "--meso", "roughhole", "--texels", 12, "--directions", 16, "--samples", 1,
             "--bounces", 0, "--ranks", "4,8,6,6", "--votf-ranks", "6,6")
    run.bake("fiber", "bake material", "--meso", "fiber", "--texels", 12, "--directions", 16, "--samples", 1,
             "--bounces", 0, "--ranks", "4,8,6,6", "--votf-ranks", "6,6", "--detail", 0.3)
    if assets:
        characters(run, "fox", assets / "characters/fox_CC-BY.glb", "--poses", "single-joint")
        maps(run, "potsdamer", assets / "hdr/potsdamer_platz_1k.hdr")
        grid(run, "cornell", assets / "scenes/CornellBox-Sphere.glb", assets / "hdr/potsdamer_platz_1k.hdr",
             "--max-bounces", 3)
    screen_space(run, assets)
    print(f"{sum(run.times.values()):6.1f} s  in all", flush=True)


main()
