#!/usr/bin/env python3
"""Downloads the characters and props of the stage yard.json, and checks the SHA-256 of every file.

  fetch.py FOLDER [--mirrors FOLDER]

assets.json lists each file with its repository and commit, its author and its licence. Only these files are downloaded.
"""
import argparse
import json
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bakers/lab/tables"))
from nnao_scenes import Files, Unusable  # reads files of a commit, and checks them


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="write the files into this folder")
    parser.add_argument("--mirrors", type=pathlib.Path, help="read the files from this folder instead of the network; it contains a git directory named owner+name for each repository")
    options = parser.parse_args()
    options.assets = None  # all files are in repositories
    with tempfile.TemporaryDirectory() as scratch:
        for source in json.loads((HERE / "assets.json").read_text())["sources"]:
            files = Files(source, options, pathlib.Path(scratch))
            for file in source["files"]:
                target = options.folder / source["folder"] / pathlib.PurePosixPath(file["path"]).name
                try:
                    data = files.read(file)
                except (Unusable, OSError) as fault:
                    sys.exit(f"fetch.py: {fault}")
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(data)
            print(f"{source['name']}: {len(source['files'])} files, {source['licence']}, {source['author']}")


if __name__ == "__main__":
    main()
