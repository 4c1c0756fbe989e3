#!/usr/bin/env python3
"""casters_valid_test.py FOLDER TOOL: Khronos' validator has nothing to say against `nook export casters --format gltf`.

It needs Node.js and the package of package.json in FOLDER or above it: npm install --prefix FOLDER gltf-validator@2.0.0-dev.3.10.
Without them, it is skipped with exit code 77."""
import json
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
from write_gltf import column  # noqa: E402

VALIDATE = """
const {validateBytes} = require('gltf-validator');
validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[1])))
  .then(report => console.log(JSON.stringify(report.issues)));
"""


def main():
    folder, tool = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    folder.mkdir(parents=True, exist_ok=True)
    node = shutil.which("node")
    if not node or subprocess.run([node, "-e", "require.resolve('gltf-validator')"], cwd=folder, capture_output=True).returncode != 0:
        print(f"skipped: no gltf-validator for Node.js; npm install --prefix {folder} gltf-validator@2.0.0-dev.3.10")
        return 77
    column().write(folder / "column.glb")
    model, casters = folder / "column.nook", folder / "casters.gltf"
    subprocess.run([tool, "bake", "character", str(folder / "column.glb"), "-o", str(model), "--preset", "draft", "--poses", "auto",
                    "--auto-poses", "8", "--rays", "16", "--quiet"], check=True, timeout=600)
    subprocess.run([tool, "export", "casters", str(model), "-o", str(casters), "--format", "gltf", "--quiet"], check=True, timeout=60)
    run = subprocess.run([node, "-e", VALIDATE, str(casters)], cwd=folder, capture_output=True, text=True, check=True, timeout=60)
    issues = json.loads(run.stdout)
    print(issues)
    return 1 if issues["numErrors"] or issues["numWarnings"] else 0


if __name__ == "__main__":
    sys.exit(main())
