"""Warnings and notes: those of the command line, shown once as Python warnings."""

import os
import tempfile
import unittest
import warnings

import corpuscle
import numpy as np
from support import ROOT, command_line, press


def noisy_file(folder):
    """A recording of a press with noise of 4 mN at 100 Hz."""
    random = np.random.default_rng(3)
    force = press(100.0).repeat(3) + 4e-3 * random.standard_normal(300)
    path = os.path.join(folder, "noisy.csv")
    np.savetxt(path, force, fmt="%.6f", header="F_N", comments="")
    return path


def caught(function, *arguments, **options):
    """(result, texts of the corpuscle warnings, their file names)."""
    with warnings.catch_warnings(record=True) as shown:
        warnings.simplefilter("always")
        result = function(*arguments, **options)
    ours = [w for w in shown if issubclass(w.category, corpuscle.Warning)]
    return result, [str(w.message) for w in ours], {w.filename for w in ours}


class TextsAreThoseOfTheCommandLine(unittest.TestCase):
    def compare(self, response, shown, *arguments):
        """Every warning and note is printed by the command line, and nothing else is. Returns all of them."""
        status, _, printed = command_line("respond", *arguments)
        self.assertEqual(status, 0, printed)
        lines = [line.removeprefix("corpuscle: ").removeprefix("warning: ") for line in printed.splitlines()]
        texts = response.warnings + response.notes
        for text in texts:
            self.assertTrue(any(line.endswith(text) for line in lines), (text, lines))
        self.assertEqual(len(texts), len(lines), (texts, lines))
        self.assertEqual(shown, response.warnings)
        return "\n".join(texts)

    def test_of_excessive_rates(self):
        response, shown, _ = caught(corpuscle.respond, "press", afferent="sa1", settings={"press.F_max": "1 kN"})
        texts = self.compare(response, shown, "press", "--afferent", "sa1", "--set", "press.F_max=1kN")
        self.assertIn("a nerve fibre fires at no more than about 1 kHz", texts)
        self.assertEqual(len(response.warnings), 1)

    def test_of_truncated_steps(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "strong.csv")
            np.savetxt(path, 1e5 * press(), fmt="%.6g", header="F_N", comments="")
            force = caught(corpuscle.read, path, rate=1000)[0]
            response, shown, _ = caught(corpuscle.respond, force, afferent="sa1")
            texts = self.compare(response, response.warnings, path, "--rate", "1000", "--afferent", "sa1")
            self.assertIn("had more spikes than one step can hold", texts)

    def test_of_silent_afferents(self):
        response, shown, _ = caught(corpuscle.respond, "press", settings={"press.F_min": 0, "press.F_max": "1 mN"})
        texts = self.compare(response, shown, "press", "--set", "press.F_min=0", "--set", "press.F_max=1mN")
        self.assertIn("sa1 never fired: the largest force was 0.001 N; it would fire at about", texts)
        self.assertEqual(shown, [])

    def test_of_silent_skins_with_the_remedy(self):
        response, shown, _ = caught(corpuscle.grid(3, 3).respond, "press", settings={"press.F_min": 0, "press.F_max": "1 mN"})
        texts = self.compare(response, shown, "press", "--population", "grid 3x3", "--set", "press.F_min=0", "--set", "press.F_max=1mN")
        self.assertIn("no afferent fired", shown[0])
        self.assertIn("try --set press.F_max=", texts)

    def test_of_a_low_rate_and_of_noise_without_effect(self):
        response, shown, _ = caught(corpuscle.respond, "press", 500, ["fa2", "sa1-kim"], noise=1e-9)
        self.compare(response, shown, "press", "--rate", "500Hz", "--afferent", "fa2,sa1-kim", "--noise", "1nA")
        self.assertEqual(len(shown), 3)

    def test_of_unfelt_shear(self):
        response, shown, _ = caught(corpuscle.grid(4, 4).respond, "press", settings={"contact.tilt": 0.2})
        self.assertIn("the shear has no effect", self.compare(response, shown, "press", "--population", "grid 4x4", "--set", "contact.tilt=0.2"))

    def test_of_the_noise_of_a_sensor(self):
        with tempfile.TemporaryDirectory() as folder:
            path = noisy_file(folder)
            force, of_force, _ = caught(corpuscle.read, path, rate=100)
            response, shown, _ = caught(corpuscle.respond, force, afferent="fa1-nerve")
            self.assertEqual(of_force + shown, response.warnings)
            texts = self.compare(response, response.warnings, path, "--rate", "100", "--afferent", "fa1-nerve")
            self.assertIn("Use --zero 500ms --deadband auto", texts)
            status, _, printed = command_line("stream", "--in", path, "--rate", "100", "--pace", "fast", "--population", "fa1-nerve", "--out", os.path.join(folder, "s.csv"))
            self.assertEqual(status, 0, printed)
            self.assertIn("the noise of the sensor, about ", printed)


class Shown(unittest.TestCase):
    def test_at_the_line_of_the_caller(self):
        for function, arguments, options in ((corpuscle.respond, ("press",), {"settings": {"press.F_max": "1 kN"}}),
                                             (corpuscle.grid(3, 3).respond, ("press",), {"settings": {"press.F_max": "1 mN"}})):
            _, texts, files = caught(function, *arguments, **options)
            self.assertTrue(texts)
            self.assertEqual({os.path.basename(f) for f in files}, {"warnings_test.py"})

    def test_once_with_the_filter_of_python(self):
        with warnings.catch_warnings(record=True) as shown:
            warnings.simplefilter("default")
            for _ in range(3):
                corpuscle.respond("press", afferent="sa1", settings={"press.F_max": "1 kN"})
        self.assertEqual(len(shown), 1)

    def test_they_can_be_errors_or_ignored(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", corpuscle.Warning)
            with self.assertRaises(corpuscle.Warning):
                corpuscle.respond("press", afferent="sa1", settings={"press.F_max": "1 kN"})
            warnings.simplefilter("ignore", corpuscle.Warning)
            self.assertEqual(len(corpuscle.respond("press", afferent="sa1", settings={"press.F_max": "1 kN"}).warnings), 1)

    def test_a_good_run_shows_none(self):
        response, shown, _ = caught(corpuscle.respond, "press")
        self.assertEqual((response.warnings, shown), ([], []))


class Origins(unittest.TestCase):
    """A recording or a stimulus keeps its phases, parameters and quality on the way through Python."""

    def test_the_summary_is_that_of_the_command_line(self):
        import copy
        import json
        import pickle
        path = f"{ROOT}/examples/data/touch.csv"
        for force, arguments in ((corpuscle.press(F_max="2 N"), ["press", "--set", "press.F_max=2N"]), (corpuscle.sine(f=20), ["sine", "--set", "sine.f=20"]),
                                 (corpuscle.read(path, unit="N"), [path, "--unit", "N"])):
            document = json.loads(command_line("respond", *arguments, "--json")[1])
            for same in (force, copy.deepcopy(force), pickle.loads(pickle.dumps(force))):
                summary = caught(corpuscle.respond, same)[0].summary
                self.assertEqual({**summary, "inputs": None}, {**{k: v for k, v in document.items() if k not in ("spikes", "files")}, "inputs": None})
                self.assertEqual(summary["inputs"], document["inputs"])


if __name__ == "__main__":
    unittest.main()
