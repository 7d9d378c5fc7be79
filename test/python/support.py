"""Functions that the tests of the package share."""

import os
import pathlib
import subprocess

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
