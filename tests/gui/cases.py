"""Cases of a test file: each gets a fresh Stage; their results are printed, their screenshots kept."""

import argparse
import faulthandler
import os
import re
import sys
import time
import traceback

from sandbox import Sandbox
from screen import Screen

CASE_LIMIT = 800  # s; a case that takes longer hangs, and says where
_cases = []


def case(function):
    """Marks a function (stage) -> None as a case. Its first line of documentation says what must hold."""
    _cases.append(function)
    return function


def check(condition, text):
    if not condition:
        raise AssertionError(text)


class Skip(Exception):
    """What is not there for this case to run."""


def skip(why):
    """Ends the case as skipped, which is counted; where CI is set, that has all that it needs, as failed."""
    if os.environ.get("CI", "false") not in ("", "false"):
        raise AssertionError("not skipped, since CI has all that it needs: " + why)
    raise Skip(why)


class Stage:
    """What a case works with: a screen, programs on it, and a folder for screenshots."""

    def __init__(self, tyglab, screen, shots, name):
        self.tyglab, self.screen, self.shots, self.name = tyglab, screen, shots, name
        self.sandboxes = []

    def start(self, *arguments, **options):
        sandbox = Sandbox(self.tyglab, self.screen, arguments, **options)
        self.sandboxes.append(sandbox)
        return sandbox

    def keep(self, what, still=False):
        """Keeps a screenshot of the window, if need be once it (True) or a box of it stands still; returns it."""
        sandbox = self.sandboxes[-1]
        picture = sandbox.still_picture(None if still is True else still) if still else self.screen.picture()
        width, height = sandbox.report()["window"]
        picture = picture.crop((0, 0, width, height))
        picture.save(os.path.join(self.shots, f"{self.name}-{what}.png"))
        return picture

    def close(self):
        for sandbox in self.sandboxes:
            sandbox.close()


def run(function, tyglab, screen, shots, prefix):
    """Returns None, or what went wrong."""
    faulthandler.dump_traceback_later(CASE_LIMIT, exit=True)
    stage = Stage(tyglab, screen, shots, f"{prefix}-{function.__name__}")
    try:
        function(stage)
        return None
    except Skip:
        raise
    except Exception as error:
        if stage.sandboxes and stage.sandboxes[-1].report() is not None:
            stage.keep("FAILED")
        return str(error) if isinstance(error, AssertionError) and str(error) else traceback.format_exc()
    finally:
        stage.close()
        faulthandler.cancel_dump_traceback_later()


def main():
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__)
    parser.add_argument("--tyglab", required=True, help="the program")
    parser.add_argument("--shots", required=True, help="folder for screenshots")
    parser.add_argument("--only", default="", help="cases whose names contain this alone")
    options = parser.parse_args()
    prefix = os.path.splitext(os.path.basename(sys.argv[0]))[0].removeprefix("test_")
    os.makedirs(options.shots, exist_ok=True)
    for old in os.listdir(options.shots):
        if re.match(re.escape(prefix) + "-.*\\.png$", old) and options.only in old:
            os.remove(os.path.join(options.shots, old))
    tyglab = os.path.abspath(options.tyglab)
    failed, skipped, chosen = 0, 0, [c for c in _cases if options.only in c.__name__]
    screen = Screen()
    try:
        for function in chosen:
            begun = time.monotonic()
            title = f"{prefix}: {function.__doc__.splitlines()[0]}"
            try:
                problem = run(function, tyglab, screen, options.shots, prefix)
            except Skip as why:
                print(f"SKIPPED: {title}: {why}", flush=True)
                skipped += 1
                continue
            print(f"{'FAILED' if problem else 'passed'}  {title}  ({time.monotonic() - begun:.1f} s)", flush=True)
            if problem:
                failed += 1
                print("        " + problem.rstrip().replace("\n", "\n        "), flush=True)
    finally:
        screen.close()
    print(f"[gui] test cases: {len(chosen)} | {len(chosen) - failed} passed | {failed} failed")
    if skipped:
        print(f"[skip] test cases: {skipped}")
    print(f"Screenshots: {options.shots}")
    sys.exit(1 if failed else 0)
