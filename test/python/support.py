"""Functions that the tests of the package share."""

import os
import pathlib
import subprocess
import threading
import time

import corpuscle
import numpy as np

ROOT = os.environ["CORPUSCLE_ROOT"]
PROGRAM = os.environ["CORPUSCLE_PROGRAM"]


def press(rate=1000.0):
    """A force of 1 s with a press in it, N."""
    t = np.arange(int(rate)) / rate
    return 2 * np.clip(np.minimum(t - 0.2, 0.8 - t) * 10, 0, 1)


def command_line(*arguments):
    """(exit status, standard output, standard error) of the program."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


def processor_seconds(pid):
    """The processor time of a process so far. Unlike the time of a clock, it does not depend on other processes."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def error_of(function, *arguments, **options):
    """The text of the InputError that a call raises."""
    try:
        function(*arguments, **options)
    except corpuscle.InputError as error:
        return str(error)
    raise AssertionError("there was no error")


def ticks_during(run):
    """The duration (s) of run(), and how often another thread of Python, which counts each millisecond, counted meanwhile."""
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    other = threading.Thread(target=tick)
    other.start()
    start = time.monotonic()
    run()
    stop = time.monotonic()
    done.set()
    other.join()
    return stop - start, sum(start < t < stop for t in ticks)
