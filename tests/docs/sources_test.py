#!/usr/bin/env python3
"""Each body, light map, scene and material of a table in docs/ has an entry in docs/sources.json or docs/nnao_views.json.

An entry has author, licence, address and SHA-256. Where the file lies on this machine, its hash is the listed one: in the
folder NOOK_ASSETS, by default ../shared/assets, and for what a script or the tree makes, here. The rules are tried first on
lists and pages that break them in memory. samples/showcase/fetch.py is tried on a repository of the test.

  sources_test.py           exit code 1 if a rule is broken
"""
import copy
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))
import generate_sources as sources  # noqa: E402

ASSETS = pathlib.Path(os.environ.get("NOOK_ASSETS", ROOT.parent / "shared/assets"))
FETCH = ROOT / "samples/showcase/fetch.py"
GENERATED = re.compile(r"docs/(api/|messages\.md|gl_state\.md|sources\.md)")
# File names of bodies and maps say what they are, wherever they stand.
FILE_NAME = re.compile(r"(?<![\w/-])(\w+_(?:CC0|MIT|CC-BY)|\w+_1k)(?![\w-])")
# First cells of the head of a table whose rows are data, and the one table where "map" is an image of a material.
DATA_HEADS = ("body", "character", "character, fitted", "scene", "shape", "source", "map", "material", "model")
OTHER_MAPS = "| map | words | without it |"
SUMMARIES = ("geometric mean",)  # rows that are about all others
SNAKE = re.compile(r"[A-Za-z]+(?:_[A-Za-z0-9]+)+")
HASH = re.compile(r"[0-9a-f]{64}")


def pages():
    """{path from the root: text} of README and docs/, without what programs write."""
    found = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    texts = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in found}
    return {name: text for name, text in texts.items() if not GENERATED.match(name)}


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def tables(text):
    """(line number, head, rows) of each table."""
    lines = text.split("\n")
    for number, line in enumerate(lines[1:], 1):
        if not re.fullmatch(r"\|(\s*:?-+:?\s*\|)+", line.strip()) or not lines[number - 1].startswith("|"):
            continue
        rows = []
        for row in lines[number + 1:]:
            if not row.startswith("|"):
                break
            rows.append(cells(row))
        yield number, lines[number - 1], rows


def names_of(listed, views):
    """Each name of a table and the list that has it."""
    found = {name: "docs/sources.json" for source in listed["sources"] for file in source["files"] for name in file["names"]}
    found.update({name: "docs/sources.json" for entry in listed["made"] for name in entry["names"]})
    for source in views["sources"]:
        for name in [source["name"], *(scene["name"] for scene in source["scenes"])]:
            found.setdefault(name, "docs/nnao_views.json")
    return found


def pattern(names):
    """Finds one of the names as whole words, also without the licence at its end."""
    words = {word for name in names for word in (name, re.sub(r"_(CC0|MIT|CC-BY|1k)$", "", name))}
    return re.compile(rf"(?<!\w)(?:{'|'.join(re.escape(word) for word in sorted(words, key=len, reverse=True))})(?!\w)")


def claims(texts):
    """What tables are about: (place, "name", file name), (place, "label", first cell) or (place, "columns", words of the head)."""
    found = []
    for page, text in texts.items():
        found += [(page, "name", name) for name in sorted(set(FILE_NAME.findall(text)))]
        for line, head, rows in tables(text):
            columns = cells(head)
            if columns[0] in DATA_HEADS and head != OTHER_MAPS:
                labels = dict.fromkeys(row[0] for row in rows if row[0] and row[0] not in SUMMARIES)
                found += [(f"{page}:{line}", "label", label) for label in labels]
            found.append((f"{page}:{line}", "columns", [cell for cell in columns[1:] if SNAKE.fullmatch(cell)]))
    return found


def nameless(claimed, names):
    """Names of tables that no list has."""
    known, missing = pattern(names), []
    for place, kind, what in claimed:
        if kind == "name":
            missing += [(place, what)] * (what not in names)
        elif kind == "label":
            missing += [(place, what)] * (not known.search(what))
        elif any(word in names for word in what):
            # Maps and scenes as columns: where one is known, all words of this form are names.
            missing += [(place, word) for word in what if word not in names]
    return [f"{place}: no list has '{what}'; add an entry to docs/sources.json" for place, what in missing]


def all_entries(listed):
    return [file["names"] for source in listed["sources"] for file in source["files"]] + [entry["names"] for entry in listed["made"]]


def unused(texts, entries, views):
    """Entries that neither a page nor the list of views names."""
    whole = "\n".join([*texts.values(), *(scene["name"] for source in views["sources"] for scene in source["scenes"])])
    return [f"docs/sources.json: no page names {names[0]}; remove the entry" for names in entries if not pattern(names).search(whole)]


def incomplete(listed, views):
    """Entries without author, licence, address or hash."""
    faults = []
    for place, source in [("docs/sources.json", s) for s in listed["sources"]] + [("docs/nnao_views.json", s) for s in views["sources"]]:
        faults += [f"{place}: {source['name']} has no {key}" for key in ("author", "licence", "page") if not source.get(key, "").strip()]
        if not re.match(r"https?://", source.get("page", "")):
            faults.append(f"{place}: the page of {source['name']} is not an address")
        if ("repository" in source) != bool(re.fullmatch(r"[0-9a-f]{40}", source.get("commit", ""))):
            faults.append(f"{place}: {source['name']} needs both a repository and the 40 digits of a commit, or neither")
        files = source.get("files", []) + [file for scene in source.get("scenes", []) for file in scene["files"]]
        faults += [f"{place}: {source['name']} has no files"] * (not files)
        for file in files:
            if not HASH.fullmatch(file.get("sha256", "")):
                faults.append(f"{place}: the SHA-256 of {file['path']} needs 64 hexadecimal digits")
            if place == "docs/sources.json" and "repository" not in source and not file.get("conversion"):
                faults.append(f"{place}: {file['path']} is in no repository, so say how it was converted")
    for entry in listed["made"]:
        if not (ROOT / entry["by"]).exists():
            faults.append(f"docs/sources.json: {entry['by']}, which makes {entry['names'][0]}, does not exist")
        if "writes" in entry and not HASH.fullmatch(entry.get("sha256", "")):
            faults.append(f"docs/sources.json: the SHA-256 of {entry['writes']} needs 64 hexadecimal digits")
    return faults


def listed_files(listed, views):
    """(path in the folder of assets, hash) of both lists; views name only files that are in no repository."""
    for source in listed["sources"]:
        for file in source["files"]:
            yield file.get("as", file["path"]), file["sha256"]
    for source in views["sources"]:
        for file in (file for scene in source["scenes"] for file in scene["files"] if "repository" not in source):
            yield file["path"], file["sha256"]


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def different(listed, views, assets):
    """Files of this machine with another hash, and how many were compared."""
    faults, compared = [], 0
    for path, wanted in listed_files(listed, views):
        if (assets / path).exists():
            compared += 1
            if sha256(assets / path) != wanted:
                faults.append(f"{path}: SHA-256 is {sha256(assets / path)}, and the list has {wanted}")
    return faults, compared


def made_differently(listed):
    """Files that a script writes with another hash."""
    faults = []
    for script in {entry["by"] for entry in listed["made"] if "writes" in entry}:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, ROOT / script, folder], check=True)
            for entry in listed["made"]:
                if entry["by"] == script and "writes" in entry and sha256(pathlib.Path(folder) / entry["writes"]) != entry["sha256"]:
                    faults.append(f"{script}: {entry['writes']} has another SHA-256 than docs/sources.json says")
    return faults


def broken(texts, listed, views):
    return nameless(claims(texts), names_of(listed, views)) + unused(texts, all_entries(listed), views) + incomplete(listed, views)


def self_test(texts, listed, views):
    """What the rules miss."""
    missed, claimed = [], claims(texts)

    def try_change(what, change):
        other = copy.deepcopy(listed)
        change(other)
        # Only a few names are new, so the slow search for old ones in all pages is left out.
        new = [names for names in all_entries(other) if names not in all_entries(listed)]
        if not (incomplete(other, views) or nameless(claimed, names_of(other, views)) or unused(texts, new, views)):
            missed.append(f"{what} passes")

    for i, source in enumerate(listed["sources"]):
        for key in ("author", "licence", "page"):
            try_change(f"{source['name']} without {key}", lambda other: other["sources"][i].update({key: " "}))
        for j, file in enumerate(source["files"]):
            try_change(f"{file['path']} with 63 digits", lambda other: other["sources"][i]["files"][j].update(sha256=file["sha256"][1:]))
            try_change(f"{file['path']} under an unknown name", lambda other: other["sources"][i]["files"][j].update(names=["zebra_CC0"]))
    try_change("a program that does not exist", lambda other: other["made"][0].update(by="bakers/nothing"))
    # Bodies and maps that tables name. A body's name is found in text as well, a map's in rows and columns.
    for page, line in (("docs/character.md", "\nThe body is `zebra_CC0`.\n"), ("docs/limits.md", "\n| body | mse |\n|---|---|\n| a zebra | 1 |\n"),
                       ("docs/evidence.md", "\n| | potsdamer_platz | grand_canal |\n|---|---|---|\n| AO | 1 | 2 |\n")):
        if not nameless(claims({page: texts[page] + line}), names_of(listed, views)):
            missed.append(f"{page} with a name that no list has passes: {line.strip()}")
    with tempfile.TemporaryDirectory() as folder:
        path, _ = next(listed_files(listed, views))
        target = pathlib.Path(folder) / path
        target.parent.mkdir(parents=True)
        target.write_bytes(b"other bytes")
        if not different(listed, views, pathlib.Path(folder))[0]:
            missed.append("a file with other bytes passes")
    return missed


def git(folder, *words):
    return subprocess.run(["git", "-C", str(folder), "-c", "user.name=n", "-c", "user.email=n@n", *words],
                          check=True, capture_output=True, text=True).stdout.strip()


def fetch_faults():
    """What fetch.py does wrong with a repository, a converted file and wrong bytes."""
    faults, data = [], b"a body"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        repository = folder / "mirrors/someone/bodies"
        (repository / "models").mkdir(parents=True)
        (repository / "models/body.glb").write_bytes(data)
        git(repository, "init", "-q")
        for option in ("uploadpack.allowFilter", "uploadpack.allowAnySHA1InWant"):
            git(repository, "config", option, "true")
        git(repository, "add", ".")
        git(repository, "commit", "-q", "-m", "a body")
        digest = hashlib.sha256(data).hexdigest()
        (folder / "assets/scenes").mkdir(parents=True)
        (folder / "assets/scenes/room.glb").write_bytes(data)
        public = {"name": "bodies", "author": "a", "licence": "l", "page": "http://b", "repository": repository.as_uri(), "commit": git(repository, "rev-parse", "HEAD"),
                  "files": [{"path": "models/body.glb", "as": "characters/body_CC0.glb", "sha256": digest, "names": ["body_CC0"]}]}
        converted = {"name": "rooms", "author": "a", "licence": "l", "page": "http://r", "files": [{"path": "scenes/room.glb", "sha256": digest, "names": ["room"]}]}
        listing = folder / "list.json"

        def run(target, *words):
            listing.write_text(sources.json.dumps({"sources": [public, converted]}))
            done = subprocess.run([sys.executable, FETCH, folder / target, "--list", listing, *words], capture_output=True, text=True)
            return done, sorted(path.relative_to(folder / target).as_posix() for path in (folder / target).rglob("*.glb"))

        both = ["characters/body_CC0.glb", "scenes/room.glb"]
        for target, words, wanted, code, said in (
                ("cloned", ["--assets", folder / "assets"], both, 0, ""),
                ("mirrored", ["--assets", folder / "assets", "--mirrors", folder / "mirrors"], both, 0, ""),
                ("public", ["--mirrors", folder / "mirrors"], both[:1], 1, "give its folder with --assets"),
                ("one", ["--mirrors", folder / "mirrors", "--only", "body_CC0"], both[:1], 0, ""),
                ("unknown", ["--only", "nobody"], [], 1, "no file with the name nobody")):
            done, found = run(target, *words)
            if done.returncode != code or found != wanted or said not in done.stderr:
                faults.append(f"fetch.py, {target}: returned {done.returncode} with {found}: {done.stderr}")
        public["files"][0]["sha256"] = "0" * 64
        done, found = run("refused", "--mirrors", folder / "mirrors", "--only", "body_CC0")
        if done.returncode != 1 or found or "SHA-256" not in done.stderr:
            faults.append(f"fetch.py takes other bytes than the list says: {done.stderr}")
    return faults


def main():
    listed, views = sources.load()
    texts = pages()
    faults = broken(texts, listed, views)
    if sources.page(listed, views) != sources.PAGE.read_text(encoding="utf-8"):
        faults.append("docs/sources.md differs from the lists; run docs/generate_sources.py")
    # The self test needs lists and pages without faults.
    faults = faults or self_test(texts, listed, views)
    wrong, compared = different(listed, views, ASSETS)
    faults += wrong + made_differently(listed) + fetch_faults()
    print("\n".join(faults), end="\n" if faults else "")
    print(f"{len(names_of(listed, views))} names have a source; compared the bytes of {compared} files in {ASSETS}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
