#!/usr/bin/env python3
"""Fetches the files of a list of sources, and checks the SHA-256 of every file.

  fetch.py FOLDER                                        the characters and props of yard.json
  fetch.py FOLDER --list docs/sources.json               bodies, light maps and scenes of the tables in docs/
  fetch.py FOLDER --list docs/sources.json --only fox_CC-BY

A list names each file, its repository and commit, its author and its licence. Only these files are downloaded. A file
without a repository was converted, and is copied from the folder that --assets names. The script names the files that
it cannot get, fetches the others, and returns 1.
"""
import argparse
import json
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bakers/lab/tables"))
from nnao_scenes import Files, Unusable  # reads files of a commit, and checks them


def place(source, file):
    """The path of a file in the target folder."""
    if "as" in file:
        return pathlib.PurePosixPath(file["as"])
    path = pathlib.PurePosixPath(file["path"])
    return pathlib.PurePosixPath(source["folder"]) / path.name if "folder" in source else path


def wanted(source, only):
    """The files of a source that the user asks for: all, or the ones with one of these names."""
    return [file for file in source["files"] if not only or set(only) & set(file.get("names", []))]


def fetch(source, chosen, options, scratch, clones):
    """Writes the files, and returns what went wrong. clones keeps the git directories, because sources share repositories."""
    files, faults = Files(source, options, scratch), []
    commit = source.get("repository"), source.get("commit")
    files.directory = clones.get(commit)
    for file in chosen:
        try:
            data = files.read(file)
        except (Unusable, OSError) as fault:
            faults.append(str(fault))
            continue
        target = options.folder / place(source, file)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    clones[commit] = files.directory
    print(f"{source['name']}: {len(chosen) - len(faults)} of {len(chosen)} files, {source['licence']}, {source['author']}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="folder to write the files into")
    parser.add_argument("--list", type=pathlib.Path, default=HERE / "assets.json", help="list of sources; default: assets.json beside this script")
    parser.add_argument("--only", action="append", help="name of a file in the tables; you can repeat the option")
    parser.add_argument("--mirrors", type=pathlib.Path, help="folder of git directories named owner+name, to read in place of the network")
    parser.add_argument("--assets", type=pathlib.Path, help="folder with the files that are in no repository")
    options = parser.parse_args()
    chosen = [(source, wanted(source, options.only)) for source in json.loads(options.list.read_text(encoding="utf-8"))["sources"]]
    unknown = set(options.only or []) - {name for _, files in chosen for file in files for name in file.get("names", [])}
    if unknown:
        sys.exit(f"fetch.py: {options.list} has no file with the name {', '.join(sorted(unknown))}")
    faults, clones = [], {}
    with tempfile.TemporaryDirectory() as scratch:
        for source, files in chosen:
            if files:
                faults += fetch(source, files, options, pathlib.Path(scratch), clones)
    for fault in faults:
        print(f"fetch.py: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
