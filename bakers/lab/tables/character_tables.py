#!/usr/bin/env python3
"""Bakes three bodies with both splits of their clips, measures them and the baselines, and prints the tables
of docs/lab/character.md and docs/evidence.md.

    bakers/lab/tables/character_tables.py --out out/character_tables [--write]

A step is skipped if its report already exists in the output folder. Remove the folder to measure again. On
two idle cores, a bake takes 2 to 4 minutes, and an evaluation with baselines takes about as long.
"""
import argparse
import json
import pathlib
import subprocess
import sys

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
BODIES = ["ual_mannequin_CC0", "m2m_female_CC0", "rocketbox_Female_Adult_01_MIT"]
SPLITS = {"half": "every second clip", "families": "families"}
BASELINES = {"linear_pose": "linear pose", "pose_clusters": "pose clusters"}


def run(arguments, report):
    """Runs the tool unless the report already exists. Returns the report."""
    if not report.exists():
        print("+ " + " ".join(map(str, arguments)), file=sys.stderr, flush=True)
        subprocess.run([*map(str, arguments), "--report", str(report)], check=True, stdout=subprocess.DEVNULL)
    return json.loads(report.read_text())


def measure(options, body, split):
    """Returns the report of the bake and the row of the evaluation."""
    source = options.assets / "characters" / f"{body}.glb"
    model = options.out / f"{body}.{split}.nook"
    baked = run([options.tool, "bake", "character", source, "-o", model, "--split", split, "--quiet"],
                model.with_suffix(".bake.json"))
    evaluate = ["evaluate", "character", source, model, "--rays", 128, "--quiet"]
    if options.without_baselines:
        measured = run([options.tool, *evaluate], model.with_suffix(".plain.json"))
    else:
        measured = run([options.lab, *evaluate], model.with_suffix(".eval.json"))
    return baked, measured["rows"][0]


def number(value):
    """Returns a number as text with three digits and a short exponent, such as 7.14e-3."""
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def summary(results):
    return table(["", "split", "mse_visible", "of a static bake", "ratio", "all vertices: mse", "ratio"],
                 [[body, SPLITS[split], number(r["mse_visible"]), number(r["mse_static_visible"]),
                   f"{r['ratio_to_static_visible']:.3f}", number(r["mse"]), f"{r['ratio_to_static']:.3f}"]
                  for body, split, _, r in results])


def errors(results):
    return table(["character", "split", "visible share", "mse_visible", "static", "oracle", "mse_visible / static", "mse",
                  "static", "oracle", "mse / static", "mse_area", "of static", "mse_body", "mse_hands", "noise floor"],
                 [[body, SPLITS[split], f"{r['visible_share']:.3f}", number(r["mse_visible"]),
                   number(r["mse_static_visible"]), number(r["mse_oracle_visible"]), f"{r['ratio_to_static_visible']:.3f}",
                   number(r["mse"]), number(r["mse_static"]), number(r["mse_oracle"]), f"{r['ratio_to_static']:.3f}",
                   number(r["mse_area"]), f"{r['ratio_to_static_area']:.3f}", number(r["mse_body"]),
                   number(r["mse_hands"]), number(r["noise_floor_mse"])] for body, split, _, r in results])


def sizes(results):
    parts = ["map_bytes", "bind_bytes", "rest_bytes"]
    return table(["character", "split", "vertices", "measured poses", "model bytes", "file order", "bind data",
                  "rest positions", "bake, s: rays + fit"],
                 [[body, SPLITS[split], f"{r['vertices']:,}", str(r["poses"]),
                   f"{r['model_bytes'] - sum(r[p] for p in parts):,}", *(f"{r[p]:,}" for p in parts),
                   f"{b['seconds_raytrace']:.0f} + {b['seconds_fit']:.0f}"] for body, split, b, r in results])


def baselines(results):
    rows = []
    for body, split, _, r in results:
        rows.append([body, SPLITS[split], "Nook", number(r["mse_visible"]), number(r["mse"]), number(r["mse_area"]),
                     f"{r['model_bytes'] - r['bind_bytes'] - r['rest_bytes']:,}", ""])
        for key, name in BASELINES.items():
            rows.append(["", "", name, number(r[f"mse_{key}_visible"]), number(r[f"mse_{key}"]),
                         number(r[f"mse_area_{key}"]), f"{r[f'bytes_{key}']:,}", r[f"tuned_{key}"]])
        for key, name in (("static", "static bake"), ("oracle", "oracle of static bakes")):
            rows.append(["", "", name, number(r[f"mse_{key}_visible"]), number(r[f"mse_{key}"]),
                         number(r[f"mse_area_{key}"]), "", ""])
    return table(["character", "split", "", "mse_visible", "mse", "mse_area", "bytes", "settings chosen"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=pathlib.Path, default=ROOT / "build/bakers/tool/nook", help="path of the program nook; default build/bakers/tool/nook")
    parser.add_argument("--lab", type=pathlib.Path, default=ROOT / "build/bakers/lab/tool/nook-lab", help="path of the program nook-lab; default build/bakers/lab/tool/nook-lab")
    parser.add_argument("--assets", type=pathlib.Path, default=ROOT.parent / "shared/assets", help="folder that contains the bodies; default shared/assets beside the source tree")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="write models and reports into this folder")
    parser.add_argument("--without-baselines", action="store_true",
                        help="do not measure the other methods, and leave out their table; this halves the time")
    parser.add_argument("--write", action="store_true", help="put the tables into the documents instead of printing them")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    results = [(body, split, *measure(options, body, split)) for body in BODIES for split in SPLITS]
    script = pathlib.Path(__file__).name
    show(ROOT / "docs/evidence.md", script, {"summary": summary(results)}, options.write)
    tables = {"errors": errors(results), "sizes": sizes(results)}
    if not options.without_baselines:
        tables["baselines"] = baselines(results)
    show(ROOT / "docs/lab/character.md", script, tables, options.write)


if __name__ == "__main__":
    main()
