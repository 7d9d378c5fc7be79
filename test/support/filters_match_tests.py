"""filters_match_tests.py PROGRAM FILTER: checks that every pattern of a GoogleTest filter matches a test of the program.

The filter lists the long tests; without this check, a renamed test would become one of the quick tests unnoticed."""
import fnmatch
import subprocess
import sys

program, patterns = sys.argv[1], sys.argv[2].split(":")
names, suite = [], ""
for line in subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout.splitlines():
    name = line.split("#")[0].rstrip()
    if name and not line.startswith(" "):
        suite = name
    elif name:
        names.append(suite + name.strip())
unmatched = [pattern for pattern in patterns if not any(fnmatch.fnmatchcase(name, pattern) for name in names)]
for pattern in unmatched:
    print(f"{program}: no test matches {pattern}; correct the list in test/CMakeLists.txt")
sys.exit(bool(unmatched) or not names)
