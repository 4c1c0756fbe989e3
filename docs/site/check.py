#!/usr/bin/env python3
"""Every link of the site leads to a file and a place in it, and no page loads anything from elsewhere.

  check.py FOLDER
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

# Attributes of elements that a browser loads by itself.
LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("video", "src")}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("id", "name") and value:
                self.names.add(value)
            if (tag, key) in LOADED and not (tag == "link" and ("rel", "canonical") in attributes):
                self.loaded.append(value)
            if tag == "a" and key == "href":
                self.links.append(value)


def faults_of_sheets(folder):
    """Sheets load files of the site alone: pages that are opened from a folder have no root of a server."""
    faults = []
    for sheet in folder.rglob("*.css"):
        for target in re.findall(r"url\(\s*['\"]?([^)'\"]+)", sheet.read_text(encoding="utf-8", errors="replace")):
            if not target.startswith("data:") and (re.match(r"\w+:|/", target) or not (sheet.parent / target).exists()):
                faults.append(f"{sheet.relative_to(folder)} loads {target}")
    return faults


def faults_of_scripts(folder):
    """Browsers load modules from a server alone. The live page is opened through one."""
    return [f"{script.relative_to(folder)} is a module" for script in (folder / "_static").rglob("*.js")
            if re.search(r"^(import|export) ", script.read_text(encoding="utf-8", errors="replace"), re.M)]


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = {p: Page(p.read_text(encoding="utf-8")) for p in folder.rglob("*.html")}
    faults, count = [], 0
    for path, page in pages.items():
        name = path.relative_to(folder)
        for target in page.links + page.loaded:
            count += 1
            if re.match(r"(https?:)?//", target or ""):
                if target in page.loaded:
                    faults.append(f"{name} loads {target}")
                continue
            if not target or re.match(r"(mailto|data|javascript):", target):
                continue
            where, _, anchor = target.partition("#")
            where = urllib.parse.unquote(where.split("?")[0])
            to = (path.parent / where).resolve() if where else path
            if not to.exists():
                faults.append(f"{name}: {target} is not there")
            elif anchor and to in pages and urllib.parse.unquote(anchor) not in pages[to].names:
                faults.append(f"{name}: {target}: there is no such place")
    faults += faults_of_sheets(folder) + faults_of_scripts(folder)
    print("\n".join(sorted(set(faults))) if faults else f"{len(pages)} pages, {count} links, none dead; nothing is loaded from elsewhere")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
