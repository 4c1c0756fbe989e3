#!/usr/bin/env python3
"""Bakes radiance transfer for the shapes of the tests, measures it under the light maps of the assets, and
prints the tables of docs/lab/transfer.md.

    bakers/lab/tables/transfer_tables.py --out out/transfer_tables [--material FIBER.nook --raw FIBER.raw] [--write]

--only NAME,... makes only these tables: vectors, pictures, raw, lights, times, reflections, holes, paper. A
step is skipped if its report already exists in the output folder. Remove the folder to measure again. Without
--material, the script first bakes the fiber material, which takes two minutes. Light maps are read from
NOOK_ASSETS, or from ../shared/assets.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
MAPS = ["potsdamer_platz", "st_fagans_interior", "venice_sunset", "studio_small_03", "rooitou_park"]
# Shapes and numbers of lobes.
CASES = [("knot", 162), ("knot", 642), ("knot", 1284), ("cloth", 642)]
# Shapes whose pictures are compared with the raw material.
RAW_SHAPES = ["knot", "mannequin", "cloth"]


class Bench:
    def __init__(self, build, out, assets, material, raw):
        self.nook, self.shape_tool = build / "bakers/tool/nook", build / "tests/transfer/transfer_shape"
        self.out, self.material, self.raw = out, material, raw
        self.maps = [str(next((assets / "hdr").glob(f"{name}*.hdr"))) for name in MAPS]
        out.mkdir(parents=True, exist_ok=True)

    def path(self, name):
        return str(self.out / name)

    def run(self, name, *arguments):
        """Returns the report of a step, and runs the step if the report does not exist."""
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

    def bake_form(self, name, shape, *options):
        """Bakes with the given options and returns the row of the report. The file has the name `name`."""
        return self.run(f"{name}_bake", "bake", "transfer", self.shape(shape), "-o", self.path(f"{name}.nook"),
                        *options)["rows"][0]

    def evaluate_form(self, name, shape, variant, *options):
        return self.run(f"{name}_{variant}", "evaluate", "transfer", self.shape(shape), self.path(f"{name}.nook"),
                        "--material", self.material, "--light", *self.maps, *options)

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


def raw_table(bench):
    rows = []
    for shape in RAW_SHAPES:
        raw = bench.evaluate(shape, 642, "raw", "--raw", bench.raw, *FEW)
        decoded = bench.evaluate(shape, 642, "decoded", *FEW)
        bench.bake_form(f"{shape}_642_paper", shape, "--form", "paper", "--material", bench.material)
        paper = bench.evaluate_form(f"{shape}_642_paper", shape, "raw", "--raw", bench.raw, *FEW)
        rows.append([shape, "raw", "separated", *mse_row(raw)])
        rows.append([shape, "raw", "paper", *mse_row(paper, "paper")])
        rows += [[shape, "raw", form, *mse_row(raw, form)] for form in ["ao", "none"]]
        rows += [[shape, "decoded", form, *mse_row(decoded, form)] for form in ["separated", "ao", "none"]]
        rows.append([shape, "raw", "noise of the truth", *mse_row(raw, key="noise_floor_mse")])
    return table(["shape", "truth", "form", *MAPS], rows)


def light_table(bench):
    rows = []
    for label, variant, options in [("all light", "pictures", []),
                                    ("without suns", "no_suns", ["--without-suns", "--no-pictures"])]:
        report = bench.evaluate("knot", 642, variant, *options)
        for what, key, scale in [("S/E, dB", "se_db", 1), ("error of the light, %", "light_error", 100),
                                 ("negative share, %", "negative_share", 100)]:
            rows.append([label, what, *[f"{scale * value:.1f}" for value in of_form(report, "separated", key)]])
    return table(["light", "", *MAPS], rows)


# Smaller pictures, because path tracing with reflections takes four times as long as with direct light.
FEW = ["--width", "160", "--height", "120", "--paths", "64"]


def mse_row(report, form="separated", key="mse"):
    return [f"{value:.1e}" for value in of_form(report, form, key)]


def reflections_table(bench):
    rows = []
    for bounces in [0, 1, 2]:
        name = f"knot_642_bounces_{bounces}"
        bake = bench.bake_form(name, "knot", "--bounces", str(bounces))
        report = bench.evaluate_form(name, "knot", "pictures", "--truth-bounces", "2", *FEW)
        rows.append([str(bounces), f"{bake['file_bytes'] / 2**20:.2f}", f"{bake['indirect_bytes'] / 2**20:.2f}",
                     *mse_row(report)])
    rows.append(["noise of the truth", "-", "-", *mse_row(report, key="noise_floor_mse")])
    return table(["bounces of the file", "file, MiB", "of it reflections, MiB", *MAPS], rows)


def holes_table(bench):
    rows = []
    for label, name, options in [("with holes", "knot_642_holes", ["--votf", bench.material]),
                                 ("without", "knot_642_bounces_0", [])]:
        bench.bake_form(name, "knot", *options)
        report = bench.evaluate_form(name, "knot", "holes", "--truth-holes", *FEW)
        rows.append([label, "S/E, dB", *[f"{value:.1f}" for value in of_form(report, "separated", "se_db")]])
        rows.append([label, "squared error of pictures", *mse_row(report)])
    rows.append(["noise of the truth", "squared error of pictures", *mse_row(report, key="noise_floor_mse")])
    return table(["file", "", *MAPS], rows)


# Numbers of clusters and vertex ranks of clustered PCA. Each cluster has a matrix of all lobes for each
# vertex mode. With these numbers, a file takes slightly fewer bytes than the paper's form.
PCA = [(38, 1), (19, 2), (12, 3), (9, 4)]
# The same, but all matrices share 128 combinations of lobes, which are stored once.
COMMON_PCA = [(22, 8)]


def paper_table(bench):
    rows = []

    def row(label, name, size, *options):
        bake = bench.bake_form(name, "knot", *options)
        report = bench.evaluate_form(name, "knot", "vectors", "--no-pictures")
        form = "separated" if label.startswith("separated") else "paper"
        rows.append([label, f"{size(bake) / 2**20:.2f}",
                     *[f"{value:.1f}" for value in of_form(report, form, "se_db")],
                     f"{min(of_form(report, form, 'ms_vectors')):.1f}"])
        return bake

    row("separated", "knot_642_bounces_0", lambda bake: bake["file_bytes"])
    of_paper = ["--form", "paper", "--material", bench.material]
    bake = row("paper, CTA", "knot_642_paper", lambda bake: bake["file_bytes"], *of_paper)
    modes = bake["light_modes"]
    for clusters, rank in PCA:
        row(f"clustered PCA, {clusters} x {rank}", f"knot_642_pca_{clusters}_{rank}",
            lambda bake: 2 * rank * clusters * 642 * 3 * modes + bake["vertices"] * (2 * rank + 1), *of_paper,
            "--lobe-rank", "128", "--vertex-rank", str(rank), "--clusters", str(clusters))
    for clusters, rank in COMMON_PCA:
        row(f"clustered PCA of 128 combinations, {clusters} x {rank}", f"knot_642_pca_{clusters}_{rank}",
            lambda bake: 2 * 128 * (642 + rank * clusters * 3 * modes) + bake["vertices"] * (2 * rank + 1), *of_paper,
            "--lobe-rank", "128", "--vertex-rank", str(rank), "--clusters", str(clusters))
    return table(["form", "MiB", *MAPS, "vectors, ms"], rows)


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
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="build folder that contains the programs; default build")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/transfer_tables", help="write transfers and reports into this folder; default out/transfer_tables")
    parser.add_argument("--material", help="the baked fiber material, a .nook file; default: bake it first, which takes two minutes")
    parser.add_argument("--raw", help="with --material: the raw fiber material, which `nook bake material --keep-raw` wrote")
    parser.add_argument("--only", help="make only these tables; separate their names by commas. Default: all")
    parser.add_argument("--write", action="store_true", help="put the tables into the document instead of printing them")
    arguments = parser.parse_args()
    assets = pathlib.Path(os.environ.get("NOOK_ASSETS", ROOT.parent / "shared/assets"))
    bench = Bench(arguments.build, arguments.out, assets, arguments.material or str(arguments.out / "fiber.nook"),
                  arguments.raw or str(arguments.out / "fiber.raw"))
    if not arguments.material:
        bench.run("fiber", "bake", "material", "--meso", "fiber", "-o", bench.material, "--keep-raw", bench.raw)
    makers = {"vectors": vectors_table, "pictures": pictures_table, "raw": raw_table, "lights": light_table, "times": times_table,
              "reflections": reflections_table, "holes": holes_table, "paper": paper_table}
    names = arguments.only.split(",") if arguments.only else list(makers)
    tables = {name: makers[name](bench) for name in names}
    show(ROOT / "docs/lab/transfer.md", "transfer_tables.py", tables, arguments.write)


if __name__ == "__main__":
    main()
