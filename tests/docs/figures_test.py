#!/usr/bin/env python3
"""Every number of README, evidence, performance and limits is a figure of a report file, or has a reason why nobody measured it.

The comparison itself is tried first: it has to find each digit that changes on a page, each value that changes in a report, and
a number that is in no list. Only the texts in memory change.
"""
import copy
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))
import figures as pages  # noqa: E402


def with_number(texts, page, line, match, token):
    lines = texts[page].split("\n")
    lines[line - 1] = lines[line - 1][:match.start()] + token + lines[line - 1][match.end():]
    return dict(texts, **{page: "\n".join(lines)})


def self_test(texts, bindings, figures):
    """What the comparison misses."""
    missed = []
    found, _ = pages.bound(texts, bindings, figures)
    for page, line, match, name in found:
        # The first digit that is not 0 becomes another one.
        token = match.group()
        place = next((i for i, letter in enumerate(token) if letter in "123456789"), 0)
        changed = token[:place] + str(int(token[place]) % 9 + 1) + token[place + 1:]
        if not pages.check(with_number(texts, page, line, match, changed), bindings, figures):
            missed.append(f"{page}:{line}: {changed} in place of {token} passes")
    for name in sorted({name for *_, name in found}):
        other = copy.copy(figures)
        # One and a half times a value differs at two digits or more, whatever the page shows. A value of 0 becomes 1.
        other[name] = dict(figures[name], value=figures[name]["value"] * 1.5 or 1)
        if not pages.check(texts, bindings, other):
            missed.append(f"{figures[name]['file']}: a changed value of '{name}' passes")
        # The pages that are written from the changed value agree with it.
        if pages.check(pages.written(texts, bindings, other), bindings, other):
            missed.append(f"{figures[name]['file']}: the pages that --write makes from a changed '{name}' do not agree with it")
    page = pages.PAGES[0]
    if not pages.check(dict(texts, **{page: texts[page] + "\nIt takes 12.5 ms.\n"}), bindings, figures):
        missed.append(f"{page}: a number that no list has passes")
    if not pages.check(dict(texts, **{page: texts[page] + "\nIt takes 5.1µs.\n"}), bindings, figures):
        missed.append(f"{page}: a number that touches its unit passes")
    return missed


def main():
    texts, bindings, figures = pages.load()
    faults = pages.check(texts, bindings, figures)
    # The self test needs pages without faults.
    faults = faults or self_test(texts, bindings, figures)
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
