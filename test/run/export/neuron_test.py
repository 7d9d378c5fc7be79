"""Exported NEURON scripts give the spikes of corpuscle."""

import os
import shutil
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor

import export_support as support

try:
    import neuron
except ImportError:
    neuron = None


@unittest.skipIf(neuron is None or shutil.which("nrnivmodl") is None, "NEURON is not installed (Debian: python3-neuron, neuron-dev)")
class Neuron(unittest.TestCase):
    def trains(self, folder, name, settings):
        """The spikes of the script, which runs as a program, because NEURON loads a mechanism only once."""
        path = os.path.join(folder, "script.py")
        support.program("export", name, "--for", "neuron", *support.set_options(settings), "-o", path)
        done = subprocess.run([sys.executable, path, "force.csv"], cwd=folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, f"{name}: {done.stderr}")
        return support.trains_of(os.path.join(folder, "spikes.csv"))

    def difference(self, case):
        name, settings = case
        # The filters of fa2 reach 500 Hz: at 10 kHz corpuscle's straight lines between samples move a spike by more than a step.
        step = support.STEP / 5 if name == "fa2" else support.STEP
        with support.temporary_folder() as folder:
            ours = support.our_trains(folder, name, settings, *support.touch(step))
            self.assertGreater(sum(map(len, ours)), 1, name)
            return name, support.largest_difference(ours, self.trains(folder, name, settings))

    def test_every_afferent_fires_as_in_corpuscle(self):
        cases = support.afferents()
        self.assertGreater(len(cases), 15)
        with ThreadPoolExecutor(2) as pool:
            for name, difference in pool.map(self.difference, cases):
                with self.subTest(name):
                    self.assertLess(difference, support.STEP)


if __name__ == "__main__":
    unittest.main()
