"""Circuits in threads and processes: progress, Ctrl-C and fork."""

import concurrent.futures
import io
import multiprocessing
import signal
import subprocess
import sys
import time
import unittest

import corpuscle
from support import processor_seconds, ticks_during

RC = "RC\nv1 in 0 dc 1 sin(0 1 1k)\nr1 in out 1k\nc1 out 0 1u\n"


def voltage(r):
    return corpuscle.circuit(RC.replace("1k\nc1", f"{r}\nc1")).tran("10u", "5m")["v(out)"].tolist()


class Threads(unittest.TestCase):
    def test_one_circuit_runs_on_several_threads(self):
        circuit = corpuscle.circuit("sa1-circuit")
        expected = circuit.tran("1m", "50m")["v(vf)"].tolist()
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for result in pool.map(lambda _: circuit.tran("1m", "50m"), range(4)):
                self.assertEqual(result["v(vf)"].tolist(), expected)

    def test_other_threads_of_python_go_on_during_a_run(self):
        duration, ticks = ticks_during(lambda: corpuscle.circuit("sa1-circuit").tran())
        self.assertGreater(duration, 0.05, "the run is too short for this test")
        self.assertGreater(ticks, 5)


class Processes(unittest.TestCase):
    def test_a_fork_after_a_run_simulates(self):
        expected = [voltage(r) for r in (1000, 2000)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map(voltage, (1000, 2000)), expected)

    def test_after_ctrl_c_it_computes_for_at_most_a_fifth_of_a_second(self):
        program = ("import corpuscle\ncircuit = corpuscle.circuit('sa1-circuit')\nprint('ready', flush=True)\n"
                   "try:\n    circuit.tran('1m', '1000')\nexcept KeyboardInterrupt:\n    print('stopped', flush=True)\n    input()\n")
        with subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "ready\n")
            time.sleep(0.5)
            child.send_signal(signal.SIGINT)
            start = processor_seconds(child.pid)
            self.assertEqual(child.stdout.readline(), "stopped\n")
            self.assertLess(processor_seconds(child.pid) - start, 0.2)
            child.communicate("\n")


class Progress(unittest.TestCase):
    def test_a_function_gets_rising_fractions_and_may_stop(self):
        fractions = []
        corpuscle.circuit("sa1-circuit").tran(progress=fractions.append)
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1)
        with self.assertRaises(KeyboardInterrupt):
            corpuscle.circuit("sa1-circuit").tran("1m", "1000", progress=lambda fraction: False)
        with self.assertRaises(ZeroDivisionError):
            corpuscle.circuit("sa1-circuit").tran("1m", "1000", progress=lambda fraction: 1 / 0)

    def test_a_line_has_the_fraction_and_the_time_left_and_is_removed(self):
        from corpuscle import _progress
        standard, sys.stderr = sys.stderr, io.StringIO()
        try:
            with _progress.ProgressLine() as line:
                line(0.1)
                self.assertEqual(sys.stderr.getvalue(), "", "not in the first second")
                line._start -= 10
                line._last -= 10
                line(0.5)
                self.assertIn(f"[{'=' * 16}{' ' * 16}]  50 %  10 s left", sys.stderr.getvalue())
            self.assertTrue(sys.stderr.getvalue().endswith(" \r"))
            self.assertIsNone(_progress.progress_of(None).__enter__(), "not a terminal")
        finally:
            sys.stderr = standard


if __name__ == "__main__":
    unittest.main()
