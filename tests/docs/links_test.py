#!/usr/bin/env python3
"""Every link of every Markdown page leads to a file, and to a heading where it names one; every page of docs/ can be reached.

Pictures need a text in place of the picture. Pages in which something can be seen, the guides and concepts, need a picture.
Links to the web are not followed. Comments and messages of sources name documents by their path from the root, such as
docs/poses.md; these are there too.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]*(?:\([^()]*\))?[^()\s]*)\)")
# The page from which all others can be found.
START = ROOT / "README.md"
PICTURED = ["docs/concepts.md", "docs/start.md", "docs/guide/character.md", "docs/guide/world.md", "docs/nnao.md",
            "docs/probes.md", "docs/materials.md", "docs/transfer.md", "README.md", "ARCHITECTURE.md"]


def prose(text):
    """The text without fenced blocks and inline code, whose brackets are not links."""
    text = re.sub(r"^(```|~~~).*?^\1", "", text, flags=re.M | re.S)
    return re.sub(r"(?<!\[)`[^`\n]*`(?!\])", "", text)


def anchors(path):
    """Anchors as Markdown renderers derive them from headings."""
    text = re.sub(r"^(```|~~~).*?^\1", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    found = {}
    for heading in re.findall(r"^#+ (.*)$", text, re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w -]", "", heading.strip().lower()).replace(" ", "-")
        found[anchor] = found.get(anchor, -1) + 1
    return {a + (f"-{i}" if i else "") for a, count in found.items() for i in range(count + 1)}


def files(*endings):
    """The files of the repository with these endings; without git, the files of its folders."""
    try:
        names = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard",
                                *(f"*.{e}" for e in endings)], check=True, capture_output=True, text=True).stdout.split("\0")
        return sorted(ROOT / name for name in names if name and (ROOT / name).exists())
    except (OSError, subprocess.CalledProcessError):
        folders = ("sdk", "bakers", "shaders", "platform", "docs", "samples", "packaging", "tests", "cmake")
        found = [*ROOT.iterdir(), *(p for f in folders for p in (ROOT / f).rglob("*") if "node_modules" not in p.parts)]
        return sorted(p for p in found if p.suffix[1:] in endings)


def named_documents():
    """Documents that sources name and that are not there."""
    for path in files("h", "hpp", "cpp", "c", "inl", "glsl", "cmake", "txt", "py", "sh"):
        for name in re.findall(r"(?<![\w/])docs/[\w/]+\.(?:md|py|sh|png)\b", path.read_text(encoding="utf-8", errors="replace")):
            if not (ROOT / name).exists():
                yield f"{path.relative_to(ROOT)} names {name}, which is not there"


def main():
    faults, graph = [], {}
    pages = files("md")
    for page in pages:
        name, text = page.relative_to(ROOT), page.read_text(encoding="utf-8")
        graph[page] = set()
        for picture, words, target in LINK.findall(prose(text)):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            to = (page.parent / path).resolve() if path else page
            if picture and not words.strip():
                faults.append(f"{name}: the picture {target} has no text in its place")
            if not to.exists():
                faults.append(f"{name}: {target} is not there")
            elif anchor and to.suffix == ".md" and anchor not in anchors(to):
                faults.append(f"{name}: {target}: there is no such heading")
            if to.is_dir() and (to / "README.md").exists():
                to = to / "README.md"
            graph[page].add(to)
        if str(name) in PICTURED and "![" not in text:
            faults.append(f"{name} has no picture")
    reached, front = {START}, [START]
    while front:
        for to in graph.get(front.pop(), ()):
            if to in graph and to not in reached:
                reached.add(to)
                front.append(to)
    faults += [f"{p.relative_to(ROOT)}: README.md does not lead there" for p in pages
               if p not in reached and p.relative_to(ROOT).parts[0] == "docs"]
    faults += named_documents()
    print("\n".join(faults) if faults else f"{len(pages)} pages, {sum(map(len, graph.values()))} links")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
