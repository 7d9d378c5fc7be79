"""results_are_returned.py ROOT: no member is `mutable` except locks, memories of costly results, and buffers.

A function that takes `const T&` must not hand its result back through a mutable member of T: it returns it."""
import pathlib
import re
import subprocess
import sys

MAY_BE_MUTABLE = {
    "src/circuit/afferent/circuit_afferent.cpp": "transients that no call uses, for the next call, and their lock",
    "src/circuit/cost/power.hpp": "buffers of one function",
    "src/circuit/solve/linear/elimination.hpp": "buffer of one function",
    "src/circuit/solve/linear/front_elimination.hpp": "buffers of one function",
    "src/sweep/parallel/worker_pool.hpp": "a lock",
    "src/sweep/subject/chip_sweep.cpp": "recent designs",
    "src/sweep/subject/subject.hpp": "a limit that is computed when it is first needed, and its lock",
}


def check(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "src", "apps"], check=True, capture_output=True, text=True).stdout
    found = {name for name in listed.splitlines() if name.endswith((".hpp", ".cpp"))
             and (root / name).exists() and re.search(r"^\s*mutable\b", (root / name).read_text(), re.M)}
    return ([f"{name}: a mutable member; return the result instead" for name in sorted(found - MAY_BE_MUTABLE.keys())]
            + [f"{name}: has no mutable member; remove it from the table" for name in sorted(MAY_BE_MUTABLE.keys() - found)])


if __name__ == "__main__":
    faults = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(faults))
    sys.exit(bool(faults))
