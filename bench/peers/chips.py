#!/usr/bin/env python3
"""A Monte Carlo analysis of the bias generator compared with ngspice: operating points of chips with mismatch in each transistor.

    chips.py CORPUSCLE BENCH_CHIPS NETLIST [CHIPS] [CHIPS_OF_NGSPICE]      default: 5000 and 100 chips

Method: `bench-chips` solves its chips. Then ngspice runs the same circuit as exported by `corpuscle export`. Normal deviates of the same
sizes are added to each transistor's threshold and current (agauss). The chips run one after another in one process (reset, op), as is usual
there. Its deviates differ from Corpuscle's, so only means and standard deviations of v(q) are compared, not single chips. ngspice's time is
the wall time of its complete process minus that of a process with one chip. A chip has failed if ngspice reports a failed operating point.
It is wrong if v(q) differs from Corpuscle's mean by more than 20 of its standard deviations.
"""
import math
import re
import statistics
import subprocess
import sys
import tempfile
import time

corpuscle, bench, netlist = sys.argv[1:4]
chips, ngspice_chips = (int(sys.argv[k]) if len(sys.argv) > k else n for k, n in ((4, 5000), (5, 100)))
card = open(re.sub(r"circuits/[^/]*$", "process/tsmc180.lib", netlist)).read()
card_values = {name: float(value) * {"": 1, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "f": 1e-15}[unit]
               for name, value, unit in re.findall(r"\b(avt|ais|cox)=([0-9.e+-]+)([munpf]?)", card)}


def with_deviates(deck):
    """The deck with deviates on each transistor's `vt` and `is`, according to its gate area."""
    def size(match):
        area = float(match["cox"]) / card_values["cox"]
        return (f"{match['name']}vt={{{match['vt']}+agauss(0,{card_values['avt'] / math.sqrt(area)},1)}}{match['between']}"
                f"is={{{match['is']}*(1+agauss(0,{card_values['ais'] / math.sqrt(area)},1))}}{match['then']}cox={match['cox']}")
    return re.sub(r"(?P<name>^xm[^\n]*)vt=(?P<vt>\S+)(?P<between>[^\n]*)\bis=(?P<is>\S+)(?P<then>[^\n]*\n\+ )cox=(?P<cox>\S+)", size,
                  deck, flags=re.M)


deck = subprocess.run([corpuscle, "export", netlist, "--for", "ngspice"], capture_output=True, text=True, check=True).stdout
deck = "\n".join(l for l in with_deviates(deck).splitlines() if not re.match(r"\.(op|end|print|save|meas)$|\.(print|save|meas) ", l))
assert "agauss" in deck


def ngspice(count):
    """Wall time (s), v(q) of each chip that converged, and number of the others."""
    text = f"{deck}\n.control\nrepeat {count}\nreset\nop\nprint v(q)\nend\nquit\n.endc\n.end\n"
    with tempfile.NamedTemporaryFile("w", suffix=".cir") as file:
        file.write(text)
        file.flush()
        start = time.perf_counter()
        ran = subprocess.run(["ngspice", "-b", file.name], capture_output=True, text=True)
        seconds = time.perf_counter() - start
    values = [float(v) for v in re.findall(r"^v\(q\) = (\S+)", ran.stdout, re.M)]
    return seconds, values, count - len(values)


ours = subprocess.run([bench, netlist, str(chips)], capture_output=True, text=True, check=True).stdout
print("corpuscle:", ours.splitlines()[0])
us = float(re.search(r"([0-9.]+) us each", ours)[1])
mean, deviation = (float(x) for x in re.search(r"v\(q\) +mean ([0-9.]+) V +deviation ([0-9.]+) V", ours).groups())
single = min(ngspice(1)[0] for _ in range(3))
seconds, values, failed = ngspice(ngspice_chips + 1)
peer = (seconds - single) / ngspice_chips * 1e6
good = [v for v in values if abs(v - mean) < 20 * deviation]
print(f"ngspice:   {ngspice_chips} chips: {peer:.0f} us each, {failed} failed, {len(values) - len(good)} wrong")
print(f"v(q): ours {mean * 1e3:.3f} mV, deviation {deviation * 1e3:.3f} mV; ngspice {statistics.mean(good) * 1e3:.3f} mV, "
      f"deviation {statistics.stdev(good) * 1e3:.3f} mV")
print(f"ngspice's time over ours: {peer / us:.0f}")
