#!/usr/bin/env python3
"""Prints the times of the kernels in WebAssembly beside native code on the same machine.

Both are nook_kernel_time, one built natively, one by Emscripten and run by node. They run in turns, and each number is the
fastest of all turns, since other processes can only add to it.

usage: wasm_time.py build-kernels/nook_kernel_time build-wasm/nook_kernel_time.js [--native sse2] [--rounds 5] [--node node]
"""

import argparse
import subprocess


def times(command, isa):
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    columns = lines[1].split()[1:]
    for line in lines[2:]:
        name, *numbers = line.split()
        if name == isa:
            return columns, [float(number) for number in numbers]
    raise SystemExit(f"wasm_time: {command[-1]} has no row of {isa} (got rows {[line.split()[0] for line in lines[2:]]})")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program", help="nook_kernel_time, native")
    arguments.add_argument("script", help="nook_kernel_time.js")
    arguments.add_argument("--native", default="sse2")
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--node", default="node")
    given = arguments.parse_args()
    # Older output of Emscripten takes node's fetch for a browser's.
    script = [given.node, "--no-experimental-fetch", given.script]
    rows = {}
    for _ in range(given.rounds):
        for key, command, isa in (("native", [given.program], given.native), ("wasm", script, "wasm128")):
            columns, numbers = times(command, isa)
            rows[key] = [min(pair) for pair in zip(rows.get(key, numbers), numbers)]
    print(f"{'microseconds':16}" + "".join(f"{column:>10}" for column in columns))
    for isa, numbers in ((given.native, rows["native"]), ("wasm128", rows["wasm"])):
        print(f"{isa:16}" + "".join(f"{number:10.2f}" for number in numbers))
    print(f"{'wasm128 / ' + given.native:16}"
          + "".join(f"{a / b:10.2f}" for a, b in zip(rows["wasm"], rows["native"])))


if __name__ == "__main__":
    main()
