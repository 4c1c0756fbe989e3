#!/usr/bin/env python3
"""Bakes four materials in seven files, measures grazing views of each, and prints the table of docs/material_decoding.md.

    docs/material_footprints.py --out out/footprints [--write]

A file that is in the output folder already is not baked again. Neural materials train for minutes.
"""
import argparse
import json
import pathlib
import subprocess
import sys

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parent.parent
SMALL = ["--directions", "49", "--texels", "48"]
# Name: the raw material's name, how it is made, and options of its compression.
MATERIALS = {"weave": ("weave", ["--meso", "weave", *SMALL], []),
             "weave, relief": ("weave", None, ["--relief", "estimated"]),
             "weave, neural": ("weave", None, ["--method", "neural", "--steps", "3000"]),
             "fiber": ("fiber", ["--meso", "fiber", *SMALL], []),
             "rings": ("rings", "docs/material_rings.py", []),
             "wood": ("wood", "docs/material_wood.py", ["--ranks", "12,20,24,24"]),
             "wood, neural": ("wood", None, ["--method", "neural"])}


class Bench:
    def __init__(self, tool, out):
        self.tool, self.out = tool, out
        out.mkdir(parents=True, exist_ok=True)

    def run(self, *arguments):
        print("+ " + " ".join(map(str, arguments)), file=sys.stderr, flush=True)
        subprocess.run([str(a) for a in arguments], check=True)

    def raw_of(self, name, source):
        raw = self.out / f"{name}.raw"
        if raw.exists():
            return raw
        if source == "docs/material_wood.py":
            self.run(sys.executable, ROOT / source, raw)
            return raw
        if isinstance(source, str):
            self.run(sys.executable, ROOT / source, self.out / f"{name}.glb")
            source = ["--meso", self.out / f"{name}.glb", *SMALL]
        self.run(self.tool, "bake", "material", *source, "-o", self.out / f"{name}.nook", "--keep-raw", raw, "--quiet")
        return raw

    def row(self, name):
        """The row of the report of a material's grazing views."""
        raw_name, source, options = MATERIALS[name]
        raw, file = self.raw_of(raw_name, source), self.out / f"{name.replace(', ', '_')}.nook"
        if not file.exists():
            self.run(self.tool, "bake", "material", "--raw", raw, *options, "-o", file, "--quiet")
        report = self.out / f"{file.stem}.json"
        self.run(self.tool, "evaluate", "material", raw, file, "--grazing", "--quiet", "--report", report)
        return json.loads(report.read_text())["rows"][0]


def cells(name, row):
    errors = {error["fetches"]: error for error in row["grazing"]}
    further = [f"{errors[count]['of_isotropic']:.2f}" for count in (2, 3, 4, 8)]
    raw = [f"{errors[count]['of_isotropic_raw']:.2f}" for count in (2, 3)]
    return [name, f"{errors[1]['mse']:.2e}", *further, f"{errors[1]['mse_raw']:.2e}", *raw]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=pathlib.Path, default=ROOT / "build/bakers/tool/nook")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for materials and reports")
    parser.add_argument("--write", action="store_true", help="put the table into the document instead of printing it")
    options = parser.parse_args()
    bench = Bench(options.tool, options.out)
    rows = [cells(name, bench.row(name)) for name in MATERIALS]
    heads = ["material", "mse, isotropic", "2 fetches, of it", "3", "4", "8", "mse to the raw images, isotropic", "2 fetches, of it", "3"]
    show(ROOT / "docs/material_decoding.md", pathlib.Path(__file__).name, {"grazing views": table(heads, rows)}, options.write)


if __name__ == "__main__":
    main()
