"""Exported Brian 2 scripts give the spikes of corpuscle."""

import json
import os
import subprocess
import sys
import unittest

import numpy as np

import export_support as support

try:
    import brian2
except ImportError:
    brian2 = None


@unittest.skipIf(brian2 is None, "Brian 2 is not installed (Debian: python3-brian)")
class Brian2(unittest.TestCase):
    def trains(self, name, settings, t, forces, step):
        with support.temporary_folder() as folder:
            brian2.start_scope()
            module = support.exported_module(folder, name, settings, "brian2")
            return module.simulate(*self.resampled(t, forces, step))

    def resampled(self, t, forces, step):
        grid = np.arange(round(t[-1] / step) + 1) * step
        return np.stack([np.interp(grid, t, column) for column in forces.T], axis=1), step

    # Each script takes Brian 2 about two seconds, so these afferents have each receptor and each neuron once, and all classes of nerves.
    # NEURON (neuron_test.py) is faster, and simulates more.
    def test_every_class_receptor_and_neuron_fires_as_in_corpuscle(self):
        t, forces = support.touch()
        chosen = {"sa1", "fa1", "fa1-nerve", "sa2", "fa1a+adaptive", "sa1b+izhikevich", "sa1b+adex", "vibration+lif-b", "sa1a+lif-b"}
        cases = [case for case in support.afferents() if case[0] in chosen]
        self.assertEqual(len(cases), len(chosen))
        for name, settings in cases:
            with self.subTest(name), support.temporary_folder() as folder:
                ours = support.our_trains(folder, name, settings, t, forces)
                self.assertGreater(sum(map(len, ours)), 2)
                # The upstroke of adex is exponential, so it needs a shorter step.
                step = support.STEP / 4 if name == "sa1b+adex" else support.STEP
                self.assertLess(support.largest_difference(ours, self.trains(name, settings, t, forces, step)), support.STEP)

    def test_the_times_converge_with_the_square_of_the_step(self):
        # The force is a straight line between few samples, so both simulations have the same force at every step.
        t = np.array([0, 0.01, 0.05, 0.14])
        forces = np.array([[0, 0], [0, 0.5], [3, 2], [3, 2]])
        with support.temporary_folder() as folder:
            fine = np.arange(70001) * 2e-6
            truth = support.our_trains(folder, "sa1b+lif-a", [], fine, np.stack([np.interp(fine, t, column) for column in forces.T], axis=1))
        errors = [support.largest_difference(truth, self.trains("sa1b+lif-a", [], t, forces, step)) for step in (1e-3, 5e-4, 2.5e-4)]
        for coarse, fine in zip(errors, errors[1:]):
            self.assertLess(fine, coarse / 2.5, errors)

    def test_the_script_reads_a_file_and_writes_spikes_that_corpuscle_reads(self):
        t, forces = support.touch()
        with support.temporary_folder() as folder:
            ours = support.our_trains(folder, "sa1", ["sa1.f_B=25Hz"], t, forces)
            support.program("export", "sa1", "--for", "brian2", "--set", "sa1.f_B=25Hz", "-o", os.path.join(folder, "sa1.py"))
            run = [sys.executable, "sa1.py", "force.csv"]
            done = subprocess.run(run, cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLess(support.largest_difference(ours, support.trains_of(os.path.join(folder, "spikes.csv"))), support.STEP)
            compared = support.program("compare", os.path.join(folder, "spikes.csv"), os.path.join(folder, "ours", "spikes.csv"), "--json")
            total = json.loads(compared.stdout)["total"]
            self.assertEqual((total["missing"], total["extra"], total["matched"]), (0, 0, sum(map(len, ours))))

    def test_bad_files_are_errors_with_their_row(self):
        with support.temporary_folder() as folder:
            module = support.exported_module(folder, "sa1", [], "brian2")
            path = os.path.join(folder, "bad.csv")
            for text, message in (("", "expected a column of times"), ("t,F\n0,1\n", "expected at least two rows"),
                                  ("t,F\n0,1\n1,x\n", "bad.csv:3: could not convert string to float: 'x'"),
                                  ("t,F\n0,1\n1\n", "bad.csv:3: expected 2 finite numbers"), ("t,F\n0,1\n1,nan\n", "bad.csv:3: expected 2 finite"),
                                  ("t (ms),F\n0,1\n", "bad.csv:1: t is in ms; convert it to s"), ("t,F [mN]\n0,1\n", "bad.csv:1: F is in mN; convert it to N"),
                                  ("0,1\n1,1\n1,2\n", "bad.csv:3: the time must be later")):
                with open(path, "w") as file:
                    file.write(text)
                with self.assertRaises(SystemExit) as caught:
                    module.read_force(path, 1e-4)
                self.assertIn(message, str(caught.exception))
            with self.assertRaises(SystemExit):
                module.write_spikes(path, path, ["a"], [[0.5]])


if __name__ == "__main__":
    unittest.main()
