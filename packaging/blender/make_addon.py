#!/usr/bin/env python3
"""make_addon.py VERSION FOLDER: packs the add-on and the Python module into
FOLDER/nook-blender-VERSION.zip.

The same sources and the same SOURCE_DATE_EPOCH give the same bytes.
"""
import ast
import pathlib
import re
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE.parent))
from zip_folder import add  # noqa: E402

MODULE = HERE.parent / "python/nook"


def read_addon_version():
    """Returns the add-on version that Blender shows."""
    tree = ast.parse((HERE / "nook_ao/__init__.py").read_text(encoding="utf-8"))
    info = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign) and node.targets[0].id == "bl_info")
    return ".".join(map(str, info["version"]))


def main():
    layouts = (MODULE / "_layouts.py").read_text(encoding="utf-8")
    library = ".".join(re.search(rf"^NOOK_VERSION_{part} = (\d+)", layouts, re.M).group(1) for part in ("MAJOR", "MINOR", "PATCH"))
    if read_addon_version() != library:
        raise SystemExit(f"make_addon.py: the add-on has version {read_addon_version()} and the library {library}; change bl_info in nook_ao/__init__.py")
    files = {f"nook_ao/{p.name}": p for p in HERE.glob("nook_ao/*.py")}
    files.update({f"nook_ao/nook/{p.name}": p for p in [*MODULE.glob("*.py"), MODULE / "py.typed"]})
    files.update({f"nook_ao/{name}": ROOT / name for name in ("LICENSE", "NOTICE")})
    path = pathlib.Path(sys.argv[2]) / f"nook-blender-{sys.argv[1]}.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for name in sorted(files):
            add(archive, files[name], name)
    print(path)


if __name__ == "__main__":
    main()
