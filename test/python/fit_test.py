"""corpuscle.fit() finds what `corpuscle fit afferent` finds, and refuses the same data."""

import json
import os
import tempfile
import unittest

import corpuscle
import numpy as np
from support import ROOT, command_line

DATA = os.path.join(ROOT, "examples", "data")
TOUCH, SPIKES, TARGETS = (os.path.join(DATA, name) for name in ("touch.csv", "touch_spikes.csv", "targets.csv"))
QUICK = {"starts": 2, "points": 20}
QUICK_OPTIONS = ["--starts", "2", "--points", "20", "--json"]


class SameAsTheCommandLine(unittest.TestCase):
    def setUp(self):
        self.force = corpuscle.read(TOUCH)

    def test_spikes_of_a_file(self):
        fit = corpuscle.fit(self.force, SPIKES, free=["k_A", "K_B"], hold_out=0.2, **QUICK)
        status, out, err = command_line("fit", "afferent", TOUCH, "--spikes", SPIKES, "--free", "k_A,K_B", "--hold-out", "0.2", *QUICK_OPTIONS)
        self.assertEqual(status, 0, err)
        document = json.loads(out)
        self.assertEqual(fit.document["parameters"], document["parameters"])
        self.assertEqual(fit.document["score"], document["score"])
        self.assertEqual([p.value for p in fit.parameters], [p["value"] for p in document["parameters"]])
        self.assertEqual(fit.test_score, document["score"]["test"])

    def test_a_table_of_targets(self):
        fit = corpuscle.fit(targets=TARGETS, free="k_A", bounds={"f_B": ("5 Hz", 50)}, **QUICK)
        status, out, err = command_line("fit", "afferent", "--targets", TARGETS, "--free", "k_A", "--bounds", "f_B=5Hz:50Hz", *QUICK_OPTIONS)
        self.assertEqual(status, 0, err)
        self.assertEqual(fit.document["parameters"], json.loads(out)["parameters"])

    def test_refusals_have_the_same_text(self):
        for given, options in (({"free": "k_Q"}, ["--free", "k_Q"]), ({"free": "k_A", "afferent": "sa1-circuit"}, ["--free", "k_A", "-a", "sa1-circuit"]),
                               ({"free": "k_A", "settings": {"k_B": 1}}, ["--free", "k_A", "--set", "sa1.k_B=1"])):
            with self.subTest(given), self.assertRaises(corpuscle.InputError) as refused:
                corpuscle.fit(self.force, SPIKES, **given)
            self.assertIn(str(refused.exception), command_line("fit", "afferent", TOUCH, "--spikes", SPIKES, *options)[2])


class Fits(unittest.TestCase):
    def setUp(self):
        rate = 2000
        t = np.arange(4 * rate) / rate
        self.force = corpuscle.Force(1 + np.sin(2 * np.pi * (0.5 + t) * t) ** 2, rate)
        self.truth = {"k_A": 1.6e-6, "f_B": 14.0}
        self.response = corpuscle.respond(self.force, afferent="sa1", settings=self.truth)

    def check(self, fit):
        for name, value in self.truth.items():
            self.assertAlmostEqual(fit[name] / value, 1, delta=0.01)

    def test_known_values_are_recovered_from_a_response_an_array_a_delayed_train_and_repetitions(self):
        train = self.response.train()
        for spikes, options in ((self.response, {}), (train, {}), (train + 0.012, {"delay": 0.012}), ([train, train], {})):
            fit = corpuscle.fit(self.force, spikes, free=list(self.truth), **options)
            self.check(fit)
        again = corpuscle.respond(self.force, afferent=fit.afferent, settings=fit.settings)
        self.assertEqual(len(again), len(self.response))
        self.assertLess(np.abs(again.times - self.response.times).max(), 1e-3)

    def test_several_recordings(self):
        hold = corpuscle.Force(np.full(4000, 1.5), 2000)
        pairs = [(force, corpuscle.respond(force, afferent="sa1", settings=self.truth)) for force in (self.force, hold)]
        self.check(corpuscle.fit(pairs, free=list(self.truth)))

    def test_the_result_does_not_depend_on_threads(self):
        one, two = (corpuscle.fit(self.force, self.response, free="k_A", threads=n, **QUICK) for n in (1, 2))
        self.assertEqual(one.document, two.document)

    def test_progress_rises_and_can_end_the_search_with_the_best_values_so_far(self):
        fractions = []
        stopped = corpuscle.fit(self.force, self.response, free="k_A", starts=10000, progress=lambda f: fractions.append(f) or len(fractions) < 3)
        self.assertTrue(stopped.is_interrupted)
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(len(fractions), 3)
        with self.assertRaises(ZeroDivisionError):
            corpuscle.fit(self.force, self.response, free="k_A", starts=10000, progress=lambda f: 1 / 0)

    def test_the_saved_file_sets_the_values_and_replaces_nothing(self):
        fit = corpuscle.fit(self.force, self.response, free="k_A", **QUICK)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "fitted.toml")
            fit.save(path)
            with open(path) as file:
                self.assertIn(f"k_A = {fit['k_A']:.6g}", file.read())
            with self.assertRaisesRegex(corpuscle.InputError, "exists"):
                fit.save(path)

    def test_bad_data_are_refused(self):
        press = self.force
        for match, arguments in (("no data", {"force": press}), ("no data", {"force": [press]}), ("rate of the force", {"force": [1.0], "spikes": [1.0]}),
                                 ("not a finite number", {"force": press, "spikes": [np.nan]}), ("not a finite number", {"force": [np.nan], "spikes": [1.0], "rate": 1000}),
                                 ("2 channels", {"force": np.ones((9, 2)), "spikes": [1.0], "rate": 1000}), ("free", {"force": press, "spikes": [1.0], "free": ()}),
                                 ("one dimension", {"force": press, "spikes": np.ones((2, 2))}), ("no spike", {"force": press, "spikes": []}),
                                 ("either", {"force": press, "spikes": [1.0], "targets": TARGETS}), ("tau", {"force": press, "spikes": [1.0], "tau": 0}),
                                 ("hold_out", {"force": press, "spikes": [1.0], "hold_out": 1}), ("starts", {"force": press, "spikes": [1.0], "starts": 0}),
                                 ("low, high", {"force": press, "spikes": [1.0], "bounds": {"f_B": 3}}), ("no such train", {"force": press, "spikes": self.response, "train": "x"}),
                                 ("is not a function", {"force": press, "spikes": [1.0], "progress": 3})):
            with self.subTest(match, arguments=arguments), self.assertRaisesRegex(corpuscle.InputError, match):
                corpuscle.fit(**{"free": "k_A", **arguments})


class SpikeFiles(unittest.TestCase):
    def test_a_file_that_the_program_wrote_has_the_spikes_of_the_response(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(command_line("respond", "press", "--out", os.path.join(folder, "out"), "--quiet")[0], 0)
            trains = corpuscle.read_spikes(os.path.join(folder, "out", "spikes.csv"))
        response = corpuscle.respond("press")
        self.assertEqual(set(trains), set(response.names))
        for name, times in trains.items():
            np.testing.assert_allclose(times, response.train(name), atol=1e-9)

    def test_columns_are_chosen_by_name_and_faults_are_located(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "units.csv")
            with open(path, "w") as file:
                file.write("when,cell\n0.1,a\n0.2,b\n0.3,a\n")
            self.assertEqual({k: v.tolist() for k, v in corpuscle.read_spikes(path, time="when", train="cell").items()}, {"a": [0.1, 0.3], "b": [0.2]})
            with open(path, "a") as file:
                file.write("x,a\n")
            with self.assertRaisesRegex(corpuscle.InputError, "units.csv:5"):
                corpuscle.read_spikes(path, time="when", train="cell")


if __name__ == "__main__":
    unittest.main()
