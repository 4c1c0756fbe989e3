#!/usr/bin/env python3
"""Compares two folders of reports that run.py wrote; exit code 0: equal, 1: they differ, 2: bad arguments.

    tests/reports/compare.py BEFORE AFTER [--ignore REGEX]

Every number must be equal to its last digit. Times, memory and paths are left out: the keys seconds*, ms*, *_ms, *_per_s,
ratio_to_nnao (a ratio of times) and peak_bytes, and what a text holds up to its last slash. The .nook files are compared as
well, byte by byte, under files/. Other files that a command wrote, such as pictures, pages, tables and recordings, are
compared by their hashes, under written_COMMAND; where one differs, look at it in files/ of both folders. --ignore leaves out
further keys, by a regular expression for the dotted path, such as 'evaluate_sky.*luminance'.
"""
import argparse
import json
import pathlib
import re
import sys

timed = re.compile(r"^(seconds.*|.*_seconds|ms|ms_.*|.*_ms|.*_per_s|peak_bytes|ratio_to_nnao)$")


def leaves(value, path):
    """(path, value) of every number, text and truth value that counts."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if not timed.match(key):
                yield from leaves(inner, f"{path}.{key}")
    elif isinstance(value, list):
        yield f"{path}.length", len(value)
        for i, inner in enumerate(value):
            yield from leaves(inner, f"{path}.{i}")
    else:
        yield path, re.sub(r"\S*/", "", value) if isinstance(value, str) else value


def read(folder):
    values = {}
    for file in sorted(folder.glob("*.json")):
        if file.name != "machine.json":
            # The text of a number is kept, so that equal means equal to the digit.
            content = json.loads(file.read_text(), parse_float=lambda text: f"{text} (decimal)")
            values.update(leaves(content, file.stem))
    for file in sorted((folder / "files").glob("*.nook")):
        values[f"files/{file.name}"] = file.read_bytes()
    return values


def shown(value):
    if value is None:
        return "nothing"
    return f"{len(value)} bytes" if isinstance(value, bytes) else str(value)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--ignore", default="$^", help="paths that match this regular expression are left out")
    options = parser.parse_args()
    for folder in (options.before, options.after):
        if not (folder / "machine.json").is_file():
            parser.error(f"{folder} holds no reports of run.py")
    sets = [json.loads((f / "machine.json").read_text())["instruction_sets"] for f in (options.before, options.after)]
    if sets[0] != sets[1]:
        parser.error(f"the processors differ in {', '.join(sorted(set(sets[0]) ^ set(sets[1])))}; run both on one")
    before, after = read(options.before), read(options.after)
    names = [n for n in dict.fromkeys([*before, *after]) if not re.search(options.ignore, n)]
    different = [n for n in names if before.get(n) != after.get(n)]
    report_of = lambda name: name if name.startswith("files/") else name.split(".")[0]
    sides = [{report_of(n) for n in names if n in values} for values in (before, after)]
    for report in sorted(sides[0] ^ sides[1]):
        print(f"{report}: only {'before' if report in sides[0] else 'after'}")
    for name in different:
        if report_of(name) in sides[0] & sides[1]:
            print(f"{name}: {shown(before.get(name))} before, {shown(after.get(name))} after")
    reports = {report_of(n) for n in names if not n.startswith(("files/", "written_"))}
    files = [n for n in names if n.startswith(("files/", "written_"))]
    print(f"{len(different)} of {len(names)} values differ ({len(reports)} reports, {len(files)} files)")
    sys.exit(1 if different else 0)


main()
