"""How many afferent-steps per second does Brian2 compute on one core, for the tasks of work.py?

Method: C++ standalone, no OpenMP. One group; a step is one `run_regularly`, then threshold, monitor and reset. Inputs common to all
afferents are a TimedArray in time, so the receptor of `shared` costs nothing. The forces of `streamed` are a TimedArray in time and
afferent, fetched in a separate `run_regularly`, because the compiler does not vectorize a combined one. The time is the processor time of
the loop over steps, as Brian2 measures it. It excludes generating and compiling code, reading the forces, and writing the spikes. The same
program runs several times; the median is the result. With --monitor spikes, spikes are stored as time and afferent; `count` only counts
them per afferent, `rate` per step, and with `none` the reset counts them. Compiler flags: `default` are Brian2's own, `strict` keeps the
order of sums, `unrolled` is the fastest, because the search for spikes is not vectorized and benefits from unrolling. --rectify is the
expression for max{x, 0}. The tasks and forms are described in work.py.

    brian2_standalone.py [--work shared ...] [--dtype float32 ...] [--form folded ...] [--n 100000] [--runs 5]
                         [--flags unrolled | default | strict | =FLAGS] [--monitor spikes | count | rate | none] [--rectify clip | int | abs]
"""

import subprocess
import tempfile
import warnings
from pathlib import Path

import numpy as np
import work

warnings.simplefilter("ignore")  # warnings of the libraries about each other
import brian2 as b2  # noqa: E402

FLAGS = {
    "unrolled": "-w -O3 -ffast-math -fno-finite-math-only -march=native -funroll-loops -mprefer-vector-width=256 -std=c++11",
    "default": "-w -O3 -ffast-math -fno-finite-math-only -march=native -std=c++11",  # Brian2's own
    "strict": "-w -O3 -march=native -ffp-contract=off -std=c++11",
}
# three expressions for max{x, 0}
RECTIFY = {"clip": "clip({0}, 0, inf)", "int": "int(({0}) > 0)*({0})", "abs": "0.5*(({0}) + abs({0}))"}


# for `streamed`: code that reads the forces of a step
FETCH = "F_before = F\nF = frames(t, i)"


def step_of(name, folded, rectify):
    """Code of one step of the task `name`: the receptor, then the membrane voltage u, limited below to E_L = 0.

    For `streamed`, FETCH precedes it."""
    positive = RECTIFY[rectify].format
    if name == "shared":
        lines = ["du = g*current_k(t) - leak_k" if folded else "du = (g*current(t) - I_leak0)*k"]
    else:
        change = "g*change(t)" if folded else "F - g*press(t - dt)"
        lines = ["F = g*press(t)", f"dF = {change}"] if name == "own" else ["dF = F - F_before"]
        if folded:
            lines += ["x_B = keep_B*(x_B + dF)", "x_C = keep_C*(x_C + dF)"]
            lines += [f"du = k_A_k*F + K_B_k*{positive('x_B')} + K_C_k*{positive('x_C')} - leak_k"]
        else:
            lines += ["x_B = keep_B*x_B + keep_B*dF", "x_C = keep_C*x_C + keep_C*dF"]
            lines += [f"du = (k_A*F + {positive('K_B*x_B')} + {positive('K_C*x_C')} - I_leak0)*k"]
    return "\n".join([*lines, "v = u + du", f"u = {positive('v')}"])


def constants(name, n):
    """Parameters by their names in the step code. They become variables of the group, because literals in the code would be doubles."""
    k = work.K
    return {"k": k, "k_A": work.K_A, "K_B": work.K_B, "K_C": work.K_C, "I_leak0": work.I_LEAK0, "keep_C": work.keep(work.F_C),
            "k_A_k": work.K_A * k, "K_B_k": work.K_B * k, "K_C_k": work.K_C * k, "leak_k": work.I_LEAK0 * k,
            "keep_B": work.keep(work.corners(n) if name == "own" else work.F_B), "g": work.gains(n)}


def forces(name, n, dtype):
    """Inputs of the afferents, as functions of time."""
    press = np.array(work.press(work.SAMPLES[name]))
    current = np.array(work.currents(list(press)))
    inputs = {"press": press, "change": np.diff(press, prepend=press[0]), "current": current, "current_k": current * work.K}
    if name == "streamed":
        inputs = {"frames": work.frames(n, work.SAMPLES[name], dtype)}
    return {key: b2.TimedArray(value, dt=work.DT * b2.second) for key, value in inputs.items()}


def afferents(name, dtype, folded, n, rectify):
    """The NeuronGroup of a task, with its parameters, inputs and step."""
    values, inputs = constants(name, n), forces(name, n, dtype)
    model = "".join(f"{key} : 1 (constant{', shared' if np.ndim(value) == 0 else ''})\n" for key, value in values.items())
    states = {"shared": ["u"], "own": ["u", "x_B", "x_C"], "streamed": ["u", "x_B", "x_C", "F", "F_before"]}[name]
    model += "".join(f"{key} : 1\n" for key in states)
    assert work.E_L == 0
    group = b2.NeuronGroup(n, model + "fired : integer", threshold="u > V_th", reset="u -= drop",
                           namespace={"V_th": work.V_TH, "drop": work.DROP, **inputs})
    if name == "streamed":
        group.run_regularly(FETCH, order=-1)
    group.run_regularly(step_of(name, folded, rectify))
    for key, value in values.items():
        setattr(group, key, value)
    if name == "streamed":
        group.F = inputs["frames"].values[0]
    return group


def monitor_of(kind, group, n):
    """The monitor for spikes, if any, and a function that returns their number after a run."""
    if kind == "rate":
        rate = b2.PopulationRateMonitor(group)
        return [rate], lambda: round(float(np.sum(rate.rate / b2.Hz)) * work.DT * n)
    if kind == "none":
        group.event_codes["spike"] += "\nfired += 1"
        return [], lambda: int(np.sum(group.fired[:]))
    spikes = b2.SpikeMonitor(group, record=kind == "spikes")
    return [spikes], lambda: int(spikes.num_spikes)


def build(name, dtype, form, options, directory):
    """Builds the program in the directory and runs it once. Returns the number of spikes."""
    b2.device.reinit()
    b2.set_device("cpp_standalone", build_on_run=False)
    b2.prefs.core.default_float_dtype = np.dtype(dtype).type
    b2.prefs.codegen.cpp.extra_compile_args_gcc = FLAGS.get(options.flags, options.flags).split()
    b2.defaultclock.dt = work.DT * b2.second
    group = afferents(name, np.dtype(dtype).type, form == "folded", options.n, options.rectify)
    monitor, count = monitor_of(options.monitor, group, options.n)
    net = b2.Network(group, *monitor)
    net.run(len(work.SAMPLES[name]) * work.DT * b2.second)
    b2.device.build(directory=directory, compile=True, run=True, with_output=False)
    return count()


def run(directory):
    """Runs the program again. Returns the time (s) of its loop over steps, by its own measurement."""
    subprocess.run(["./main"], cwd=directory, check=True, stdout=subprocess.DEVNULL)
    return float(Path(directory, "results", "last_run_info.txt").read_text(encoding="utf-8").split()[0])


def main():
    options = work.arguments(form=["as-written", "folded"], flags="unrolled", monitor="spikes", rectify="clip")
    print(work.machine())
    for name, dtype, form in options.works:
        with tempfile.TemporaryDirectory() as directory:
            spikes = build(name, dtype, form, options, directory)
            seconds = [run(directory) for _ in range(options.runs)]
        how = f"{form}, {options.rectify}, monitor: {options.monitor}, {FLAGS.get(options.flags, options.flags)}"
        work.report(f"brian2 {b2.__version__}", name, dtype, how, options.n, seconds, spikes)


if __name__ == "__main__":
    main()
