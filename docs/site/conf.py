"""Sphinx: the pages of docs/site/gather.py with MyST and Furo. Nothing is loaded from elsewhere: formulas are plain text,
and fonts are those of the system."""
import pathlib
import re

header = (pathlib.Path(__file__).resolve().parents[2] / "sdk/include/nook/nook.h").read_text(encoding="utf-8")
version = release = ".".join(re.search(rf"NOOK_VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH"))
project = "Nook"
author = copyright = "the authors of Nook"
html_title = f"Nook {version}"
extensions = ["myst_parser"]
myst_heading_anchors = 4
source_suffix = {".md": "markdown"}
html_theme = "furo"
exclude_patterns = ["files"]
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
# A console session or a line of shell has no lexer of its own.
highlight_language = "none"
pygments_style = "default"
pygments_dark_style = "monokai"
suppress_warnings = ["myst.header"]
html_theme_options = {"sidebar_hide_name": False}

