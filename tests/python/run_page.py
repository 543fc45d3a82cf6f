"""Runs the Python of docs/python.md, block after block as one script, and its files; says where one fails."""

import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def run(folder, name, text, *arguments):
    (folder / name).write_text(text)
    done = subprocess.run([sys.executable, "-B", name, *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"docs/python.md, {name} {' '.join(arguments)}:\n{done.stdout}{done.stderr}")
    print(done.stdout, end="")
    return done.stdout


blocks = re.findall(r"^```python\n(.*?)^```$", (ROOT / "docs" / "python.md").read_text(), re.DOTALL | re.MULTILINE)
files = [block for block in blocks if block.startswith("# ")]
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    run(folder, "page.py", "\n".join(block for block in blocks if block not in files))
    for text in files:
        file = text.split()[1]
        printed = run(folder, file, text)
        if "--dask" not in text:
            continue
        if importlib.util.find_spec("distributed") is None:
            print("SKIPPED: a sweep through Dask: python3-distributed is missing")
        elif run(folder, file, text, "--dask") != printed:
            sys.exit(f"docs/python.md: {file} prints something else through Dask")
