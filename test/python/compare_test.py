"""Comparisons: the numbers and the text of `corpuscle compare`, closed forms, errors."""

import json
import os
import tempfile
import unittest

import corpuscle
import numpy as np
from support import ROOT, command_line, error_of


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        for name, f_B in (("one", 20), ("two", 25)):
            status, _, message = command_line("respond", "press", "--afferent", "sa1,fa1", "--set", f"sa1.f_B={f_B}Hz", "--out", name, "--npz")
            self.assertEqual(status, 0, message)

    def responses(self):
        return [corpuscle.respond("press", afferent=["sa1", "fa1"], settings={"sa1.f_B": f"{f} Hz"}) for f in (20, 25)]

    def check(self, comparison, *arguments):
        status, output, message = command_line("compare", *arguments, "--json")
        self.assertEqual(status, 0, message)
        self.assertEqual(comparison.document, json.loads(output))
        self.assertEqual(repr(comparison) + "\n", command_line("compare", *arguments)[1])
        fields = ["spikes_a", "spikes_b", "matched", "missing", "extra", "victor_purpura", "van_rossum"]
        for pair, stated in zip([*comparison.pairs, comparison.total], [*comparison.document["pairs"], comparison.document["total"]]):
            self.assertEqual([pair[f] for f in fields], [stated[f] for f in fields])


class Numbers(InAFolder):
    def test_of_files_are_those_of_the_command_line(self):
        files = ["one/spikes.csv", "two/spikes.csv"]
        self.check(corpuscle.compare(*files), *files)
        self.check(corpuscle.compare(*files, window=2e-3, cost=50, tau=0.02), *files, "--window", "2ms", "--cost", "50Hz", "--tau", "20ms")
        self.check(corpuscle.compare(*files, pairs={"sa1": "fa1"}), *files, "--pair", "sa1=fa1")
        self.check(corpuscle.compare(*files, by_order=True), *files, "--by-order")

    def test_of_responses_are_those_of_their_files(self):
        one, two = self.responses()
        document = json.loads(command_line("compare", "one/spikes.npz", "two/spikes.npz", "--json")[1])
        for a, b in ((one, two), (one, "two/spikes.npz"), ("one/spikes.npz", two)):
            comparison = corpuscle.compare(a, b)
            ours = {p["a"].split(",")[0]: p for p in comparison.pairs}
            for stated in document["pairs"]:
                pair = ours[stated["a"].split(",")[0]]
                fields = ("spikes_a", "spikes_b", "matched", "victor_purpura", "van_rossum")
                self.assertEqual([pair[f] for f in fields], [stated[f] for f in fields])

    def test_agree_with_closed_forms(self):
        same = corpuscle.compare([0.1, 0.2, 0.3], [0.1, 0.2, 0.3])
        self.assertEqual([same.total[f] for f in ("matched", "missing", "extra", "max_shift_s", "victor_purpura", "van_rossum")], [3, 0, 0, 0, 0, 0])
        shifted = corpuscle.compare({"x": [0.1, 0.2]}, {"x": [0.101, 0.202]}, cost=100).pairs[0]
        self.assertAlmostEqual(shifted["victor_purpura"], 0.3, delta=1e-12)
        self.assertAlmostEqual(shifted["max_shift_s"], 0.002, delta=1e-12)
        self.assertAlmostEqual(shifted["rms_shift_s"], np.sqrt((1e-6 + 4e-6) / 2), delta=1e-12)
        # Two single spikes: D^2 = 1 - exp(-|t - u| / tau), of which a lone spike is 1/2; scaled so that one extra spike is 1.
        pair = corpuscle.compare([0.1], [0.15], tau=0.02).total
        self.assertAlmostEqual(pair["van_rossum"], np.sqrt(2 * (1 - np.exp(-0.05 / 0.02))), delta=1e-9)
        extra = corpuscle.compare([], [0.5]).total
        self.assertEqual([extra["extra"], extra["victor_purpura"]], [1, 1])
        self.assertAlmostEqual(extra["van_rossum"], 1, delta=1e-12)
        self.assertTrue(np.isnan(extra["max_shift_s"]))

    def test_of_a_chip_and_its_model(self):
        chip = corpuscle.circuit("sa1-circuit").tran()
        comparison = corpuscle.compare(corpuscle.respond("press", afferent="sa1"), chip, window=0.02)
        self.assertEqual(comparison.total["spikes_b"], len(chip.spikes))

    def test_show_themselves(self):
        comparison = corpuscle.compare(*self.responses())
        self.assertIn("data:image/png", comparison._repr_html_())
        self.assertEqual(len(comparison.to_pandas()), 2)
        self.assertEqual(sum(p.get_width() for p in comparison.plot().patches), sum(p["matched"] + p["missing"] + p["extra"] for p in comparison.pairs))


class Errors(InAFolder):
    def test_are_those_of_the_command_line(self):
        files = ["one/spikes.csv", "two/spikes.csv"]
        for arguments, options, line in ((["none.csv", files[1]], {}, []), ([f"{ROOT}/examples/data/touch.toml", files[1]], {}, []),
                                         (files, dict(pairs="sa1=x"), ["--pair", "sa1=x"]), (files, dict(pairs=["sa1"]), ["--pair", "sa1"])):
            status, _, message = command_line("compare", *arguments, *line)
            self.assertIn(status, (1, 2))
            self.assertIn(error_of(corpuscle.compare, *arguments, **options), message)

    def test_of_arguments(self):
        for options, message in ((dict(window=0), "window = 0 s must be above 0"), (dict(window=-1), "must be above 0"), (dict(window=np.nan), "must be above 0"),
                                 (dict(cost=-1), "cost = -1 Hz must be 0 or more"), (dict(tau=np.inf), "tau = inf s must be above 0"),
                                 (dict(window="5ms"), "is not a number"), (dict(progress=1), "is not a function")):
            self.assertIn(message, error_of(corpuscle.compare, [0.1], [0.2], **options))
        for times, message in (([[0.1]], "has 2 dimensions"), ([np.nan], "is not a finite number"), (["a"], "not an array of real numbers"), ([1j], "complex"),
                               (None, "has 0 dimensions")):
            self.assertIn(message, error_of(corpuscle.compare, [0.1], times))
        self.assertIn("has no spikes", error_of(corpuscle.compare, [0.1], corpuscle.circuit("t\nv1 a 0 1\nr1 a 0 1\n").op()))


if __name__ == "__main__":
    unittest.main()
