#!/usr/bin/python3
"""test_zip.py: cmake/zip packs two folders of the same content to the same bytes, whatever the order and times of their
files, and what it packs unpacks to that content."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import zipfile

ZIP = pathlib.Path(__file__).resolve().parents[2] / "cmake/zip"
MOMENT = (2024, 2, 29, 12, 34, 56)
FILES = {"tyglab.exe": b"MZ" + bytes(5000), "README.txt": b"Read me.\r\n", "data/fonts/Å.ttf": bytes(range(256)) * 9,
         "data/a.json": b"{}"}


def packed(scratch, name, order, changed, zone):
    folder = scratch / name
    for file in order:
        path = folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(FILES[file])
        path.chmod(0o600)
        os.utime(path, (changed, changed))
    epoch = str(int(time.mktime((*MOMENT, 0, 0, 0)) - time.timezone))
    subprocess.run([sys.executable, ZIP, folder, scratch / f"{name}.zip"], check=True,
                   env={**os.environ, "SOURCE_DATE_EPOCH": epoch, "TZ": zone})
    return scratch / f"{name}.zip"


def main():
    os.environ["TZ"] = "UTC"
    time.tzset()
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        first = packed(scratch, "first", list(FILES), 1e9, "UTC")
        second = packed(scratch, "second", list(reversed(FILES)), 1.7e9, "Asia/Tokyo")
        assert first.read_bytes() == second.read_bytes(), "two zips of the same files differ"
        with zipfile.ZipFile(first) as archive:
            entries = {entry.filename: entry for entry in archive.infolist()}
            assert list(entries) == sorted(f"tyglab/{file}" for file in FILES), list(entries)
            for file, content in FILES.items():
                entry = entries[f"tyglab/{file}"]
                assert archive.read(entry) == content, file
                assert entry.date_time == MOMENT, (file, entry.date_time)
                assert entry.external_attr >> 16 & 0o777 == (0o755 if file.endswith(".exe") else 0o644), file
    print("The zip is sound.")


main()
