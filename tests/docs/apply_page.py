#!/usr/bin/env python3
"""apply_page.py PAGE ROOT OUT: does what a page says. Each code block of PAGE that stands behind a comment
<!-- into FILE, before|behind the line: TEXT --> is put into a copy of ROOT/FILE, OUT/<name of FILE>, beside the only
line that is TEXT (in quotation marks: with its spaces)."""
import pathlib
import re
import sys

page, root, out = map(pathlib.Path, sys.argv[1:])
copies = {}
for file, side, mark, block in re.findall(r"<!-- into (\S+), (before|behind) the line: (.*?) -->\n```cpp\n(.*?)```",
                                          page.read_text(), re.DOTALL):
    lines = copies.setdefault(file, (root / file).read_text().splitlines(keepends=True))
    found = [n for n, line in enumerate(lines)
             if (line.rstrip("\n") == mark.strip('"') if mark.startswith('"') else line.strip() == mark)]
    if len(found) != 1:
        sys.exit(f"{page}: {file} has {len(found)} lines that are {mark}; the page needs one.")
    at = found[0] + (side == "behind")
    lines[at:at] = [block]
if not copies:
    sys.exit(f"{page} has no block that goes into a file.")
out.mkdir(parents=True, exist_ok=True)
for file, lines in copies.items():
    (out / pathlib.Path(file).name).write_text("".join(lines))
