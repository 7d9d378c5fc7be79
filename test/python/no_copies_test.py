"""Large results become arrays without a copy. bench/python_calls.py measures the time of calls."""

import unittest

import corpuscle
import numpy as np


class Arrays(unittest.TestCase):
    def test_a_million_spikes_are_not_copied(self):
        raw = corpuscle.respond(np.full(10000, 4.0), 1000, "sa1", copies=5000)._raw
        self.assertGreater(len(raw.times), 1_000_000)
        self.assertTrue(np.shares_memory(raw.times, raw.times))
        self.assertTrue(np.shares_memory(raw.indices, raw.indices))

    def test_a_million_points_are_not_copied(self):
        result = corpuscle.circuit("divider\nv1 a 0 1\nr1 a b 1k\nr2 b 0 1k\n").dc("v1", 0, 1, 1e-6)
        self.assertEqual(result["v(b)"].shape, (1_000_001,))
        np.testing.assert_allclose(result["v(b)"], result["v(a)"] / 2, rtol=1e-9, atol=1e-15)
        self.assertTrue(np.shares_memory(result["v(b)"], result["v(b)"]))


if __name__ == "__main__":
    unittest.main()
