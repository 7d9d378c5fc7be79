#!/usr/bin/python3
"""PYTHONPATH=build/release/python bench/python_calls.py: the shortest time of small calls, over 20 rounds of 200 calls."""
import time

import corpuscle
import numpy as np

ROUNDS, CALLS = 20, 200


def microseconds(function):
    best = np.inf
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(CALLS):
            function()
        best = min(best, (time.perf_counter() - start) / CALLS)
    return 1e6 * best


force = np.zeros(10)
circuit = corpuscle.circuit("divider\nv1 a 0 1\nr1 a b 1k\nr2 b 0 1k\n")
spikes = corpuscle.respond(np.full(10000, 4.0), 1000, "sa1", copies=5000)._raw
points = circuit.dc("v1", 0, 1, 1e-6)
print(f"respond, 10 samples of sa1: {microseconds(lambda: corpuscle.respond(force, 1000.0, 'sa1')):.1f} us")
print(f"operating point of a divider: {microseconds(circuit.op):.1f} us")
print(f"{len(spikes.times)} spikes as arrays: {microseconds(lambda: (spikes.times, spikes.indices)):.1f} us")
print(f"{len(points['v(b)'])} points as an array: {microseconds(lambda: points['v(b)']):.1f} us")
