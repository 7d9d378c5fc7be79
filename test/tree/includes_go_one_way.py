"""includes_go_one_way.py ROOT: every module includes only the modules below it, and no folder has too many files.

The table is that of doc/architecture.md. A file may include the files of its own module. The public headers, in include/, include only each
other, so that a user of the installed library needs no other header."""
import collections
import pathlib
import re
import subprocess
import sys

BASE = {"core"}
MAY_INCLUDE = {
    "core": set(),
    "model": BASE,
    "circuit": BASE,
    "measure": BASE,
    "io": BASE,
    "nir": BASE | {"io"},
    "skin": BASE | {"model", "io"},
    "live": BASE | {"model", "io", "skin"},
    "run": BASE | {"model", "circuit", "measure", "io", "nir", "skin", "live"},
    "sweep": BASE | {"model", "circuit", "measure", "io", "skin", "live", "run"},
    "optimize": BASE | {"model", "circuit", "measure", "io", "skin", "live", "run", "sweep"},
    "fit": BASE | {"model", "circuit", "measure", "io", "skin", "live", "run"},
    "page": BASE | {"model", "circuit", "measure", "io", "nir", "skin", "live", "run"},
    "api": BASE | {"model", "circuit", "measure", "io", "nir", "skin", "live", "run", "sweep", "fit", "report"},
    "report": BASE | {"model", "circuit", "measure", "io", "skin", "live", "run", "sweep", "fit"},
    "readers": BASE | {"io"},
    "cli": BASE | {"model", "circuit", "measure", "io", "skin", "live", "run", "sweep", "optimize", "fit", "report", "page"},
    "reproduction": BASE | {"model", "circuit", "measure", "io", "skin", "live", "run", "report", "cli"},
}
MAX_FILES = 25
LISTS = {"reproduction/studies": "a list of studies: one file for each figure, table or question"}


def module_of(path):
    """The module of a file; None for the public headers and for files outside the modules."""
    parts = path.parts
    if parts[0] in ("src", "apps") and len(parts) > 2:
        return parts[1]
    return "reproduction" if parts[0] == "reproduction" else None


def check(root):
    files = [pathlib.Path(line) for line in subprocess.run(["git", "-C", root, "ls-files"], check=True, capture_output=True, text=True).stdout.splitlines()]
    files = [path for path in files if path.parts[0] in ("include", "src", "apps", "reproduction") and (root / path).exists()]
    names = {}  # as written after #include
    for path in files:
        names[str(path)] = path
        if path.parts[0] in ("include", "src", "apps"):
            names[str(pathlib.Path(*path.parts[1:]))] = path
    faults = []
    for path in files:
        module = module_of(path)
        if path.parts[0] == "include":
            included = re.findall(r'#\s*include "([^"]+)"', (root / path).read_text())
            faults += [f"{path}: includes {name}, which is not installed" for name in included if not (root / "include" / name).exists()]
        if module is None or path.suffix not in (".hpp", ".cpp", ".h", ".c", ".def"):
            continue
        if module not in MAY_INCLUDE:
            faults.append(f"{path}: the module '{module}' is not in the table of {pathlib.Path(__file__).name}")
            continue
        for number, line in enumerate((root / path).read_text().splitlines(), 1):
            included = re.match(r'\s*#\s*include "([^"]+)"', line)
            target = names.get(included[1]) if included else None
            if target is None:
                continue
            other = module_of(target)
            if other is None and module != "api":
                faults.append(f"{path}:{number}: includes {target}; only src/api includes the public headers")
            elif other is not None and other != module and other not in MAY_INCLUDE[module]:
                faults.append(f"{path}:{number}: {module} must not include {other} ({included[1]})")
    for folder, count in collections.Counter(str(path.parent) for path in files).items():
        if count > MAX_FILES and folder not in LISTS:
            faults.append(f"{folder}: {count} files; with more than {MAX_FILES} it needs a subfolder")
    return faults


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(found))
    sys.exit(bool(found))
