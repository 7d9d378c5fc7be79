"""How do the times of Corpuscle and ngspice grow with the number of unknowns?

    large.py build/release/corpuscle [CIRCUIT ...]

Circuits are line, mesh and diodes (a mesh with a diode to ground at every hundredth node), followed by the number of unknowns: line1000,
mesh10000. circuits.py says what a line and a mesh are. The default is 100, 1000 and 10000 of each; 100000 takes minutes here, and ngspice
needs hours for a mesh. Both programs run one after the other, ROUNDS (3) times; the table has the median.

    .op     the operating point; every curve is written
    .tran   the response to a step; one curve is written. Both have reltol=1e-3 and ngspice's other tolerances. Corpuscle also runs
            with its default tolerance. The error is the rms difference of the curve from a run of Corpuscle with reltol=1e-6 (REFERENCE),
            over its span

A program is stopped after LIMIT (600) seconds of processor time. seconds: processor time of the whole process, user and system; wall: time of the clock. The
last lines give the exponent of the growth of the time between two sizes, without the time of a process for 100 unknowns.
"""

import json
import math
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import circuits

ROUNDS = int(os.environ.get("ROUNDS", "3"))
LIMIT = int(os.environ.get("LIMIT", "600"))
REFERENCE = os.environ.get("REFERENCE", "1e-6")
SAME = ".options reltol=1e-3 abstol=1e-12 vntol=1e-6 chgtol=1e-14"


def deck(name, unknowns, analysis, options):
    """The netlist and the name of its curve."""
    side = round(math.sqrt(unknowns))
    text, curve = circuits.line(unknowns) if name == "line" else circuits.mesh(side)
    if name == "diodes":
        text += "\n.model d d(is=1e-14 cjo=0.1p)"
        text += "".join(f"\nd{x}_{y} n{x}_{y} 0 d" for x in range(0, side, 10) for y in range(0, side, 10))
    if analysis == "op":
        text = re.sub(r"\n\.tran.*", "\n.op", text)
    else:
        text += f"\n.save {curve}"
    return f"* {name} {unknowns}\n{text}\n{options}\n.end\n", curve


def peak_memory(process):
    """Megabytes that a running process has used at most; getrusage() would count those of this program, from which it was made."""
    try:
        found = re.search(r"VmHWM:\s*(\d+) kB", Path(f"/proc/{process}/status").read_text())
    except OSError:
        return 0
    return int(found[1]) / 1024 if found else 0


def measure(command):
    """Processor seconds, seconds of the clock, megabytes, and what the command printed; None if it takes too long."""
    begin, memory = time.monotonic(), 0
    limit = ["prlimit", f"--cpu={LIMIT}"]
    with tempfile.TemporaryFile() as out, subprocess.Popen(limit + command, stdout=out, stderr=subprocess.DEVNULL) as process:
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid != 0:
                break
            memory = max(memory, peak_memory(process.pid))
            time.sleep(0.001)
        process.returncode = os.waitstatus_to_exitcode(status)
        wall = time.monotonic() - begin
        out.seek(0)
        printed = out.read().decode(errors="replace")
    if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return None
    if process.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {process.returncode}\n{printed}")
    return usage.ru_utime + usage.ru_stime, wall, memory, printed


def work(kind, printed):
    """Steps and Newton iterations of a transient."""
    if kind == "ngspice":
        found = [re.search(rf"{text}\s*=\s*(\d+)", printed) for text in ("Accepted timepoints", "Transient iterations", "Rejected timepoints")]
        steps, iterations, rejected = (int(each[1]) if each else 0 for each in found)
        return f"{steps} + {rejected}", iterations
    run = json.loads(printed)["analyses"][0]
    return (f"{run['steps']} + {run['rejected']}", run["iterations"]) if "steps" in run else ("", "")


def run(program, name, unknowns, analysis, directory):
    """Measures one circuit in both programs, and prints its rows. Returns the seconds of each kind of run."""
    kinds = {"Corpuscle": SAME, "Corpuscle, default": "", "ngspice": SAME + " acct"}
    if analysis == "op":
        del kinds["Corpuscle, default"]
    commands, curve = {}, ""
    for kind, options in kinds.items():
        text, curve = deck(name, unknowns, analysis, options)
        path, out = directory / f"{kind}.cir", directory / f"{kind}.raw"
        path.write_text(text)
        commands[kind] = ["ngspice", "-b", "-r", out, path] if kind == "ngspice" else [program, "run", path, "--json", "--overwrite", "--out", out]
    results = {kind: [] for kind in kinds}
    for turn in range(ROUNDS):
        for kind, command in commands.items():
            if turn == 0 or results[kind][0] is not None:
                results[kind].append(measure(command))
    reference = None
    if analysis == "tran":
        text, _ = deck(name, unknowns, analysis, f".options reltol={REFERENCE}")
        (directory / "reference.cir").write_text(text)
        subprocess.run([program, "run", directory / "reference.cir", "--quiet", "--overwrite", "--out", directory / "reference.raw"], check=True)
        reference = circuits.read(directory / "reference.raw", curve)
    seconds = {}
    for kind, runs in results.items():
        if None in runs:
            print(f"| {name} {unknowns} .{analysis} | {kind} | more than {LIMIT} | | | | | |", flush=True)
            continue
        seconds[kind] = statistics.median(r[0] for r in runs)
        wall, memory = statistics.median(r[1] for r in runs), max(r[2] for r in runs)
        steps, iterations = work(kind, runs[0][3]) if analysis == "tran" else ("", "")
        error = f"{circuits.error(False, circuits.read(directory / f'{kind}.raw', curve), reference):.1e}" if reference else ""
        print(f"| {name} {unknowns} .{analysis} | {kind} | {seconds[kind]:.3g} | {wall:.3g} | {memory:.0f} | {steps} | {iterations} | {error} |",
              flush=True)
    return seconds


def main():
    program = Path(sys.argv[1]).resolve()
    chosen = sys.argv[2:] or [f"{name}{n}" for name in ("line", "mesh", "diodes") for n in (100, 1000, 10000)]
    print("| circuit | program | seconds | wall | MB | steps + rejected | iterations | error |\n| --- | --- | --- | --- | --- | --- | --- | --- |",
          flush=True)
    times = {}
    for each in chosen:
        name, unknowns = re.fullmatch(r"([a-z]+)(\d+)", each).groups()
        with tempfile.TemporaryDirectory() as directory:
            for analysis in "op", "tran":
                for kind, seconds in run(program, name, int(unknowns), analysis, Path(directory)).items():
                    times.setdefault((name, analysis, kind), []).append((int(unknowns), seconds))
    for (name, analysis, kind), points in times.items():
        start = min(points)[1] if min(points)[0] == 100 else 0
        points = [(n, s - start) for n, s in sorted(points) if n > 100]
        for (n0, s0), (n1, s1) in zip(points, points[1:]):
            if s0 > 0 and s1 > 0:
                print(f"growth of {name} .{analysis}, {kind}, from {n0} to {n1}: {math.log(s1 / s0) / math.log(n1 / n0):.2f}")


if __name__ == "__main__":
    main()
