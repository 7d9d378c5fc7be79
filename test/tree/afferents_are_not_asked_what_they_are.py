"""afferents_are_not_asked_what_they_are.py ROOT: outside src/circuit no code asks whether an afferent is a netlist.

It asks the interface (AfferentTraits and AfferentFactory in src/core/afferent_factory.hpp) what it needs to know. If the interface lacks the
answer, add it there."""
import pathlib
import re
import subprocess
import sys

QUESTIONS = [
    (r"(\.|->)factory\b(?!\s*->|\s*=[^=])", "tests or casts the factory of an afferent"),
    (r"dynamic_(pointer_)?cast<[^>]*(circuit::|Circuit)", "casts an afferent to a type of circuit/"),
    (r"composition\(\)\s*[=!]=", "compares a composition, which is a text for people"),
    (r"\bnames_netlist\(", "asks whether a name is that of a netlist"),
]
# Files that may ask, with the reason.
MAY_ASK = {
    "src/run/afferent_plan.hpp": "turns a name into the plan of an afferent",
    "src/run/afferent_plan.cpp": "turns a name into the plan of an afferent",
    "src/sweep/spec/read_sweep.cpp": "chooses the subject of a sweep; the sweep of a netlist varies its devices",
}


def check(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "src", "apps", "reproduction"], check=True, capture_output=True, text=True).stdout
    faults = []
    for name in listed.splitlines():
        path = root / name
        if path.suffix not in (".hpp", ".cpp") or name.startswith("src/circuit/") or not path.exists():
            continue
        questions = [(pattern, what) for pattern, what in QUESTIONS if name not in MAY_ASK or "names_netlist" not in pattern]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            code = line.split("//")[0]
            faults += [f"{name}:{number}: {what}: {line.strip()}" for pattern, what in questions if re.search(pattern, code)]
    return faults


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(found))
    sys.exit(bool(found))
