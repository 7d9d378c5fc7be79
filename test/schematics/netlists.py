"""For the tests of schematics: xschem without a display, and the flat deck of a netlist."""
import os
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMATICS = ROOT / "circuits" / "schematics"
SETTINGS = SCHEMATICS / "xschemrc"
SKIPPED = 77


def copy_circuits(folder):
    """A copy of circuits/ in the folder: xschem 2.8 saves a schematic when it writes the netlist. Returns the folder of schematics."""
    shutil.copytree(ROOT / "circuits", pathlib.Path(folder) / "circuits")
    return pathlib.Path(folder) / "circuits" / "schematics"


def xschem_netlist(schematic, folder):
    """The netlist that xschem writes of a schematic, which is in the folder or below it."""
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"} | {"HOME": str(folder)}
    answer = subprocess.run([shutil.which("xschem"), "-x", "-q", "-r", "-n", "-s", "--rcfile", str(SETTINGS), str(schematic)], cwd=folder,
                            env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60, check=False)
    netlist = pathlib.Path(folder) / (pathlib.Path(schematic).stem + ".spice")
    if not netlist.exists():
        raise SystemExit(f"{schematic}: xschem wrote no netlist\n{answer.stdout}{answer.stderr}")
    return netlist


def flat_deck(corpuscle, netlist):
    """The lines of the exported deck: every device with its nodes and values, every directive. The order of a netlist has no meaning."""
    answer = subprocess.run([corpuscle, "export", str(netlist), "--quiet"], capture_output=True, text=True, timeout=60, check=False)
    if answer.returncode != 0:
        return {f"{pathlib.Path(netlist).name} is refused: {answer.stderr.strip()}"}, []
    deck = re.sub(r"\n\+ *", " ", answer.stdout)
    deck = re.sub(r"(\.spike \S+ \S+) rise ", r"\1 ", deck)  # the default
    lines = deck.split("\n")[2:]  # without the title and the name of the file
    return set(lines), sorted(lines)
