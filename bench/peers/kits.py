"""Do all circuits give the same in ngspice: with UICM as expressions, and with the transistors of a kit?

    python3 bench/peers/kits.py build/release/corpuscle [circuits/invb.cir ...] [--only uicm|kit] [--limit 600] [--until 0.332]

Each circuit (default: all of circuits/) runs here, then its exported deck in ngspice, which measures one kind of analysis only: all other
analyses are removed from the deck. Spikes of .spike are measured as crossings. Output: a row in Markdown for each circuit and kind of
transistor, with the number of measures and spikes, the largest deviation and its measure, ngspice's processor seconds, and the measures
that ngspice has no result for. The option --until ends transients earlier, in both programs. The option --step sets the longest step in
ngspice. The kit is by default the invented BSIM3 card of test/kits; --card, --map, --nch and --pch name another."""

import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ANALYSES = ("op", "dc", "ac", "noise", "tran", "tf", "pz", "sens")
MAX_SPIKES = 40


def shortened(text, until):
    """The netlist with its transients ended at this time (s), and without what is expected later."""
    return re.sub(r"(?m)^(\.tran\s+\S+\s+)\S+", rf"\g<1>{until}", re.sub(r"(?m)^\.expect.*\n", "", text)) if until else text


def spike_of(text):
    found = re.search(r"(?m)^(?:\* left out: )?\.spike\s+(\S+)\s+(\S+?)(?:\s+(rise|fall))?(?:\s|$)", text)
    return found and (found[1], found[2], found[3] or "rise")


def zeros_of(text):
    """The measures that are expected to be zero, and how far from it they may be."""
    found = re.finditer(r"(?mi)^\.expect\s+(\w+)\s+0\s+([\d.]+)([a-z]?)\s*$", text)
    return {m[1].lower(): float(m[2]) * {"": 1, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "f": 1e-15}[m[3].lower()] for m in found}


def measures_of(text, analysis):
    return {m[1].lower() for m in re.finditer(rf"(?mi)^\.meas\S*\s+{analysis}\s+(\w+)", text)}


def deviation(ours, theirs, tolerance):
    """Relative. A measure that is expected to be zero has none if both are within its tolerance."""
    if tolerance and max(abs(ours), abs(theirs)) <= tolerance:
        return 0
    return abs(theirs / ours - 1) if ours else abs(theirs)


def measurable(deck):
    """The deck with only the analysis that most of its measures need, and a measure for each spike."""
    kinds = Counter(re.findall(r"(?mi)^\.meas\S*\s+(\w+)", deck))
    spike = spike_of(deck)
    if not kinds and not spike:
        return None, ""
    kind = kinds.most_common(1)[0][0].lower() if kinds else "tran"
    lines = [line for line in deck.splitlines()
             if not any(line.lower().startswith("." + a) and line[len(a) + 1:len(a) + 2] in ("", " ") for a in ANALYSES if a != kind)
             and not (line.lower() == ".end" or line.lower().startswith((".save", ".print")))]
    if kind == "ac":
        lines.append(".save all")
    if spike and kind == "tran":
        lines += [f".meas tran spike_{k} when {spike[0]}={spike[1]} {spike[2]}={k}" for k in range(1, MAX_SPIKES + 1)]
    return "\n".join(lines) + "\n.end\n", kind


def ours(program, netlist):
    run = subprocess.run([program, "run", netlist, "--json", "--quiet"], capture_output=True, text=True)
    if not run.stdout:
        raise SystemExit(f"{netlist}: {run.stderr}")
    document = json.loads(run.stdout)
    numbers = {name.lower(): value for name, value in document["numbers"].items() if value is not None}
    for times in document.get("spikes", [])[:1]:
        numbers |= {f"spike_{k + 1}": t for k, t in enumerate(times[:MAX_SPIKES])}
    return numbers


def theirs(deck, limit):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        log = subprocess.run(["ngspice", "-b", deck], capture_output=True, text=True, timeout=limit, stdin=subprocess.DEVNULL, cwd=Path(deck).parent,
                             env=os.environ | {"OMP_NUM_THREADS": "1"})
    except subprocess.TimeoutExpired:
        return None, limit, f"not finished in {limit:g} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = log.stdout + log.stderr
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    numbers = {m[1].lower(): float(m[2]) for m in re.finditer(r"(?m)^\s*(\w+)\s+=\s+([-+.\deE]+)(?:\s|$)", text)}
    trouble = re.search(r"(?i).*(timestep too small|singular matrix|fatal|unknown subckt|could not find a valid modelname).*", text)
    return numbers, seconds, trouble[0].strip() if trouble else ""


def row(name, kind, mine, measures, zeros, other, seconds, trouble):
    common = {n: (v, other[n]) for n, v in mine.items() if other and n in other}
    spikes = [n for n in mine if re.fullmatch(r"spike_\d+", n)]
    found = [n for n in (other or {}) if n.startswith("spike_")]
    apart = {n: deviation(*common[n], zeros.get(n)) for n in measures if n in common}
    late = [abs(b - a) for n, (a, b) in common.items() if n.startswith("spike_")]
    worst = max(apart, key=apart.get) if apart else None
    missing = [n for n in measures if n not in apart and n in mine]
    cells = [name, kind, f"{len(apart)} of {len(apart) + len(missing)}", f"{apart[worst]:.1g} ({worst})" if worst else "",
             (f"{len(found)} for {len(spikes)}" + (f", {1e3 * max(late):.3g} ms" if late else "")) if spikes or found else "", f"{seconds:.1f}",
             trouble if missing or not common else "", " ".join(missing)]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("corpuscle")
    parser.add_argument("netlists", nargs="*")
    parser.add_argument("--only", choices=("uicm", "kit"))
    parser.add_argument("--limit", type=float, default=600)
    parser.add_argument("--until", type=float)
    parser.add_argument("--step")
    parser.add_argument("--card", default=str(ROOT / "test/kits/made_up_bsim3.lib"))
    parser.add_argument("--map", default="bsim")
    parser.add_argument("--nch", default="made_n")
    parser.add_argument("--pch", default="made_p")
    options = parser.parse_args()
    kit = ["--card", options.card, "--map", options.map, "--nch", options.nch, "--pch", options.pch]
    columns = ("circuit", "transistors", "measures", "largest deviation", "spikes", "seconds", "trouble", "missing")
    print("| " + " | ".join(columns) + " |\n" + "| --- " * len(columns) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for path in options.netlists or sorted(str(p) for p in (ROOT / "circuits").glob("*.cir")):
            path = Path(path).resolve()
            netlist = Path(folder, path.name)
            text = shortened(path.read_text(), options.until)
            text = re.sub(r"(?mi)^(\.(?:include|inc|lib)\s+')([^'/][^']*')", rf"\g<1>{path.parent}/\g<2>", text)
            netlist.write_text(text)
            mine = ours(options.corpuscle, netlist)
            for kind, arguments in (("uicm", []), ("kit", kit)):
                if options.only not in (None, kind):
                    continue
                deck = netlist.with_suffix(f".{kind}.cir")
                run = subprocess.run([options.corpuscle, "export", netlist, "--for", "ngspice", *arguments, "-o", deck, "--quiet"],
                                     capture_output=True, text=True)
                if run.returncode:
                    print(f"| {path.stem} | {kind} | | | | | {run.stderr.strip().splitlines()[-1]} | |", flush=True)
                    continue
                reduced, analysis = measurable(deck.read_text())
                if reduced is None:
                    print(f"| {path.stem} | {kind} | | | | | nothing is measured | |", flush=True)
                    continue
                deck.write_text(re.sub(r"(?m)^(\.tran \S+ \S+) \S+ \S+", rf"\1 0 {options.step}", reduced) if options.step else reduced)
                row(path.stem, kind, mine, measures_of(text, analysis), zeros_of(text), *theirs(deck, options.limit))


sys.exit(main())
