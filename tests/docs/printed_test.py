#!/usr/bin/env python3
"""The ten lines of README.md equal samples/minimal/ten_lines.cpp, and what the pages say that programs print is printed.

  printed_test.py TEN_LINES MINIMAL        the two programs
"""
import pathlib
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODEL = ROOT / "samples/minimal/mannequin.nook"
# Instruction sets differ by up to 1.4e-3 in the AO of a vertex of thin bodies (docs/platforms.md); a mean differs by less.
TOLERANCE = 2e-3


def require(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


def fenced(text, language):
    return re.search(rf"^```{language}\n(.*?)^```$", text, re.M | re.S).group(1)


def words(code):
    """Lines without the spaces that only place comments below one another."""
    return [re.sub(r"\s+", " ", line) for line in textwrap.dedent(code).strip().split("\n")]


def same(printed, documented, where):
    """The same words, and numbers within the tolerance."""
    number = r"\d+(?:\.\d+)?"
    require(re.sub(number, "#", printed.strip()) == re.sub(number, "#", documented.strip()),
            f"{where} documents\n{documented}\nand the program prints\n{printed}")
    for a, b in zip(re.findall(number, printed), re.findall(number, documented)):
        require(abs(float(a) - float(b)) <= TOLERANCE, f"{where}: {b} is {a}")


def run(program):
    return subprocess.run([program, MODEL], check=True, capture_output=True, text=True).stdout


def main():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    source = (ROOT / "samples/minimal/ten_lines.cpp").read_text(encoding="utf-8")
    lines = source.split("// ---- the ten lines ----\n")[1].split("  // ---- end ----")[0]
    require(len(words(lines)) == 10, "ten lines")
    require(words(fenced(readme, "cpp")) == words(lines), "README.md shows the lines of samples/minimal/ten_lines.cpp")
    same(run(sys.argv[1]), fenced(readme, "text"), "README.md")
    page = (ROOT / "samples/minimal/README.md").read_text(encoding="utf-8")
    block = re.search(r"^    \d+ vertices, .*?(?=\n\n)", page, re.M | re.S).group(0)
    same(run(sys.argv[2]), textwrap.dedent(block), "samples/minimal/README.md")


if __name__ == "__main__":
    main()
