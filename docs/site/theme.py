#!/usr/bin/env python3
"""Makes Debian's Furo work for pages that a browser opens from a folder, and follow its choice of dark or light.

  theme.py FOLDER

The package has its script as a module, which browsers load from a server alone; it takes a style sheet from the root of
the server; and its own sheet lacks the rules for browsers that prefer dark.
"""
import pathlib
import re
import sys

NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")


def join_scripts(folder):
    furo, gumshoe = folder / "furo.js", folder / "gumshoe-patched.js"
    text = furo.read_text(encoding="utf-8")
    without_import = re.sub(r"^import Gumshoe from [^\n]*\n", "", text)
    if without_import != text:
        furo.write_text(gumshoe.read_text(encoding="utf-8") + without_import, encoding="utf-8")


def rules_for_dark(sheet):
    """The block of body[data-theme="dark"], for bodies that leave the choice to the browser."""
    found = re.search(r'body\[data-theme="dark"\] \{([^{}]*)\}', sheet)
    if not found or "prefers-color-scheme" in sheet:
        return ""
    return f'\n@media not print {{ @media (prefers-color-scheme: dark) {{ body[data-theme="auto"] {{{found.group(1)}}} }} }}\n'


def mend_sheet(path):
    text = path.read_text(encoding="utf-8")
    text += rules_for_dark(text)
    if "/javascript/normalize.css" in text:
        (path.parent / "normalize.css").write_bytes(NORMALIZE.read_bytes())
        text = text.replace("url(/javascript/normalize.css/normalize.css)", "url(normalize.css)")
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    static = pathlib.Path(sys.argv[1]) / "_static"
    join_scripts(static / "scripts")
    mend_sheet(static / "styles/furo.css")
