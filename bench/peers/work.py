"""The tasks on which the peers (other simulators) are compared with bench-population.

N afferents sa1 (SA-IB and LIF-B at their defaults), 10 kHz, backward Euler, spikes on the samples. The force of afferent i is g_i times the
press, g_i = 0.5 + 0.5 i / (N - 1), i = 0 ... N - 1. Before the first sample, the force is that of the first sample, and membranes are at
rest.

    shared     one receptor for all: the current of afferent i is g_i times the current under the press
    own        one receptor per afferent: f_B of afferent i is 15 Hz + 10 Hz i / (N - 1)
    streamed   one receptor per afferent, at the defaults; forces are read from memory, [step][afferent]

In each step, with the force F (F_before: of the step before), the high-passes x_B and x_C, the current I and the membrane voltage u:

    x_B = keep_B x_B + keep_B (F - F_before);   x_C in the same way
    I = k_A F + max{K_B x_B, 0} + max{K_C x_C, 0}
    u = max{u + (I - I_leak0) k, E_L};   if u > V_th: a spike, stored as step and afferent, and u decreases by V_th - V_reset

Here keep is the factor keep(f) below, and k is DT / C_m. The form `as-written` computes this in this order; `folded` is the same algebra
with fewer operations, so its last digits differ.
"""

import argparse
import itertools
import json
import platform
import statistics

import numpy

DT = 1e-4  # s
K_A, K_B, F_B, K_C, F_C = 1e-6, 8e-6, 20.0, 2e-6, 2.0  # A/N, A/N, Hz, A/N, Hz
C_M, I_LEAK0, E_L, V_TH, V_RESET = 500e-9, 500e-9, 0.0, 0.5, 0.25  # F, A, V, V, V
K = DT / C_M  # V/A: increase of u in one step per current
DROP = V_TH - V_RESET  # V: decrease of u at a spike

# For each task, the samples of the press: all, the rise (2500 to 3750) with the start of the plateau, or most of the rise.
SAMPLES = {"shared": range(0, 10000), "own": range(2400, 4400), "streamed": range(2400, 3400)}


def cos_half_turn(x):
    """cos(pi x) for 0 <= x <= 1, with the operations of src/core/number/elementary.hpp, for bitwise equal results."""
    turns = 0.5 * x
    big = 6755399441055744.0
    quarter = (turns * 4.0 + big) - big
    y = (turns - quarter * 0.25) * 6.283185307179586
    z = y * y
    s = 1.0 / 355687428096000.0
    for f in (-1307674368000.0, 6227020800.0, -39916800.0, 362880.0, -5040.0, 120.0, -6.0):
        s = s * z + 1.0 / f
    c = -1.0 / 6402373705728000.0
    for f in (20922789888000.0, -87178291200.0, 479001600.0, -3628800.0, 40320.0, -720.0, 24.0):
        c = c * z + 1.0 / f
    s, c = y + y * z * s, (1.0 - 0.5 * z) + z * z * c
    return {0.0: c, 1.0: -s, 2.0: -c}[quarter]


def press_at(t):
    """The press at its defaults, N (src/core/stimulus/touch.hpp)."""
    progress = lambda start: 0.0 if t < start else (t - start) / 0.125 if t < start + 0.125 else 1.0
    up, down = progress(0.25), progress(0.25 + 0.125 + 0.25)
    return 0.2 + (4.0 - 0.2) * 0.5 * (1 - cos_half_turn(1 - down if down > 0 else up))


def press(samples):
    """The force of these samples of the press at 10 kHz, N."""
    return [press_at(k / 10000) for k in samples]


def keep(f):
    """The factor `keep` of a high-pass with cutoff f (Hz) in backward Euler."""
    return 1.0 / (1.0 + f * (6.283185307179586 * DT))


def between(low, high, n):
    """n equally spaced values from low to high."""
    return low + (high - low) * numpy.arange(n) / max(n - 1, 1)


def gains(n):
    """Factor g_i of each afferent's force."""
    return between(0.5, 1.0, n)


def corners(n):
    """f_B of each afferent of `own`, Hz."""
    return between(15.0, 25.0, n)


def frames(n, samples, dtype):
    """The forces of `streamed`: [step][afferent], N."""
    out, g = numpy.empty((len(samples), n), dtype), gains(n)
    for row, F in zip(out, press(samples)):
        row[:] = g * F
    return out


def currents(force):
    """The receptor's current with the default parameters at each sample of a force, A."""
    out, before, x_B, x_C, keep_B, keep_C = [], force[0], 0.0, 0.0, keep(F_B), keep(F_C)
    for F in force:
        dF, before = F - before, F
        x_B, x_C = keep_B * x_B + keep_B * dF, keep_C * x_C + keep_C * dF
        out.append(K_A * F + max(K_B * x_B, 0.0) + max(K_C * x_C, 0.0))
    return out


def arguments(form, **more):
    """Parses the command line: tasks, number types and forms (default: all), numbers of afferents and runs.

    `more`: further options with their defaults."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--work", nargs="+", choices=list(SAMPLES), default=list(SAMPLES))
    parser.add_argument("--dtype", nargs="+", choices=["float64", "float32"], default=["float64", "float32"])
    parser.add_argument("--form", nargs="+", choices=form, default=form)
    parser.add_argument("--n", type=int, default=100000, help="afferents")
    parser.add_argument("--runs", type=int, default=5)
    for name, value in more.items():
        parser.add_argument(f"--{name}", type=type(value), default=value)
    options = parser.parse_args()
    options.works = list(itertools.product(options.work, options.dtype, options.form))
    return options


def report(peer, work, dtype, form, n, seconds, spikes):
    """Prints the measurement of one task as text and as JSON. `seconds`: time of each run; `n`: number of afferents."""
    steps, median = len(SAMPLES[work]), statistics.median(seconds)
    rate, spread = n * steps / median, (max(seconds) - min(seconds)) / median
    print(f"{peer} {work:9}{dtype:8} {rate / 1e6:8.0f} M afferent-steps/s  {n} x {steps}: {median:6.3f} s, {len(seconds)} runs, "
          f"spread {spread:4.0%}  {spikes} spikes  ({form})")
    print(json.dumps({"peer": peer, "work": work, "dtype": dtype, "afferent_steps_per_s": round(rate), "runs": len(seconds),
                      "spikes": spikes, "afferents": n, "steps": steps, "form": form}), flush=True)


def machine():
    """Describes the machine in one line."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), platform.machine())
    return f"{model}; Python {platform.python_version()}, NumPy {numpy.__version__}"
