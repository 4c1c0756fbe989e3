#!/usr/bin/env python3
"""Bakes four materials in seven files, measures grazing views of each, and prints the table of docs/material_decoding.md.

    bakers/lab/tables/material_footprints.py --out out/footprints [--write]

A step is skipped if its report already exists in the output folder. Training a neural material takes minutes.
"""
import pathlib
import subprocess
import sys

from markdown_table import show, table
from material_tables import bench_of_arguments

ROOT = pathlib.Path(__file__).resolve().parents[3]
SMALL = ["--directions", "49", "--texels", "48"]
# For each name: the name of the raw material, the options that make it, and the options of the compression.
MATERIALS = {"weave": ("weave", ["--meso", "weave", *SMALL], []),
             "weave, relief": ("weave", None, ["--relief", "estimated"]),
             "weave, neural": ("weave", None, ["--method", "neural", "--steps", "3000"]),
             "fiber": ("fiber", ["--meso", "fiber", *SMALL], []),
             "rings": ("rings", "bakers/lab/tables/material_rings.py", []),
             "wood": ("wood", "bakers/lab/tables/material_wood.py", ["--ranks", "12,20,24,24"]),
             "wood, neural": ("wood", None, ["--method", "neural"])}


def raw_of(bench, name, source):
    """Returns the raw material, and makes it if it does not exist."""
    raw = bench.path(f"{name}.raw")
    if pathlib.Path(raw).exists():
        return raw
    if source == "bakers/lab/tables/material_wood.py":
        bench.write_wood()
        return raw
    if isinstance(source, str):
        mesh = bench.path(f"{name}.glb")
        subprocess.run([sys.executable, str(ROOT / source), mesh], check=True)
        source = ["--meso", mesh, *SMALL]
    bench.run(f"{name} raw", "bake", "material", *source, "-o", bench.path(f"{name}.nook"), "--keep-raw", raw)
    return raw


def grazing_row(bench, name):
    """Returns the row of the report on grazing views of a material."""
    raw_name, source, options = MATERIALS[name]
    raw, file = raw_of(bench, raw_name, source), bench.path(f"{name} grazing.nook")
    bench.run(f"{name} baked", "bake", "material", "--raw", raw, *options, "-o", file)
    return bench.run(f"{name} grazing", "evaluate", "material", raw, file, "--grazing")["rows"][0]


def cells(name, row):
    errors = {error["fetches"]: error for error in row["grazing"]}
    further = [f"{errors[count]['of_isotropic']:.2f}" for count in (2, 3, 4, 8)]
    raw = [f"{errors[count]['of_isotropic_raw']:.2f}" for count in (2, 3)]
    return [name, f"{errors[1]['mse']:.2e}", *further, f"{errors[1]['mse_raw']:.2e}", *raw]


def main():
    bench, write = bench_of_arguments(__doc__)
    rows = [cells(name, grazing_row(bench, name)) for name in MATERIALS]
    heads = ["material", "mse, isotropic", "2 fetches, of it", "3", "4", "8", "mse to the raw images, isotropic", "2 fetches, of it", "3"]
    show(ROOT / "docs/material_decoding.md", pathlib.Path(__file__).name, {"grazing views": table(heads, rows)}, write)


if __name__ == "__main__":
    main()
