#!/usr/bin/env python3
"""Writes docs/sources.md: bodies, light maps, scenes and materials of the tables, with author, licence, source and SHA-256.

The page shows docs/sources.json and docs/nnao_views.json. With --check nothing is written; the exit code is 1 if the
page differs from what the lists give.
"""
import hashlib
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/sources.md"
LIST = ROOT / "docs/sources.json"
VIEWS = ROOT / "docs/nnao_views.json"

TOP = """# Sources of the data

`docs/generate_sources.py` writes this page. It lists the bodies, light maps, scenes and materials that the tables of these pages measure. This project holds none of the files of other authors.
[sources.json](sources.json) and [nnao_views.json](nnao_views.json) have the whole SHA-256, the repository, the commit and the path of each file. These commands fetch the public ones and check them:

```
samples/showcase/fetch.py FOLDER --list docs/sources.json        # bodies, light maps, scenes
bakers/lab/tables/nnao_scenes.py FOLDER --assets FOLDER          # scenes of the screen pass, in metres
```

Converted files are not public in this form: fetch.py takes them from a folder that you name with `--assets`.
"""


def code(names):
    return ", ".join(f"`{name}`" for name in names)


def file_address(repository, commit, path):
    """Returns the address of a file or folder of a repository on GitHub."""
    repository = repository.removesuffix(".git")
    return f"{repository}/tree/{commit}/{path}" if commit else f"{repository}/tree/HEAD/{path}"


def made_from(origin):
    return f"[{pathlib.PurePosixPath(origin['path']).name}]({file_address(origin['repository'], origin.get('commit'), origin['path'])})"


def file_rows(listed):
    """A row for each file of sources.json: names, author, licence, source, hash, conversion."""
    for source in listed["sources"]:
        for file in source["files"]:
            where = [f"[{source['name']}]({source['page']})"]
            if "repository" in source:
                where.append(f"[file]({file_address(source['repository'], source['commit'], file['path'])})")
            if "made_from" in file:
                where.append(f"made from {made_from(file['made_from'])}")
            how = "; ".join(text for text in (source.get("note"), file.get("conversion")) if text)
            yield code(file["names"]), source["author"], source["licence"], ", ".join(where), f"`{file['sha256'][:12]}`", how


def scene_rows(views):
    """A row for each scene of nnao_views.json whose files are in a repository; sources.json has the others."""
    for source in views["sources"]:
        if "repository" not in source:
            continue
        for scene in source["scenes"]:
            names = dict.fromkeys([source["name"], scene["name"]])
            path = scene["files"][0]["path"]
            where = f"[{source['name']}]({source['page']}), [file]({file_address(source['repository'], source['commit'], path)})"
            hashes = ", ".join(f"`{file['sha256'][:12]}`" for file in scene["files"])
            yield code(names), source["author"], source["licence"], where, hashes, source.get("note", "")


def made_hash(entry):
    """The SHA-256 of what a program made: of the file in the tree, or of the listed one. The tree gives others the commit."""
    if "file" in entry:
        return hashlib.sha256((ROOT / entry["file"]).read_bytes()).hexdigest()
    return entry.get("sha256", "")


def made_rows(listed):
    for entry in listed["made"]:
        what = entry["what"] + (f", from [{entry['author']}]({entry['page']}), {entry['licence']}" if "author" in entry else "")
        kept = f", `{entry['file']}`" if "file" in entry else ""
        short = f"`{made_hash(entry)[:12]}`" if made_hash(entry) else "the commit's"
        yield code(entry["names"]), what, f"`{entry['by']}`{kept}", f"`{entry['command']}`", short


def missing_rows(listed, views):
    """What nobody could find out."""
    for source in listed["sources"] + views["sources"]:
        for entry in [source, *source.get("files", [])]:
            if "missing" in entry:
                yield code(entry.get("names", [source["name"]])), entry["missing"]
    for entry in listed["made"] + listed["missing"]:
        if "missing" in entry:
            yield entry.get("what") if "names" not in entry else code(entry["names"]), entry["missing"]


def table(head, rows):
    return "\n".join(["| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *rows]]) + "\n"


def page(listed, views):
    head = ["in the tables", "author", "licence", "source", "SHA-256", "form"]
    return "\n".join([
        TOP, "## Bodies, light maps and scenes\n", table(head, file_rows(listed)),
        "## Other scenes of the screen pass\n", table(head, scene_rows(views)),
        "## Made by this project\n", "Their licence is the project's, MIT, unless the row names another one.\n",
        table(["in the tables", "what", "made by", "command", "SHA-256"], made_rows(listed)),
        "## What is not known\n", table(["in the tables", "missing"], missing_rows(listed, views))])


def load():
    return [json.loads(path.read_text(encoding="utf-8")) for path in (LIST, VIEWS)]


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(f"unknown option '{sys.argv[1]}'; the option is --check")
    text = page(*load())
    if sys.argv[1:] == ["--check"]:
        if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
            sys.exit("docs/sources.md differs from the lists; run docs/generate_sources.py")
        return
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
