#!/usr/bin/env python3
"""Runs scripts that check a whole platform, and writes the commit and the date of each run into the table of docs/platforms.md.

  platforms_run.py SCRIPT...     installs the packages of a script, such as tests/hosts.sh, runs it, and writes its row of the table
  platforms_run.py all           does this for all scripts
  platforms_run.py --check       fails if a row of the committed table belongs to another tree than the committed one

Commit your changes first, because a row contains the commit. Commit the table afterwards. A row stays valid as long as only
docs/platforms.md changes. packaging/release.sh begins with --check.
"""
import argparse
import datetime
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = "docs/platforms.md"
MARK = "<!-- runs, by docs/platforms_run.py -->\n"
NOT_RUN = "not yet run"
# Each script and the package lists that it does not install itself.
SCRIPTS = {
    "tests/portability.sh": ["packages.txt", "tests/portability/packages.txt", "samples/web/packages.txt"],
    "tests/hosts.sh": [],
    "samples/web/test.sh": ["packages.txt", "samples/web/packages.txt"],
    "tests/blender.sh": [],
}


def git(*arguments):
    """The output of git, or None if it fails."""
    done = subprocess.run(["git", "-C", ROOT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


def read_rows(page):
    """The (commit, date) of each script in the page's table."""
    if MARK not in page:
        sys.exit(f"{PAGE} has no table of runs; it begins with the line {MARK.strip()}")
    table = page.split(MARK)[1].split("\n\n")[0]
    found = dict((script, (commit, date))
                 for script, commit, date in re.findall(r"^\| `([^`]+)` \| ([^|]*) \| ([^|]*) \|$", table, re.M))
    return {script: found.get(script, (NOT_RUN, "")) for script in SCRIPTS}


def write_row(script, commit, date):
    """Writes the row of one script; the others stay."""
    path = ROOT / PAGE
    page = path.read_text(encoding="utf-8")
    rows = read_rows(page)
    rows[script] = (commit, date)
    head, rest = page.split(MARK)
    table = ["| run in full | commit | date |", "|---|---|---|"]
    table += [f"| `{name}` | {row[0]} | {row[1]} |" for name, row in rows.items()]
    after = rest.split("\n\n", 1)
    path.write_text(head + MARK + "\n".join(table) + "\n\n" + (after[1] if len(after) > 1 else ""), encoding="utf-8")


def changed_files():
    """Files that differ from the commit, but for the page of the table."""
    return git("status", "--porcelain", "--", ".", f":!{PAGE}").splitlines()


def install(script):
    for packages in SCRIPTS[script]:
        subprocess.run([ROOT / "install_packages.sh"], check=True, env={**os.environ, "NOOK_PACKAGES": str(ROOT / packages)})


def run(script):
    """Runs the script and writes its row. Ends with a message if the run fails or leaves something out."""
    if changed_files():
        sys.exit(f"{script} was not run: there are changes that are not committed; commit them, so that the row can name them\n" +
                 "\n".join(changed_files()))
    commit = git("rev-parse", "HEAD")
    install(script)
    missing = []
    with subprocess.Popen([ROOT / script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            # A line of the table at the end of portability.sh.
            if re.match(r"\S+ +not had ", line):
                missing.append(line.strip())
    if process.returncode:
        sys.exit(f"{script} failed with status {process.returncode}; its row stays as it was")
    if missing:
        sys.exit(f"{script} left rows out, so its row stays as it was:\n" + "\n".join(missing))
    if git("rev-parse", "HEAD") != commit or changed_files():
        sys.exit(f"the sources changed while {script} ran; run it again")
    write_row(script, commit[:12], datetime.datetime.now(datetime.timezone.utc).date().isoformat())
    print(f"{PAGE} has the run of {script}; commit the page")


def fault(commit):
    """The fault of a row with this commit; None if it is a run of the committed tree."""
    if not re.fullmatch("[0-9a-f]{12}", commit):
        return "has not been run yet" if commit == NOT_RUN else f'has "{commit}" in place of a commit'
    if git("cat-file", "-e", f"{commit}^{{commit}}") is None:
        return f"was run with commit {commit}, which this repository does not have"
    if git("diff", "--quiet", commit, "HEAD", "--", ".", f":!{PAGE}") is None:
        return f"was run with commit {commit}, and the sources have changed since"
    return None


def check():
    page = git("show", f"HEAD:{PAGE}")
    if page is None:
        sys.exit(f"the commit has no {PAGE}")
    faults = [(script, fault(commit)) for script, (commit, _) in read_rows(page + "\n\n").items()]
    messages = [f"{PAGE}: {script} {text}; run docs/platforms_run.py {script} and commit the page" for script, text in faults if text]
    if messages:
        sys.exit("\n".join(messages))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scripts", nargs="*", metavar="SCRIPT", help="the scripts to run, or all")
    parser.add_argument("--check", action="store_true", help="run nothing; check the committed table")
    options = parser.parse_args()
    scripts = list(SCRIPTS) if options.scripts == ["all"] else options.scripts
    for script in scripts:
        if script not in SCRIPTS:
            parser.error(f'there is no row "{script}"; choose from all {" ".join(SCRIPTS)}')
    if options.check == bool(scripts):
        parser.error("give scripts or --check")
    if options.check:
        check()
    for script in scripts:
        run(script)


if __name__ == "__main__":
    main()
