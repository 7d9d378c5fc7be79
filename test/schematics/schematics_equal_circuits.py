"""Each circuit has a schematic, whose netlist by xschem is the same circuit: devices, nodes, values and directives.

schematics_equal_circuits.py CORPUSCLE. The decks of both are compared, in which `corpuscle export` has expanded all subcircuits.
The commands of doc/schematics.md are run, too.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from netlists import ROOT, SCHEMATICS, SKIPPED, copy_circuits, flat_deck, xschem_netlist


def differences(corpuscle, circuit, schematic, folder):
    drawn, drawn_lines = flat_deck(corpuscle, xschem_netlist(schematic, folder))
    written, written_lines = flat_deck(corpuscle, circuit)
    if drawn_lines == written_lines:
        return []
    only = [f"  only in the schematic: {line[:160]}" for line in sorted(drawn - written)]
    return only + [f"  only in the circuit: {line[:160]}" for line in sorted(written - drawn)] or ["  a line occurs more often in one of them"]


def page_failures(corpuscle, folder):
    """The commands of doc/schematics.md that fail."""
    blocks = re.findall(r"^```sh\n(.*?)^```$", (ROOT / "doc" / "schematics.md").read_text(encoding="utf-8"), re.S | re.M)
    environment = {**os.environ, "HOME": folder, "PATH": f"{pathlib.Path(corpuscle).resolve().parent}:{os.environ['PATH']}"}
    environment.pop("DISPLAY", None)
    ran = [subprocess.run(["sh", "-ec", block], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False) for block in blocks]
    return [f"doc/schematics.md has {len(blocks)} blocks of commands instead of 3"] * (len(blocks) != 3) + [one.stderr for one in ran if one.returncode != 0]


def main(corpuscle):
    if not shutil.which("xschem"):
        print("skipped: xschem is not installed (apt-get install xschem)")
        return SKIPPED
    circuits = {path.stem: path for path in sorted((ROOT / "circuits").glob("*.cir"))}
    schematics = {path.stem: path for path in sorted(SCHEMATICS.glob("*.sch"))}
    failures = [f"{name}: a circuit without a schematic" for name in sorted(circuits.keys() - schematics.keys())]
    failures += [f"{name}: a schematic without a circuit" for name in sorted(schematics.keys() - circuits.keys())]
    with tempfile.TemporaryDirectory() as folder:
        copied = copy_circuits(folder)
        for name in sorted(circuits.keys() & schematics.keys()):
            found = differences(corpuscle, circuits[name], copied / schematics[name].name, folder)
            if found:
                failures.append("\n".join([f"{name}: the schematic is another circuit", *found[:12]]))
        failures += page_failures(corpuscle, folder)
    print("\n".join(failures) if failures else f"{len(circuits)} schematics are their circuits")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
