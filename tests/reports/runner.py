"""Runs one command after another and keeps what each one reports, prints and writes."""
import hashlib
import json
import os
import re
import resource
import subprocess
import sys

common = ["--threads", "1", "--seed", "1", "--quiet"]
groups = ("bake", "evaluate", "train", "export")
# Measurements for developers may be commands of nook-lab; what a tool does not have is looked for in the next one.
tools = ("nook", "nook-lab")


def find_program(build, name):
    """The program of this name in the build folder, wherever its folder is; None where it was not built."""
    for depth in range(5):
        for path in sorted(build.glob("*/" * depth + name)):
            if path.is_file() and os.access(path, os.X_OK):
                return path
    return None


def subcommands(tool, group):
    """The commands that the help of a tool, or of a group of its commands, lists."""
    shown = subprocess.run([tool, *group, "--help"], capture_output=True, text=True).stdout
    listed = shown.partition("\nSubcommands:\n")[2]
    return set(re.findall(r"^  (\S+)", listed, re.M))


def hash_of(data):
    return hashlib.sha256(data).hexdigest()


def without_timed_cells(text):
    """A table of Markdown or of a page without its times and memory, which differ from run to run."""
    text = re.sub(rb"<tr><td>(seconds\w*|peak_bytes)</td>\s*<td>[^<]*</td>", b"", text)
    rows, timed = [], []
    for line in text.split(b"\n"):
        cells = line.split(b"|")
        if len(cells) > 2:
            timed = [i for i, c in enumerate(cells) if c.strip() in (b"ms", b"ratio_to_nnao")] or timed
            line = b"|".join(c for i, c in enumerate(cells) if i not in timed)
        else:
            timed = []
        rows.append(line)
    return b"\n".join(rows)


def describe_file(path):
    """Hashes a file. The text of a page and each picture in it have their own hashes, so that you see which one differs."""
    data = path.read_bytes()
    if path.suffix == ".md":
        return hash_of(without_timed_cells(data))
    if path.suffix != ".html":
        return hash_of(data)
    embedded = re.findall(rb"data:[a-z/+-]+;base64,[A-Za-z0-9+/=]*", data)
    for each in embedded:
        data = data.replace(each, b"")
    return {"text": hash_of(without_timed_cells(data)), "embedded": [hash_of(each) for each in embedded]}


def processor_seconds():
    """Returns the processor time of all commands that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Runner:
    def __init__(self, build, out, only):
        self.build, self.out, self.only = build, out, re.compile(only)
        self.files = out / "files"
        self.times, self.failed, self.programs, self.listed = {}, [], {}, {}
        if not self.program_path("nook"):
            sys.exit(f"run.py: {build} holds no nook; build the targets nook and mannequin there")

    def program_path(self, name):
        if name not in self.programs:
            self.programs[name] = find_program(self.build, name)
        return self.programs[name]

    def tool_of(self, words):
        """The first of the tools that has this command."""
        group = (words[0],) if words[0] in groups else ()
        for name in tools:
            tool = self.program_path(name)
            if tool and (name, group) not in self.listed:
                self.listed[name, group] = subcommands(tool, group)
            if tool and words[len(group)] in self.listed[name, group]:
                return tool
        return self.program_path(tools[0])

    def snapshot(self):
        return {p: (p.stat().st_mtime_ns, p.stat().st_size) for p in self.files.rglob("*") if p.is_file()}

    def run(self, name, command, keep):
        """Runs one command. keep(stdout) puts its report at self.out/NAME.json. The hashes of the files that it wrote go to
        written_NAME.json, but for .nook files in files/, which compare.py compares byte by byte."""
        before, began = self.snapshot(), processor_seconds()
        command = [str(c) for c in command]
        result = subprocess.run(command, cwd=self.files, capture_output=True)
        if result.returncode != 0:
            self.failed.append(name)
            print(f"     failed  {name}: {' '.join(command)}\n{result.stderr.decode(errors='replace')}", flush=True)
            return
        written = [p for p, state in self.snapshot().items()
                   if before.get(p) != state and not (p.parent == self.files and p.suffix == ".nook")]
        hashes = {str(p.relative_to(self.files)): describe_file(p) for p in sorted(written)}
        if hashes:
            (self.out / f"written_{name}.json").write_text(json.dumps(hashes, indent=2) + "\n")
        keep(result.stdout)  # last: the report tells that the command is done
        self.times[name] = round(processor_seconds() - began, 1)
        print(f"{self.times[name]:6.1f} s  {name}", flush=True)

    def due(self, name):
        return self.only.search(name) and not (self.out / f"{name}.json").exists()

    def report(self, name, *arguments, tool=None):
        """Runs a command, of the first tool that has it where none is named; its report becomes NAME.json."""
        if not self.due(name):
            return
        if tool and not self.program_path(tool):
            print(f"   left out  {name}: there is no {tool}", flush=True)
            return
        unfinished = self.out / f"{name}.unfinished"
        command = [self.program_path(tool) if tool else self.tool_of(arguments), *arguments, *common, "--report", unfinished]
        self.run(name, command, lambda stdout: unfinished.rename(self.out / f"{name}.json"))

    def bake(self, name, kind, *arguments):
        """Bakes files/NAME.nook and inspects it."""
        model = f"{name}.nook"
        self.report(f"{kind.split()[0]}_{name}", *kind.split(), *arguments, "-o", model)
        self.report(f"inspect_{name}", "inspect", model)
        return model

    def program(self, name, program, *arguments, folder=None, report=False):
        """Runs another program, and makes a folder for its files first. With report the program takes --report FILE;
        otherwise its output becomes the report, line by line. A program that was not built is left out."""
        if not self.due(name):
            return
        path = self.program_path(program)
        if not path:
            print(f"   left out  {name}: there is no {program}", flush=True)
            return
        if folder:
            (self.files / folder).mkdir(parents=True, exist_ok=True)
        target, unfinished = self.out / f"{name}.json", self.out / f"{name}.unfinished"
        if report:
            self.run(name, [path, *arguments, "--report", unfinished], lambda stdout: unfinished.rename(target))
        else:
            self.run(name, [path, *arguments], lambda stdout: target.write_text(
                json.dumps({"output": stdout.decode(errors="replace").splitlines()}, indent=2) + "\n"))
