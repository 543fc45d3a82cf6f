#!/usr/bin/env python3
"""apply_page.py PAGE ROOT OUT [--tree]: does what a page says. Each code block of PAGE that stands behind a comment
<!-- into FILE, before|behind the line: TEXT --> is put into a copy of ROOT/FILE beside the only line that is TEXT (in
quotation marks: with its spaces); behind <!-- in FILE: TEXT --> in the place of the only TEXT; and behind
<!-- new file FILE --> into a new one. The copies are OUT/<name of FILE>, or with --tree OUT/FILE."""
import pathlib
import re
import sys

tree = sys.argv[4:] == ["--tree"]
page, root, out = map(pathlib.Path, sys.argv[1:4])
copies = {}
blocks = re.findall(r"<!-- (into|in|new file) ([^\s,:]+)(?:, (before|behind) the line: |: )?(.*?) ?-->\n```cpp\n(.*?)```",
                    page.read_text(), re.DOTALL)
for how, file, side, mark, block in blocks:
    if how == "new file":
        copies[file] = [block]
        continue
    lines = copies.setdefault(file, (root / file).read_text().splitlines(keepends=True))
    if how == "in":
        text = "".join(lines)
        if text.count(mark) != 1:
            sys.exit(f"{page}: {file} has {text.count(mark)} times {mark}; the page needs one.")
        copies[file] = text.replace(mark, block.strip()).splitlines(keepends=True)
        continue
    found = [n for n, line in enumerate(lines)
             if (line.rstrip("\n") == mark.strip('"') if mark.startswith('"') else line.strip() == mark)]
    if len(found) != 1:
        sys.exit(f"{page}: {file} has {len(found)} lines that are {mark}; the page needs one.")
    at = found[0] + (side == "behind")
    lines[at:at] = [block]
if not copies:
    sys.exit(f"{page} has no block that goes into a file.")
for file, lines in copies.items():
    to = out / (file if tree else pathlib.Path(file).name)
    to.parent.mkdir(parents=True, exist_ok=True)
    to.write_text("".join(lines))
