"""Each kind of device has a symbol, whose line in xschem's netlist is read and solved: devices_have_symbols.py CORPUSCLE."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from netlists import SCHEMATICS, SKIPPED, xschem_netlist

# Kind as `corpuscle list devices` prints it, and its symbols, each with the attributes of an instance.
SYMBOLS = {
    "r: resistor": [("resistor", "")],
    "c: capacitor, linear or with an expression for its charge": [("capacitor", ""), ("capacitor", 'value="q=\\{1p*v(n5,n6)\\}"')],
    "l: inductor": [("inductor", "")],
    "k: coupling of inductors": [("coupling", "first=l_1 second=l_2 value=0.5")],
    "v: voltage source": [("vsource", "value=1"), ("force_source", "")],
    "i: current source": [("isource", "value=1n"), ("force_current", "")],
    "e: voltage source controlled by a voltage or an expression": [("vcvs", "")],
    "f: current source controlled by a current": [("cccs", "source=v_1")],
    "g: current source controlled by a voltage or an expression": [("vccs", "value=1n")],
    "h: voltage source controlled by a current": [("ccvs", "source=v_1")],
    "b: voltage or current source with an expression": [("expression_voltage", 'value="\\{v(n1)/2\\}"'), ("expression_current", 'value="\\{v(n1)/1meg\\}"')],
    "s: switch controlled by a voltage": [("voltage_switch", "model=a_switch")],
    "w: switch controlled by a current": [("current_switch", "source=v_1 model=a_current_switch")],
    "d: junction diode": [("diode", "model=a_diode")],
    "q: bipolar transistor": [("npn", "model=an_npn"), ("pnp", "model=a_pnp")],
    "m: MOS transistor, SPICE level 1": [("nmos_other", "model=level_1"), ("pmos_other", "model=p_level_1")],
    "m: MOS transistor, EKV 2.6": [("nmos_other", "model=ekv")],
    "m: MOS transistor, UICM": [(name, "") for base in ("nch", "nch_hv", "pch", "pch_hv") for name in (base, base + "_rail")],
}
MODELS = [".lib 'process/tsmc180.lib' tt", ".model a_switch sw(vt=0.5)", ".model a_current_switch csw(it=1m)", ".model a_diode d", ".model an_npn npn",
          ".model a_pnp pnp", ".model level_1 nmos(level=1)", ".model p_level_1 pmos(level=1)", ".model ekv nmos(level=44)", ".op", ".tran 1u 10u",
          ".force press"]
# Symbols of nodes and directives.
NOT_DEVICES = {"label", "wire_label", "ground", "supply", "directives", "measures", "spike"}


def pins(symbol):
    text = (SCHEMATICS / "symbols" / f"{symbol}.sym").read_text(encoding="utf-8")
    return [tuple(float(v) for v in row) for row in re.findall(r"^B 5 (\S+) (\S+) (\S+) (\S+) \{name=", text, re.M)]


def sheet():
    """A schematic with one instance of each symbol, each pin of which has its own node with a resistor to ground."""
    out, nodes, count = ["v {xschem version=2.8.1 file_version=1.1}", "G {}", "V {}", "S {}", "E {}"], 1, {}
    for kind, symbols in SYMBOLS.items():
        for symbol, attributes in symbols + ([("inductor", "")] if kind[0] == "l" else []):
            count[kind[0]] = count.get(kind[0], 0) + 1
            x, y = 400 * (len(out) % 40), 400 * len(count)
            out.append(f"C {{symbols/{symbol}.sym}} {x} {y} 0 0 {{name={kind[0]}_{count[kind[0]]} {attributes}}}")
            for left, top, right, bottom in pins(symbol):
                out.append(f"C {{symbols/label.sym}} {(left + right) / 2 + x:.0f} {(top + bottom) / 2 + y:.0f} 0 0 {{name=p{nodes} lab=n{nodes}}}")
                nodes += 1
    loads = [f"r_load_{k} n{k} 0 1k" for k in range(1, nodes)]
    out.append("C {symbols/spike.sym} 0 8000 0 0 {name=spike1 level=2 edge=rise}\nC {symbols/label.sym} 0 8000 0 0 {name=p0 lab=n1}")
    out.append('C {symbols/directives.sym} 0 9000 0 0 {name=d value="' + "\n".join(["vdd vdd 0 0.7", *loads, *MODELS]) + '"}')
    return "\n".join(out) + "\n", sum(map(len, SYMBOLS.values())) + 1


def main(corpuscle):
    answer = subprocess.run([corpuscle, "list", "devices", "--json"], capture_output=True, text=True, check=True)
    kinds = {f"{row['name']}: {row['description']}" for row in json.loads(answer.stdout)["devices"]}
    drawn = {symbol for symbols in SYMBOLS.values() for symbol, _ in symbols}
    files = {path.stem for path in (SCHEMATICS / "symbols").glob("*.sym")}
    failures = [f"{kind}: a kind of device without a symbol in {__file__}" for kind in kinds - SYMBOLS.keys()]
    failures += [f"{kind}: no such kind of device" for kind in SYMBOLS.keys() - kinds]
    failures += [f"{symbol}.sym: neither in SYMBOLS nor in NOT_DEVICES" for symbol in files - drawn - NOT_DEVICES]
    if not failures and not shutil.which("xschem"):
        print("skipped: xschem is not installed (apt-get install xschem)")
        return SKIPPED
    if not failures:
        with tempfile.TemporaryDirectory() as folder:
            text, count = sheet()
            path = pathlib.Path(folder, "devices.sch")
            path.write_text(text, encoding="utf-8")
            netlist = xschem_netlist(path, folder)
            lines = [line for line in netlist.read_text(encoding="utf-8").split("\n") if re.match(r"[a-z]_\d+ ", line)]
            if len(lines) != count:
                failures.append(f"{len(lines)} lines of devices instead of {count}:\n" + "\n".join(lines))
            if ".spike v(" not in netlist.read_text(encoding="utf-8"):
                failures.append("the symbol of a spike output gives no .spike line")
            run = subprocess.run([corpuscle, "run", str(netlist), "--quiet"], capture_output=True, text=True, check=False)
            if run.returncode != 0:
                failures.append(run.stderr + "\n".join(lines))
    print("\n".join(failures) if failures else f"{len(kinds)} kinds of devices have symbols")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
