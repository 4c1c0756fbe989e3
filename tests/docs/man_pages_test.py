#!/usr/bin/env python3
"""man_pages_test.py TOOL: the man pages hold every command and option of the tool's help, in plain words, and are roff without faults."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    tool = sys.argv[1]
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, ROOT / "packaging/man/man_pages.py", tool, folder], check=True)
        pages = sorted(pathlib.Path(folder).iterdir())
        for path in pages:
            text = path.read_text(encoding="utf-8")
            plain = text.replace("\\-", "-")
            command = path.stem.split("-")[1:]
            help_text = subprocess.run([tool, *command, "--help"], check=True, capture_output=True, text=True).stdout
            for option in re.findall(r"^  (?:-\w,)?(--[a-z0-9-]+)", help_text, re.M):
                if f"\\fB{option}\\fR" not in plain:
                    faults.append(f"{path.name} lacks {option}")
            # Names of types belong to the program that parses them.
            faults += [f"{path.name}: {word}" for word in re.findall(r"\b(?:UINT|FLOAT|TEXT|REQUIRED|ENUM)\b|\bin \[.*", plain)]
            if shutil.which("groff"):
                checked = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", path], capture_output=True, text=True)
                faults += [line for line in checked.stderr.splitlines()]
    print("\n".join(faults) if faults else f"{len(pages)} man pages hold every option")
    return 1 if faults or len(pages) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
