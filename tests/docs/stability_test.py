#!/usr/bin/env python3
"""docs/stability.md names a tier for every public C header, and no header twice or one that is gone."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    headers = {path.name for path in (ROOT / "sdk/include/nook").rglob("*.h")}
    rows = [line for line in (ROOT / "docs/stability.md").read_text(encoding="utf-8").split("\n") if line.startswith("| ")]
    named = [name for row in rows for name in re.findall(r"`(nook\w*\.h)`", row)]
    faults = [f"{name} has no tier" for name in sorted(headers - set(named))]
    faults += [f"{name} is not a header" for name in sorted(set(named) - headers)]
    faults += [f"{name} has two tiers" for name in sorted(set(named)) if named.count(name) > 1]
    for fault in faults:
        print(f"docs/stability.md: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
