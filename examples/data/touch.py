"""Computes touch.csv: the force of a fingertip on a load cell, as a 12-bit converter at 500 Hz would log it.

Usage: python3 touch.py > touch.csv

Two taps, a press that is held, and a rub. The hold relaxes slowly and has physiological tremor at 9 Hz. The rub is a load of 1.8 N
that varies at 6 Hz. The sensor adds mains hum, noise, an offset that drifts, and steps of 1.5 mN.
"""

import math
import random

RATE, LENGTH = 500, 6.0  # Hz, s
STEP = 1.5  # mN, one code of the converter


def pulse(t, start, rise, hold, fall):
    """A pulse at time t: it rises from 0 to 1 as half a cosine, is held at 1, and falls back in the same way. All times in s."""
    if t < start or t > start + rise + hold + fall:
        return 0.0
    if t < start + rise:
        return 0.5 - 0.5 * math.cos(math.pi * (t - start) / rise)
    if t < start + rise + hold:
        return 1.0
    return 0.5 + 0.5 * math.cos(math.pi * (t - start - rise - hold) / fall)


def force(t):
    """Force of the finger, N."""
    taps = 2.4 * pulse(t, 0.50, 0.04, 0.02, 0.06) + 3.1 * pulse(t, 0.95, 0.03, 0.03, 0.05)
    held = pulse(t, 1.60, 0.12, 1.30, 0.15) * (3.2 + 0.35 * math.exp(-max(t - 1.72, 0) / 0.4) + 0.06 * math.sin(2 * math.pi * 9 * t))
    rub = pulse(t, 3.90, 0.20, 1.10, 0.20) * (1.8 + 0.9 * math.sin(2 * math.pi * 6 * t))
    return taps + held + rub


def main():
    rng = random.Random(2)
    print("time_s,fz_mN")
    for k in range(int(RATE * LENGTH)):
        t = k / RATE
        noise = sum(rng.random() - 0.5 for _ in range(6)) * 4  # mN, nearly normal with a deviation of 2.8 mN
        hum = 3 * math.sin(2 * math.pi * 50.02 * t)  # mN, mains
        reading = 1e3 * force(t) + 4 + 1.2 * t + hum + noise  # mN; the offset of 4 mN drifts by 1.2 mN/s
        print(f"{t:.3f},{STEP * round(reading / STEP):.1f}")


if __name__ == "__main__":
    main()
