#!/usr/bin/env python3
"""Bakes the built-in materials, compares the methods of compression, and prints the tables of docs/lab/materials.md.

    bakers/lab/tables/material_tables.py --out out/material_tables [--write]

A step is skipped if its report already exists in the output folder. Remove the folder to measure again. A
full-size raw material takes 0.5 GB of disk, and 3 GB of memory while it is baked.
"""
import argparse
import json
import pathlib
import subprocess
import sys

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
# For each name, the options of the bake.
FULL = {"fiber": [], "roughhole": []}
SMALL = {"weave": ["--directions", "49", "--texels", "48"],
         "small roughhole": ["--directions", "100", "--lights", "8", "--texels", "48"],
         "49 x 49 fiber": ["--directions", "49", "--texels", "48"],
         "49 x 49 roughhole": ["--directions", "49", "--texels", "48"]}
# The tables compare methods with the paper's fits and with half floats.
NO_REFITS = ["--votf-refits", "0"]
PAPER = [*NO_REFITS, "--bits", "16"]
# The materials that the tables of number formats contain, with the ranks for the comparison with N-SVD.
NUMBERS = {"wood": ["--ranks", "12,20,24,24"], "49 x 49 fiber": [], "weave": [], "49 x 49 roughhole": []}
SWEEP = [12, 20, 28, 36, 44, 60, 76]
# The smallest ranks that `bake material` allows. They are used if only the raw material is needed as a
# reference.
REST = ["--ranks", "4,8,8,8", "--votf-ranks", "8,8"]


class Bench:
    def __init__(self, tool, lab, out):
        self.tool, self.lab, self.out = tool, lab, out
        out.mkdir(parents=True, exist_ok=True)

    def path(self, name):
        return str(self.out / name.replace(" ", "_"))

    def run(self, name, *arguments, tool=None):
        """Returns the report of a step, and runs the step if the report does not exist. `tool` is nook or
        another tool."""
        tool = tool or self.tool
        report = pathlib.Path(self.path(name) + ".json")
        if not report.exists():
            print(f"+ {tool.name} " + " ".join(arguments), file=sys.stderr, flush=True)
            subprocess.run([str(tool), *arguments, "--quiet", "--report", str(report)], check=True)
        return json.loads(report.read_text())

    def bake(self, material, options):
        """Bakes a material and keeps the raw material."""
        return self.run(f"{material} bake", "bake", "material", "--meso", material.split()[-1], *options, *PAPER, "-o",
                        self.path(f"{material}.nook"), "--keep-raw", self.path(f"{material}.raw"))

    def compress(self, material, variant, options, common=PAPER):
        """Compresses a kept raw material again."""
        return self.run(f"{material} {variant}", "bake", "material", "--raw", self.path(f"{material}.raw"),
                        *common, *options, "-o", self.path(f"{material} {variant}.nook"))

    def write_wood(self):
        if not pathlib.Path(self.path("wood.raw")).exists():
            subprocess.run([sys.executable, str(ROOT / "bakers/lab/tables/material_wood.py"), self.path("wood.raw")], check=True)

    def compare(self, name, *arguments):
        """Returns the report of nook-lab, which also measures other methods."""
        return self.run(name, *arguments, tool=self.lab)

    def evaluate(self, material, variant, options):
        return self.compare(f"{material} {variant} evaluated", "evaluate", "material", self.path(f"{material}.raw"),
                            self.path(f"{material}.nook"), *options, *NO_REFITS)


def mib(bytes_):
    return f"{bytes_ / 2**20:.2f}"


def count(texels):
    return "-" if texels is None else str(texels)


def mixture(row):
    return str(row["k"]) if "K-CTA" in row["method"] else "-"


def methods_table(reports):
    return table(["material", "method", "K", "view rank", "file, MiB", "numbers, MiB", "S/E, dB", "error texels (B)", "(S)"],
                 [[material, r["method"], mixture(r), count(r["view_rank"]), mib(r["file_bytes"]), mib(r["bytes"]),
                   f"{r['se_db']:.2f}", count(r["votf_error_texels_binary"]), count(r["votf_error_texels_distance"])]
                  for material, report in reports.items() for r in report["rows"][1:]])


def unseen_table(reports, views, unseen_views):
    """Makes the table of unseen views. Error texels are per 10,000 texels."""
    def share(texels, of):
        return "-" if texels is None else f"{1e4 * texels / (of * 96 * 96):.0f}"
    return table(["material", "method", "K", "file, MiB", "S/E, dB: fitted views", "unseen views",
                  "error texels (S), of 10,000: fitted", "unseen"],
                 [[material, r["method"], mixture(r), mib(r["file_bytes"]), f"{r['se_db']:.2f}", f"{r['se_db_unseen']:.2f}",
                   share(r["votf_error_texels_distance"], views), share(r.get("votf_error_texels_unseen"), unseen_views)]
                  for material, report in reports.items() for r in report["rows"] if "se_db_unseen" in r])


def maps_table(maps):
    return table(["material", "cells a side", "file, MiB", "S/E, dB, unseen views", "error texels (S), unseen views"],
                 [[material, str(side), mib(r["file_bytes"]), f"{r['se_db_unseen']:.2f}", count(r["votf_error_texels_unseen"])]
                  for material, side, r in maps])


def sweep_table(report):
    rows = {}
    for r in report["sweep"]:
        label = r["method"] + (f" ({r['k']})" if r["method"] == "K-CTA" else "")
        rows.setdefault(label, {})[r["view_rank"]] = r
    columns = {"file, KiB": lambda r: f"{r['file_bytes'] / 1024:.0f}", "S/E, dB": lambda r: f"{r['se_db']:.2f}",
               "(B)": lambda r: count(r["votf_error_texels_binary"]),
               "(S)": lambda r: count(r["votf_error_texels_distance"])}
    return table(["total view rank", *map(str, SWEEP)],
                 [[f"{label}, {name}", *(show(of[rank]) if rank in of else "-" for rank in SWEEP)]
                  for label, of in rows.items() for name, show in columns.items()])


def thresholds_table(reports):
    rows = []
    for material, threshold, report in reports:
        compression, r = report["recipe"]["compression"], report["rows"][0]
        ranks = ", ".join(map(str, compression["ranks"])) + "; " + ", ".join(map(str, compression["votf_ranks"]))
        rows.append([material, f"{100 * threshold:g} %", ranks, str(compression["clusters"]),
                     f"{r['file_bytes'] / 1024:.0f}", f"{r['se_db']:.2f}", count(r["votf_error_texels_distance"])])
    return table(["material", "threshold", "ranks: light, view, x, y; VOTF x, y", "C", "file, KiB", "S/E, dB",
                  "error texels (S)"], rows)


def seeding_table(report):
    return table(["first clusters", "method", "file, KiB", "S/E, dB", "error texels (B)", "(S)"],
                 [[r["seeding"], r["method"] + (" (3)" if r["method"] == "K-CTA" else ""), f"{r['file_bytes'] / 1024:.0f}",
                   f"{r['se_db']:.2f}", count(r["votf_error_texels_binary"]), count(r["votf_error_texels_distance"])]
                  for r in report["seeding"]])


def numbers_table(rows):
    """Makes a table with one row for each material, method and number of bits."""
    return table(["material", "method", "bits", "file, KiB", "a byte each, KiB", "S/E, dB", "drawn", "GPU, bytes for each texel"],
                 [[material, r["method"].replace("file: ", ""), bits, f"{r['file_bytes'] / 1024:.0f}",
                   f"{r['bytes'] * 8 / int(bits) / 1024:.0f}", f"{r['se_db']:.2f}", f"{r['se_db_drawn']:.2f}",
                   f"{r['gpu_bytes_texel']:.0f}"] for material, bits, r in rows])


def numbers_rows(bench):
    bench.write_wood()
    for material, ranks in NUMBERS.items():
        for method, refits in (("k-cta", []), ("n-svd", NO_REFITS)):
            for bits in ("16", "8"):
                name = f"{method} {bits} bits"
                bench.compress(material, name, [*ranks, "--method", method, "--bits", bits], refits)
                report = bench.run(f"{material} {name} evaluated", "evaluate", "material", bench.path(f"{material}.raw"),
                                   bench.path(f"{material} {name}.nook"))
                yield material, bits, report["rows"][0]


# Modes of `evaluate material`: the block format, and the number of light modes that are not compressed. The
# value 1,024 is more than any of these files has.
BLOCKS = {"half floats": ("plain", 4), "signed bytes, light map of blocks": ("rgtc", 1024), "RGTC but for 8 light modes": ("rgtc", 8),
          "RGTC but for 4 light modes": ("rgtc", 4), "EAC but for 4 light modes": ("eac", 4), "RGTC": ("rgtc", 0)}


def blocks_table(bench):
    """Writes the bytes and the errors of textures in blocks, for the half-float files that numbers_rows makes."""
    rows = []
    for material in NUMBERS:
        for name, (modes, whole) in BLOCKS.items():
            r = bench.run(f"{material} {modes} {whole}", "evaluate", "material", bench.path(f"{material}.raw"),
                          bench.path(f"{material} k-cta 16 bits.nook"), "--modes", modes, "--whole-light-modes", str(whole))["rows"][0]
            rows.append([material, name, f"{r['gpu_bytes_texel']:.0f}", f"{r['se_db_drawn']:.2f}", f"{r['se_db_drawn'] - r['se_db']:.2f}"])
    return table(["material", "modes", "GPU, bytes for each texel", "drawn, S/E, dB", "less the file"], rows)


def jumps_table(bench):
    """Makes the table of the largest jump and the 99th percentile of each method, with and without its view
    map."""
    def pair(row, rest):
        return [f"{row[key + rest]:.3f}" for key in ("jump_largest", "jump_99")] if "jump_largest" + rest in row else ["-", "-"]
    rows = []
    for material in ("49 x 49 fiber", "weave", "49 x 49 roughhole"):
        report = bench.compare(f"{material} jumps", "evaluate", "material", bench.path(f"{material}.raw"),
                               bench.path(f"{material} k-cta 8 bits.nook"), "--methods", "n-svd,cta", "--jumps", "--images",
                               bench.path("images"))
        for r in report["rows"]:
            mapped, plain = (pair(r, ""), pair(r, "_without_map")) if "jump_99_without_map" in r else (["-", "-"], pair(r, ""))
            rows.append([material, r["method"].replace("file: ", ""), *mapped, *plain])
    return table(["material", "method", "view map: largest", "99 %", "three nearest views: largest", "99 %"], rows)


def between_rows(bench):
    """Measures a material file and the maps fitted to the same material, at views and lights that were not
    used for either fit. Also measures K-CTA with more views at the same ranks, with and without a relief."""
    def evaluated(name, file, between):
        return bench.run(f"{file} between", "evaluate", "material", bench.path(f"{name}.raw"), bench.path(f"{file}.nook"),
                         "--unseen", between, "--jumps")["rows"][0]
    for material in ("weave", "49 x 49 fiber", "49 x 49 roughhole"):
        shape, between = material.split()[-1], bench.path(f"{material} between.raw")
        bench.run(f"{material} between", "bake", "material", "--meso", shape, "--directions", "37", "--texels", "48", *REST,
                  "-o", bench.path(f"{material} between.nook"), "--keep-raw", between)
        report = bench.evaluate(material, "between", ["--unseen", between, "--methods", "pbr"])
        ranks = ["--ranks", ",".join(map(str, report["settings"]["ranks"]))]
        name = f"{material} 147 views"
        bench.run(f"{name} bake", "bake", "material", "--meso", shape, "--directions", "147", "--lights", "49",
                  "--texels", "48", *ranks, *PAPER, "-o", bench.path(f"{name}.nook"), "--keep-raw", bench.path(f"{name}.raw"))
        for raw, views in ((material, "49"), (name, "147")):
            for relief in ("none", "estimated"):
                file = f"{raw} relief {relief}"
                bench.compress(raw, f"relief {relief}", [*ranks, "--relief", relief], NO_REFITS)
                yield material, views, relief, evaluated(raw, file, between)
        for row in report["rows"][1:]:
            yield material, "49", "", row


def between_table(rows):
    return table(["material", "method", "fitted views", "file, KiB", "S/E, dB: fitted", "unseen views and lights",
                  "largest jump", "99 %"],
                 [[material, row["method"].replace("file: ", "") + (", relief" if relief == "estimated" else ""), views,
                   f"{row['file_bytes'] / 1024:.0f}", f"{row['se_db']:.2f}", f"{row['se_db_unseen']:.2f}",
                   *(f"{row[key]:.3f}" if key in row else "-" for key in ("jump_largest", "jump_99"))]
                  for material, views, relief, row in rows])


def neural_rows(bench):
    """Compares 8-bit files with all baselines at the size of the whole file. The views were not used for the
    fit. The lights were not used either, except for wood."""
    bench.write_wood()
    for material, ranks in NUMBERS.items():
        if material.endswith("roughhole"):
            continue
        bench.compress(material, "k-cta 8 bits", [*ranks, "--method", "k-cta", "--bits", "8"], [])
        unseen = bench.path(f"{material} between.raw")
        if material == "wood" and not pathlib.Path(unseen).exists():
            subprocess.run([sys.executable, str(ROOT / "bakers/lab/tables/material_wood.py"), unseen, "--views", "between"], check=True)
        report = bench.compare(f"{material} neural", "evaluate", "material", bench.path(f"{material}.raw"),
                               bench.path(f"{material} k-cta 8 bits.nook"), "--unseen", unseen, "--methods",
                               "n-svd,cta,pca,pbr,neural", *NO_REFITS)
        for row in report["rows"]:
            yield material, row
        if material != "wood":  # made by between_rows
            row = json.loads(pathlib.Path(bench.path(f"{material} relief estimated between") + ".json").read_text())["rows"][0]
            yield material, {**row, "method": "K-CTA, relief"}


def neural_table(rows):
    def cell(row, key):
        return f"{row[key]:.2f}" if key in row else "-"
    return table(["material", "method", "file, KiB", "S/E, dB: fitted", "unseen", "PSNR, toned, dB", "GPU, bytes for each texel"],
                 [[material, row["method"].replace("file: ", ""), f"{row['file_bytes'] / 1024:.0f}",
                   cell(row, "se_db"), cell(row, "se_db_unseen"), cell(row, "psnr_toned_db"),
                   f"{row['gpu_bytes_texel']:.0f}" if "gpu_bytes_texel" in row else "-"] for material, row in rows])


def cycles_table():
    """Makes the table of modelled cycles, from the counts of bakers/lab/tables/gpu_cost.py."""
    counts = json.loads((ROOT / "tests/bakers/lab/gpu_cost/counts.json").read_text())["rows"]
    sums = {row["shader"]: row["alu_cycles"] + row["texture_cycles"] for row in counts if row["family"] == "navi21"}
    names = {"K-CTA, weave": "material, weave, K-CTA, K = 3", "neural, small": "neural material, small",
             "neural, equal bytes": "neural material, equal bytes"}
    return table(["", "one light", "four lights and a probe"],
                 [[label, f"{sums[name]:,.0f}", f"{sums[name + ', four lights and a probe']:,.0f}"]
                  for label, name in names.items()])


def summary_table(reports):
    """Makes the table of the signal-to-error ratio and the file size of each method."""
    def cell(rows, method, mixture):
        row = next(r for r in rows if r["method"] == method and r["k"] == mixture)
        return f"{row['se_db']:.2f} ({mib(row['file_bytes'])})"
    columns = {"PCA": ("PCA", 1), "N-SVD": ("N-SVD, equal bytes", 1), "CTA": ("CTA", 1), "K-CTA": ("K-CTA", 3)}
    return table(["", "raw", *columns],
                        [[material, "1.03 GiB", *(cell(report["rows"], *of) for of in columns.values())]
                         for material, report in reports.items()])


def bench_of_arguments(description):
    """Parses the arguments of a script. Returns the bench, and whether to write into the documents."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=pathlib.Path, default=ROOT / "build/bakers/tool/nook", help="path of the program nook; default build/bakers/tool/nook")
    parser.add_argument("--lab", type=pathlib.Path, default=ROOT / "build/bakers/lab/tool/nook-lab", help="path of the program nook-lab; default build/bakers/lab/tool/nook-lab")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="write materials and reports into this folder")
    parser.add_argument("--write", action="store_true", help="put the tables into the documents instead of printing them")
    options = parser.parse_args()
    return Bench(options.tool, options.lab, options.out), options.write


def main():
    bench, write = bench_of_arguments(__doc__)
    for material, its in SMALL.items():
        bench.bake(material, its)
    weave = bench.evaluate("weave", "peers", [])
    numbers = numbers_table(list(numbers_rows(bench)))
    blocks = blocks_table(bench)
    between = between_table(list(between_rows(bench)))
    small = "small roughhole"
    sweep = bench.evaluate(small, "sweep", ["--methods", "none", "--sweep", ",".join(map(str, SWEEP)), "--images", bench.path("images")])
    seeding = bench.evaluate(small, "seeding", ["--methods", "none", "--compare-seeding"])
    thresholds = [(material, threshold,
                   bench.compress(material, f"threshold {threshold}", ["--ranks", "auto", "--threshold", str(threshold)]))
                  for material in (small, "weave") for threshold in (0.01, 0.003)]
    methods, maps = {}, []
    for material, its in FULL.items():
        bench.bake(material, its)
        unseen = bench.path(f"{material} unseen.raw")
        bench.run(f"{material} unseen", "bake", "material", "--meso", material, "--directions", "37", "--lights", "100",
                  *REST, "-o", bench.path(f"{material} unseen.nook"), "--keep-raw", unseen)
        for side in (256, 64, 32):
            bench.compress(material, f"map {side}", ["--view-map", str(side)])
            report = bench.run(f"{material} map {side} evaluated", "evaluate", "material", bench.path(f"{material}.raw"),
                               bench.path(f"{material} map {side}.nook"), "--unseen", unseen)
            maps.append((material, side, report["rows"][0]))
        methods[material] = bench.evaluate(material, "peers", ["--unseen", unseen, "--images", bench.path("images")])
    page = ROOT / "docs/lab/materials.md"
    # These tables are not on the page, so they are always printed.
    show(page, pathlib.Path(__file__).name,
         {"unseen views": unseen_table(methods, 100, 37), "view ranks": sweep_table(sweep), "first clusters": seeding_table(seeding)}, False)
    show(page, pathlib.Path(__file__).name,
         {"methods": methods_table({**methods, "weave": weave}),
          "view maps": maps_table(maps), "thresholds": thresholds_table(thresholds), "numbers": numbers, "modes in blocks": blocks, "jumps": jumps_table(bench),
          "between the samples": between, "neural": neural_table(neural_rows(bench)), "neural cycles": cycles_table()}, write)
    show(ROOT / "docs/evidence.md", pathlib.Path(__file__).name, {"materials": summary_table(methods)}, write)


if __name__ == "__main__":
    main()
