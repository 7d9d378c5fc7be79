#!/usr/bin/python3
"""The record of the binary interface: functions.txt and, if abigail-tools are installed, corpuscle.abi. Run it after a function or a
member has been added to include/corpuscle.h; git then shows what has changed.
"""

import pathlib
import re
import shutil
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
INCLUDE = HERE.parent.parent / "include"


def declared_functions():
    """The functions of corpuscle.h as the compiler understands them, one in a line."""
    with tempfile.NamedTemporaryFile("r", suffix=".txt") as prototypes:
        subprocess.run(["gcc", "-fsyntax-only", "-x", "c", "-aux-info", prototypes.name, INCLUDE / "corpuscle.h"], check=True)
        lines = prototypes.read().splitlines()
    functions = [m[1] for line in lines if (m := re.search(r"\*/ extern (.*\bcorpuscle_\w+ \(.*\));", line))]
    return sorted(functions, key=lambda f: re.search(r"(corpuscle_\w+) \(", f)[1])


def build_interface(library):
    """Compiles a library that has these functions and does nothing, so that only the types of the header are in it."""
    source = '#include "corpuscle.h"\n' + "".join(f"{f} {{ __builtin_trap(); }}\n" for f in declared_functions())
    subprocess.run(["gcc", "-std=gnu2x", "-g", "-shared", "-fPIC", f"-I{INCLUDE}", "-x", "c", "-", "-o", library], input=source, text=True, check=True)


def main():
    (HERE / "functions.txt").write_text("".join(f + "\n" for f in declared_functions()))
    if not shutil.which("abidw"):
        return print("corpuscle.abi was not updated: install abigail-tools")
    with tempfile.TemporaryDirectory() as folder:
        library = pathlib.Path(folder, "libcorpuscle.so")
        build_interface(library)
        options = ["--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--no-elf-needed", "--no-architecture"]
        subprocess.run(["abidw", *options, "--out-file", HERE / "corpuscle.abi", library], check=True)


if __name__ == "__main__":
    main()
