#!/usr/bin/env python3
"""The search of the site finds every message of docs/messages.md by each of its words.

  check_search.py FOLDER

It reads the index that the browser reads, and takes words apart as Sphinx does. It needs the Python of Sphinx.
"""
import json
import pathlib
import re
import sys

from sphinx.search.en import SearchEnglish

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    text = (pathlib.Path(sys.argv[1]) / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[text.index("(") + 1:text.rindex(")")])
    page, english = index["docnames"].index("messages"), SearchEnglish({})

    def found(word):
        pages = []
        for kind in ("terms", "titleterms"):
            for form in (english.stem(word), word):
                hit = index[kind].get(form, [])
                pages += hit if isinstance(hit, list) else [hit]
        return page in pages

    messages = [line[2:] for line in (ROOT / "docs/messages.md").read_text(encoding="utf-8").split("\n") if line.startswith("- ")]
    missing = []
    for message in messages:
        words = [w for w in english.split(re.sub(r"\\(.)", r"\1", message).lower()) if english.word_filter(w)]
        missing += [f"{word} of: {message}" for word in words if not found(word)]
    print("\n".join(missing) if missing else f"the search finds {len(messages)} messages by each of their words")
    return 1 if missing or not messages else 0


if __name__ == "__main__":
    sys.exit(main())
