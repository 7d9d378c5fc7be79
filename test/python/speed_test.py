"""The cost of a call, in seconds of a machine on which Python adds up a range of 1,000 numbers in 10 us.

Machines differ, and other programs may run on them, so each round measures the sum beside the call. doc/python.md has measured numbers."""

import time
import unittest

import corpuscle
import numpy as np

SUM = 10e-6  # s, of the sum


def elapsed(function, calls):
    start = time.perf_counter()
    for _ in range(calls):
        function()
    return (time.perf_counter() - start) / calls


def seconds(function, calls=200, rounds=20):
    """The shortest time of a call over rounds of `calls` calls, relative to that of the sum."""
    numbers = range(1000)
    times = [(elapsed(function, calls), elapsed(lambda: sum(numbers), calls)) for _ in range(rounds)]
    return SUM * min(call for call, _ in times) / min(reference for _, reference in times)


class Speed(unittest.TestCase):
    def test_the_smallest_call_takes_less_than_20_microseconds(self):
        force = np.zeros(10)
        self.assertLess(seconds(lambda: corpuscle.respond(force, 1000.0, "sa1")), 20e-6)

    def test_a_million_spikes_become_arrays_in_less_than_20_microseconds(self):
        raw = corpuscle.respond(np.full(10000, 4.0), 1000, "sa1", copies=5000)._raw
        self.assertGreater(len(raw.times), 1_000_000)
        self.assertLess(seconds(lambda: (raw.times, raw.indices)), 20e-6)

    def test_the_smallest_circuit_takes_less_than_60_microseconds(self):
        circuit = corpuscle.circuit("divider\nv1 a 0 1\nr1 a b 1k\nr2 b 0 1k\n")
        self.assertLess(seconds(circuit.op), 60e-6)

    def test_a_million_points_become_arrays_without_a_copy(self):
        result = corpuscle.circuit("divider\nv1 a 0 1\nr1 a b 1k\nr2 b 0 1k\n").dc("v1", 0, 1, 1e-6)
        self.assertEqual(result["v(b)"].shape, (1_000_001,))
        np.testing.assert_allclose(result["v(b)"], result["v(a)"] / 2, rtol=1e-9, atol=1e-15)
        self.assertLess(seconds(lambda: result["v(b)"]), 20e-6)


if __name__ == "__main__":
    unittest.main()
