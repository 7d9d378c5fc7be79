#!/usr/bin/env python3
"""The same touches on Corpuscle's fingertip and in TouchSim (Saal et al., PNAS 2017): which afferents fire, how much, and when?

    touchsim_responses.py CORPUSCLE [--population NAME|FILE] [--only TEXT] [--noise] [--json]

Equal in both: positions and classes of the afferents (SA-I is SA1, FA-I is RA, FA-II is PC; TouchSim has no SA-II), the indenter, its path,
and its force over time, sampled at 5 kHz. Corpuscle takes the force. TouchSim takes the depth that belongs to it in an elastic half-space with
TouchSim's own stiffness (touchsim_pins.py). Spikes are counted without conduction delay. TouchSim's noise is off unless --noise is given.

The stimuli are in touchsim_stimuli.py: ramps and sines of a probe with a radius of 0.5 mm, presses and strokes with a sphere, and gratings
that move under a patch of 4 mm. The probe touches four places in turn, which count as one stimulus. A rate is the mean over the touched
afferents: SA-I and FA-I within 1.5 mm of the contact, and all FA-II of the fingertip. The onset part is the ramp and 20 ms (of a sine, its
first 100 ms). The steady part is the end of the hold (of a sine, from 100 ms on; of a stroke, the movement). Totals are spikes of all
afferents over all time, for one place.

The output has rates and totals of each stimulus. For each class it has the correlation of rates over the set (Pearson's of rates, Spearman's
of their ranks) and the ratio of totals, and last the rank order of the classes that fire. An asterisk marks what misses the aims: a
correlation of 0.8, a ratio of 0.5 to 2.
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

from touchsim_agreement import agreement, print_agreement, print_rates
from touchsim_skin import CLASSES as OURS
from touchsim_skin import corpuscle_trains, read_afferents, run_corpuscle, touchsim_population, touchsim_trains
from touchsim_stimuli import RATE, all_stimuli

CLASSES = ("SA1", "RA", "PC")
MARGIN = 1.5  # mm around the contact


def touched_units(afferents, stimulus):
    """Indices of the touched afferents of each class."""
    places = np.array([[x, y] for _, _, x, y, _ in afferents])
    distance = np.hypot(*(places[:, None] - stimulus.path).T).min(0)
    return {c: [k for k, a in enumerate(afferents) if a[1] == c and (c == "PC" or distance[k] <= stimulus.radius + MARGIN)]
            for c in CLASSES}


def counts(stimulus, afferents, ours, theirs):
    """Spike counts of one stimulus, a row for each class."""
    touched = touched_units(afferents, stimulus)
    for c in CLASSES:
        if not touched[c]:
            sys.exit(f"{stimulus.name}: the population has no {c} near the contact; use a skin with afferents of the classes "
                     f"{', '.join(OURS)} around x = {stimulus.path[0][0]:g} mm, y = {stimulus.path[0][1]:g} mm, such as fingertip")
        row = {"stimulus": stimulus.name, "group": stimulus.group, "class": c, "touched": len(touched[c]), "places": 1}
        for program, trains in (("ours", ours), ("theirs", theirs)):
            for part, (start, end) in stimulus.windows.items():
                row[f"{part}_spikes_{program}"] = sum(bool(start <= t < end) for k in touched[c] for t in trains[k])
            row[f"total_{program}"] = sum(len(trains[k]) for k, a in enumerate(afferents) if a[1] == c)
        yield row


def joined(rows):
    """The sum of the rows of the same stimulus and class, which differ in place."""
    out = {}
    for row in rows:
        first = out.setdefault((row["stimulus"], row["class"]), {})
        first.update({key: value if isinstance(value, str) else first.get(key, 0) + value for key, value in row.items()})
    return out.values()


def with_rates(row, windows):
    """The row with spikes per touched afferent, rates, and totals of one place."""
    for program in ("ours", "theirs"):
        for part, (start, end) in windows.items():
            row[f"{part}_spikes_per_unit_{program}"] = row[f"{part}_spikes_{program}"] / row["touched"]
            row[f"{part}_Hz_{program}"] = row[f"{part}_spikes_per_unit_{program}"] / (end - start)
        row[f"total_{program}"] /= row["places"]
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("corpuscle")
    parser.add_argument("--population", default="fingertip", help="a skin with the region of the built-in fingertip")
    parser.add_argument("--only", default="", help="stimuli whose name contains this text")
    parser.add_argument("--noise", action="store_true", help="switch TouchSim's noise on")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    stimuli = [s for s in all_stimuli() if options.only in s.name]
    if not stimuli:
        parser.error(f"--only: no stimulus is called '{options.only}'; the names are: " + "; ".join(dict.fromkeys(s.name for s in all_stimuli())))
    rows, forces, population = [], {}, None
    with tempfile.TemporaryDirectory() as scratch:
        for stimulus in stimuli:
            folder = run_corpuscle(options.corpuscle, options.population, stimulus, RATE, Path(scratch))
            afferents = read_afferents(folder)
            population = population or touchsim_population(afferents, options.noise)
            theirs, force = touchsim_trains(population, stimulus, RATE)
            forces[stimulus.name] = {"ours_N": float(stimulus.force.max()), "theirs_N": force}
            rows += counts(stimulus, afferents, corpuscle_trains(folder, afferents), theirs)
    windows = {s.name: s.windows for s in stimuli}
    rows = [with_rates(row, windows[row["stimulus"]]) for row in joined(rows)]
    result = {"population": options.population, "forces": forces, "rows": rows, "agreement": agreement(rows, CLASSES)}
    if options.json:
        print(json.dumps(result, indent=1))
    else:
        print_rates(rows, forces)
        print_agreement(result["agreement"])


if __name__ == "__main__":
    main()
