"""install_packages.sh installs what is missing, and nothing that another installed package provides."""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# An installed node that provides npm, and a package that was removed: its words do not count.
QUERY = """#!/bin/sh
case "$*" in
  *Provides*) printf 'installed nodejs-legacy, npm (= 10.8)\\nconfig-files ghost, gone\\ninstalled \\n' ;;
  *" node") printf installed ;;
  *" removed") printf config-files ;;
  *) exit 1 ;;
esac
"""
INSTALL = """#!/bin/sh
echo "$@" >> "$CALLS"
"""


class Packages(unittest.TestCase):
    def missing(self, *names):
        """The packages that apt-get is told to install."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("dpkg-query", QUERY), ("apt-get", INSTALL), ("sudo", '#!/bin/sh\nexec "$@"\n')):
                path = pathlib.Path(folder, name)
                path.write_text(text, encoding="utf-8")
                path.chmod(0o755)
            packages, calls = pathlib.Path(folder, "packages.txt"), pathlib.Path(folder, "calls")
            packages.write_text("# a comment\n" + "".join(f"{name}  # why\n" for name in names), encoding="utf-8")
            subprocess.run([ROOT / "install_packages.sh"], check=True, stdout=subprocess.DEVNULL, env={
                **os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "NOOK_PACKAGES": str(packages), "CALLS": str(calls)})
            lines = calls.read_text(encoding="utf-8").splitlines() if calls.exists() else []
            return [line.split("--no-install-recommends ")[1] for line in lines if line.startswith("install ")]

    def test_installed_and_provided_packages_are_left(self):
        self.assertEqual(self.missing("node", "npm", "nodejs-legacy"), [])

    def test_others_are_installed(self):
        self.assertEqual(self.missing("node", "npm", "ghost", "removed", "npm-other", "np"), ["ghost removed npm-other np"])


if __name__ == "__main__":
    unittest.main()
