#!/usr/bin/env python3
"""How long do a thousand chips of SA-I take under the press, and how does the time depend on cores and lanes?

    bench/thousand.py CORPUSCLE [CHIPS]

Method: examples/sweeps/sa1-chips.toml runs unchanged (process and mismatch, 1.0 s of press, spikes and ten measures stored) into a file on
disk. The result is the wall time of the complete command. All chips run on two threads. Then a tenth of them runs on one thread three
times, with 8 lanes (the default), 4 and 1; the results of the three must be equal. bench-batch times single iterations and chips without
lanes. peers/chip.py times a chip in ngspice.
"""
import os
import subprocess
import sys
import tempfile
import time

program, chips = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1000
sweep = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../examples/sweeps/sa1-chips.toml")


def run(samples, *options):
    """Runs the sweep with this number of chips, prints its time, and returns its results as text."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "r.sqlite")
        began = time.perf_counter()
        subprocess.run([program, "sweep", sweep, "--quiet", "--out", out, "--samples", str(samples), *options], check=True, stdout=subprocess.DEVNULL)
        took = time.perf_counter() - began
        rows = subprocess.run([program, "sweep", "dump", out], check=True, capture_output=True).stdout
        print(f"{samples} chips, {' '.join(options)}: {took:.1f} s, {took / samples * 1e3:.1f} ms a chip, {os.path.getsize(out) / samples:.0f} bytes a chip")
        return rows


run(chips, "-j", "2")
few = max(chips // 10, 8)
one = run(few, "-j", "1", "--lanes", "8")
for lanes in ("4", "1"):
    assert run(few, "-j", "1", "--lanes", lanes) == one, "the results depend on the number of lanes"
