"""Circuits: the numbers and texts of `corpuscle run`, closed forms, errors."""

import copy
import glob
import json
import math
import os
import pickle
import tempfile
import unittest

import corpuscle
import numpy as np
from support import ROOT, command_line, error_of

RC = "\n".join(["RC low-pass", ".param r=1k", "v1 in 0 dc 1 ac 1 pulse(0 1 0 1n 1n 1 2)", "r1 in out {r}", "c1 out 0 1u", ".tran 10u 5m",
                ".meas tran tau when v(out)=0.632120559", ".end", ""])
NO_SOLUTION = "a current that no voltage takes\n.param a=4\ni1 0 x 1\nb1 x 0 i={a}*(v(x)*v(x)+0.5)\n.op\n"
DECKS = sorted(glob.glob(f"{ROOT}/test/circuit/decks/**/*.cir", recursive=True)) + [f"{ROOT}/circuits/divider.cir", f"{ROOT}/circuits/spiker.cir"]


def finite(values):
    """Values as JSON has them: None for NaN, pairs for complex numbers."""
    one = lambda x: None if not math.isfinite(x) else x
    return [[one(v.real), one(v.imag)] if isinstance(v, complex) else one(v) for v in np.atleast_1d(values).tolist()]


class Numbers(unittest.TestCase):
    def test_are_those_of_the_command_line(self):
        self.assertGreater(len(DECKS), 70)
        for path in DECKS:
            status, output, message = command_line("run", path, "--json")
            with self.subTest(path=path):
                if status not in (0, 1) or not output:
                    self.assertIn(error_of(corpuscle.circuit(path).run, progress=False), message)
                    continue
                document = json.loads(output)
                result = corpuscle.circuit(path).run(progress=False)
                steps, documents = (result.steps, document) if isinstance(document, list) else ([result], [document])
                self.assertEqual(len(steps), len(documents))
                for step, expected in zip(steps, documents):
                    self.compare(step, expected)

    def compare(self, result, expected):
        self.assertEqual(result.title, expected["title"])
        self.assertEqual([p.name for p in result.plots], [p["plot"] for p in expected["plots"]])
        for plot, stated in zip(result.plots, expected["plots"]):
            self.assertEqual({n: finite(plot[n]) for n in plot}, stated["curves"])
            self.assertEqual(set(plot.units), set(stated["curves"]))
        self.assertEqual({n: finite(v)[0] for n, v in result.measures.items()}, expected["numbers"])
        unmet = [e for e in expected["expectations"] if not e["met"]]
        self.assertEqual(result.warnings[:len(expected["warnings"])], expected["warnings"])
        self.assertEqual(len(result.warnings) - len(expected["warnings"]), bool(unmet))
        self.assertEqual(result.expectations, expected["expectations"])
        self.assertEqual([a.name for a in result.analyses], [a["analysis"] for a in expected["analyses"]])
        for analysis, stated in zip(result.analyses, expected["analyses"]):
            self.assertEqual({n: int(v) for n, v in analysis.counters.items()}, {n: stated[n] for n in analysis.counters})
        self.assertEqual(result.spikes is not None, "spikes" in expected)
        if result.spikes is not None:
            self.assertEqual(result.spikes.tolist(), expected["spikes"][0])

    def test_with_settings_are_those_of_the_command_line(self):
        options = ["--corner", "ff", "--temp", "85", "--mismatch", "7/3", "--set", "summer.N3B=8x4", "--probe", "i(N3B)"]
        document = json.loads(command_line("run", "sa1-circuit", "--json", *options)[1])
        circuit = corpuscle.circuit("sa1-circuit", {"summer.N3B": "8x4"}, corner="ff", temp=85, mismatch="7/3", probe=["i(N3B)"])
        result = circuit.run()
        self.compare(result, document)
        self.assertIn("i(xsummer.mn3b)", result.names)

    def test_of_the_files_are_those_of_the_arrays(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "rc.csv")
            netlist = os.path.join(folder, "rc.cir")
            with open(netlist, "w") as file:
                file.write(RC)
            command_line("run", netlist, "-o", path)
            table = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
            result = corpuscle.circuit(netlist).tran()
            for name in result:
                np.testing.assert_allclose(result[name], table[name], rtol=1e-8, atol=1e-30)


class ClosedForms(unittest.TestCase):
    def setUp(self):
        self.circuit = corpuscle.circuit(RC)

    def test_of_all_analyses_of_an_rc_filter(self):
        self.assertEqual(float(self.circuit.op()["v(out)"]), 1)
        np.testing.assert_allclose(self.circuit.dc("v1", 0, 1, 0.25)["v(out)"], [0, 0.25, 0.5, 0.75, 1], atol=1e-9)
        response = self.circuit.ac("dec", 10, 1, "1meg")
        exact = 1 / (1 + 2j * np.pi * response.frequency * 1e-3)
        np.testing.assert_allclose(response["v(out)"], exact, rtol=1e-9)
        np.testing.assert_allclose(response["vdb(out)"], 20 * np.log10(abs(exact)), rtol=1e-9)
        tran = self.circuit.tran("10u", 5e-3)
        np.testing.assert_allclose(tran["v(out)"], 1 - np.exp(-tran.time / 1e-3), atol=2e-4)
        np.testing.assert_array_equal(tran["v(in,out)"], tran["v(in)"] - tran["v(out)"])
        self.assertAlmostEqual(tran.measures["tau"], 1e-3, delta=2e-6)
        noise = self.circuit.noise("v(out)", "v1", "dec", 20, 0.01, "100meg")
        self.assertAlmostEqual(noise.measures["onoise_total"], math.sqrt(1.380649e-23 * 300.15 / 1e-6), delta=3e-10)
        self.assertEqual(noise.units["onoise_spectrum"], "V/sqrt(Hz)")
        pole = self.circuit.pz("in", 0, "out", 0, "vol", "pol").plots[0]
        np.testing.assert_allclose(complex(pole[pole.names[0]]), -1e3, rtol=1e-9)

    def test_a_parameter_and_a_temperature_change_them(self):
        hot = corpuscle.circuit(RC, {"r": 2e3}, temp=85)
        self.assertAlmostEqual(hot.tran("10u", "10m").measures["tau"], 2e-3, delta=4e-6)
        total = hot.noise("v(out)", "v1", "dec", 20, 0.01, "100meg").measures["onoise_total"]
        self.assertAlmostEqual(total, math.sqrt(1.380649e-23 * 358.15 / 1e-6), delta=4e-10)

    def test_steps(self):
        result = corpuscle.circuit(RC.replace(".end", ".step param r list 1k 3k")).tran()
        self.assertEqual([s.step for s in result.steps], ["r=1000", "r=3000"])
        np.testing.assert_allclose(result.measures["tau"], [1e-3, 3e-3], rtol=3e-3)
        table = result.to_pandas()
        self.assertEqual(list(table["step"].unique()), ["r=1000", "r=3000"])
        self.assertEqual(len(table), sum(len(s) for s in result.steps))
        self.assertIn("take the curve of one: steps[0]", error_of(lambda: result["v(out)"]))


class Arrays(unittest.TestCase):
    def test_show_memory_of_the_library_and_outlive_the_result(self):
        result = corpuscle.circuit(RC).tran("1u", "5m")
        first, second = result["v(out)"], result["v(out)"]
        self.assertTrue(np.shares_memory(first, second))
        self.assertFalse(first.flags.writeable or first.flags.owndata)
        expected = first.tolist()
        del result, second
        self.assertEqual(first.tolist(), expected)
        computed = corpuscle.circuit(RC).ac("dec", 10, 1, 100)["vdb(out)"]
        self.assertEqual(computed.shape, (21,))
        self.assertTrue(np.isfinite(computed).all())

    def test_travel_between_processes(self):
        circuit = corpuscle.circuit(RC)
        for result in (circuit.op(), circuit.ac("dec", 10, 1, 100), circuit.tran()):
            for other in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
                for name in [*result.names, "v(in,out)"]:
                    np.testing.assert_array_equal(other[name], result[name])
                self.assertEqual(other.measures, result.measures)
        self.assertEqual(pickle.loads(pickle.dumps(circuit)).nodes, ["in", "out"])

    def test_become_tables_pictures_and_html(self):
        circuit = corpuscle.circuit(RC)
        tran = circuit.tran()
        self.assertEqual(list(tran.to_pandas().columns), tran.names)
        axes = tran.plot("v(out)", "v(in)")
        self.assertEqual(len(axes.lines), 2)
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), tran["v(out)"])
        self.assertEqual(circuit.ac("dec", 10, 1, 100).plot("v(out)").get_xscale(), "log")
        for result in (circuit.op(), tran, circuit.ac("dec", 10, 1, 100), corpuscle.circuit(RC.replace(".end", ".step param r list 1k 3k")).tran()):
            page = result._repr_html_()
            self.assertIn("<table>", page)
            self.assertEqual("data:image/png" in page, len(result) > 1 or bool(result.steps))
        self.assertIn("&lt;b&gt;", corpuscle.circuit(RC.replace("RC low-pass", "<b>")).op()._repr_html_())
        self.assertIn("no swept quantity", error_of(circuit.op().plot))
        self.assertIn("tau = 1.0", repr(tran))


class Errors(unittest.TestCase):
    def test_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            def check(netlist, *arguments, **options):
                path = os.path.join(folder, "x.cir")
                with open(path, "w") as file:
                    file.write(netlist)
                status, _, message = command_line("run", path, *arguments)
                text = error_of(lambda: corpuscle.circuit(path, **options).run())
                self.assertEqual(status, 3 if netlist == NO_SOLUTION else 1, message)
                for option in ("--corner ", "--temp "):  # in Python these are settings
                    message = message.replace(option, option[2:-1] + "=")
                for line in text.split("\n"):
                    self.assertIn(line, message)
            check("title\nr1 a 0\n")
            check("title\nr1 a 0\nr2 b 0\n")
            check("title\nr1 a 0 1k\n")
            check(RC.replace(".tran 10u 5m", ".tran 10u -5m"))
            check(RC.replace(".tran 10u 5m", ".dc v9 0 1 0.1"))
            check(RC, "--set", "rr=1", settings={"rr": "1"})
            check(RC, "--set", "r1=-x", settings={"r1": "-x"})
            check(RC, "--corner", "qq", corner="qq")
            check(RC, "--temp", "nan", temp=float("nan"))
            check(RC, "--temp", "-300.0", temp=-300.0)
            check(RC, "--probe", "v(nowhere)", probe="v(nowhere)")
            check(NO_SOLUTION)
        path = "/no/such/file.cir"
        self.assertIn(error_of(corpuscle.circuit, path), command_line("run", path)[2])

    def test_what_does_not_converge_says_where(self):
        with self.assertRaisesRegex(corpuscle.NotConvergedError, "no operating point"):
            corpuscle.circuit(NO_SOLUTION).op()
        result = corpuscle.circuit(NO_SOLUTION + ".step param a list 1 4 1\n").op()
        self.assertIn("no operating point", result.steps[1].error)
        self.assertAlmostEqual(float(result.steps[2]["v(x)"]), math.sqrt(0.5), delta=1e-6)
        self.assertIn("1 of 3 did not converge", result.warnings[0])
        with self.assertRaises(corpuscle.NotConvergedError):
            result.steps[1]["v(x)"]
        self.assertIn("no operating point", repr(result.steps[1]))
        self.assertIn("<table>", result._repr_html_())

    def test_of_arguments(self):
        circuit = corpuscle.circuit(RC)
        for words, message in (((), "the netlist has no .dc; add one, or give the words of .dc SOURCE"), (("v1", 0, 1, float("nan")), "'nan' is not a number"),
                               (("v1", 0, 1, -0.1), "step -0.1 does not lead from 0 to 1"), (("v1", 0, 1), "expected .dc SOURCE"),
                               (("v1", 0, 1, "1\n.end"), "the character '\\n' is not allowed"), (("v1", 0, "(1", 1), ".dc v1 0 (1 1: "),
                               (("v1", 0, 1, 1e-12), "the maximum is 10000000"), (("", "", "", ""), "0 words; expected .dc"), ((None, 0, 1, 1), "'none' is not a source")):
            self.assertIn(message, error_of(circuit.dc, *words))
        self.assertIn("did you mean 'v(out)'", error_of(lambda: circuit.op()["v(ou)"]))
        for name in ("", "v(", "v(out", "((", "par('", "v(out)+", "x" * 100000, "é"):
            self.assertIn("there is no curve", error_of(lambda: circuit.op()[name]))
        for source in (None, 7, "\0", "", b"\xff.cir"):
            self.assertTrue(error_of(corpuscle.circuit, source))
        for settings in ("r", "r=", "=1", ["r=1", 3]):
            self.assertTrue(error_of(corpuscle.circuit, RC, settings))
        self.assertIn("is not a function", error_of(circuit.op, progress=3))
        with self.assertRaises(TypeError):
            corpuscle.circuit(RC, temperature=3)

    def test_of_an_object_that_was_not_initialised(self):
        with self.assertRaises(AttributeError):
            corpuscle.Circuit.__new__(corpuscle.Circuit).op()


if __name__ == "__main__":
    unittest.main()
