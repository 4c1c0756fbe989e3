#!/usr/bin/env python3
"""Binds every measured figure of four pages to a report file, so that nobody types a digit.

  figures.py             prints each figure: page, line, text, name, file and the command that measures it
  figures.py --check     fails for each number that no report file holds, and for each one that differs from its file
  figures.py --write     writes the figures of the files into the pages, each with as many digits as the page shows
  figures.py --count     prints how many figures are counted or computed, and how many were carried over from a page

docs/data/pages.json lists the lines that have numbers. "line" is a text that occurs in this line of the page alone, and "numbers"
says what each number of the line is, from left to right. "report.figure" names a figure of docs/data/report.json, a pass or shader
of the committed counts ("gpu_cost.NNAO 9"), or a figure of computed() below. "not: reason" marks a number that nobody measured;
"reasons" explains each reason. Numbers in code, comments, links, names and versions are not looked at.
"""
import functools
import json
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
DATA = "docs/data"
PARTS = ("character_speed.", "neighbour_cost.")  # pages show what computed() makes of these reports
COUNTS = "tests/bakers/lab/gpu_cost/counts.json"
PAGES = ("README.md", "docs/evidence.md", "docs/performance.md", "docs/limits.md")

IGNORED = (
    re.compile(r"^```.*?^```", re.S | re.M),                                        # blocks of code
    re.compile(r"^    .*$", re.M),                                                  # indented code, a formula
    re.compile(r"<!--.*?-->|`[^`\n]*`|\]\([^)\n]*\)|https?://\S+", re.S),           # comments, code, targets of links
    re.compile(r"\b(?:OpenGL(?: ES)?|ES|WebGL|Debian|C\+\+|version) ?\d+(?:\.\d+)*(?:, ES \d\.\d)?"),   # versions
    re.compile(r"\b(?:AVX-\d+|(?:GTAO|HBAO) \d+(?= \|))"),                          # names of methods with their taps
    re.compile(r"(?<=by draws \()3\.3\b|\bon 3\.3\b|\btime of 4\.3\b|OpenGL tier \| 3\.3|; 4\.3 or"),   # tiers
)
# No letter, digit or underscore touches a number, so m2m and Adult_01 have none.
NUMBER = re.compile(r"(?<![\w.])\d+(?:,\d{3})*(?:\.\d+)?(?:e-?\d+)?(?!\w)")


@functools.lru_cache(maxsize=8)
def numbers(text):
    """The numbers of each line of a page, as matches that count from the line's start."""
    for pattern in IGNORED:
        text = pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
    return [list(NUMBER.finditer(line)) for line in text.split("\n")]


def formatted(value, like):
    """The value with the digits of the text `like`: 6.27e-3, 1,672 or 0.0085."""
    digits = len(like.split("e")[0].partition(".")[2])
    if "e" in like:
        mantissa, exponent = f"{value:.{digits}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    return f"{value:,.{digits}f}" if value >= 1000 and ("," in like or "." not in like) else f"{value:.{digits}f}"


def read_reports(root=ROOT):
    """{"report.figure": entry}; an entry has value, unit, command, file and carried_over."""
    found = {}
    for path in sorted((root / DATA).glob("*.json")):
        if path.name == "pages.json":
            continue
        report = json.loads(path.read_text(encoding="utf-8"))
        for name, figure in report["figures"].items():
            found[f"{path.stem}.{name}"] = dict(figure, command=figure.get("command", report["command"]), file=f"{DATA}/{path.name}",
                                                carried_over=figure.get("carried_over", report["carried_over"]))
    counts = json.loads((root / COUNTS).read_text(encoding="utf-8"))
    for row in counts["passes"] + counts["rows"]:
        if row["family"] == "navi21":
            found["gpu_cost." + row.get("pass", row.get("shader"))] = {
                "value": row["alu_cycles"] + row["texture_cycles"], "unit": "cycles", "file": COUNTS,
                "command": "bakers/lab/tables/gpu_cost.py --write", "carried_over": False}
    return found


def computed(reports):
    """Figures that follow from others."""
    value = lambda name: reports[name]["value"]
    found = {}

    def add(name, number, unit):
        found["computed." + name] = {"value": number, "unit": unit, "file": "docs/figures.py", "carried_over": False,
                                     "command": "docs/figures.py"}

    presets = {"fast": "NNAO 9, half", "default": "NNAO 9", "best": "NNAO 32"}
    for gpu, width, height, units, clock in (("40 units", 1920, 1080, 40, 2.0e9), ("8 units", 1280, 800, 8, 1.6e9),
                                             ("H200", 1920, 1080, 8, 1.98e9)):
        for preset, passes in presets.items():
            add(f"{gpu}, {preset}", width * height / 64 * value("gpu_cost." + passes) / (units * clock) * 1000, "ms")
    add("fast / default", value("gpu_cost.NNAO 9, half") / value("gpu_cost.NNAO 9"), "ratio of cycles")
    add("casters of a body", 40 * value("gpu_cost.one caster of the world pass"), "cycles")
    add("raw floats of a material", 100 * 100 * 96 * 96 * 3 * 4 / 2**30, "GiB")
    for isa in ("AVX2", "AVX-512"):
        for place in ("far", "near"):
            alone, four = (value(f"neighbour_cost.{place}, {isa}: {who}") for who in ("alone", "with four"))
            add(f"a {place} neighbour, {isa}", (four - alone) / 4, "µs")
    add("rms of ual_mannequin", math.sqrt(value("character.ual_mannequin, every second clip: mse")), "AO")
    for name, unit in {name: entry["unit"] for name, entry in reports.items() if name.startswith("character_speed.")}.items():
        body, _, part = name.partition(".")[2].rpartition(": ")
        if part == "pose":
            add(f"speed of {body}", sum(value(f"character_speed.{body}: {p}") for p in ("pose", "update", "read")), unit)
    return found


def load(root=ROOT):
    """Returns the pages' texts, the bindings and the figures."""
    texts = {page: (root / page).read_text(encoding="utf-8") for page in PAGES}
    reports = read_reports(root)
    reports.update(computed(reports))
    return texts, json.loads((root / DATA / "pages.json").read_text(encoding="utf-8")), reports


def bound(texts, bindings, figures):
    """Returns ([(page, line, match, name)], faults)."""
    found, faults, used = [], [], set()
    for page, text in texts.items():
        lines = text.split("\n")
        rows = bindings["pages"].get(page, [])
        for row in rows:
            places = [i for i, line in enumerate(lines) if row["line"] in line]
            if len(places) != 1:
                faults.append(f"{page}: {len(places)} lines have the text '{row['line']}', need 1; mend the entry in {DATA}/pages.json")
        for index, matches in enumerate(numbers(text)):
            if not matches:
                continue
            where = f"{page}:{index + 1}"
            row = next((row for row in rows if row["line"] in lines[index]), None)
            names = row["numbers"] if row else []
            if len(names) != len(matches):
                tokens = ", ".join(match.group() for match in matches)
                faults.append(f"{where}: the line has {len(matches)} numbers ({tokens}), and {DATA}/pages.json names {len(names)}; "
                              "name a figure of a report file for each number, or 'not: reason'")
                continue
            for match, name in zip(matches, names):
                used.add(name)
                if name.startswith("not: "):
                    if name[5:] not in bindings["reasons"]:
                        faults.append(f"{where}: {match.group()} has the reason '{name[5:]}', which {DATA}/pages.json does not explain")
                elif name not in figures:
                    faults.append(f"{where}: no report file holds '{name}' for {match.group()}; measure it and write it into {DATA}")
                else:
                    found.append((page, index + 1, match, name))
    for name in figures:
        if figures[name]["file"].startswith(DATA) and name not in used and not name.startswith(PARTS):
            faults.append(f"{figures[name]['file']}: no page shows '{name.partition('.')[2]}'; remove it, or name it in {DATA}/pages.json")
    return found, faults


def check(texts, bindings, figures):
    """The faults of the pages."""
    found, faults = bound(texts, bindings, figures)
    for page, line, match, name in found:
        expected = formatted(figures[name]["value"], match.group())
        if expected != match.group():
            faults.append(f"{page}:{line}: the page has {match.group()}, and {figures[name]['file']} has {expected} for '{name}'; "
                          "run docs/figures.py --write")
    return faults


def written(texts, bindings, figures):
    """The pages with the figures of the files."""
    lines = {page: text.split("\n") for page, text in texts.items()}
    # From right to left, so that the places of the others stay.
    for page, line, match, name in reversed(bound(texts, bindings, figures)[0]):
        old = lines[page][line - 1]
        lines[page][line - 1] = old[:match.start()] + formatted(figures[name]["value"], match.group()) + old[match.end():]
    return {page: "\n".join(text) for page, text in lines.items()}


def main():
    option = sys.argv[1] if len(sys.argv) > 1 else ""
    if option not in ("", "--check", "--write", "--count"):
        sys.exit(f"unknown option '{option}'; the options are --check, --write and --count")
    texts, bindings, figures = load()
    if option == "--write":
        for page, text in written(texts, bindings, figures).items():
            if text != texts[page]:
                (ROOT / page).write_text(text, encoding="utf-8")
                print(f"wrote {page}")
        texts = load()[0]
    found, faults = bound(texts, bindings, figures)
    if option == "":
        for page, line, match, name in found:
            print(f"{page}:{line}: {match.group()}  {name}  {figures[name]['file']}  {figures[name]['command']}")
    if option == "--count":
        carried = sum(figures[name]["carried_over"] for *_, name in found)
        print(f"{len(found)} figures on {len(texts)} pages: {len(found) - carried} counted or computed, {carried} carried over")
    faults = check(texts, bindings, figures)
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
