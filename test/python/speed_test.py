"""The cost of a call. The limits are wide, because other programs may run on the machine; doc/python.md has measured numbers."""

import time
import unittest

import corpuscle
import numpy as np


def seconds(function, calls, rounds=20):
    """The shortest time of a call, over rounds of `calls` calls."""
    best = np.inf
    for _ in range(rounds):
        start = time.perf_counter()
        for _ in range(calls):
            function()
        best = min(best, (time.perf_counter() - start) / calls)
    return best


class Speed(unittest.TestCase):
    def test_the_smallest_call_takes_less_than_20_microseconds(self):
        force = np.zeros(10)
        self.assertLess(seconds(lambda: corpuscle.respond(force, 1000.0, "sa1"), 200), 20e-6)

    def test_a_million_spikes_become_arrays_in_less_than_20_microseconds(self):
        raw = corpuscle.respond(np.full(10000, 4.0), 1000, "sa1", copies=5000)._raw
        self.assertGreater(len(raw.times), 1_000_000)
        self.assertLess(seconds(lambda: (raw.times, raw.indices), 200), 20e-6)


if __name__ == "__main__":
    unittest.main()
