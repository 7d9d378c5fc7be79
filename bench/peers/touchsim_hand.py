#!/usr/bin/env python3
"""A fingertip strokes the hand: processor time and memory per second of touch in Corpuscle and in TouchSim (Saal et al., PNAS 2017).

    touchsim_hand.py CORPUSCLE [--rounds N] [--seconds S] [--rate HZ] [--pitch MM] [--part AFFERENTS] [--noise]

Method: the parts of a round run in sequence, each in its own process on one core. Corpuscle runs `corpuscle respond stroke --population
hand` for its 10 s. TouchSim runs for the first S seconds, once with all afferents together (its usual call) and once with AFFERENTS at a
time (smaller arrays need less cache and memory). Output: medians, and minimum and maximum of the ratios. Corpuscle's time is that of the
complete command, which builds the hand, simulates and writes its files. TouchSim's time is only that of Stimulus() and response(); its
import (with numba's compilation), its afferents and a first small run are listed separately. Peak memory is that of complete processes;
TouchSim's memory before its start is listed, too.

Equal in both: positions and classes of the afferents (Corpuscle's sa1 is SA1, fa1 is RA, fa2 is PC), the sphere, its path and speed, and
the input sampling rate. Different: TouchSim has no SA-II, so Corpuscle has more afferents. TouchSim's input is in millimetres: pins on a
lattice as fine as Corpuscle's sites, only in the region of this contact. Each pin is indented by max(0, d - r^2/2R), where r is its
distance from the centre of the contact, R the radius of the sphere, and d the depth of Corpuscle's Hertz contact under the stroke's force.
TouchSim's own mechanics release pins that would pull at the skin, and leave those in Hertz's circle of contact; its forces follow from its
own skin model. That skin is an infinite plane here. Wave paths around the outline of its hand, or its usual ten pins per millimetre, would
take more time. TouchSim's neurons always step at 5 kHz; Corpuscle's step at the sampling rate. TouchSim's noise is off unless --noise is
given.
"""
import argparse
import csv
import importlib.util
import json
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

from touchsim_skin import CLASSES, read_afferents

ONE_CORE = {f"{library}_NUM_THREADS": "1" for library in ("NUMBA", "OPENBLAS", "OMP", "MKL")}


def run_process(command):
    """Processor seconds, wall seconds, peak memory (MB) and output of a process on one core."""
    began = time.perf_counter()
    with tempfile.TemporaryFile("w+") as printed:
        process = subprocess.Popen([str(word) for word in command], stdout=printed, env=os.environ | ONE_CORE)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{command[0]} ended with status {process.returncode}")
        printed.seek(0)
        return used.ru_utime + used.ru_stime, time.perf_counter() - began, used.ru_maxrss / 1024, printed.read()


def touchsim(folder, options):
    """Runs TouchSim with the stroke recorded in Corpuscle's output folder, in its own process, which prints its resource use as JSON."""
    warnings.simplefilter("ignore")
    import numpy as np
    import touchsim as ts
    from touchsim_pins import sphere_depth, sphere_pins
    p = {name: parameter["value"] for name, parameter in json.loads((folder / "summary.json").read_text())["input"]["parameters"].items()}
    R, E = 1e3 * p["contact.radius"], 1e-6 * p["contact.E_star"]  # mm, MPa
    t = np.arange(round(options.seconds * options.rate)) / options.rate  # s
    depth = sphere_depth(p["ramp-hold.F_max"] * np.minimum(1, t / p["ramp-hold.t_up"]), R, E)
    start, end = (1e3 * np.array([p["contact.x" + n], p["contact.y" + n]]) for n in ("", "1"))
    path = start + np.outer(t / p["contact.t_move"], end - start)
    pins, indentation = sphere_pins(depth, path, R, options.pitch)
    random.seed(0)  # TouchSim chooses each afferent at random from its few fitted ones
    skin = ts.AfferentPopulation(*[ts.Afferent(c, location=[x, y], noisy=options.noise) for _, c, x, y, _ in read_afferents(folder)])

    def respond(skin, samples):
        stroke = ts.Stimulus(trace=indentation[:, :samples], location=pins, fs=options.rate, pin_radius=options.pitch / 2)
        part = options.part or len(skin)
        return stroke, [train for k in range(0, len(skin), part) for train in skin[k:k + part].response(stroke).spikes]

    respond(skin[:100], round(0.1 * options.rate))
    before, real = resource.getrusage(resource.RUSAGE_SELF), time.perf_counter()
    stroke, trains = respond(skin, t.size)
    after, real = resource.getrusage(resource.RUSAGE_SELF), time.perf_counter() - real
    kernel, user = after.ru_stime - before.ru_stime, after.ru_utime - before.ru_utime
    far = np.hypot(*(skin.location[:, None] - path[::20]).T).min(0)  # distance of each afferent from the path, mm
    fired_by_class = []
    for c in dict.fromkeys(CLASSES.values()):
        fired = [(len(train), d) for a, train, d in zip(skin.affclass, trains, far) if a == c and len(train)]
        spikes, off = sum(k for k, _ in fired), np.median([d for _, d in fired] or [0])
        fired_by_class.append(f"{c} {spikes} spikes of {len(fired)} afferents, half of these within {off:.0f} mm")
    print(json.dumps({
        "cpu": (user + kernel) / options.seconds, "kernel": kernel / options.seconds, "real": real / options.seconds,
        "afferents": len(skin), "steps": 5000 * len(skin),
        "spikes": sum(map(len, trains)) / options.seconds, "apart": before.ru_utime + before.ru_stime, "before": before.ru_maxrss / 1024,
        "pressed": f"{len(pins)} pins, up to {depth.max():.2f} mm deep, {np.median(stroke._profile.sum(1)):.2f} N by its mechanics",
        "fired": "; ".join(fired_by_class)}))


def medians(runs):
    """The median of each number over the runs; texts are those of the first run."""
    return {name: value if isinstance(value, str) else statistics.median(run[name] for run in runs) for name, value in runs[0].items()}


def row(program, runs):
    m = medians(runs)
    print(f"{program:<36}{m['cpu']:9.4f}{m['real']:9.4f}{m['peak']:9.0f}{m['afferents']:11.0f}{m['steps']:10.2g}{m['spikes']:9.0f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("corpuscle")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=1, help="seconds of the stroke for TouchSim, whose memory use grows with them")
    parser.add_argument("--rate", type=float, default=1000, help="sampling rate of both, Hz")
    parser.add_argument("--pitch", type=float, default=2, help="distance of TouchSim's pins, mm")
    parser.add_argument("--part", type=int, default=100, help="number of TouchSim afferents at a time")
    parser.add_argument("--noise", action="store_true", help="switch TouchSim's noise on")
    parser.add_argument("--within", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.within:
        return touchsim(options.within, options)
    there = importlib.util.find_spec("touchsim") is not None
    ours, theirs = [], {0: [], options.part: []}
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for _ in range(options.rounds):
            stroke = ["respond", "stroke", "--population", "hand", "--rate", options.rate, "--threads", 1, "--quiet", "--out", folder]
            cpu, real, peak, _ = run_process([options.corpuscle, *stroke])
            summary = json.loads((folder / "summary.json").read_text())
            work, s = summary["work"], summary["input"]["samples"] / summary["input"]["rate_Hz"]
            ours.append({"cpu": cpu / s, "real": real / s, "peak": peak, "afferents": summary["skin"]["afferents"],
                         "spikes": work["spikes"] / s, "steps": (work["afferent_steps"] + work["at_rest"]) / s,
                         "worked": work["afferent_steps"] / s})
            for part, runs in theirs.items() if there else ():
                same = [word for name in ("seconds", "rate", "pitch") for word in ("--" + name, getattr(options, name))]
                same += ["--noise"] * options.noise
                _, _, peak, printed = run_process([sys.executable, __file__, options.corpuscle, "--within", folder, "--part", part, *same])
                runs.append(json.loads(printed) | {"peak": peak})
        spikes = csv.DictReader((folder / "spikes.csv").open())
        first = [u["afferent"].split("#")[0] for u in spikes if float(u["time_s"]) < options.seconds]
    print("one core, per second of touch          cpu s   real s  peak MB  afferents     steps   spikes")
    row("corpuscle, a stroke over the hand", ours)
    print(f"    {ours[0]['worked']:.2g} steps computed, the others skipped; in the first {options.seconds:g} s "
          + ", ".join(f"{name} {first.count(name)}" for name in sorted(set(first))) + " spikes")
    if not there:
        print("TouchSim is not installed: pip install git+https://github.com/hsaal/touchsim, or add a checkout to PYTHONPATH.")
    for part, runs in theirs.items() if there else ():
        row("TouchSim, " + (f"{part} afferents at a time" if part else "all afferents at once"), runs)
        m, ratios = medians(runs), [run["cpu"] / mine["cpu"] for run, mine in zip(runs, ours)]
        print(f"    {m['kernel']:.1f} s of it in the kernel; before its start {m['apart']:.1f} s and {m['before']:.0f} MB")
        print(f"    over ours: processor {statistics.median(ratios):.0f} ({min(ratios):.0f} to {max(ratios):.0f}, "
              f"{options.rounds} rounds), memory {m['peak'] / medians(ours)['peak']:.1f}")
    if there:
        print(f"TouchSim: {m['pressed']}; distances from the path:\n    {m['fired']}")


main()
