"""Do the peers compute the same as Corpuscle? Compares the spikes of numpy_in_place.py in float64 with those of Corpuscle ("the program"),
for each afferent. The peers are the other simulators in this folder.

Method: 50 afferents. The program reads their forces as a recording with exactly the same doubles, and runs with `--method backward-euler
--sampled`, one afferent per run if each has its own f_B. In the task `shared`, NumPy scales the current but the program scales the force,
so the last digits of u differ; in the other tasks both do the same operations. Ends with status 1 if any spike differs.

    same_work.py build/release/corpuscle
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import work
from numpy_in_place import Task, run

N = 50


def trains(spikes):
    """For each afferent, the steps with a spike."""
    out = [[] for _ in range(N)]
    for step, first, fired in spikes:
        for i in fired:
            out[first + i].append(step)
    return out


def respond(program, recording, out, options):
    """The program's spike trains, one per channel of the recording, as lists of steps."""
    subprocess.run([program, "respond", recording, "--unit", "N", "--rate", "10kHz", "--afferent", "sa1", "--method", "backward-euler",
                    "--sampled", "--quiet", "--out", out, *options], check=True)
    found = [[] for _ in range(N)]
    with open(Path(out) / "spikes.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found[int(row["channel"].removeprefix("ch")) - 1].append(round(float(row["time_s"]) / work.DT))
    return found


def by_program(program, name, directory):
    """The program's spike trains in the task `name`."""
    recording = Path(directory) / "force.npy"
    np.save(recording, work.frames(N, work.SAMPLES[name], np.float64))
    if name != "own":
        return respond(program, recording, directory, [])
    each = [respond(program, recording, directory, ["--channel", f"ch{i + 1}", "--set", f"sa1.f_B={f!r}"])[i]
            for i, f in enumerate(work.corners(N).tolist())]
    return each


def main():
    program, same = sys.argv[1], True
    for name in work.SAMPLES:
        with tempfile.TemporaryDirectory() as directory:
            ours = by_program(program, name, directory)
        for form in "as-written", "folded":
            theirs = trains(run(Task(name, np.float64, form, N), N)[1])
            differ = sum(a != b for a, b in zip(ours, theirs))
            print(f"{name:9}{form:11} program {sum(map(len, ours))} spikes, numpy {sum(map(len, theirs))}; "
                  f"{N - differ} of {N} afferents fire at the same steps")
            same = same and differ == 0
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
