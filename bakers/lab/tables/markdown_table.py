"""Makes Markdown tables from rows, and writes them into documents after a marker. The measuring scripts use
it."""


def table(columns, rows):
    """Returns a table as text, with one line per row."""
    def line(cells):
        return "| " + " | ".join(cells) + " |\n"
    return line(columns) + "|" + "---|" * len(columns) + "\n" + "".join(map(line, rows))


def replace(path, marker, text):
    """Replaces the table that follows the line `<!-- marker -->` in a document."""
    lines = path.read_text().splitlines(keepends=True)
    first = lines.index(f"<!-- {marker} -->\n") + 1
    last = first
    while last < len(lines) and lines[last].startswith("|"):
        last += 1
    path.write_text("".join([*lines[:first], text, *lines[last:]]))


def show(document, script, tables, write):
    """Prints the tables, or writes them into the document. `tables` is a dictionary by name. In the document,
    each table follows the line `<!-- name, by script -->`."""
    for name, text in tables.items():
        if write:
            replace(document, f"{name}, by bakers/lab/tables/{script}", text)
        else:
            print(f"{document.name}, {name}:\n\n{text}")
