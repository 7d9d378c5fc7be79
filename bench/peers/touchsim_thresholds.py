#!/usr/bin/env python3
"""Thresholds of TouchSim's fitted afferents under the middle of a flat probe with a radius of 0.5 mm.

    touchsim_thresholds.py

Two stimuli: a ramp of 50 ms that is then held, and a sine around a depth of 0.5 mm. The output is, for each fitted model of a class, from the
least to the greatest:

- the least depth (um) and force (mN) at which the ramp gives a spike;
- the least amplitude (um) at which the sine gives more spikes than the depth alone;
- the least amplitude at which it gives a spike a cycle, on average over 0.4 s.

`-` means that no amplitude below 1 mm does, or that the depth alone gives as many spikes. TouchSim's noise is off.
"""
import numpy as np

from touchsim_pins import flat_depth
from touchsim_skin import import_touchsim

RATE, RADIUS, PRELOAD = 5000, 0.5, 0.5  # Hz, mm, mm
TIME = np.arange(round(0.7 * RATE)) / RATE
VIBRATION = (0.3, 0.7)  # s
FREQUENCIES = (5, 10, 20, 40, 80, 160, 300)  # Hz
LARGEST = 1.0  # mm


def spike_count(touchsim, unit, depth):
    """Number of spikes from the start of the vibration, and of all."""
    pressed = touchsim.Stimulus(trace=depth[None], location=np.zeros((1, 2)), fs=RATE, pin_radius=RADIUS)
    train = unit.response(pressed).spikes[0]
    return np.sum(train >= VIBRATION[0]), len(train)


def least(is_enough):
    """The least value (mm) that is enough, by bisection on a logarithmic scale; NaN if none is."""
    low, high = 1e-5, LARGEST
    if not is_enough(high):
        return np.nan
    while high > 1.01 * low:
        middle = np.sqrt(low * high)
        low, high = (low, middle) if is_enough(middle) else (middle, high)
    return high


def vibration(frequency, amplitude):
    return PRELOAD * np.interp(TIME, [0, 0.05], [0, 1]) + amplitude * np.where(TIME >= VIBRATION[0],
                                                                             np.sin(2 * np.pi * frequency * (TIME - VIBRATION[0])), 0)


def text(values):
    return " ".join("-" if np.isnan(v) else f"{v:.3g}" for v in np.sort(values))


def main():
    touchsim = import_touchsim()
    for c, fitted in touchsim.Afferent.affparams.items():
        units = [touchsim.AfferentPopulation(touchsim.Afferent(c, idx=k, noisy=False)) for k in range(len(fitted))]
        ramp = np.interp(TIME, [0.05, 0.1], [0, 1])
        depths = np.array([least(lambda d: spike_count(touchsim, u, d * ramp)[1] > 0) for u in units])
        print(f"{c}: ramp {text(1e3 * depths)} um, {text(1e3 * depths / flat_depth(1, RADIUS))} mN")
        held = [spike_count(touchsim, u, vibration(0, 0))[0] for u in units]
        for f in FREQUENCIES:
            cycles = round(f * (VIBRATION[1] - VIBRATION[0]))
            excess, followed = (
                [least(lambda a: h < n <= spike_count(touchsim, u, vibration(f, a))[0]) for u, h, n in zip(units, held, needed)]
                for needed in ([h + 1 for h in held], [cycles] * len(units)))
            print(f"    {f} Hz: a spike {text(1e3 * np.array(excess))} um; a spike a cycle {text(1e3 * np.array(followed))} um")


if __name__ == "__main__":
    main()
