#!/usr/bin/env python3
"""Prints the tables of docs/gpu_time.md from two reports of nook_gpu_time and the modelled cycles of
counts.json.

    nook_gpu_time --model MODEL.nook --material FILE... --report hd.json
    nook_gpu_time --width 3840 --height 2160 --report uhd.json
    bakers/lab/tables/gpu_time.py hd.json uhd.json [--write]     --write puts the tables into the document
"""
import argparse
import json
import math
import pathlib

from gpu_cost import COUNTS, FAMILIES, cycles
from markdown_table import show, table

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCRIPT = pathlib.Path(__file__).name
DOCUMENT = ROOT / "docs/gpu_time.md"
REFERENCE = "hbao 64"
# Maps the names of methods in the timings to their names in the model's table.
METHODS = {"ssao": "SSAO", "ssao+": "SSAO+", "hbao": "HBAO", "gtao": "GTAO", "gtao_bitmask": "GTAO with bitmask",
           "n8ao": "N8AO", "s4ao": "S4AO", "vtk": "VTK", "qgis": "QGIS", "filament": "Filament"}
XEGTAO = {"8": "Medium", "18": "High", "54": "Ultra"}
TUNED_XEGTAO = {"8": "denoised three times", "18": "blurred", "54": "denoised once"}
DENOISED = {"edges_1": "denoised once", "edges_2": "denoised twice", "edges_3": "denoised three times"}


def modelled_name(name):
    """Returns the name of the model's row or the beginning of this name. Returns None if the model does not
    have the row."""
    if name.startswith("NNAO"):
        return name
    method, rest = name.split(" ", 1)
    taps, _, denoiser = rest.partition(", ")
    if method == "xegtao":
        return f"XeGTAO {XEGTAO[taps]}, {DENOISED.get(denoiser, TUNED_XEGTAO[taps])}"
    return f"{METHODS[method]} {taps}," if method in METHODS else None


def shown_name(name):
    """Returns the name of a row in the document. It is the same as in gpu_cost.md."""
    if name.startswith("NNAO"):
        return name
    method, taps = name.split(" ", 1)
    if method == "xegtao":
        return modelled_name(name)
    shipped = method.endswith("_shipped")
    return f"{METHODS[method.removesuffix('_shipped')]} {taps}" + (", as shipped" if shipped else "")


def is_repeated(name):
    """Returns whether a row repeats another one. XeGTAO has two equal rows if its own denoiser is also the
    tuned one."""
    taps, _, denoiser = name.removeprefix("xegtao ").partition(", ")
    return name.startswith("xegtao") and denoiser != "" and DENOISED[denoiser] == TUNED_XEGTAO[taps]


def modelled_cycles(passes, name):
    wanted = modelled_name(name)
    for row in passes:
        if wanted and row["family"] == FAMILIES[0] and (row["pass"] == wanted or
                                                         (wanted.endswith(",") and row["pass"].startswith(wanted))):
            return cycles(row)
    return None


def is_of_the_screen(name):
    return name.startswith("NNAO") or name.split(" ")[0].removesuffix("_shipped") in [*METHODS, "xegtao"]


def times(report):
    return {row["name"]: row for row in report["rows"]}


def screen_table(small, large, passes):
    reference_ms, reference_cycles = small[REFERENCE]["gpu_ms"], modelled_cycles(passes, REFERENCE)
    rows = []
    for name, row in small.items():
        if not is_of_the_screen(name) or is_repeated(name):
            continue
        dispatched = "compute" in name
        modelled = None if dispatched else modelled_cycles(passes, name)
        rows.append([shown_name(name), f"{row['gpu_ms']:.2f}", f"{large[name]['gpu_ms']:.2f}",
                     "" if dispatched else f"{row['gpu_ms'] / reference_ms:.2f}",
                     f"{modelled / reference_cycles:.2f}" if modelled else ""])
    return table(["pass", "ms, 1920 x 1080", "ms, 3840 x 2160", "of HBAO 64", "of it, by the model"], rows)


def other_table(small):
    return table(["what", "GPU, ms", "CPU, ms"],
                 [[name, f"{row['gpu_ms']:.3f}", f"{row['cpu_ms']:.3f}"]
                  for name, row in small.items() if not is_of_the_screen(name)])


def print_agreement(small, passes):
    """Prints how far the measured ratios are from the modelled ratios. Compute shaders, the reference row and
    repeated rows are left out."""
    ratios = {}
    for name, row in small.items():
        if not is_of_the_screen(name) or "compute" in name or name == REFERENCE or is_repeated(name):
            continue
        if modelled := modelled_cycles(passes, name):
            ratios[name] = row["gpu_ms"] / small[REFERENCE]["gpu_ms"] * modelled_cycles(passes, REFERENCE) / modelled
    logs = [math.log(r) for r in ratios.values()]
    mean = sum(logs) / len(logs)
    spread = math.sqrt(sum((x - mean) ** 2 for x in logs) / len(logs))
    lowest, highest = min(ratios, key=ratios.get), max(ratios, key=ratios.get)
    print(f"measured over modelled ratio, {len(logs)} passes: geometric mean {math.exp(mean):.2f}, spread "
          f"{math.exp(spread) - 1:.0%}, {ratios[lowest]:.2f} ({lowest}) to {ratios[highest]:.2f} ({highest})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("small", type=pathlib.Path, help="report at 1920 x 1080")
    parser.add_argument("large", type=pathlib.Path, help="report at 3840 x 2160")
    parser.add_argument("--write", action="store_true", help="write the tables into the document")
    options = parser.parse_args()
    small, large = times(json.loads(options.small.read_text())), times(json.loads(options.large.read_text()))
    passes = json.loads(COUNTS.read_text())["passes"]
    show(DOCUMENT, SCRIPT, {"screen": screen_table(small, large, passes), "others": other_table(small)}, options.write)
    print_agreement(small, passes)


if __name__ == "__main__":
    main()
