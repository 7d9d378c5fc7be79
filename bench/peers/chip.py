#!/usr/bin/env python3
"""The SA-I chip under the thesis's press: time for one second of touch, accuracy of its spikes, and time of ngspice.

    chip.py CORPUSCLE CHIP_CIR [--until SECONDS] [--rounds N] [--keep DIR]

Method: `corpuscle run` simulates the netlist N times with its default accuracy, and once with tolerances a hundred times tighter as the
reference for the spikes. Output: the fastest and the median, in processor seconds of complete processes. Then ngspice runs once on the
netlist as exported by `corpuscle export` (the same transistors as expressions, the force as a piecewise linear source), up to SECONDS of
the press. It uses Corpuscle's tolerances instead of the much tighter ones of the deck. Corpuscle runs again up to the same time. A spike is
an upward crossing of half the supply (0.35 V) by v(s), interpolated linearly between two points. All runs use one core, in sequence.
"""
import argparse
import re
import resource
import statistics
import struct
import subprocess
import tempfile
from pathlib import Path

# for ngspice; with looser values, currents of picoamperes are lost, and the chip does not fire
OPTIONS = "reltol=1e-5 abstol=1e-16 vntol=1e-9"


def timed(command):
    """Processor seconds and output of a process."""
    def processor():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime
    before = processor()
    ran = subprocess.run(command, capture_output=True, text=True)
    return processor() - before, ran.stdout + ran.stderr


def spikes(raw):
    """Times (s) at which v(s) crosses 0.35 V upward, in the last plot of a binary .raw file."""
    head, _, body = Path(raw).read_bytes().rpartition(b"Binary:\n")
    head = head.decode(errors="replace")[-100000:]
    head = head[head.rindex("No. Variables"):]
    variables, points = (int(re.search(rf"No. {what}: *(\d+)", head)[1]) for what in ("Variables", "Points"))
    names = [l.split()[1].lower() for l in head.split("\nVariables:")[1].strip().splitlines()]
    rows = list(struct.iter_unpack(f"<{variables}d", body[:points * variables * 8]))
    s = names.index("v(s)")
    return [a[0] + (b[0] - a[0]) * (0.35 - a[s]) / (b[s] - a[s]) for a, b in zip(rows, rows[1:]) if a[s] < 0.35 <= b[s]]


class Chip:
    """The chip's netlist, to be simulated by both programs. Each run gives seconds, [steps, rejected steps, iterations] and spike times."""
    def __init__(self, program, netlist, folder):
        self.program, self.folder = program, folder
        self.text = re.sub(r"(?m)^\.(op|expect).*\n", "", netlist.read_text())
        for kind in ("lib", "include"):
            self.text = re.sub(rf"(?m)^\.{kind} '([^']*)'", lambda m: f".{kind} '{(netlist.parent / m[1]).resolve()}'", self.text)

    def netlist(self, name, until, options):
        """Text of the chip's netlist with these options and stop time."""
        text = re.sub(r"(?m)^\.tran (\S+) \S+", rf".tran \1 {until}", self.text).replace("\n.end", f"\n.options {options}\n.end")
        path = self.folder / f"{name}.cir"
        path.write_text(text)
        return path

    def ours(self, name, until, options=""):
        raw = self.folder / f"{name}.raw"
        seconds, log = timed([self.program, "run", str(self.netlist(name, until, "spikecheck=0 " + options)), "-o", str(raw)])
        numbers = re.search(r"(\d+) steps, (\d+) rejected, (\d+) Newton iterations", log)
        if not numbers:
            raise SystemExit(log)
        return seconds, [int(n) for n in numbers.groups()], spikes(raw)

    def theirs(self, until):
        deck, raw = self.folder / "ngspice.cir", self.folder / "ngspice.raw"
        source = self.netlist("exported", until, "spikecheck=0")
        subprocess.run([self.program, "export", str(source), "--for", "ngspice", "-o", str(deck), "--quiet"], check=True, capture_output=True)
        text = re.sub(r"reltol=\S+ abstol=\S+ vntol=\S+", OPTIONS, deck.read_text())
        control = f".control\nset num_threads=1\nrun\nrusage traniter accept rejected\nwrite {raw}\nquit\n.endc\n.end\n"
        deck.write_text(re.sub(r"\.end\n*$", control, text))
        seconds, log = timed(["ngspice", "-b", str(deck)])
        numbers = [re.search(rf"{what} = (\d+)", log) for what in ("Accepted timepoints", "Rejected timepoints", "Transient iterations")]
        if not all(numbers):
            raise SystemExit("ngspice did not finish:\n" + log[-2000:])
        return seconds, [int(n[1]) for n in numbers], spikes(raw)


def row(name, run):
    seconds, (steps, rejected, iterations), found = run
    spike_times = f"{', '.join(f'{1e3 * t:.3f}' for t in found[:3])} ... {1e3 * found[-1]:.3f} ms" if found else "none"
    print(f"{name:<26}{seconds:9.3f} s{steps:8}{rejected:9}{iterations:11}{1e6 * seconds / iterations:9.1f}{len(found):8}   {spike_times}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("corpuscle")
    parser.add_argument("chip", type=Path)
    parser.add_argument("--until", type=float, default=0.332, help="seconds of the press that ngspice simulates")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        chip = Chip(options.corpuscle, options.chip, folder)
        print(f"{options.chip.stem} under the press\n" + " " * 32 + "cpu   steps rejected iterations  us each  spikes")
        rounds = sorted((chip.ours("default", 1) for _ in range(options.rounds)), key=lambda run: run[0])
        middle = statistics.median(run[0] for run in rounds)
        row("corpuscle, 1 s of touch", rounds[0])
        print(f"{'':<26}{middle:9.3f} s is the median of {options.rounds} rounds")
        tight = chip.ours("tight", 1, "reltol=1e-7 vntol=1e-8")
        row("a hundredth of reltol", tight)
        worst = max((abs(a - b) for a, b in zip(rounds[0][2], tight[2])), default=float("nan"))
        same = "the same number of" if len(rounds[0][2]) == len(tight[2]) else "NOT the same number of"
        print(f"{'':<26}{same} spikes, largest difference {1e6 * worst:.0f} us")
        mine, peer = chip.ours("part", options.until), chip.theirs(options.until)
        row(f"corpuscle, {options.until:g} s", mine)
        row(f"ngspice, {options.until:g} s", peer)
        off = max((abs(a - b) for a, b in zip(mine[2], peer[2])), default=float("nan"))
        print(f"{'':<26}ngspice over ours: total {peer[0] / mine[0]:.0f}, per iteration "
              f"{peer[0] / peer[1][2] / (mine[0] / mine[1][2]):.0f}; spikes {1e6 * off:.0f} us apart")


main()
