"""Functions that the tests of exported scripts share: an afferent is exported, run in the other simulator, and compared with corpuscle."""

import csv
import importlib.util
import json
import os
import subprocess
import tempfile

import numpy as np

PROGRAM = os.environ["CORPUSCLE_PROGRAM"]
STEP = 1e-4  # s, between the samples of the force


def program(*arguments, check=True):
    """The finished program corpuscle."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)
    if check and done.returncode != 0:
        raise AssertionError(f"corpuscle {' '.join(arguments)}: {done.stderr}")
    return done


def touch(step=STEP):
    """Times (s) and forces (N) of two channels: an edge, a hold with a vibration, and a release."""
    t = np.arange(round(0.16 / step)) * step
    edge = np.clip(np.minimum((t - 0.01) / 0.03, (0.13 - t) / 0.02), 0, 1)
    force = 2.5 * edge + 0.03 * np.sin(2 * np.pi * 60 * t) * (t > 0.05) * (t < 0.1)
    return t, np.stack([force, 0.7 * force + 0.1], axis=1)


def write_force(path, t, forces):
    with open(path, "w") as file:
        file.write("time (s),finger (N),thumb (N)\n")
        file.writelines(f"{a!r},{b!r},{c!r}\n" for a, (b, c) in zip(t.tolist(), forces.tolist()))


def trains_of(path):
    """The spike times of each channel in a spikes.csv."""
    with open(path) as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["afferent", "channel", "time_s"], rows[0]
    names = dict.fromkeys(["finger", "thumb"])
    return [np.array([float(row[2]) for row in rows[1:] if row[1].startswith(name)]) for name in names]


def afferents():
    """Afferents that together have every receptor and neuron, and all named ones, with the settings that an export needs.

    Netlists and those of fixed point are left out; other tests check that they are refused."""
    listed = json.loads(program("list", "--json").stdout)
    named = [a["name"] for a in listed["afferents"] if "+" in a["composition"] and "adc" not in a["composition"]]
    receptors, neurons = ([entry["name"] for entry in listed[kind]] for kind in ("receptors", "neurons"))
    combined = [f"{receptor}+lif-b" for receptor in receptors] + [f"sa1b+{neuron}" for neuron in neurons] + ["fa1a+adaptive"]
    settings = {"sa1-nerve": ["sa1-nerve.jitter=0"], "sa2": ["sa2.jitter=0"], "fa1a+adaptive": ["fa1a+adaptive.k=2uA s/N"],
                "sa1b+lif-b": ["sa1b+lif-b.t_ref=2ms"], "fa1a+lif-b": ["fa1a+lif-b.k=5uA s/N"],
                "vibration+lif-b": ["vibration+lif-b.k=0.01"]}
    return [(name, settings.get(name, [])) for name in dict.fromkeys(named + combined)]


def set_options(settings):
    return [word for setting in settings for word in ("--set", setting)]


def our_trains(folder, name, settings, t, forces):
    write_force(os.path.join(folder, "force.csv"), t, forces)
    out = os.path.join(folder, "ours")
    program("respond", os.path.join(folder, "force.csv"), "--afferent", name, *set_options(settings), "-o", out, "--overwrite", "--quiet")
    return trains_of(os.path.join(out, "spikes.csv"))


def exported_module(folder, name, settings, target):
    """The exported script as a module."""
    path = os.path.join(folder, f"{target}_script.py")
    program("export", name, "--for", target, *set_options(settings), "-o", path)
    spec = importlib.util.spec_from_file_location(f"{target}_script", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def temporary_folder():
    return tempfile.TemporaryDirectory()


def largest_difference(ours, theirs):
    """Between the times of two lists of trains, s; infinite if a train has another number of spikes."""
    if [len(train) for train in ours] != [len(train) for train in theirs]:
        return np.inf
    return max((np.abs(a - np.sort(b)).max() for a, b in zip(ours, theirs) if len(a)), default=0.0)


