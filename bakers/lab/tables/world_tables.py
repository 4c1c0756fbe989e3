#!/usr/bin/env python3
"""Bakes characters, runs `nook evaluate world` on them, and prints the tables of docs/guide/world.md and
docs/lab/world.md.

    bakers/lab/tables/world_tables.py --nook build/bakers/tool/nook [--write] [--keep DIR] [--room SCENE.glb=METRES] [--light MAP.hdr] CHARACTER.glb ...

Half of the clips are used for the fit, and the other half for the measurement. The self-shadow is fitted with
few steps and rays (--steps 100 --rays 4), because the casters do not depend on it. With --keep, models and
reports are kept, and existing ones are reused. The table of rooms has the first character in the built-in
room and in the rooms that you give with --room. METRES is the number of metres per unit of the scene. Without
--room, this table is not changed. With --light, only the table of irradiance under these maps is made.
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCRIPT = pathlib.Path(__file__).name
DOCUMENT = ROOT / "docs/guide/world.md"
LAB = ROOT / "docs/lab/world.md"
BAKE = ["--split", "half", "--auto-poses", "300", "--samples-per-clip", "8", "--steps", "100", "--rays", "4"]
EVALUATE = ["--max-poses", "44", "--points", "600"]
LIGHTS = ["--max-poses", "12", "--points", "400", "--rays", "512"]
ROOMS = ["--composite", "--views", "8", "--rays", "128"]
# Rows of the table.
RULES = ["nook", "nook, half resolution", "mask, product", "mask, sum", "mask, between sum and minimum", "mask, minimum", "product", "minimum",
         "screen", "screen without characters", "world", "none"]


def surface_of(row):
    return f"cone {row['cone_degrees']:g}°" if row["surface"] == "cone" else row["surface"]


def bake(nook, character, folder):
    model = folder / f"{character.stem}.nook"
    if not model.exists():
        subprocess.run([nook, "bake", "character", character, "-o", model, *BAKE, "--quiet"], check=True)
    return model


def measure(nook, character, folder):
    model, report = bake(nook, character, folder), folder / f"{character.stem}.json"
    if not report.exists():
        subprocess.run([nook, "evaluate", "world", character, model, *EVALUATE, "--report", report, "--quiet"], check=True)
    return json.loads(report.read_text())["rows"]


def measure_rooms(nook, character, folder, rooms):
    report = folder / f"{character.stem}_rooms.json"
    if not report.exists():
        scenes = [word for room in rooms for word in ("--scene", room.split("=")[0], "--scene-metres", room.split("=")[1])]
        subprocess.run([nook, "evaluate", "world", character, folder / f"{character.stem}.nook", *ROOMS, *scenes, "--report", report,
                        "--quiet"], check=True)
    return json.loads(report.read_text())["rows"]


def room_table(rows):
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    by = {(row["scene"], row["region"], row["method"]): row for row in rows}
    lines = [[rule, *(f"{by[scene, 'darkened', rule]['mse'] * 1e3:.2f} ({by[scene, 'darkened', rule]['bias']:+.3f})" for scene in scenes),
              *(f"{by[scene, 'elsewhere', rule]['mse'] * 1e3:.2f}" for scene in scenes[-1:])] for rule in RULES]
    return table(["", *scenes, f"elsewhere, {scenes[-1]}"], lines)


def measure_lights(nook, character, folder, maps):
    model, report = bake(nook, character, folder), folder / f"{character.stem}_lights.json"
    if not report.exists():
        lights = [word for path in maps for word in ("--light", path)]
        subprocess.run([nook, "evaluate", "world", character, model, *LIGHTS, *lights, "--report", report, "--quiet"], check=True)
    return json.loads(report.read_text())["rows"]


# For each surface, there are three columns: all light; light without the sun; and all light, with the
# irradiance of the map instead of the irradiance of the lobes.
PARTS = [("floor", ""), ("wall", ""), ("floor", "_soft"), ("wall", "_soft"), ("floor", "_exact"), ("wall", "_exact")]


def light_table(rows_by_character):
    lines, ratios = [], {part: [] for part in PARTS}
    for name, rows in rows_by_character.items():
        by = {(row["map"], row["surface"]): row for row in rows if row["method"] == "per_lobe"}
        for light in dict.fromkeys(row["map"] for row in rows):
            cells = []
            for surface, part in PARTS:
                row, key = by[light, surface], f"over_ao_x_probe{part}"
                ratios[surface, part].append(row[key])
                bounds = "" if part else f" [{row[key + '_low']:.2f}, {row[key + '_high']:.2f}]"
                cells.append(f"{row[key]:.2f}{bounds}")
            lines.append([name, light.removesuffix("_1k"), "yes" if by[light, "floor"]["sun"] else "no", *cells])
    means = [f"{math.exp(sum(map(math.log, values)) / len(values)):.2f}" for values in ratios.values()]
    lines.append(["geometric mean", "", "", *means])
    return table(["character", "map", "sun", "floor", "wall", "floor, no sun", "wall, no sun", "floor, exact", "wall, exact"], lines)


def tables(rows_by_character):
    lines = []
    for name, rows in rows_by_character.items():
        by_surface = {}
        for row in rows:
            by_surface.setdefault(surface_of(row), {})[row["method"]] = row
        for surface, methods in by_surface.items():
            own = methods["nook"]
            others = [f"{methods[m]['over_none']:.3f}" for m in ("capsules", "ellipsoids", "blobs")]
            lines.append([name, surface, f"{own['over_none']:.4f} [{own['over_none_low']:.4f}, {own['over_none_high']:.4f}]",
                          f"{own['over_capsules']:.2f} [{own['over_capsules_low']:.2f}, {own['over_capsules_high']:.2f}]", *others])
    return {"errors": table(["character", "surface", "over none", "over capsules", "capsules", "ellipsoids", "blobs"], lines)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--nook", default=ROOT / "build/bakers/tool/nook", help="path of the program nook; default build/bakers/tool/nook")
    parser.add_argument("--write", action="store_true", help="put the tables into the documents instead of printing them")
    parser.add_argument("--keep", type=pathlib.Path, help="keep models and reports in this folder, and use those that it already contains")
    parser.add_argument("--room", action="append", default=[], help="SCENE.glb=METRES: also measure in this room; METRES is the number of metres per unit of the scene. You can repeat the option")
    parser.add_argument("--light", action="append", default=[], type=pathlib.Path, help="make only the table of irradiance, under this light map; you can repeat the option")
    parser.add_argument("characters", nargs="+", type=pathlib.Path, help="the characters to bake and measure, .glb files")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        if options.light:
            found = {"lights": light_table({character.stem: measure_lights(options.nook, character, folder, options.light)
                                            for character in options.characters})}
        else:
            found = tables({character.stem: measure(options.nook, character, folder) for character in options.characters})
        if options.room:
            rooms = room_table(measure_rooms(options.nook, options.characters[0], folder, options.room))
            show(DOCUMENT, SCRIPT, {"rooms": rooms}, options.write)
    show(LAB, SCRIPT, found, options.write)


if __name__ == "__main__":
    main()
