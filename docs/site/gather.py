#!/usr/bin/env python3
"""Copies the pages of the site into one folder: docs/, the pages at the root of the repository, and those of the samples.

  gather.py FOLDER

Links that lead to a page or a picture of the site stay links. Other files of the repository that a page links to, such as
sources, are copied beside the pages, and folders become their names.
"""
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")
# Pages outside docs/ and their places in the site.
OUTSIDE = {"README.md": "readme.md", "ARCHITECTURE.md": "architecture.md", "CONTRIBUTING.md": "contributing.md",
           "SECURITY.md": "security.md", "CHANGELOG.md": "history.md"}

# The order of the pages at the side; a page that is missing here is found by the search and by links.
# Pages of docs/lab are not at the side at all: they hold protocols, trials and long tables.
LAB = "lab/"
TREE = [("Use it", ["readme", "start", "concepts", "glossary", "install", "conventions", "poses", "performance", "troubleshooting", "messages", "limits"]),
        ("Guide", ["guide/README", "guide/frame", "guide/character", "guide/world", "nnao", "probes", "materials",
                   "transfer", "guide/reports", "guide/pipeline", "guide/farms", "guide/artists"]),
        ("Engines", ["engines/README", "engines/raylib", "engines/sdl", "engines/ogre", "engines/osg", "engines/vtk", "engines/three",
                     "engines/vulkan"]),
        ("Evidence", ["evidence", "sources", "character", "material_decoding", "synthesis", "gpu_cost", "gpu_time"]),
        ("Platforms", ["platforms", "opengl_es", "web", "python", "gl_state"]),
        ("Reference", ["api/README"]),
        ("Samples", []),
        ("Project", ["architecture", "contributing", "security", "stability", "history", "patents", "from_rc1"])]


# Pages whose own title is too general at the side.
TITLES = {"readme": "In five minutes <readme>", "guide/README": "Overview <guide/README>", "engines/README": "Overview <engines/README>",
          "api/README": "Headers <api/README>",
          "history": "History <history>", "samples/overview": "Overview <samples/overview>"}


def places():
    """Every page of the repository that is in the site, and its place there."""
    found = {p: p.relative_to(ROOT / "docs").as_posix() for p in (ROOT / "docs").rglob("*.md") if "site" not in p.parts}
    found.update({ROOT / name: place for name, place in OUTSIDE.items() if (ROOT / name).exists()})
    for page in sorted((ROOT / "samples").rglob("README.md")):
        if "node_modules" not in page.parts:
            folder = page.parent.relative_to(ROOT / "samples").as_posix().replace("/", "_")
            found[page] = f"samples/{'overview' if folder == '.' else folder}.md"
    return found


def relative(to, place):
    """The path from one page of the site to another file of it."""
    ups = place.count("/")
    return "../" * ups + to


def rewritten(text, page, place, pages, files):
    def link(match):
        picture, words, target = match.groups()
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return match.group(0)
        path, mark, anchor = target.partition("#")
        to = (page.parent / path).resolve()
        if to.is_dir() and to / "README.md" in pages:
            to = to / "README.md"
        if to in pages:
            return f"{picture}[{words}]({relative(pages[to], place)}{mark}{anchor})"
        if to.is_dir():
            return words
        name = "files/" + to.relative_to(ROOT).as_posix()
        files[to] = name
        # Sources are copied under a name that browsers show as text.
        if not picture and to.suffix not in (".png", ".svg", ".json", ".nook", ".txt"):
            files[to] = name = name + ".txt"
        if picture:
            return f"![{words}]({relative(name, place)})"
        return f'<a href="{relative(name, place)}">{plain(words)}</a>'

    # Fenced blocks stay as they are.
    pieces = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
    return "".join(piece if piece.startswith("```") else LINK.sub(link, piece) for piece in pieces)


def plain(words):
    words = words.replace("&", "&amp;").replace("<", "&lt;")
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", words)


def tree(pages):
    samples = sorted((p[:-3] for p in pages.values() if p.startswith("samples/")), key=lambda p: (p != "samples/overview", p))
    listed = {name for _, names in TREE for name in names}
    out = []
    for title, names in TREE:
        names = samples if title == "Samples" else names
        if title == "Reference":
            names = names + sorted(p[:-3] for p in pages.values() if p.startswith("api/") and p != "api/README.md")
        names = [TITLES.get(n, n) for n in names if n + ".md" in pages.values()]
        out += ["```{toctree}", ":hidden:", f":caption: {title}", "", *names, "```", ""]
    rest = sorted(p[:-3] for p in pages.values() if p[:-3] not in listed and not p.startswith(("api/", "samples/", LAB)) and p != "README.md")
    if rest:
        out += ["```{toctree}", ":hidden:", ":caption: More", "", *rest, "```", ""]
    return "\n".join(out)


def main():
    target = pathlib.Path(sys.argv[1])
    pages, files = places(), {}
    for page, place in pages.items():
        text = rewritten(page.read_text(encoding="utf-8"), page, place, pages, files)
        # The page of the browser sample, where it was built: samples/web/build.sh.
        if place == "web.md" and (ROOT / "build-web/site/index.html").exists():
            text += "\nThe page itself is <a href=\"live/index.html\">in this site</a>; browsers load its module from a server only, such as "
            text += "`node samples/web/serve.mjs build-site/html`.\n"
        # The page of docs/ that lists all others is the first one of the site.
        if place == "README.md":
            text = text.replace("# Documentation\n", "# Nook\n", 1) + "\n" + tree(pages)
        if place.startswith(LAB):
            text = "---\norphan: true\n---\n\n" + text
        out = target / ("index.md" if place == "README.md" else place)
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(text.replace("](README.md)", "](index.md)") if "/" not in place else
                       text.replace("](../README.md)", "](../index.md)"), encoding="utf-8")
    for path, name in files.items():
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target / name)
    print(f"{len(pages)} pages, {len(files)} files")


if __name__ == "__main__":
    main()
