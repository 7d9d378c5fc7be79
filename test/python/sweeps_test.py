"""Sweeps: the numbers and texts of `corpuscle sweep`, resumed results, errors, Ctrl-C."""

import copy
import csv
import io
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import corpuscle
import numpy as np
from support import command_line, error_of, processor_seconds

GRID = """title = "two axes"
afferent = "sa1"
force = "press"
measures = ["spikes", "peak_rate", "first_spike"]
[[vary]]
what = "press.F_max"
list = ["1N", "2N", "3N"]
[[vary]]
what = "sa1.f_B"
list = ["20Hz", "40Hz"]
"""
CHIPS = 'afferent = "sa1-circuit"\nsamples = 1000\n[[vary]]\nwhat = "mismatch"\n'
CORNERS = 'netlist = "bias.cir"\nmeasures = ["v(b)"]\n[[vary]]\nwhat = "r1"\nlist = ["1k", "3k"]\n[[vary]]\nwhat = "corner"\nlist = ["tt", "ss"]\n'


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        with open("grid.toml", "w") as file:
            file.write(GRID)


class Numbers(InAFolder):
    def test_are_those_of_the_command_line(self):
        result = corpuscle.sweep("grid.toml", "python.sqlite")
        self.assertEqual(command_line("sweep", "grid.toml", "-o", "program.sqlite")[0], 0)
        dump = command_line("sweep", "dump", "program.sqlite")[1]
        self.assertEqual(command_line("sweep", "dump", "python.sqlite")[1], dump)
        rows = list(csv.DictReader(io.StringIO(dump)))
        table = result.to_pandas()
        self.assertEqual(len(table), 6)
        self.assertEqual(list(table["item"]), [int(r["item"]) for r in rows])
        for name in ("press.F_max", "sa1.f_B", "spikes", "peak_rate", "first_spike"):
            np.testing.assert_array_equal(result[name], [float(r[name] or "nan") for r in rows], name)
            self.assertFalse(result[name].flags.writeable)
        self.assertEqual(result.summary, json.loads(command_line("sweep", "show", "python.sqlite", "--json")[1]))
        self.assertEqual(repr(result) + "\n", command_line("sweep", "show", "python.sqlite")[1])
        self.assertEqual((result.axes["press.F_max"].unit, result.measures["peak_rate"].unit), ("N", "Hz"))
        self.assertEqual((result.title, result.item_count, set(result.ended), result.failures), ("two axes", 6, {"done"}, []))
        # The measure itself: the spikes of one point.
        point = corpuscle.respond(corpuscle.press(F_max="2N"), afferent="sa1", settings={"f_B": "40Hz"})
        at = (result["press.F_max"] == 2) & (result["sa1.f_B"] == 40)
        self.assertEqual(result["spikes"][at].tolist(), [len(point)])

    def test_of_a_netlist_have_labels(self):
        with open("bias.cir", "w") as file:
            file.write("bias\n.lib 'c.lib' tt\nv1 a 0 {supply}\nr1 a b 1k\nr2 b 0 1k\n.op\n.end\n")
        with open("c.lib", "w") as file:
            file.write(".lib tt\n.param supply=1\n.endl\n.lib ss\n.param supply=2\n.endl\n")
        result = corpuscle.sweep(CORNERS)
        self.assertEqual(result.axes["corner"].labels, ["tt", "ss"])
        table = result.to_pandas()
        self.assertEqual(list(table["corner"]), ["tt", "ss"] * 2 if table["corner"][0] != table["corner"][1] else ["tt"] * 2 + ["ss"] * 2)
        expected = np.where(table["corner"] == "tt", 1, 2) * 1e3 / (1e3 + table["r1"])
        np.testing.assert_allclose(result["v(b)"], expected, rtol=1e-6)
        self.assertEqual([t.get_text() for t in result.plot("v(b)", "corner").get_xticklabels()], ["tt", "ss"])

    def test_seed_samples_and_shard_are_those_of_the_command_line(self):
        text = 'afferent = "sa1"\nsamples = 5\n[[vary]]\nwhat = "f_B"\nsigma = "10%"\nmean = "20Hz"\n'
        with open("random.toml", "w") as file:
            file.write(text)
        command_line("sweep", "random.toml", "-o", "program.sqlite", "--seed", "7", "--samples", "9", "--shard", "2/3")
        result = corpuscle.sweep("random.toml", seed=7, samples=9, shard="2/3")
        self.assertEqual(os.path.basename(result.path), "random-2of3.sqlite")
        program = corpuscle.read_sweep("program.sqlite")
        self.assertEqual(len(program), 3)
        for name in program:
            np.testing.assert_array_equal(result[name], program[name])
        self.assertEqual(len(result.plot("spikes").patches or result.plot("spikes").lines) > 0, True)

    def test_travel_show_themselves_and_are_resumed(self):
        result = corpuscle.sweep(GRID)
        self.assertEqual(result.path, "sweep.sqlite")
        other = copy.deepcopy(result)
        np.testing.assert_array_equal(other["spikes"], result["spikes"])
        page = result._repr_html_()
        self.assertIn("<table>", page)
        self.assertIn("data:image/png", page)
        fractions = []
        again = corpuscle.sweep(GRID, progress=fractions.append)
        self.assertEqual(len(again), 6)
        means = [result["spikes"][result["press.F_max"] == f].mean() for f in (1, 2, 3)]
        np.testing.assert_allclose(np.asarray(result.plot("spikes", "press.F_max").lines[0].get_ydata(), dtype=float), means)


class Errors(InAFolder):
    def test_are_those_of_the_command_line(self):
        for text in ("", "afferent = 3\n", GRID + "x = 1\n", GRID.replace("sa1.f_B", "sa1.f_X"), GRID.replace("20Hz", "20 pigs"), 'netlist = "none.cir"\n',
                     "afferent = \"sa1\"\n[[vary]]\nlist = [1]\n", "[[\n"):
            with open("x.toml", "w") as file:
                file.write(text)
            status, _, message = command_line("sweep", "x.toml")
            self.assertEqual(status, 1, text)
            found = error_of(corpuscle.sweep, "x.toml")
            self.assertIn(found, message)
            if "\n" in text:
                self.assertEqual(error_of(corpuscle.sweep, text).replace("sweep.toml", "x.toml"), found)
        self.assertIn(error_of(corpuscle.sweep, "none.toml"), command_line("sweep", "none.toml")[2])
        self.assertIn(error_of(corpuscle.sweep, "grid.toml", shard="5/3"), command_line("sweep", "grid.toml", "--shard", "5/3")[2])
        self.assertFalse([f for f in os.listdir() if f.endswith(".sqlite")])

    def test_of_results(self):
        result = corpuscle.sweep("grid.toml")
        with open("own.sqlite", "w") as file:
            file.write("mine")
        for path in ("none.sqlite", "grid.toml", "own.sqlite", "."):
            self.assertIn(error_of(corpuscle.read_sweep, path), command_line("sweep", "show", path)[2])
        self.assertIn("own.sqlite", error_of(corpuscle.sweep, "grid.toml", "own.sqlite"))
        with open("own.sqlite") as file:
            self.assertEqual(file.read(), "mine")
        with open("grid.toml", "w") as file:
            file.write(GRID.replace("3N", "4N"))
        self.assertIn(error_of(corpuscle.sweep, "grid.toml"), command_line("sweep", "grid.toml")[2])
        self.assertIn("there are press.F_max", error_of(lambda: result["spike"]))
        self.assertIn("there is no measure 'x'", error_of(result.plot, "x"))
        self.assertIn("there is no axis 'x'", error_of(result.plot, axis="x"))

    def test_of_arguments(self):
        for options, message in ((dict(seed=-1), "seed = -1 is outside"), (dict(samples=0), "samples = 0 must be above 0"), (dict(samples=1.5), "is not an integer"),
                                 (dict(threads=-1), "threads = -1 is outside"), (dict(progress=3), "is not a function"), (dict(shard=3), "write K/N"),
                                 (dict(results=3), "is not a path")):
            self.assertIn(message, error_of(corpuscle.sweep, "grid.toml", **options))
        self.assertIn("is not a path", error_of(corpuscle.sweep, None))

    def test_if_no_item_converges(self):
        with open("none.cir", "w") as file:
            file.write("t\n.param a=1\ni1 0 x 1\nb1 x 0 i={a}*(v(x)*v(x)+0.5)\n.op\n.print op v(x)\n.step param a list 4 5\n")
        status, _, message = command_line("sweep", "none.cir", "-o", "program.sqlite")
        self.assertEqual(status, 3)
        with self.assertRaises(corpuscle.NotConvergedError) as raised:
            corpuscle.sweep("none.cir", "python.sqlite")
        self.assertIn(str(raised.exception), message)
        stored = corpuscle.read_sweep("python.sqlite")
        self.assertEqual(list(stored.ended), ["diverged"] * 2)
        self.assertEqual([item for item, _ in stored.failures], [0, 1])
        self.assertTrue(stored._repr_html_())


class Intervals(InAFolder):
    RANDOM = '[[vary]]\nwhat = "f_B"\nhow = "normal"\nsigma = "5%"\n'
    LISTED = '[[vary]]\nwhat = "press.F_max"\nlist = ["1N", "2N"]\n'

    def document(self, axes):
        with open("intervals.toml", "w") as file:
            file.write('afferent = "sa1"\nforce = "press"\nmeasures = ["first_spike"]\nsamples = 3\n' + axes)
        for arguments in (["intervals.toml", "--out", "intervals.sqlite", "--quiet"], ["show", "intervals.sqlite", "--json"]):
            status, printed, message = command_line("sweep", *arguments)
            self.assertEqual(status, 0, message)
        os.remove("intervals.sqlite")
        document = json.loads(printed)
        return [one["is_listed"] for one in document["axes"]], document["all"]["measures"][0]["mean"]["low"], document["points"][0]["yield"]["low"]

    def test_items_at_several_listed_values_have_none_together_but_each_point_has_one(self):
        listed, of_all, of_point = self.document(self.RANDOM + self.LISTED)
        self.assertEqual(listed, [False, True])
        self.assertIsNone(of_all)
        self.assertIsNotNone(of_point)

    def test_random_items_have_one_although_they_are_few(self):
        listed, of_all, _ = self.document(self.RANDOM)
        self.assertEqual(listed, [False])
        self.assertIsNotNone(of_all)


class Interruption(InAFolder):
    def test_after_ctrl_c_it_computes_for_at_most_a_fifth_of_a_second_and_the_same_call_resumes(self):
        program = (f"import corpuscle\nprint('ready', flush=True)\ntry:\n    corpuscle.sweep({CHIPS!r}, 'chips.sqlite')\n"
                   "except KeyboardInterrupt as stop:\n    print('stopped', stop, flush=True)\n    input()\n")
        with subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "ready\n")
            while not os.path.exists("chips.sqlite") or len(corpuscle.read_sweep("chips.sqlite")) == 0:
                time.sleep(0.05)
            child.send_signal(signal.SIGINT)
            start = processor_seconds(child.pid)
            line = child.stdout.readline()
            computed = processor_seconds(child.pid) - start
            child.communicate("\n")
        self.assertTrue(line.startswith("stopped"), line)
        self.assertLess(computed, 0.2)
        done = len(corpuscle.read_sweep("chips.sqlite"))
        self.assertGreater(done, 0)

        def until_three_more(fraction):
            return fraction * (1000 - done) < 3

        with self.assertRaises(KeyboardInterrupt) as raised:
            corpuscle.sweep(CHIPS, "chips.sqlite", progress=until_three_more)
        self.assertRegex(str(raised.exception), "interrupted|^$")
        self.assertGreater(len(corpuscle.read_sweep("chips.sqlite")), done)


if __name__ == "__main__":
    unittest.main()
