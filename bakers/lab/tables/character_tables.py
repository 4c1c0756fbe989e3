#!/usr/bin/env python3
"""Bakes three bodies with both splits of their clips and seven without any clip, measures them and the
baselines, and prints the tables of docs/lab/character.md and docs/evidence.md.

    bakers/lab/tables/character_tables.py --out out/character_tables [--write]

With --write the tables go into the documents and the figures into docs/data/character.json. A step is skipped
if its report already exists in the output folder. Remove the folder to measure again. On two idle cores, a bake
takes 2 to 4 minutes, and an evaluation with baselines takes about as long.
"""
import argparse
import datetime
import json
import pathlib
import subprocess
import sys

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
BODIES = ["ual_mannequin_CC0", "m2m_female_CC0", "rocketbox_Female_Adult_01_MIT"]
SPLITS = {"half": "every second clip", "families": "families"}
WITHOUT_CLIPS = [*BODIES, "cesium_man_CC-BY", "robot_expressive_CC0", "fox_CC-BY", "quaternius_horse_CC0"]
BASELINES = {"linear_pose": "linear pose", "pose_clusters": "pose clusters"}
DATA = ROOT / "docs/data/character.json"


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
    return baked, run([options.lab, *evaluate], model.with_suffix(".eval.json"))["rows"][0]


def measure_automatic(options, body):
    """Returns the row of a model that was fitted to automatic poses alone."""
    source = options.assets / "characters" / f"{body}.glb"
    model = options.out / f"{body}.auto.nook"
    run([options.tool, "bake", "character", source, "-o", model, "--poses", "auto", "--quiet"],
        model.with_suffix(".bake.json"))
    return run([options.tool, "evaluate", "character", source, model, "--rays", 96, "--max-poses", 220, "--quiet"],
               model.with_suffix(".eval.json"))["rows"][0]


def number(value):
    """Returns a number as text with three digits and a short exponent, such as 7.14e-3."""
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def summary(results):
    return table(["", "split", "mse_visible", "of a static bake", "ratio", "between vertices: mse_surface", "ratio"],
                 [[body, SPLITS[split], number(r["mse_visible"]), number(r["mse_static_visible"]),
                   f"{r['ratio_to_static_visible']:.3f}", number(r["mse_surface"]), f"{r['ratio_to_static_surface']:.3f}"]
                  for body, split, _, r in results])


def surface_columns(r):
    """Returns the errors between vertices: of the model, of the static bake, of exact AO, and the ratio of the first two."""
    return [number(r["mse_surface"]), number(r["mse_surface_static"]), number(r["mse_surface_exact_vertices"]),
            f"{r['ratio_to_static_surface']:.3f}"]


def errors(results):
    return table(["character", "split", "visible share", "mse_visible", "static", "oracle", "of static", "of static, by area",
                  "mse_surface", "static", "exact vertices", "of static", "noise floor"],
                 [[body, SPLITS[split], f"{r['visible_share']:.3f}", number(r["mse_visible"]),
                   number(r["mse_static_visible"]), number(r["mse_oracle_visible"]), f"{r['ratio_to_static_visible']:.3f}",
                   f"{r['ratio_to_static_visible_by_area']:.3f}", *surface_columns(r), number(r["noise_floor_mse"])]
                  for body, split, _, r in results])


def automatic(results):
    return table(["character", "visible share", "mse_visible", "static", "of static", "of static, by area", "of oracle",
                  "mse_surface", "static", "exact vertices", "of static", "worst clip, its ratio over that of the body",
                  "noise floor"],
                 [[body, f"{r['visible_share']:.3f}", number(r["mse_visible"]), number(r["mse_static_visible"]),
                   f"{r['ratio_to_static_visible']:.3f}", f"{r['ratio_to_static_visible_by_area']:.3f}",
                   f"{r['ratio_to_oracle_visible']:.2f}", *surface_columns(r),
                   f"{r['worst_clip']}, {r['worst_clip_over_body']:.1f}", number(r["noise_floor_mse"])] for body, r in results])


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
        rows.append([body, SPLITS[split], "Nook", number(r["mse_visible"]), f"{nook_bytes(r):,}", ""])
        for key, name in BASELINES.items():
            rows.append(["", "", name, number(r[f"mse_{key}_visible"]), f"{r[f'bytes_{key}']:,}", r[f"tuned_{key}"]])
        for key, name in (("static", "static bake"), ("oracle", "oracle of static bakes")):
            rows.append(["", "", name, number(r[f"mse_{key}_visible"]), "", ""])
    return table(["character", "split", "", "mse_visible", "bytes", "settings chosen"], rows)


def nook_bytes(r):
    """Returns the model's bytes without bind data and rest positions, which the baselines would need too."""
    return r["model_bytes"] - r["bind_bytes"] - r["rest_bytes"]


def figures(results):
    """Returns the figures of docs/data/character.json, which docs/figures.py binds to the pages."""
    found = {}
    for body, split, _, r in results:
        name = f"{body.rsplit('_', 1)[0]}, {SPLITS[split]}"
        row = {"mse": (r["mse_visible"], "mse"), "mse of a static bake": (r["mse_static_visible"], "mse"),
               "ratio": (r["ratio_to_static_visible"], "ratio"), "mse between vertices": (r["mse_surface"], "mse"),
               "ratio between vertices": (r["ratio_to_static_surface"], "ratio")}
        if body == BODIES[0] and split == "half":
            row |= {"bytes": (nook_bytes(r) / 1e3, "kB"), "mse of pose clusters": (r["mse_pose_clusters_visible"], "mse"),
                    "bytes of pose clusters": (r["bytes_pose_clusters"] / 1e6, "MB"),
                    "mse of a linear pose model": (r["mse_linear_pose_visible"], "mse"),
                    "bytes of a linear pose model": (r["bytes_linear_pose"] / 1e6, "MB")}
        found |= {f"{name}: {key}": {"value": value, "unit": unit} for key, (value, unit) in row.items()}
    return found


def write_figures(results):
    data = json.loads(DATA.read_text())
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short=9", "HEAD"], check=True, capture_output=True, text=True)
    data |= {"command": "bakers/lab/tables/character_tables.py --out out/character_tables --write",
             "commit": commit.stdout.strip(), "date": datetime.date.today().isoformat(), "carried_over": False}
    lines = [f"  {json.dumps(name, ensure_ascii=False)}: {json.dumps(figure)}" for name, figure in figures(results).items()]
    head = json.dumps({key: value for key, value in data.items() if key != "figures"}, indent=1, ensure_ascii=False)
    DATA.write_text(head[:-2] + ',\n "figures": {\n' + ",\n".join(lines) + "\n }\n}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=pathlib.Path, default=ROOT / "build/bakers/tool/nook",
                        help="path of the program nook; default build/bakers/tool/nook")
    parser.add_argument("--lab", type=pathlib.Path, default=ROOT / "build/bakers/lab/tool/nook-lab",
                        help="path of the program nook-lab; default build/bakers/lab/tool/nook-lab")
    parser.add_argument("--assets", type=pathlib.Path, default=ROOT.parent / "shared/assets",
                        help="folder that contains the bodies; default shared/assets beside the source tree")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="write models and reports into this folder")
    parser.add_argument("--write", action="store_true", help="put the tables into the documents instead of printing them")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    results = [(body, split, *measure(options, body, split)) for body in BODIES for split in SPLITS]
    without_clips = [(body, measure_automatic(options, body)) for body in WITHOUT_CLIPS]
    script = pathlib.Path(__file__).name
    show(ROOT / "docs/evidence.md", script, {"summary": summary(results)}, options.write)
    tables = {"errors": errors(results), "sizes": sizes(results), "baselines": baselines(results),
              "automatic": automatic(without_clips)}
    show(ROOT / "docs/lab/character.md", script, tables, options.write)
    if options.write:
        write_figures(results)


if __name__ == "__main__":
    main()
