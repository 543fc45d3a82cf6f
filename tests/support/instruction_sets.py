"""What is loaded before a program: so that it has narrower vectors than the machine (x86-64), or that valgrind can run it."""
import pathlib
import subprocess

# Loaded first: Highway, the library of vectors, then passes over what is disabled. Names are its targets.
LIMIT = """#include <hwy/targets.h>
__attribute__((constructor)) static void limit() { hwy::DisableTargets(%s); }
"""
WIDER = {"AVX2": "HWY_AVX3 | HWY_AVX3_DL", "128 bits": "HWY_AVX3 | HWY_AVX3_DL | HWY_AVX2"}


def limited_to(name, folder):
    """The environment in which programs have at most those of WIDER; builds what that takes in the folder."""
    library = pathlib.Path(folder) / f"{name.replace(' ', '_')}.so"  # a space ends a name there
    subprocess.run(["g++", "-shared", "-fPIC", "-x", "c++", "-", "-o", library, "-lhwy"], input=LIMIT % WIDER[name], text=True,
                   check=True)
    return {"LD_PRELOAD": str(library)}


def for_valgrind(folder):
    """The environment in which valgrind can run programs that load Highway."""
    library = pathlib.Path(folder) / "resolution.so"
    subprocess.run(["g++", "-shared", "-fPIC", pathlib.Path(__file__).with_name("for_valgrind.cpp"), "-o", library], check=True)
    return {"LD_PRELOAD": str(library)}
