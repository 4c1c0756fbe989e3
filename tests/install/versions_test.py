#!/usr/bin/env python3
"""Every file that states the version of the project agrees with nook.h: the changelog, the recipes of package managers, the
Debian packages, the Python module and the Blender add-on. The Debian packages' names end in the number of the library's soname.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def first(pattern, path):
    found = re.search(pattern, text(path), re.M)
    return found.group(1) if found else None


def of_python_module():
    """The module's own version, without its library."""
    values = dict(re.findall(r"^(NOOK_VERSION_\w+) = \"?([^\"\n]*)\"?$", text("packaging/python/nook/_layouts.py"), re.M))
    line = next(line for line in text("packaging/python/nook/__init__.py").splitlines() if line.startswith("__version__ = "))
    return eval(line.split(" = ", 1)[1], values)  # noqa: S307, the tree's own line


def main():
    major, minor, patch, suffix = (first(rf'^#define NOOK_VERSION_{part} "?([^"\n]*)', "sdk/include/nook/nook.h")
                                   for part in ("MAJOR", "MINOR", "PATCH", "SUFFIX"))
    numbers = f"{major}.{minor}.{patch}"
    version = numbers + suffix
    debian = numbers + suffix.replace("-", "~")
    stated = [
        ("CHANGELOG.md", first(r"^## (.*)$", "CHANGELOG.md"), version),
        ("packaging/vcpkg/nook/vcpkg.json", json.loads(text("packaging/vcpkg/nook/vcpkg.json"))["version-semver"], version),
        ("debian/changelog", first(r"\A\w+ \((.*)-[^-]*\)", "debian/changelog"), debian),
        ("packaging/python/nook", of_python_module(), numbers + suffix.replace("-", "")),
        ("packaging/blender/nook_ao/__init__.py", first(r'"version": \((.*)\),', "packaging/blender/nook_ao/__init__.py"),
         ", ".join(numbers.split("."))),
    ]
    for library in ("nook", "nook-bake"):
        package = f"lib{library}{major}"
        file = f"debian/{package}.symbols"
        stated.append(("debian/control", first(rf"^Package: (lib{library}\d+)$", "debian/control"), package))
        stated.append((file, first(r"\"\S+\" (\S+)$", file) if (ROOT / file).exists() else None, debian))
    wrong = [f"{path} has {found}, and nook.h gives {wanted}" for path, found, wanted in stated if found != wanted]
    print("\n".join(wrong) or f"{len(stated)} places have version {version}")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
