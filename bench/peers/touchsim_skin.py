"""Afferents of a Corpuscle skin as TouchSim's, and the response of either program to a stimulus."""
import csv
import subprocess
import sys

CLASSES = {"sa1": "SA1", "sa1-nerve": "SA1", "fa1": "RA", "fa1-nerve": "RA", "fa2": "PC"}  # of Corpuscle -> of TouchSim


def import_touchsim():
    try:
        import numpy
        numpy.bool = bool  # TouchSim uses this name, which NumPy has removed
        import touchsim
    except ImportError as missing:
        sys.exit(f"{missing}\nTouchSim is needed: pip install git+https://github.com/hsaal/touchsim, or add a checkout to PYTHONPATH.")
    return touchsim


def read_afferents(folder):
    """(Name, class, x mm, y mm, delay s) of the afferents of an output folder of Corpuscle whose class TouchSim has."""
    with (folder / "afferents.csv").open() as file:
        rows = [(row, CLASSES.get(row["afferent"].split("#")[0])) for row in csv.DictReader(file)]
    return [(row["afferent"], c, float(row["x_mm"]), float(row["y_mm"]), 1e-3 * float(row["delay_ms"])) for row, c in rows if c]


def touchsim_population(afferents, noisy):
    """The same afferents in TouchSim. Each takes the next one of the fitted models of its class, so that all of these occur everywhere:
    TouchSim's usual choice is random."""
    touchsim, taken, out = import_touchsim(), {}, []
    for _, c, x, y, _ in afferents:
        taken[c] = taken.get(c, -1) + 1
        fitted = len(touchsim.Afferent.affparams[c])
        out.append(touchsim.Afferent(c, location=[x, y], idx=taken[c] % fitted, noisy=noisy))
    return touchsim.AfferentPopulation(*out)


def touchsim_trains(population, stimulus, rate):
    """Spike times (s) of each afferent, and the largest force (N) by TouchSim's own mechanics."""
    places, depths, radius = stimulus.pins()
    pressed = import_touchsim().Stimulus(trace=depths, location=places, fs=rate, pin_radius=radius)
    return population.response(pressed).spikes, float(pressed._profile.sum(1).max())


def run_corpuscle(program, population, stimulus, rate, folder):
    """Writes Corpuscle's response to a stimulus into the folder."""
    force = folder / "force.csv"
    force.write_text("force_N\n" + "\n".join(f"{max(0.0, newtons):.9g}" for newtons in stimulus.force) + "\n")
    command = [program, "respond", force, "--rate", rate, "--time", "none", "--population", population, *stimulus.contact, "--quiet",
               "--overwrite", "--out", folder / "out"]
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    except OSError as failure:
        sys.exit(f"{program} does not start: {failure}; give the path of the built program, such as build/release/corpuscle")
    if done.returncode:
        sys.exit(f"{stimulus.name}: {program} ended with status {done.returncode}: {done.stderr}")
    return folder / "out"


def corpuscle_trains(folder, afferents):
    """Spike times (s) of each afferent at its nerve ending: conduction delays are subtracted."""
    trains = {name: [] for name, *_ in afferents}
    with (folder / "spikes.csv").open() as file:
        for row in csv.DictReader(file):
            if row["afferent"] in trains:
                trains[row["afferent"]].append(float(row["time_s"]))
    return [[t - delay for t in trains[name]] for name, *_, delay in afferents]
