"""How many times faster than NumPy and Brian2 is a population, for the tasks of work.py?

Method: everything is built first. Each round then runs in sequence: Corpuscle once, NumPy once and Brian2 once, the latter two in both of
their forms. A drift of the machine's speed therefore affects all of them equally. In each round Corpuscle's rate is divided by that of the
fastest of the other runs. Output: for each program the median rate of its faster form; and the median, minimum and maximum of the ratio. If
the total numbers of spikes in double differ, the status is 1. The methods are described in numpy_in_place.py, brian2_standalone.py and
../population.cpp.

    side_by_side.py build/release/bench-population [--work shared ...] [--dtype float32 ...] [--runs 5]
"""

import statistics
import subprocess
import sys
import tempfile
from types import SimpleNamespace

import brian2_standalone
import numpy as np
import numpy_in_place
import work

FORMS = ["as-written", "folded"]


def ours(program, name, dtype, n):
    """Time (s) and number of spikes of one run of bench-population with the best instruction set, which it prints first."""
    precision = {"float64": "double", "float32": "float"}[dtype]
    run = subprocess.run([program, "--runs", "1", "--only", f"{precision} the peers' {name}"], check=True, capture_output=True, text=True)
    line = next(line for line in run.stdout.splitlines() if "the peers'" in line)
    rate, _, _, spikes = line[50:].split()
    return n * len(work.SAMPLES[name]) / float(rate), int(spikes)


def of_numpy(name, dtype, form, n):
    """A function that runs the task once and returns its time (s); and its number of spikes."""
    task = numpy_in_place.Task(name, np.dtype(dtype).type, form, n)
    block = 2**18 // task.g.itemsize
    return lambda: numpy_in_place.run(task, block)[0], numpy_in_place.count(numpy_in_place.run(task, block)[1])


def of_brian2(name, dtype, form, options, directory):
    """As of_numpy()."""
    spikes = brian2_standalone.build(name, dtype, form, options, directory)
    return lambda: brian2_standalone.run(directory), spikes


def compare(program, name, dtype, options):
    """Measures one task and prints a line. Returns True if all spike counts are equal, in double."""
    with tempfile.TemporaryDirectory() as top:
        peers = {("numpy", form): of_numpy(name, dtype, form, options.n) for form in FORMS}
        peers |= {("brian2", form): of_brian2(name, dtype, form, options, f"{top}/{form}") for form in FORMS}
        elapsed, ratios, spikes = {key: [] for key in ["ours", *peers]}, [], 0
        for _ in range(options.runs):
            seconds, spikes = ours(program, name, dtype, options.n)
            elapsed["ours"].append(seconds)
            for key, (run, _) in peers.items():
                elapsed[key].append(run())
            ratios.append(min(elapsed[key][-1] for key in peers) / seconds)
    steps = options.n * len(work.SAMPLES[name])
    best = {peer: max(steps / statistics.median(elapsed[key]) for key in elapsed if key == peer or key[0] == peer)
            for peer in ("ours", "numpy", "brian2")}
    rates = "  ".join(f"{peer} {rate / 1e6:6.0f}" for peer, rate in best.items())
    print(f"{name:9}{dtype:8} {rates}  M afferent-steps/s   {statistics.median(ratios):.1f} times the faster ({min(ratios):.1f} to {max(ratios):.1f},"
          f" {options.runs} rounds)   {spikes} spikes", flush=True)
    same = dtype != "float64" or all(found == spikes for _, found in peers.values())
    if not same:
        print(f"  not the same work: {[(*key, found) for key, (_, found) in peers.items()]}")
    return same


def main():
    program = sys.argv.pop(1)
    options = work.arguments(form=FORMS)
    options = SimpleNamespace(**vars(options), flags="unrolled", monitor="spikes", rectify="clip")
    print(work.machine())
    pairs = dict.fromkeys((name, dtype) for name, dtype, _ in options.works)
    same = [compare(program, name, dtype, options) for name, dtype in pairs]
    sys.exit(0 if all(same) else 1)


if __name__ == "__main__":
    main()
