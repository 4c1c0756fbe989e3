#!/usr/bin/env python3
"""zip_folder.py ARCHIVE FOLDER NAME: FOLDER/NAME as a .zip file whose bytes depend on the files and SOURCE_DATE_EPOCH alone."""
import os
import pathlib
import sys
import time
import zipfile


def add(archive, path, name):
    """A file with the time of the release and no owner."""
    info = zipfile.ZipInfo(name, time.gmtime(max(int(os.environ["SOURCE_DATE_EPOCH"]), 315532800))[:6])
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
