#!/usr/bin/env python3
"""Counts the instructions of every shader with nook_gpu_cost. Prints the table of docs/gpu_cost.md, and a
table of all shaders.

    bakers/lab/tables/gpu_cost.py [--write]     --write puts the table into the document and the counts into the file that the test reads
    bakers/lab/tables/gpu_cost.py --committed   prints the tables of the committed counts; counts nothing
    bakers/lab/tables/gpu_cost.py --check       fails if the document's table differs from that file; counts nothing
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCRIPT = pathlib.Path(__file__).name
DOCUMENT = ROOT / "docs/gpu_cost.md"
COUNTS = ROOT / "tests/bakers/lab/gpu_cost/counts.json"
FAMILIES = ["navi21", "gfx1100", "vega10"]


def number(value):
    return f"{value:,.0f}"


def cycles(row):
    return row["alu_cycles"] + row["texture_cycles"]


def by_name(rows, key):
    """Returns the rows of the first family, each with the rows of the same name in all families."""
    found = {}
    for row in rows:
        found.setdefault(row[key], {})[row["family"]] = row
    return found


def passes_table(report):
    rows = by_name(report["passes"], "pass")
    reference = cycles(next(of for name, of in rows.items() if name.startswith("HBAO 64,"))[FAMILIES[0]])
    return table(["pass", "ALU cycles", "texture cycles", "sum", "of HBAO 64", *(f"sum, {f}" for f in FAMILIES[1:])],
                 [[name, number(of[FAMILIES[0]]["alu_cycles"]), number(of[FAMILIES[0]]["texture_cycles"]),
                   number(cycles(of[FAMILIES[0]])), f"{cycles(of[FAMILIES[0]]) / reference:.2f}",
                   *(number(cycles(of[f])) for f in FAMILIES[1:])] for name, of in rows.items()])


def shaders_table(report):
    columns = {"VALU": "valu", "transcendental": "transcendental", "fetches": "texture", "stores": "stores",
               "LDS": "local_memory", "scalar": "scalar", "scalar loads": "scalar_loads", "registers": "registers",
               "waves": "waves", "ALU cycles": "alu_cycles", "texture cycles": "texture_cycles"}
    return table(["shader", *columns, *(f"sum, {f}" for f in FAMILIES)],
                 [[name, *(number(of[FAMILIES[0]][key]) for key in columns.values()),
                   *(number(cycles(of[f])) for f in FAMILIES)] for name, of in by_name(report["rows"], "shader").items()])


def tables(report):
    """Returns the tables of the document."""
    return {"passes": passes_table(report)}


def shown(report, write):
    show(DOCUMENT, SCRIPT, tables(report), write)
    # The table of all shaders is not in the document, so it is always printed.
    show(DOCUMENT, SCRIPT, {"shaders": shaders_table(report)}, False)


def count(tool):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "counts.json"
        subprocess.run([str(tool), "--family", ",".join(FAMILIES), "--report", str(path)], check=True,
                       stdout=subprocess.DEVNULL)
        return path.read_text()


def check():
    text = DOCUMENT.read_text()
    for name, expected in tables(json.loads(COUNTS.read_text())).items():
        if f"<!-- {name}, by bakers/lab/tables/{SCRIPT} -->\n{expected}" not in text:
            sys.exit(f"{DOCUMENT.name}: the table '{name}' differs from {COUNTS.name}; run bakers/lab/tables/{SCRIPT} --write")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=pathlib.Path, default=ROOT / "build/bakers/lab/gpu_cost/nook_gpu_cost",
                        help="path of the program nook_gpu_cost; default build/bakers/lab/gpu_cost/nook_gpu_cost")
    parser.add_argument("--write", action="store_true", help="write the document and the committed counts")
    parser.add_argument("--check", action="store_true", help="compare the document with the committed counts")
    parser.add_argument("--committed", action="store_true", help="print the tables of the committed counts")
    options = parser.parse_args()
    if options.check:
        check()
        return
    if options.committed:
        shown(json.loads(COUNTS.read_text()), False)
        return
    text = count(options.tool)
    if options.write:
        COUNTS.write_text(text)
    shown(json.loads(text), options.write)


if __name__ == "__main__":
    main()
