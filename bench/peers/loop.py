#!/usr/bin/env python3
"""Transient of the loop of 108 transistor arrays compared with ngspice: one second of touch.

    loop.py CORPUSCLE LOOP_CIR [SECONDS_AT_THE_MOST] [--keep DIR]      default: 300 s of wall time for each simulation

Method: `bench/decks/loop.cir` runs here unchanged, and in ngspice twice. The first run has its transistors as expressions with the same
parameters (each with two inner nodes y = ln q, where q is the normalised inversion charge at source or drain; this is the usual form
there). The second has BSIM3 transistors of the same sizes and, because of their leakage, a membrane of 10 pF; it compares only time, not
spikes. Topology, sources, tolerances and maximum step are the same text in all runs. ngspice needs the tight tolerances of `.options`; with
its defaults it stops or produces false spikes. Each simulation runs once, in sequence, on one core; times are of complete processes. A
spike is an upward crossing of 0.35 V by v(s), interpolated linearly between two points. Wall and processor seconds are printed side by
side. Times per iteration and per spike, and the ratios, use processor time, because other load on the machine affects it less.
"""
import re
import resource
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# A transistor for ngspice. For a pmos, the signs of all voltages are changed.
FORMULAS = """
.subckt {name} d g s b cols=1 units=1
bys ys 0 i=v(ys)+exp(v(ys))-1-((v({g},{b_g})-({vto}-0.4m*(temper-27))+({{0.01/units}})*(v({d},{b_d})+v({s},{b_s})))/{n}-v({s},{b_s}))/(8.617333e-5*(temper+273.15))
byd yd 0 i=v(yd)+exp(v(yd))-1-((v({g},{b_g})-({vto}-0.4m*(temper-27))+({{0.01/units}})*(v({d},{b_d})+v({s},{b_s})))/{n}-v({d},{b_d}))/(8.617333e-5*(temper+273.15))
bid {from_to} i={{{isq}*{w}/0.5u*cols/units}}*((exp(v(ys))+2)*exp(v(ys))-(exp(v(yd))+2)*exp(v(yd)))
cys ys 0 1n
cyd yd 0 1n
cgs g s {{0.35*8.4m*{w}*0.5u*cols*units}}
cgd g d {{0.25*8.4m*{w}*0.5u*cols*units}}
cgb g b {{0.15*8.4m*{w}*0.5u*cols*units}}
ds {junction_s} junction area={{{w}*5e5*cols}}
dd {junction_d} junction area={{{w}*5e5*cols}}
.ends
"""


def formulas(name, vto):
    if name.startswith("n"):
        return FORMULAS.format(name=name, vto=vto, n=1.27, isq="107n", w="1.5u", g="g", d="d", s="s", b_g="b", b_d="b", b_s="b",
                               from_to="d s", junction_s="b s", junction_d="b d")
    return FORMULAS.format(name=name, vto=vto, n=1.3, isq="26n", w="6u", g="b", d="b", s="b", b_g="g", b_d="d", b_s="s",
                           from_to="s d", junction_s="s b", junction_d="d b")


FLAVOURS = {"nch": 0.459, "nch_hv": 0.609, "pch": 0.449, "pch_hv": 0.599}
UICM = "".join(formulas(*f) for f in FLAVOURS.items()) + ".model junction d(is=2e-18 n=1 cjo=1f vj=0.7 m=0.4)\n"
BSIM3 = "".join(f".model {name} {name[0]}mos(level=8 version=3.3.0 tox=4.1n vth0={'-' if name[0] == 'p' else ''}{vth} u0={u0} k1=0.5 k2=0)\n"
                for name, vth, u0 in (("nch", 0.42, 350), ("nch_hv", 0.57, 350), ("pch", 0.42, 90), ("pch_hv", 0.57, 90)))
TRANSISTOR = re.compile(r"m(\w+) (\S+ \S+ \S+ \S+) ([np]ch(?:_hv)?)_\d+ w=(\S+) l=0.5u m=(\S+)(?: stack=(\d+))?$")
CONTROL = """.control
set num_threads=1
run
rusage time traniter trantime accept rejected
write {raw}
quit
.endc
.end
"""


def braced(expression):
    """An expression in one pair of braces, as ngspice requires."""
    return "{" + expression.strip("{}").replace("{", "(").replace("}", ")") + "}"


def ngspice_deck(text, model, raw):
    """The loop for ngspice, with the transistors of this model, `uicm` or `bsim3`. `raw`: path of its results."""
    lines, card = [], False
    for line in text.splitlines():
        card = line.startswith(".model") or (card and line.startswith("+"))
        if card or line == ".end":
            continue
        if at := TRANSISTOR.match(line):
            name, nodes, kind, w, m, stack = at.groups()
            stack = stack or "1"
            if model == "uicm":
                line = f"xm{name} {nodes} {kind} cols={m} units={stack}"
            else:
                width = f"{w}*{m.strip('{}')}"
                line = (f"m{name} {nodes} {kind} w={braced(width)} l={braced('0.5u*' + stack)} as={braced(width + '*0.5u')} "
                        f"ad={braced(width + '*0.5u')} ps={braced('2*' + width)} pd={braced('2*' + width)}")
        assert at or not line.startswith("m"), line
        lines.append(line if model == "uicm" else line.replace(".param cu=0.55p", ".param cu=10p"))
    return "\n".join(lines) + "\n" + (UICM if model == "uicm" else BSIM3) + CONTROL.format(raw=raw)


def spikes(raw):
    """Times (s) at which v(s) crosses 0.35 V upward, from a binary .raw file."""
    head, _, body = Path(raw).read_bytes().partition(b"Binary:\n")
    head = head.decode()
    variables, points = (int(re.search(rf"No. {what}: *(\d+)", head)[1]) for what in ("Variables", "Points"))
    names = [l.split()[1].lower() for l in head.split("\nVariables:")[1].strip().splitlines()]
    rows = list(struct.iter_unpack(f"<{variables}d", body[:points * variables * 8]))
    s = names.index("v(s)")
    return [a[0] + (b[0] - a[0]) * (0.35 - a[s]) / (b[s] - a[s]) for a, b in zip(rows, rows[1:]) if a[s] < 0.35 <= b[s]]


def timed(command):
    """(Wall, processor) seconds and the output of a process; both are None if it was stopped at the time limit."""
    def processor():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime
    start, before = time.perf_counter(), processor()
    try:
        ran = subprocess.run(command, capture_output=True, text=True, timeout=time_limit)
    except subprocess.TimeoutExpired:
        return None, None
    return (time.perf_counter() - start, processor() - before), ran.stdout + ran.stderr


def row(name, seconds, numbers, raw):
    """Prints one simulation. Returns processor seconds, microseconds per iteration and milliseconds per spike."""
    if seconds is None:
        print(f"{name:<18} not finished in {time_limit:g} s")
        return None
    steps, rejected, iterations = numbers
    found = spikes(raw)
    wall, cpu = seconds
    us, each = cpu * 1e6 / iterations, cpu * 1e3 / len(found) if found else float("nan")
    first, last = (found[0], found[-1]) if found else (float("nan"),) * 2
    print(f"{name:<18}{wall:8.2f}{cpu:8.2f} s{steps:8}{rejected:9}{iterations:11}{us:9.2f}{len(found):8}{each:10.2f}  {first:.6f}  {last:.6f} s")
    return cpu, us, each


def ours(program, deck, folder):
    raw = folder / "ours.raw"
    seconds, log = timed([program, "run", str(deck), "-o", str(raw)])
    numbers = re.search(r"(\d+) steps, (\d+) rejected, (\d+) Newton iterations", log or "")
    if log is not None and not numbers:
        sys.exit(log)
    return row("corpuscle", seconds, numbers and [int(n) for n in numbers.groups()], raw)


def theirs(model, text, folder):
    deck, raw = folder / f"{model}.cir", folder / f"{model}.raw"
    deck.write_text(ngspice_deck(text, model, raw))
    seconds, log = timed(["ngspice", "-b", str(deck)])
    numbers = log and [re.search(rf"{what} = (\d+)", log) for what in
                        ("Accepted timepoints", "Rejected timepoints", "Transient iterations")]
    if numbers and not all(numbers):
        sys.exit(log[-2000:])
    return row(f"ngspice, {model.upper()}", seconds, numbers and [int(n[1]) for n in numbers], raw)


def main():
    text = Path(sys.argv[2]).read_text()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(sys.argv[sys.argv.index("--keep") + 1] if "--keep" in sys.argv else scratch)
        folder.mkdir(parents=True, exist_ok=True)
        print("loop of 108 arrays, 1 s\n" + " " * 22 + "wall     cpu   steps rejected iterations  us each  spikes  ms each  first     last")
        mine = ours(sys.argv[1], Path(sys.argv[2]), folder)
        for model in ("uicm", "bsim3"):
            peer = theirs(model, text, folder)
            if mine and peer:
                print(f"{'':<18}ngspice over ours: total {peer[0] / mine[0]:.1f}, per iteration {peer[1] / mine[1]:.1f}, "
                      f"per spike {peer[2] / mine[2]:.1f}")


time_limit = float(sys.argv[3]) if len(sys.argv) > 3 and not sys.argv[3].startswith("-") else 300.0
main()
