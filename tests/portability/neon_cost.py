#!/usr/bin/env python3
"""Prints the cycles of one sphere at one key point, NEON beside scalar, as a model of a processor counts them.

The loop over spheres of the self-shadow (kernel nook, gamma 1) is compiled for 64-bit ARM with the flags of the library,
and llvm-mca runs its machine code on the model: the processor's ports, latencies and the dependence from one turn of the
loop to the next. Memory is counted as cache hits. The scalar loop is built without vectorisation.

usage: neon_cost.py [--cpu cortex-a76] [--compiler aarch64-linux-gnu-g++] [--mca llvm-mca-16] [--at-most RATIO]

Exit code 1: neon / scalar is above RATIO.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLAGS = ["-std=c++20", "-O3", "-fno-math-errno", "-fno-trapping-math", "-Wno-unused-function"]
# name, vector of the loop, key points in one turn of it, further flags
SETS = (
    ("scalar", "Float", 1, ["-fno-tree-vectorize", "-fno-tree-slp-vectorize"]),
    ("neon", "simd::Pair<Float>", 8, []),
)
TURNS = 1000


def assembly(compiler, name, wide, flags):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "loop.s"
        command = [*compiler.split(), *FLAGS, *flags, f"-I{ROOT}", f"-I{ROOT}/sdk/include", f'-DVECTOR="sdk/src/isa/{name}/vector.h"',
                   f"-DISA_NAMESPACE=isa_{name}", f"-DWIDE={wide}", "-S", ROOT / "tests/portability/hot_loop.cpp", "-o", out]
        subprocess.run(command, check=True)
        return out.read_text().splitlines()


def innermost_loops(lines):
    """The bodies, from a label to the branch back to it, that hold no other such body."""
    label_at = {m[1]: i for i, line in enumerate(lines) if (m := re.match(r"^(\.L\w+):", line))}
    spans = []
    for i, line in enumerate(lines):
        m = re.match(r"^\s+(?:b\.?\w*|cbn?z|tbn?z)\s.*?(\.L\w+)\s*$", line)
        if m and label_at.get(m[1], i) < i:
            spans.append((label_at[m[1]], i))
    return [lines[a + 1:b + 1] for a, b in spans if not any((c, d) != (a, b) and a <= c and d <= b for c, d in spans)]


def is_instruction(line):
    return re.match(r"^\s+[a-z]", line) and not line.lstrip().startswith(".")


def shadow_loop(lines):
    """The largest innermost loop that takes a root: a set may have a narrow loop beside the wide one."""
    loops = [[line for line in loop if is_instruction(line)] for loop in innermost_loops(lines)]
    loops = [loop for loop in loops if any("sqrt" in line for line in loop)]
    if not loops:
        sys.exit("neon_cost: found no loop that takes a root (got machine code without one, need the loop over spheres)")
    return max(loops, key=len)


def cycles_a_turn(mca, cpu, loop):
    command = [mca, "-mtriple=aarch64-linux-gnu", f"-mcpu={cpu}", f"-iterations={TURNS}"]
    answer = subprocess.run(command, input="\n".join(loop), capture_output=True, text=True, check=True).stdout
    return int(re.search(r"Total Cycles:\s+(\d+)", answer)[1]) / TURNS


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--cpu", default="cortex-a76")
    arguments.add_argument("--compiler", default="aarch64-linux-gnu-g++")
    arguments.add_argument("--mca", default="llvm-mca-16")
    arguments.add_argument("--at-most", type=float, default=float("inf"), metavar="RATIO")
    given = arguments.parse_args()
    cost = {}
    print(f"{'set':8}{'instructions':>14}{'key points':>12}{'cycles a turn':>15}{'cycles a pair':>15}")
    for name, wide, points, flags in SETS:
        loop = shadow_loop(assembly(given.compiler, name, wide, flags))
        cycles = cycles_a_turn(given.mca, given.cpu, loop)
        cost[name] = cycles / points
        print(f"{name:8}{len(loop):14}{points:12}{cycles:15.2f}{cost[name]:15.2f}")
    ratio = cost["neon"] / cost["scalar"]
    print(f"neon / scalar: {ratio:.3f}")
    return 1 if ratio > given.at_most else 0


if __name__ == "__main__":
    sys.exit(main())
