#!/usr/bin/python3
"""How much do the spikes of the SA-I chip vary by the noise of its devices, is that what .noise predicts, and what does it cost?

    bench/noise.py CORPUSCLE [SEEDS]

Method: examples/sweeps/sa1-noise.toml runs with this number of seeds (1000). The standard deviation of each of the last 14 intervals is
taken over the seeds. The prediction is linear: bench/decks/sa1_membrane_held.cir gives the density S(f) of the noise of the current I into
the membrane. The mean current over an interval T then has the variance of S(f) sinc^2(f T), summed over f, and the interval that standard
deviation times T / I. S is taken as constant below noisefmin, 1 Hz. In newtons: by the slope of the chip's rate between 1.9 and 2.1 N, and
from .noise by its gain of slow changes of the force. The cost is that of the same seeds without noise.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time

import numpy as np

program, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1000
here = os.path.dirname(os.path.abspath(__file__))
sweep_file = os.path.join(here, "../examples/sweeps/sa1-noise.toml")
deck = os.path.join(here, "decks/sa1_membrane_held.cir")
F_MIN, F_MAX, INTERVALS = 1.0, 1000.0, 14


def run(*command):
    return subprocess.run([program, *command], check=True, capture_output=True, text=True).stdout


def rows(sweep, folder, *options):
    """Runs a sweep, and returns its rows and the processor time (s)."""
    out = os.path.join(folder, "results.sqlite")
    if os.path.exists(out):
        os.remove(out)
    before = sum(os.times()[2:4])
    run("sweep", sweep, "--quiet", "--out", out, *options)
    took = sum(os.times()[2:4]) - before
    lines = run("sweep", "dump", out).splitlines()
    names = lines[0].split(",")
    return [dict(zip(names, line.split(","))) for line in lines[1:]], took


def intervals(all_rows):
    """The last intervals (s) of each chip: [seed][interval]."""
    trains = [np.array([float(t) for t in row["spikes of sa1-circuit"].split()]) for row in all_rows]
    return np.array([np.diff(t)[-INTERVALS:] for t in trains])


def rate_under(force, folder):
    """The chip's rate (Hz) under a hold without noise."""
    out = os.path.join(folder, "rate")
    run("respond", "step", "--set", f"step.F_max={force}N", "--set", "step.t_hold=1.5s", "--afferent", "sa1-circuit", "--quiet", "--overwrite", "--out", out)
    t = np.array([float(line.split(",")[2]) for line in open(os.path.join(out, "spikes.csv")).read().splitlines()[1:]])
    return 1 / np.diff(t)[-3]


def predicted(folder, T):
    """The mean current (A), and the standard deviations of the mean over T of the current (A) and of the force (N)."""
    out = os.path.join(folder, "held.csv")
    text = run("run", deck, "--set", "vforce.dc=2", "--overwrite", "-o", out)
    current = abs(float(re.search(r"^i\(vheld\)\s+(-?[\d.]+) pA", text, re.M).group(1))) * 1e-12
    path = next(p for p in (os.path.join(folder, f"held-{k}.csv") for k in range(1, 9)) if open(p).readline().startswith("frequency"))
    f, out_noise, force_noise = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    grid = np.geomspace(1e-3, F_MAX, 100001)

    def deviation(density):
        S = np.exp(2 * np.interp(np.log(np.maximum(grid, F_MIN)), np.log(f), np.log(density))) * np.sinc(grid * T) ** 2
        return np.sqrt(np.sum((S[1:] + S[:-1]) / 2 * np.diff(grid)))

    gain = out_noise[0] / force_noise[0]  # A/N, of slow changes
    return current, deviation(out_noise), deviation(out_noise) / gain


with tempfile.TemporaryDirectory() as folder:
    began = time.perf_counter()
    noisy, noisy_time = rows(sweep_file, folder, "--samples", str(seeds))
    wall = time.perf_counter() - began
    isi = intervals(noisy)
    T = isi.mean()
    sd = np.sqrt(isi.var(axis=0, ddof=1).mean())
    few = min(seeds, 64)
    without = os.path.join(folder, "without.toml")
    text = open(sweep_file).read()
    open(without, "w").write(re.sub(r"noisefmax .*\n", "", text).replace('what = "noise"', 'what = "mismatch"'))
    quiet, quiet_time = rows(without, folder, "--samples", str(few))
    current, current_sd, force_sd = predicted(folder, T)
    slope = (rate_under(2.1, folder) - rate_under(1.9, folder)) / 0.2  # Hz/N
    lag = np.mean([np.corrcoef(isi[:, k], isi[:, k + 1])[0, 1] for k in range(INTERVALS - 1)])
    steps = np.mean([float(r["steps"]) for r in noisy])
    quiet_steps = np.mean([float(r["steps"]) for r in quiet])
    print(f"{len(noisy)} seeds, interval {T * 1e3:.3f} ms: standard deviation {sd * 1e6:.1f} us, {sd / T:.2e} of it; of each: "
          + " ".join(f"{1e6 * s:.0f}" for s in isi.std(axis=0, ddof=1)))
    print(f"linear prediction {current_sd / current * T * 1e6:.1f} us from a current of {current * 1e12:.2f} pA; correlation of neighbours {lag:.2f}")
    print(f"in newtons: {sd / T**2 / slope * 1e3:.2f} mN by the slope of the rate, {slope:.2f} Hz/N; {force_sd * 1e3:.2f} mN from .noise")
    print(f"cost: {noisy_time / len(noisy):.3f} s and {steps:.0f} steps a chip with noise up to {F_MAX:g} Hz, "
          f"{quiet_time / len(quiet):.3f} s and {quiet_steps:.0f} steps without (chips with mismatch); {wall:.0f} s in all")
