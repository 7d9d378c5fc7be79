"""Threads, processes and signals."""

import concurrent.futures
import multiprocessing
import signal
import subprocess
import sys
import time
import unittest

import corpuscle
import numpy as np
from support import press, ticks_during


def simulate(seed):
    return corpuscle.respond(press(), 1000, "sa1", copies=50, spread={"f_B": "10%"}, seed=seed).times.tolist()


class Threads(unittest.TestCase):
    def test_runs_at_the_same_time_give_the_same_spikes(self):
        expected = [simulate(seed) for seed in range(8)]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(simulate, range(8))), expected)

    def test_other_threads_of_python_go_on_during_a_run(self):
        duration, ticks = ticks_during(lambda: corpuscle.respond(np.full(200000, 2.0), 1000, "sa1", copies=3000, threads=1))
        self.assertGreater(duration, 0.05, "the run is too short for this test")
        self.assertGreater(ticks, 5)

    def test_the_number_of_threads_does_not_change_the_spikes(self):
        results = [corpuscle.respond(press(), 1000, copies=300, spread={"sa1.f_B": "10%"}, threads=n).times.tobytes() for n in (0, 1, 2, 7)]
        self.assertEqual(len(set(results)), 1)


class Processes(unittest.TestCase):
    def test_a_fork_after_a_run_simulates(self):
        expected = [simulate(seed) for seed in range(4)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map(simulate, range(4)), expected)

    def test_responses_travel_between_processes(self):
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            response = pool.apply(corpuscle.respond, (press(), 1000, "sa1"))
        self.assertEqual(response.times.tolist(), corpuscle.respond(press(), 1000, "sa1").times.tolist())


LONG_RUN = """
import corpuscle, sys
def started(fraction):
    print("running", flush=True)
try:
    RUN
except KeyboardInterrupt:
    print("interrupted")
    print(len(corpuscle.respond("press", afferent="sa1").times) > 0)
"""


class Interrupts(unittest.TestCase):
    def interrupt(self, run):
        """Sends SIGINT to a child in a long run. Returns its output after that, and the seconds until it ended."""
        child = subprocess.Popen([sys.executable, "-c", LONG_RUN.replace("RUN", run)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            self.assertEqual(child.stdout.readline(), "running\n")
            self.assertGreater(child.pid, 0)
            child.send_signal(signal.SIGINT)
            start = time.monotonic()
            output = child.communicate(timeout=30)[0]
            return [line for line in output.splitlines() if line != "running"], time.monotonic() - start
        finally:
            child.kill()
            child.wait()

    def test_ctrl_c_ends_a_long_run_and_python_goes_on(self):
        for run in ('corpuscle.respond("sine", afferent="sa1", copies=20000, settings=["sine.duration=1000s"], progress=started)',
                    'corpuscle.hand().respond("sine", contact="sphere", settings=["sine.duration=1000s"], progress=started)',
                    'corpuscle.fit(corpuscle.sine(duration="100 s"), [0.1 * k for k in range(900)], free="k_A", starts=1000, progress=started)'):
            output, seconds = self.interrupt(run)
            self.assertEqual(output, ["interrupted", "True"])
            self.assertLess(seconds, 20)


class Progress(unittest.TestCase):
    def run_with(self, progress, **options):
        return corpuscle.respond(np.full(200000, 1.0), 1000, "sa1", copies=200, progress=progress, **options)

    def test_fractions_rise_to_one(self):
        fractions = []
        self.run_with(fractions.append)
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1)

    def test_false_stops_the_run(self):
        for value in (False, 0, np.False_, ""):
            with self.assertRaises(KeyboardInterrupt):
                self.run_with(lambda fraction: value)

    def test_an_exception_of_the_function_ends_the_run_and_arrives(self):
        class Stop(Exception):
            pass

        def stop(fraction):
            raise Stop("enough")

        class NoTruth:
            def __bool__(self):
                raise Stop("no truth")

        with self.assertRaisesRegex(Stop, "enough"):
            self.run_with(stop)
        with self.assertRaisesRegex(Stop, "no truth"):
            self.run_with(lambda fraction: NoTruth())
        with self.assertRaises(TypeError):
            self.run_with(lambda: True)
        with self.assertRaises(SystemExit):
            self.run_with(lambda fraction: sys.exit(3))

    def test_what_is_not_a_function_is_refused(self):
        with self.assertRaisesRegex(corpuscle.InputError, "progress = 3 is not a function"):
            self.run_with(3)

    def test_the_function_may_simulate(self):
        inner = []
        self.run_with(lambda fraction: inner.append(len(corpuscle.respond("press", afferent="sa1"))))
        self.assertGreater(len(inner), 0)
        self.assertEqual(len(set(inner)), 1)

    def test_the_function_is_freed(self):
        import weakref

        def function(fraction):
            return True

        reference = weakref.ref(function)
        self.run_with(function)
        del function
        self.assertIsNone(reference())


if __name__ == "__main__":
    unittest.main()
