#!/usr/bin/env python3
"""Copies lines of programs into the pages.

  include_snippets.py           rewrites the pages
  include_snippets.py --check   fails where a page differs from the programs

A page names a snippet on the line before the block: <!-- tests/stranger/documents.c: pose -->. The program has it between
the comments [pose] and [end].
"""
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", *sorted(p for p in (ROOT / "docs").rglob("*.md") if p.parent.name != "api")]
BLOCK = re.compile(r"^<!-- (\S+): (\w+) -->\n```(\w+)\n(.*?)^```$", re.M | re.S)


def snippet(path, name):
    text = (ROOT / path).read_text(encoding="utf-8")
    found = re.search(rf"^ */\* \[{name}\] \*/\n(.*?)^ */\* \[end\] \*/$", text, re.M | re.S)
    if not found:
        sys.exit(f"{path} has no snippet [{name}]")
    return textwrap.dedent(found.group(1))


def main():
    is_check = "--check" in sys.argv
    count = different = 0
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        count += len(BLOCK.findall(text))
        new = BLOCK.sub(lambda m: f"<!-- {m[1]}: {m[2]} -->\n```{m[3]}\n{snippet(m[1], m[2])}```", text)
        if new == text:
            continue
        different += 1
        if is_check:
            print(f"{page.relative_to(ROOT)} differs from the programs; run docs/include_snippets.py")
        else:
            page.write_text(new, encoding="utf-8")
    print(f"{count} snippets, {different} pages {'differ' if is_check else 'written'}")
    return 1 if count == 0 or (is_check and different) else 0


if __name__ == "__main__":
    sys.exit(main())
