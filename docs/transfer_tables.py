#!/usr/bin/env python3
"""Bakes radiance transfer of the tests' shapes, measures it under the maps of the assets, and prints the tables of
docs/transfer.md.

    docs/transfer_tables.py --out out/transfer_tables [--material FIBER.nook] [--write]

A step whose report is in the output folder already is not repeated: remove the folder to measure anew. Without --material
the fiber is baked first, which takes two minutes. Maps are those of NOOK_ASSETS, or of ../shared/assets.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parent.parent
MAPS = ["potsdamer_platz", "st_fagans_interior", "venice_sunset", "studio_small_03", "rooitou_park"]
# Shape and number of lobes.
CASES = [("knot", 162), ("knot", 642), ("knot", 1284), ("cloth", 642)]


class Bench:
    def __init__(self, build, out, assets, material):
        self.nook, self.shape_tool = build / "bakers/tool/nook", build / "tests/transfer/transfer_shape"
        self.out, self.material = out, material
        self.maps = [str(next((assets / "hdr").glob(f"{name}*.hdr"))) for name in MAPS]
        out.mkdir(parents=True, exist_ok=True)

    def path(self, name):
        return str(self.out / name)

    def run(self, name, *arguments):
        """The report of a step, made unless it is there."""
        report = pathlib.Path(self.path(name + ".json"))
        if not report.exists():
            print("+ nook " + " ".join(arguments), file=sys.stderr, flush=True)
            subprocess.run([str(self.nook), *arguments, "--quiet", "--report", str(report)], check=True)
        return json.loads(report.read_text())

    def shape(self, name):
        path = self.path(name + ".glb")
        if not pathlib.Path(path).exists():
            subprocess.run([str(self.shape_tool), name, path], check=True)
        return path

    def bake(self, shape, lobes):
        return self.run(f"{shape}_{lobes}_bake", "bake", "transfer", self.shape(shape), "--lobes", str(lobes), "-o",
                        self.path(f"{shape}_{lobes}.nook"))["rows"][0]

    def evaluate(self, shape, lobes, variant, *options):
        self.bake(shape, lobes)
        return self.run(f"{shape}_{lobes}_{variant}", "evaluate", "transfer", self.shape(shape),
                        self.path(f"{shape}_{lobes}.nook"), "--material", self.material, "--light", *self.maps,
                        *options)


def of_form(report, form, key):
    return [row[key] for row in report["rows"] if row["form"] == form]


def vectors_table(bench):
    rows = []
    for shape, lobes in CASES:
        report = bench.evaluate(shape, lobes, "pictures", "--images", str(bench.out), "--paths", "128", "--width", "320", "--height", "240")
        mib = f"{report['rows'][0]['file_bytes'] / 2**20:.2f}"
        for label, form, key in [("separated, exact integrals", "separated", "se_exact_db"),
                                 ("separated", "separated", "se_db"), ("ao", "ao", "se_db"), ("none", "none", "se_db")]:
            numbers = [f"{value:.1f}" for value in of_form(report, form, key)]
            rows.append([shape, str(lobes), label, mib if form == "separated" else "-", *numbers])
    return table(["shape", "lobes", "form", "file, MiB", *MAPS], rows)


def pictures_table(bench):
    rows = []
    for shape, lobes in CASES:
        report = bench.evaluate(shape, lobes, "pictures")
        for form in ["separated", "ao", "none"]:
            rows.append([shape, str(lobes), form, *[f"{value:.1e}" for value in of_form(report, form, "mse")]])
        rows.append([shape, str(lobes), "noise of the truth",
                     *[f"{value:.1e}" for value in of_form(report, "separated", "noise_floor_mse")]])
    return table(["shape", "lobes", "form", *MAPS], rows)


def light_table(bench):
    rows = []
    for label, variant, options in [("all light", "pictures", []),
                                    ("without suns", "no_suns", ["--without-suns", "--no-pictures"])]:
        report = bench.evaluate("knot", 642, variant, *options)
        for what, key, scale in [("S/E, dB", "se_db", 1), ("error of the light, %", "light_error", 100),
                                 ("negative share, %", "negative_share", 100)]:
            rows.append([label, what, *[f"{scale * value:.1f}" for value in of_form(report, "separated", key)]])
    return table(["light", "", *MAPS], rows)


def times_table(bench):
    bake = bench.bake("dense", 642)
    report = bench.evaluate("knot", 642, "times", "--no-pictures")
    vectors = min(of_form(report, "separated", "ms_vectors"))
    count = bench.bake("knot", 642)["vertices"]
    return table(["step", "time"], [
        [f"bake, {bake['vertices']:,} vertices, 642 lobes, two cores", f"{bake['seconds']:.0f} s"],
        ["factoring the Gram matrix, once", f"{report['ms_factor']:.0f} ms"],
        ["fit of a light to the lobes", f"{min(of_form(report, 'separated', 'ms_fit')):.1f} ms"],
        [f"vectors of {count:,} vertices, R_l = 16, one core, AVX2", f"{vectors:.1f} ms"],
        ["the same for 36,000 vertices, in proportion", f"{vectors * 36000 / count:.0f} ms"]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/transfer_tables")
    parser.add_argument("--material", help="a baked fiber")
    parser.add_argument("--write", action="store_true", help="put the tables into the document")
    arguments = parser.parse_args()
    assets = pathlib.Path(os.environ.get("NOOK_ASSETS", ROOT.parent / "shared/assets"))
    bench = Bench(arguments.build, arguments.out, assets, arguments.material or str(arguments.out / "fiber.nook"))
    if not arguments.material:
        bench.run("fiber", "bake", "material", "--meso", "fiber", "-o", bench.material)
    tables = {"vectors": vectors_table(bench), "pictures": pictures_table(bench), "lights": light_table(bench),
              "times": times_table(bench)}
    show(ROOT / "docs/transfer.md", "transfer_tables.py", tables, arguments.write)


if __name__ == "__main__":
    main()
