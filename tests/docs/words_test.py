#!/usr/bin/env python3
"""Users' documents stay short enough to be read: 45,000 words in all and 3,000 on a page, and 40,000 in docs/lab.

Pages that programs write do not count: docs/api, docs/messages.md, docs/gl_state.md and docs/sources.md. A word is what stands
between spaces and has a letter or a digit, so that the bars of tables and the comments for scripts do not count. Code counts.

  words_test.py           prints the sums; exit code 1 if one is above its limit
  words_test.py --list    prints the words of every page as well
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
GENERATED = re.compile(r"api/|messages\.md$|gl_state\.md$|sources\.md$")
MOST_IN_ALL, MOST_ON_A_PAGE, MOST_IN_THE_LAB = 45_000, 3_000, 40_000


def words(text):
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    return sum(bool(re.search(r"\w", word)) for word in text.split())


def main():
    counts = {path.relative_to(DOCS).as_posix(): words(path.read_text(encoding="utf-8")) for path in sorted(DOCS.rglob("*.md"))}
    counts = {name: count for name, count in counts.items() if not GENERATED.match(name)}
    lab = {name: count for name, count in counts.items() if name.startswith("lab/")}
    users = {name: count for name, count in counts.items() if name not in lab}
    if "--list" in sys.argv[1:]:
        for name, count in sorted(counts.items(), key=lambda item: item[1]):
            print(f"{count:6} docs/{name}")
    longest = max(users, key=users.get)
    print(f"users' documents: {sum(users.values())} words (at most {MOST_IN_ALL}); the longest page is docs/{longest} "
          f"with {users[longest]} (at most {MOST_ON_A_PAGE}); docs/lab: {sum(lab.values())} (at most {MOST_IN_THE_LAB})")
    faults = [f"docs/{name} has {count} words, need at most {MOST_ON_A_PAGE}; move results and protocols to docs/lab"
              for name, count in users.items() if count > MOST_ON_A_PAGE]
    if sum(users.values()) > MOST_IN_ALL:
        faults.append(f"users' documents have {sum(users.values())} words, need at most {MOST_IN_ALL}")
    if sum(lab.values()) > MOST_IN_THE_LAB:
        faults.append(f"docs/lab has {sum(lab.values())} words, need at most {MOST_IN_THE_LAB}; git keeps what you delete")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
