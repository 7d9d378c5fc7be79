"""How long do Corpuscle and ngspice take for the same circuits, at the same error?

    circuits.py build/release/corpuscle [CIRCUIT ...]

Each circuit runs in both programs with several tolerances (reltol). The error of a run is measured against a run of Corpuscle at 1e-8: the
rms difference of one curve, with straight lines between the written points, over its span. For rings it is the relative difference of the
period, against the program's own most exact run (ngspice: 1e-7), since the models of the transistors differ. The time is that of the
processor for the whole process, user and system, the median of ROUNDS (3) alternating runs; for rings it is divided by the number of
periods. At each error, 1e-2 to 1e-6, the last lines give ngspice's time over ours. log(time) is interpolated over log(error) between two
tolerances. A program whose roughest run is more exact than that has the time of its fastest run.

    line N    N resistors in series, a capacitor to ground at each node, a step at one end
    mesh N    N x N nodes, a resistor to each neighbour, a capacitor to ground, a step at one corner
    ladder N  N inductors in series, a capacitor to ground at each node, matched at both ends; a pulse travels through it
    ring N    N inverters in a ring with 20 fF at each node: UICM transistors here, level 1 in ngspice
    ring1_N   the same with level 1 in both
    rectifier four diodes in a bridge, 10 uF and 1 kohm, 20 periods of 50 Hz
"""

import math
import os
import platform
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROUNDS = int(os.environ.get("ROUNDS", "3"))
# The last one is the reference.
TOLERANCES = {"Corpuscle": ["1e-2", "1e-3", "1e-4", None, "1e-6", "1e-8"], "ngspice": ["1e-2", None, "1e-4", "1e-5", "1e-6", "1e-7"]}


def line(n):
    """An RC line; its delay is about n^2 R C / 2 = 5 us for any n."""
    parts = [f"r{k} n{k} n{k + 1} {1e3 / n}\nc{k} n{k + 1} 0 {10e-9 / n}" for k in range(n)]
    return "\n".join(["v1 n0 0 pulse(0 1 1u 10n 10n 1 2)", *parts, ".tran 1u 50u"]), f"v(n{n})"


def mesh(n):
    """A mesh of n x n nodes."""
    parts = [f"c{x}_{y} n{x}_{y} 0 1p" for x in range(n) for y in range(n)]
    parts += [f"rx{x}_{y} n{x}_{y} n{x + 1}_{y} 1k" for x in range(n - 1) for y in range(n)]
    parts += [f"ry{x}_{y} n{x}_{y} n{x}_{y + 1} 1k" for x in range(n) for y in range(n - 1)]
    stop = 3e-9 * n * n
    return "\n".join([f"v1 in 0 pulse(0 1 1n 1n 1n 1 2)\nrin in n0_0 1", *parts, f".tran {stop / 50} {stop}"]), f"v(n{n - 1}_{n - 1})"


def ladder(n):
    """An LC ladder of 50 ohm; each section delays by 1 ns."""
    parts = [f"l{k} n{k} n{k + 1} 50n\nc{k} n{k + 1} 0 20p" for k in range(n)]
    return "\n".join([f"v1 in 0 pulse(0 1 10n 5n 5n 50n 10)\nrs in n0 50", *parts, f"rl n{n} 0 50", f".tran {(2 * n + 100) * 2e-11} {(2 * n + 100) * 1e-9}"]), f"v(n{n})"


def rectifier():
    """The bridge of four diodes."""
    parts = ["v1 a b sin(0 5 50)", "d1 a p d", "d2 b p d", "d3 0 a d", "d4 0 b d", "c1 p 0 10u", "r1 p 0 1k",
             ".model d d(is=1e-14 rs=1 cjo=2p)", ".tran 8m 0.4"]
    return "\n".join(parts), "v(p)"


def ring(n, models, name_p, name_n, stop):
    """A ring of n inverters. It starts from alternate voltages, because the search for an operating point takes ngspice 5 to 20 s."""
    parts = [f"mp{k} n{(k + 1) % n} n{k} vdd vdd {name_p} w=4u l=0.5u\nmn{k} n{(k + 1) % n} n{k} 0 0 {name_n} w=1.5u l=0.5u\n"
             f"c{k} n{k} 0 20f" for k in range(n)]
    start = " ".join(f"v(n{k})={1.8 * (k % 2)}" for k in range(n))
    return "\n".join([models, "vdd vdd 0 1.8", f".ic v(vdd)=1.8 {start}", *parts, f".tran {stop / 50} {stop} uic"]), "v(n0)"


CHARGES = "tox=4.1n cgso=0.3n cgdo=0.3n"
LEVEL1 = f".model p1 pmos(vto=-0.45 kp=70u lambda=0.05 {CHARGES})\n.model n1 nmos(vto=0.4 kp=250u lambda=0.05 {CHARGES})"
LIBRARY = f".lib '{Path(__file__).resolve().parents[2] / 'process' / 'tsmc180.lib'}' tt"


def circuits(name, n):
    """The netlist for Corpuscle, the one for ngspice, and the curve to compare."""
    if name == "ring" or name == "ring1":
        theirs, curve = ring(n, LEVEL1, "p1", "n1", n * 2.5e-9)
        ours = theirs if name == "ring1" else ring(n, LIBRARY, "pch", "nch", n * 5e-9)[0]
        return ours, theirs, curve
    text, curve = rectifier() if name == "rectifier" else {"line": line, "mesh": mesh, "ladder": ladder}[name](n)
    return text, text, curve


def read(path, curve):
    """Time and curve of a .raw file, in binary."""
    data = path.read_bytes()
    at = data.index(b"Binary:\n")
    head = data[:at].decode()
    names = [row.split("\t")[2].lower() for row in head[head.index("Variables:\n") + 11:].splitlines() if row.startswith("\t")]
    table = np.frombuffer(data[at + 8:], dtype="<f8")
    table = table[:len(table) // len(names) * len(names)].reshape(-1, len(names))
    return table[:, 0], table[:, names.index(curve)]


def simulate(command, out, curve):
    """Processor seconds of a command, and the curve it wrote."""
    out.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if not out.exists():
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout.decode()}{done.stderr.decode()}")
    seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return seconds, read(out, curve)


def period(t, v):
    """The mean period between rising edges through the middle, without the first two."""
    middle = 0.5 * (v.min() + v.max())
    at = np.nonzero((v[:-1] < middle) & (v[1:] >= middle))[0]
    edges = t[at] + (middle - v[at]) / (v[at + 1] - v[at]) * (t[at + 1] - t[at])
    return (edges[-1] - edges[2]) / (len(edges) - 3), len(edges)


def error(is_ring, curve, reference):
    """The error of a curve against the reference."""
    if is_ring:
        return abs(period(*curve)[0] / period(*reference)[0] - 1)
    t = np.linspace(0, reference[0][-1], 20001)
    expected = np.interp(t, *reference)
    return math.sqrt(np.mean((np.interp(t, *curve) - expected) ** 2)) / np.ptp(expected)


def time_at(points, target):
    """Seconds at an error, by interpolation; infinite if no run is that exact."""
    points = sorted((e, s) for e, s in points if e > 0)
    if target < points[0][0]:
        return math.inf
    if target >= points[-1][0]:
        return min(s for _, s in points)
    k = next(k for k in range(len(points) - 1) if points[k + 1][0] > target)
    (e0, s0), (e1, s1) = points[k], points[k + 1]
    return s0 * (s1 / s0) ** (math.log(target / e0) / math.log(e1 / e0))


def compare(program, name, n, directory):
    """Runs one circuit in both programs, and prints a table."""
    ours, theirs, curve = circuits(name, n)
    commands = {"Corpuscle": lambda deck, out: [program, "run", deck, "--quiet", "--overwrite", "--out", out],
                "ngspice": lambda deck, out: ["ngspice", "-b", "-r", out, deck]}
    jobs, results = {}, {}
    for kind, text in ("Corpuscle", ours), ("ngspice", theirs):
        for tolerance in TOLERANCES[kind]:
            deck, out = directory / f"{kind}-{tolerance}.cir", directory / f"{kind}-{tolerance}.raw"
            options = ""
            if tolerance is not None:
                options = f".options reltol={tolerance}"
                if kind == "ngspice":  # its other tolerances follow; ours do by themselves
                    options += f" abstol={float(tolerance) * 1e-9} vntol={float(tolerance) * 1e-3} chgtol={float(tolerance) * 1e-11}"
            deck.write_text(f"* {name} {n}\n{text}\n{options}\n.save {curve}\n.end\n")
            jobs[kind, tolerance] = commands[kind](deck, out), out
    for turn in range(ROUNDS):
        for job, (command, out) in jobs.items():
            if turn == 0 or job[1] != TOLERANCES[job[0]][-1]:
                seconds, values = simulate(command, out, curve)
                results.setdefault(job, ([], values))[0].append(seconds)
    is_ring = name.startswith("ring")
    points = {kind: [] for kind in TOLERANCES}
    for (kind, tolerance), (seconds, values) in results.items():
        most_exact = kind if is_ring else "Corpuscle"
        e, spent, rings = error(is_ring, values, results[most_exact, TOLERANCES[most_exact][-1]][1]), statistics.median(seconds), ""
        if is_ring:
            length, edges = period(*values)
            spent, rings = spent / edges, f" per period of {length * 1e9:.4f} ns"
        points[kind].append((e, spent))
        print(f"{name} {n or ''}, {kind}, reltol {tolerance or 'default'}: {spent:.3g} s{rings}, {len(values[0])} points, error {e:.1e}", flush=True)
    for target in 1e-2, 1e-3, 1e-4, 1e-5, 1e-6:
        ours_at, theirs_at = time_at(points["Corpuscle"], target), time_at(points["ngspice"], target)
        if math.inf not in (ours_at, theirs_at):
            print(f"{name} {n or ''}, ratio at an error of {target:g}: {theirs_at / ours_at:.2f}", flush=True)


def main():
    program = Path(sys.argv[1]).resolve()
    chosen = sys.argv[2:] or ["line100", "line1000", "line10000", "mesh10", "mesh32", "mesh100", "ladder50", "ladder500", "rectifier",
                              "ring11", "ring101", "ring1_101"]
    print(f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores", flush=True)
    for each in chosen:
        name, n = re.fullmatch(r"(ring1_|[a-z]+)(\d*)", each).groups()
        with tempfile.TemporaryDirectory() as directory:
            compare(program, name.rstrip("_"), int(n or 0), Path(directory))


if __name__ == "__main__":
    main()
