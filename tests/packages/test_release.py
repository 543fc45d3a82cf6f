#!/usr/bin/python3
"""test_release.py: app/release, with what it builds replaced by stubs, changes no file in its folder that it did not make,
and lists exactly its own files in SHA256SUMS."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
STUBS = {
    "app/run": 'mkdir -p "$3" && echo page >"$3/index.html"',
    "cmake/windows/build": 'mkdir -p "$1" && echo "windows $VERSION" >"$1.zip"',
    # The tools that make the Debian packages, found by PATH.
    "bin/cmake": "exit 0",
    "bin/dpkg-query": "echo installed",
    "bin/apt-get": "exit 0",
    "bin/cpack": 'mkdir -p "$4" && for n in tyglab python3-tyglab; do echo "$n $VERSION" >"$4/${n}_${VERSION}_amd64.deb"; done',
}


def make_tree(tree):
    for name in ("app/release", "cmake/setup.sh", "cmake/zip"):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tree / name)
    for name, text in STUBS.items():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text(f"#!/bin/bash\n{text}\n")
        (tree / name).chmod(0o755)
    (tree / "cmake/packages.txt").write_text("[run]\ncmake\n[test]\ncmake\n")
    (tree / "build/packages").mkdir(parents=True)
    (tree / "CHANGELOG.md").write_text("")


def release(tree, *arguments, version="0.1.0"):
    return subprocess.run([tree / "app/release", *arguments], capture_output=True, text=True, cwd=tree,
                          env={**os.environ, "PATH": f"{tree}/bin:{os.environ['PATH']}", "VERSION": version})


def content(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def check(condition, what):
    if not condition:
        sys.exit(what)


def main():
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        tree, out = scratch / "a tree", scratch / "my files"
        make_tree(tree)
        out.mkdir()
        others = {"other_1.0_all.deb": b"a package", "my holiday.zip": b"pictures", "with space.deb": b"another"}
        for file, text in others.items():
            (out / file).write_bytes(text)

        def done(*arguments, version="0.1.0"):
            ran = release(tree, *arguments, out, version=version)
            check(ran.returncode == 0, f"app/release {arguments} failed: {ran.stderr}")
            now = content(out)
            for file, text in others.items():
                check(now.get(file) == text, f"app/release {arguments} changed {file}")
            listed = {line.split("  ", 1)[1] for line in now["SHA256SUMS"].decode().splitlines()}
            check(listed == set(now) - set(others) - {"SHA256SUMS"}, f"SHA256SUMS lists {listed}")
            check(subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=out).returncode == 0, "wrong sums")
            return listed

        check(done("--only", "web") == {"tyglab-web.zip"}, "one edition is more than one file")
        check(len(done()) == 4, "three editions are not four files")
        # A newer version takes the place of the packages; the other editions stay.
        listed = done("--only", "debian", version="0.2.0")
        check(listed == {"tyglab_0.2.0_amd64.deb", "python3-tyglab_0.2.0_amd64.deb", "tyglab-web.zip",
                         "tyglab-windows.zip"}, f"after a newer version there are {listed}")

        def refused(why, *arguments):
            before = content(out)
            ran = release(tree, *arguments, out)
            check(ran.returncode != 0 and why in ran.stderr, f"app/release {arguments}: {ran.stderr}")
            check(content(out) == before, f"app/release {arguments} refused, and changed the folder")

        (out / "tyglab-web.zip").write_bytes(b"edited since")
        refused("has changed", "--only", "web")
        (out / "tyglab-web.zip").unlink()
        done("--only", "web")
        (out / "tyglab_0.0.1_amd64.deb").write_bytes(b"from elsewhere")
        refused("is not listed", "--only", "debian")
        (out / "tyglab_0.0.1_amd64.deb").unlink()
        (out / "SHA256SUMS").write_text("0" * 64 + "  my holiday.zip\n")
        refused("lists my holiday.zip", "--only", "web")


main()
