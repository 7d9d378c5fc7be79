"""Exported Verilog-A modules: adms reads them, and an interpreter of the few statements that they use gives the spikes of corpuscle.

Debian has no simulator that runs Verilog-A. adms does not know the events cross and timer, so it gets initial_step in their place."""

import math
import os
import re
import shutil
import subprocess
import unittest

import numpy as np

import export_support as support


def exported_module_text(folder, name, settings):
    path = os.path.join(folder, "afferent.va")
    support.program("export", name, "--for", "verilog-a", *support.set_options(settings), "-o", path)
    with open(path) as file:
        return file.read()


FUNCTIONS = {"max": max, "min": min, "abs": abs, "asinh": math.asinh, "exp": math.exp, "floor": math.floor, "sqrt": math.sqrt, "M_PI": math.pi}


class Module:
    """The statements of a module, compiled for Python. The voltage of a node n is n in the dictionary of nodes."""

    def __init__(self, text):
        text = re.sub(r"//.*", "", text).replace("`", "")
        self.names = dict(FUNCTIONS, **{name: float(value) for name, value in re.findall(r"parameter real (\w+) = ([^;]+);", text)})
        body = text[text.index("analog begin") + len("analog begin"):]
        self.events, self.slopes, lines = {}, {}, []
        for part in re.split(r"(?<=[;\n])", body):
            lines.append(part.strip())
        self.steps, target, stack = [], None, []
        target = self.steps
        for line in filter(None, lines):
            if event := re.fullmatch(r"@\((\w+)(.*)\) begin", line):
                stack.append(target)
                target = self.events.setdefault(event[1] + event[2], [])
            elif condition := re.fullmatch(r"if \((.*)\) begin", line):
                inner = []
                target.append((self.code(condition[1]), inner))
                stack.append(target)
                target = inner
            elif line == "end":
                if not stack:
                    break
                target = stack.pop()
            elif node := re.fullmatch(r"V\((n_\w+)\) <\+ idt\((.*), ([^,()]*(?:\(.*\))?)\)(?: \+ (jump_of_\w+))?;", line):
                self.slopes[node[1]] = (self.code(node[2]), self.code(node[3]), node[4])
            elif assignment := re.fullmatch(r"(\w+) = (.*);", line):
                target.append((assignment[1], self.code(assignment[2])))
            elif not line.startswith("V(spike) <+ transition("):
                raise AssertionError(f"not understood: {line}")

    @staticmethod
    def code(expression):
        expression = re.sub(r"V\((n_\w+)\)", r"nodes['\1']", expression)
        expression = expression.replace("V(force)", "force").replace("$abstime", "abstime").replace("ddt(force)", "force_slope")
        return compile(expression, expression, "eval")

    def run(self, statements, names):
        for first, second in statements:
            if isinstance(second, list):
                if eval(first, names):
                    self.run(second, names)
            else:
                names[first] = eval(second, names)

    def simulate(self, force, step, side=0):
        """The spike times of one column of forces. Heun's method; spikes are found on straight lines within a step."""
        names = dict(self.names, nodes=dict.fromkeys(self.slopes, 0.0), force=force[0], force_slope=0.0, abstime=0.0, side=side)
        self.run(self.events["initial_step"], names)
        self.run(self.steps[:2], names)
        nodes = names["nodes"]
        for node, (_, initial, _) in self.slopes.items():
            nodes[node] = eval(initial, names)
        self.run(self.steps, names)
        spikes = []
        for k in range(len(force) - 1):
            begin, names["force_slope"] = k * step, (force[k + 1] - force[k]) / step
            names.update(force=force[k], abstime=begin)
            self.run(self.steps, names)
            before = names["margin"]
            old, end, now = dict(nodes), (k + 1) * step, begin
            while now < end:
                # The part of the step until the refractory time ends.
                stop = names["idle_until"] if not names["active"] and now < names["idle_until"] < end else end
                self.advance(names, now, stop, force[k], begin)
                if names["margin"] > 0 and names["margin"] > before and before <= 0:
                    x = before / (before - names["margin"])
                    spike = now + x * (stop - now)
                    nodes.update(old)
                    self.advance(names, now, spike, force[k], begin)
                    jumps = {node: names[jump] for node, (_, _, jump) in self.slopes.items() if jump}
                    self.run(self.events["cross(margin, 1)"], names)
                    for node, jump in jumps.items():
                        nodes[node] += names[self.slopes[node][2]] - jump
                    spikes.append(spike)
                    stop = spike
                    self.run(self.steps, names)
                if not names["active"] and stop >= names["idle_until"]:
                    self.run(self.events["timer(idle_until)"], names)
                now, before, old = stop, names["margin"], dict(nodes)
        return np.array(spikes)

    def advance(self, names, begin, end, force, force_begin):
        nodes, h = names["nodes"], end - begin

        def slopes(t):
            names.update(force=force + names["force_slope"] * (t - force_begin), abstime=t)
            self.run(self.steps, names)
            return [eval(slope, names) for slope, _, _ in self.slopes.values()]

        first, start = slopes(begin), list(nodes.values())
        nodes.update(zip(nodes, [x + h * s for x, s in zip(start, first)]))
        second = slopes(end)
        nodes.update(zip(nodes, [x + h / 2 * (a + b) for x, a, b in zip(start, first, second)]))
        slopes(end)


class VerilogA(unittest.TestCase):
    def test_every_afferent_fires_as_in_corpuscle(self):
        t, forces = support.touch()
        for name, settings in support.afferents():
            with self.subTest(name), support.temporary_folder() as folder:
                ours = support.our_trains(folder, name, settings, t, forces)[0]
                module = Module(exported_module_text(folder, name, settings))
                self.assertGreater(len(ours), 0)
                theirs = np.concatenate([module.simulate(forces[:, 0], support.STEP, side) for side in range(2 if "fa1a" in name else 1)])
                self.assertLess(support.largest_difference([ours], [theirs]), support.STEP)

    @unittest.skipIf(shutil.which("admsXml") is None, "adms is not installed (Debian: adms)")
    def test_adms_reads_every_module(self):
        for name, settings in support.afferents():
            with self.subTest(name), support.temporary_folder() as folder:
                text = re.sub(r"@\((cross|timer)\(.*?\)\)", "@(initial_step)", exported_module_text(folder, name, settings))
                path = os.path.join(folder, "adms.va")
                with open(path, "w") as file:
                    file.write(text)
                done = subprocess.run(["admsXml", path], cwd=folder, capture_output=True, text=True, timeout=60)
                self.assertEqual((done.returncode, "fatal" in done.stdout + done.stderr), (0, False), done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
