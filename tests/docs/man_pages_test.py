#!/usr/bin/env python3
"""man_pages_test.py TOOL: the man pages hold every command and option of the tool's help, in plain words, and are roff without faults."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging/man"))
sys.dont_write_bytecode = True
import man_pages  # noqa: E402


def main():
    help_texts, read = {}, man_pages.run_help

    def run_help(tool, command):
        page = "-".join(("nook", *command))
        help_texts[page] = read(tool, command)
        return help_texts[page]

    man_pages.run_help = run_help
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        sys.argv = ["man_pages.py", sys.argv[1], folder]
        man_pages.main()
        pages = sorted(pathlib.Path(folder).iterdir())
        for path in pages:
            text = path.read_text(encoding="utf-8")
            plain = text.replace("\\-", "-")
            help_text = help_texts[path.stem]
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
