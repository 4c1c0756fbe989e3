#!/usr/bin/env python3
"""zip_folder.py ARCHIVE FOLDER NAME: writes FOLDER/NAME as a .zip file.

The archive's bytes depend only on the files and on one timestamp. The timestamp is SOURCE_DATE_EPOCH if it is set, or else the
time of the commit. Without a commit, it is the earliest time that .zip files can store.
"""
import functools
import os
import pathlib
import subprocess
import sys
import time
import zipfile


EARLIEST_S = 315532800  # 1980


@functools.lru_cache(maxsize=None)
def release_time():
    """Returns the timestamp of all files in the archive, in seconds since 1970."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given is None:
        command = ["git", "-C", str(pathlib.Path(__file__).resolve().parent), "log", "-1", "--format=%ct"]
        try:
            given = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        except (OSError, subprocess.CalledProcessError):
            given = ""
    return max(int(given or EARLIEST_S), EARLIEST_S)


def add(archive, path, name):
    """Adds a file to the archive, with the time of the release and without an owner."""
    info = zipfile.ZipInfo(name, time.gmtime(release_time())[:6])
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = 0o644 << 16
    archive.writestr(info, path.read_bytes() if isinstance(path, pathlib.Path) else path)


def main():
    target, folder, name = sys.argv[1:]
    folder = pathlib.Path(folder)
    with zipfile.ZipFile(target, "w") as archive:
        for path in sorted(p for p in (folder / name).rglob("*") if p.is_file()):
            add(archive, path, path.relative_to(folder).as_posix())


if __name__ == "__main__":
    main()
