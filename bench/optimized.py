#!/usr/bin/env python3
"""Does a chip that `corpuscle optimize` found keep its limits, one chip at a time and at a hundredth of the tolerances?

    optimized.py CORPUSCLE FOUND.cir sa1|fa1 [CHIPS] [SEED]      default: 20 chips, seed 1

Method: each condition of examples/optimize (five corners, three temperatures, three supplies) and each chip with process and mismatch is one
`corpuscle run` of the found netlist, with the default tolerances and with a hundredth of them (reltol=1e-7, vntol=1e-8). The spikes are
counted here and compared with the limits of the example: everywhere those of [limits], at the nominal condition and for the chips those of
the model's pattern, too. Printed are the cases outside, the cases whose number of spikes depends on the tolerances, and the largest shift of
a spike.
"""
import bisect
import concurrent.futures
import itertools
import json
import os
import subprocess
import sys
import tempfile

corpuscle, found, kind = sys.argv[1:4]
chips, seed = (int(sys.argv[k]) if len(sys.argv) > k else n for k, n in ((4, 20), (5, 1)))
phase_ends = [0, 0.25, 0.375, 0.625, 0.75, 1.0001]  # s: rest, protraction, plateau, retraction, post
model_counts = {"sa1": [0, 5, 9, 1, 0], "fa1": [0, 2, 2, 2, 2]}[kind]


def spikes(netlist, options):
    """The spike times of a run (s)."""
    run = subprocess.run([corpuscle, "run", netlist, "--json", "--quiet", *options], capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(f"{' '.join(options)}: {run.stderr}")
    return spikes_in(json.loads(run.stdout))


def spikes_in(document):
    if isinstance(document, dict):
        if "spikes" in document and isinstance(document["spikes"], list):
            return document["spikes"][0]
        document = list(document.values())
    for part in document if isinstance(document, list) else []:
        if isinstance(part, (dict, list)) and (times := spikes_in(part)) is not None:
            return times
    return None


def is_within(times, nominal):
    counts = [bisect.bisect_left(times, b) - bisect.bisect_left(times, a) for a, b in zip(phase_ends, phase_ends[1:])]
    if nominal:
        for k, (count, expected) in enumerate(zip(counts, model_counts)):
            allowed = max(1, expected // 4) if any(model_counts[:k + 1]) else 0
            if abs(count - expected) > allowed:
                return False
    if kind == "sa1":
        return counts[0] == 0 and counts[1] >= 1 and counts[2] >= 3 and counts[4] == 0
    return counts[0] == 0 and sum(counts) >= 1


def check(case):
    name, options, nominal = case
    default, tight = spikes(found, options), spikes(tight_netlist, options)
    shift = max([abs(a - b) for a, b in zip(default, tight)], default=0) if len(default) == len(tight) else None
    return name, is_within(tight, nominal), shift


cases = [(" ".join(k), ["--corner", k[0], "--temp", k[1], "--supply", k[2]], n == 0)
         for n, k in enumerate(itertools.product(["tt", "ss", "ff", "sf", "fs"], ["27", "-20", "85"], ["0.7V", "0.6V", "0.8V"]))]
conditions = len(cases)
cases += [(f"chip {k}", ["--corner", "mc", "--mismatch", f"{seed}/{k}"], True) for k in range(chips)]

text = open(found).read()
with tempfile.NamedTemporaryFile("w", suffix=".cir", dir=os.path.dirname(os.path.abspath(found)), delete=False) as file:
    tight_netlist = file.name
    file.write(text[:text.rindex(".end")] + ".options reltol=1e-7 vntol=1e-8 spikecheck=0\n.end\n")
try:
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(check, cases))
finally:
    os.unlink(tight_netlist)
for name, within, shift in results:
    if not within or shift is None:
        print(f"{name}:{'' if within else ' outside the limits'}{' another number of spikes' if shift is None else ''}")
print(f"{found}: {sum(r[1] for r in results[:conditions])} of {conditions} conditions and {sum(r[1] for r in results[conditions:])} of {chips} "
      f"chips within the limits at a hundredth of the tolerances; {sum(r[2] is None for r in results)} cases with another number of spikes; "
      f"largest shift {1e3 * max(r[2] for r in results if r[2] is not None):.3f} ms")
