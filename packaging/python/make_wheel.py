#!/usr/bin/env python3
"""make_wheel.py VERSION FOLDER: writes the module as a wheel. The same sources and the same SOURCE_DATE_EPOCH give the same
bytes."""
import base64
import hashlib
import pathlib
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from zip_folder import add  # noqa: E402


def main():
    version = sys.argv[1].replace("-rc", "rc")
    info = f"nook_ao-{version}.dist-info"
    files = {f"nook/{p.name}": p.read_bytes() for p in sorted((HERE / "nook").iterdir()) if p.suffix in (".py", ".typed") or p.name == "py.typed"}
    files[f"{info}/METADATA"] = (f"Metadata-Version: 2.1\nName: nook-ao\nVersion: {version}\n"
                                 "Summary: Ambient occlusion for OpenGL engines: bakes, evaluation, probes and materials for pipelines\n"
                                 "License: MIT\nRequires-Python: >=3.9\nRequires-Dist: numpy (>=1.21)\nDescription-Content-Type: text/markdown\n\n"
                                 + (HERE / "README.md").read_text(encoding="utf-8")).encode()
    files[f"{info}/LICENSE"] = (HERE.parents[1] / "LICENSE").read_bytes()
    files[f"{info}/WHEEL"] = b"Wheel-Version: 1.0\nGenerator: nook\nRoot-Is-Purelib: true\nTag: py3-none-any\n"

    def digest(data):
        return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()

    record = "".join(f"{name},sha256={digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(pathlib.Path(sys.argv[2]) / f"nook_ao-{version}-py3-none-any.whl", "w") as archive:
        for name, data in files.items():
            add(archive, data, name)


if __name__ == "__main__":
    main()
