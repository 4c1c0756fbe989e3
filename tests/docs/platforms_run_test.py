#!/usr/bin/env python3
"""docs/platforms_run.py writes a row for each run of a committed tree, and packaging/release.sh refuses the others.

The scripts run in a small repository of their own, whose four checks do nothing.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKS = ["tests/portability.sh", "tests/hosts.sh", "samples/web/test.sh", "tests/blender.sh"]


def require(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


class Repository:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        for name in ["docs/platforms_run.py", "docs/platforms.md", "packaging/release.sh", "sdk/include/nook/nook.h"]:
            self.write(name, (ROOT / name).read_text(encoding="utf-8"))
        for name in [*CHECKS, "install_packages.sh"]:
            self.write(name, "#!/bin/sh\necho checked\n")
        self.write("source.cpp", "int a;\n")
        self.git("init", "-q")
        # The table begins empty, whatever the page of the real repository has.
        page = (ROOT / "docs/platforms.md").read_text(encoding="utf-8")
        head, rest = page.split("<!-- runs, by docs/platforms_run.py -->\n")
        self.write("docs/platforms.md", head + "<!-- runs, by docs/platforms_run.py -->\n\n" + rest.split("\n\n", 1)[1])
        self.commit()

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false",
                        *arguments], cwd=self.folder, check=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "Change")

    def run(self, *command):
        """(exit status, output) of a command in the repository."""
        done = subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout

    def record(self, *scripts):
        return self.run(sys.executable, "docs/platforms_run.py", *scripts)

    def refused(self):
        """The message of release.sh, which must refuse the commit before it makes a file."""
        status, text = self.run("packaging/release.sh", "--only", "source", "build-release")
        require(status != 0, f"release.sh succeeded:\n{text}")
        require(not (self.folder / "build-release").exists(), f"release.sh began in spite of the table:\n{text}")
        return text


def main():
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)

        text = repository.refused()
        for name in CHECKS:
            require(f"{name} has not been run yet; run docs/platforms_run.py {name}" in text, f"release.sh says:\n{text}")

        status, text = repository.record("all")
        require(status == 0, f"the rows were not written:\n{text}")
        require("has not been run yet" in repository.refused(), "the check takes the table that is not committed")
        repository.commit()
        status, text = repository.record("--check")
        require(status == 0, f"the check refuses rows of its own commit:\n{text}")
        status, text = repository.run("packaging/release.sh", "--only", "source", "build-release")
        require(status == 0, f"release.sh refuses rows of its own commit:\n{text}")
        shutil.rmtree(repository.folder / "build-release")

        repository.write("source.cpp", "int b;\n")
        status, text = repository.record("tests/hosts.sh")
        require(status != 0 and "not committed" in text, f"a run of uncommitted sources:\n{text}")
        repository.commit()
        repository.write("tests/hosts.sh", "#!/bin/sh\nexit 3\n")
        repository.write("tests/portability.sh", "#!/bin/sh\necho 'wasm            not had    0 s  emcmake is not installed'\n")
        repository.commit()
        page = (repository.folder / "docs/platforms.md").read_text(encoding="utf-8")
        status, text = repository.record("tests/hosts.sh")
        require(status != 0 and "failed with status 3" in text, f"a run that fails:\n{text}")
        status, text = repository.record("tests/portability.sh")
        require(status != 0 and "emcmake is not installed" in text, f"a run that leaves a row out:\n{text}")
        require(page == (repository.folder / "docs/platforms.md").read_text(encoding="utf-8"), "a failed run changed the table")

        status, text = repository.record("tests/blender.sh")
        require(status == 0, f"the row was not written:\n{text}")
        repository.commit()
        text = repository.refused()
        for name in CHECKS:
            refused = f"{name} was run with commit" in text and f"run docs/platforms_run.py {name}" in text
            require(refused == (name != "tests/blender.sh"), f"of rows with older sources, release.sh says:\n{text}")

        status, text = repository.record("tests/unknown.sh")
        require(status == 2 and "tests/unknown.sh" in text, f"of an unknown row, the script says:\n{text}")


if __name__ == "__main__":
    main()
