#!/usr/bin/python3
"""How long does it take to reproduce every figure and table of the thesis?   studies.py CORPUSCLE

Runs all studies in one process (`corpuscle study NAME ...`) three times, then all but those that sample thousands of chips.
Prints wall time and processor time, medians of three. Targets: 60 s on two cores without these studies, 90 s with them.
"""
import json
import resource
import statistics
import subprocess
import sys
import time

PROGRAM = sys.argv[1]
SAMPLED = {"table12", "table15", "table17-18", "bias-spread", "fig46"}


def timed(names):
    """Medians of wall time and processor time, s."""
    runs = []
    for _ in range(3):
        cpu_before, began = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.monotonic()
        subprocess.run([PROGRAM, "study", *names, "--quiet"], check=True)
        runs.append((time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - cpu_before))
    return [statistics.median(column) for column in zip(*runs)]


names = [study["name"] for study in json.loads(subprocess.run([PROGRAM, "study", "all", "--json", "--quiet"], check=True, capture_output=True).stdout)]
for label, chosen in (("all", names), ("without those that sample chips", [n for n in names if n not in SAMPLED])):
    wall, processor = timed(chosen)
    print(f"corpuscle study, {label} ({len(chosen)}): {wall:.1f} s, {processor:.1f} s of processor")
