"""Markdown tables for the scripts that measure: made from rows, and put into documents behind a marker."""


def table(columns, rows):
    """A table as text, a line a row."""
    def line(cells):
        return "| " + " | ".join(cells) + " |\n"
    return line(columns) + "|" + "---|" * len(columns) + "\n" + "".join(map(line, rows))


def replace(path, marker, text):
    """Puts a table in the place of the one behind the line `<!-- marker -->` of a document."""
    lines = path.read_text().splitlines(keepends=True)
    first = lines.index(f"<!-- {marker} -->\n") + 1
    last = first
    while last < len(lines) and lines[last].startswith("|"):
        last += 1
    path.write_text("".join([*lines[:first], text, *lines[last:]]))


def show(document, script, tables, write):
    """Prints tables, a dictionary by name, or writes them into the document behind `<!-- name, by script -->`."""
    for name, text in tables.items():
        if write:
            replace(document, f"{name}, by bakers/lab/tables/{script}", text)
        else:
            print(f"{document.name}, {name}:\n\n{text}")
