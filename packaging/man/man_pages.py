#!/usr/bin/env python3
"""Writes the man pages of the command line tool from its own --help: nook.1, and one page for each command.

  man_pages.py TOOL FOLDER

Pages have the version of the tool and no date, so that the same tool gives the same bytes.
"""
import pathlib
import re
import subprocess
import sys

# A help text begins with sentences and the usage line. Titled lists follow, with names in the first column and descriptions in the
# second.
TITLE = re.compile(r"(Positionals|Options|Subcommands):$")
HEADINGS = {"Positionals": "ARGUMENTS", "Options": "OPTIONS", "Subcommands": "COMMANDS"}
NAME_COLUMNS = 30
# Value types in plain words. In the synopsis, required arguments have no brackets.
WORDS = {"UINT": "number", "INT": "number", "FLOAT": "number", "TEXT": "text", "REQUIRED": ""}


def parse_help(text):
    """Splits a help text. Returns its sentences, and for each title the list of names with their descriptions."""
    words, lists, title, lines = [], {}, None, text.splitlines()
    for at, line in enumerate(lines):
        found = TITLE.match(line)
        if found:
            title = found.group(1)
            lists[title] = []
        elif title is None:
            if line and not line.startswith("Usage:"):
                words.append(line)
        elif line.startswith("  ") and line[2:3].strip():
            name, text_begins = line.strip(), ""
            # If a name extends into the second column, its description is on the next line. Such a name may contain a space at the
            # border of the columns.
            first, next_line = line[:NAME_COLUMNS], (lines[at + 1:at + 2] or [""])[0]
            if first.endswith("  ") or first.endswith(" ") and not next_line.startswith(" " * NAME_COLUMNS):
                name, text_begins = first.strip(), line[NAME_COLUMNS:].strip()
            lists[title].append([name, text_begins])
        elif line.strip():
            entry = lists[title][-1]
            entry[1] = f"{entry[1]} {line.strip()}".strip()
    return words, lists


def escaped(text):
    """Converts plain text to roff. Escapes all characters that roff would interpret."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("`", "\\(ga")
    return re.sub(r"(?m)^([.'])", r"\\&\1", text)


def spelled(name):
    """Returns an option or argument in bold, followed by the kind of value that it takes, in plain words."""
    option, _, kind = name.partition(" ")
    option = re.sub(r"\{.*\}$", "", option)
    kind = re.sub(r":\(.*\)$|:FILE(?=$| )", "", kind).replace("FLOAT:POSITIVE", "number above 0")
    kind = re.sub(r"ENUM:value in \{([^{}]*)\} OR \{.*\}", lambda m: "|".join(pair.split("->")[0] for pair in m.group(1).split(",")), kind)
    kind = re.sub(r"^[A-Z]+(,\.\.\.)?:\{([^{}]*)\}", lambda m: m.group(2).replace(",", "|") + (m.group(1) or ""), kind)
    kind = re.sub(r"(?:[A-Z]+:)?[A-Z]+ in \[(\S+) - (\S+)\]", r"\1..\2", kind)
    kind = re.sub(r"^(?:UINT|INT|FLOAT|TEXT)(?=$|=| )|\bREQUIRED$", lambda m: WORDS[m.group(0)], kind)
    kind = re.sub(r"=(\S+)$", r" (default \1)", kind).strip()
    parts = [f"\\fB{escaped(part)}\\fR" for part in option.split(",")]
    return ", ".join(parts) + (f" \\fI{escaped(kind)}\\fR" if kind else "")


def run_help(tool, command):
    return subprocess.run([tool, *command, "--help"], check=True, capture_output=True, text=True).stdout


def page(command, words, lists, version, related):
    """Returns a man page in roff."""
    name, spoken = "-".join(command), " ".join(command)
    title = words[0].rstrip(".")
    title = title[0].lower() + title[1:]
    lines = [f'.TH {escaped(name).upper()} 1 "" "Nook {version}" "Nook"', ".SH NAME", f"{escaped(name)} \\- {escaped(title)}", ".SH SYNOPSIS",
             f"\\fB{escaped(spoken)}\\fR"]
    if "Subcommands" in lists:
        lines.append("\\fIcommand\\fR")
    lines.append("[\\fIoptions\\fR]")
    for argument, _ in lists.get("Positionals", []):
        argument_name, _, kind = argument.partition(" ")
        shown = f"\\fI{escaped(argument_name)}\\fR" + (" ..." if kind.endswith("...") else "")
        lines.append(shown if "REQUIRED" in kind else f"[{shown}]")
    if len(words) > 1:
        lines.append(".SH DESCRIPTION")
        for sentence in words[1:]:
            lines += [escaped(sentence), ".PP"]
        lines.pop()
    for heading, entries in lists.items():
        lines.append(f".SH {HEADINGS[heading]}")
        for entry, text in entries:
            lines += [".TP", spelled(entry) if heading != "Subcommands" else f"\\fB{escaped(entry)}\\fR", escaped(text)]
    if related:
        lines += [".SH SEE ALSO", ",\n".join(f"\\fB{escaped('-'.join(other))}\\fR(1)" for other in related)]
    return "\n".join(lines) + "\n"


def commands(tool, command=("nook",)):
    """Returns the tool and all its subcommands, each with its help."""
    words, lists = parse_help(run_help(tool, command[1:]))
    if not words or not lists.get("Options"):
        raise SystemExit(f"man_pages.py: the help of {' '.join(command)} has no sentence or no options")
    yield command, words, lists
    for name, _ in lists.get("Subcommands", []):
        yield from commands(tool, (*command, name))


def main():
    tool, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    version = subprocess.run([tool, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    found = list(commands(tool))
    folder.mkdir(parents=True, exist_ok=True)
    for command, words, lists in found:
        below = [other for other, _, _ in found if len(other) == len(command) + 1 and other[:len(command)] == command]
        related = below or [other for other, _, _ in found if other == command[:-1]]
        path = folder / f"{'-'.join(command)}.1"
        path.write_text(page(command, words, lists, version, related), encoding="utf-8")
    print(f"{len(found)} man pages")


if __name__ == "__main__":
    main()
