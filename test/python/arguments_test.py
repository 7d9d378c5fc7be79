"""Arguments that are refused: an exception with the text of the command line, never a crash."""

import os
import tempfile
import unittest

import corpuscle
import numpy as np
from support import command_line, error_of, press


class Numbers(unittest.TestCase):
    def test_rates_outside_the_range_are_refused(self):
        for rate in (-1, -1000.0, 0, 1e13, 1e300, np.inf, np.nan):
            self.assertIn("Hz is outside [1e-06, 1e+12]", error_of(corpuscle.respond, press(), rate, "sa1"))
            self.assertIn("Hz is outside [1e-06, 1e+12]", error_of(corpuscle.respond, "press", rate, "sa1"))
            self.assertIn("Hz is outside [1e-06, 1e+12]", error_of(corpuscle.LiveSkin, "sa1", rate))

    def test_rates_that_are_not_numbers_are_refused(self):
        for rate in ("1000", "fast", [1000], 1j, True, object()):
            self.assertIn("is not a number", error_of(corpuscle.respond, press(), rate, "sa1"))
        self.assertIn("the rate of the force is missing", error_of(corpuscle.respond, press()))

    def test_another_rate_than_the_force_has_is_refused(self):
        self.assertIn("the force has 1000 Hz", error_of(corpuscle.respond, corpuscle.Force(press(), 1000), 500))

    def test_a_huge_rate_within_the_range_is_simulated(self):
        self.assertEqual(len(corpuscle.respond(np.zeros(10), 1e12, "sa1")), 0)

    def test_counts_that_are_not_counts_are_refused(self):
        for name, limit in (("seed", 2**64 - 1), ("threads", 1024), ("copies", 2**32 - 1)):
            for value in (-1, limit + 1):
                self.assertEqual(error_of(corpuscle.respond, press(), 1000, "sa1", **{name: value}), f"{name} = {value} is outside [0, {limit}]")
            for value in (1.5, "3", True):
                self.assertIn("is not an integer", error_of(corpuscle.respond, press(), 1000, "sa1", **{name: value}))

    def test_a_start_that_is_not_finite_is_refused(self):
        for start in (np.nan, np.inf):
            self.assertIn("not a finite time", error_of(corpuscle.respond, corpuscle.Force(press(), 1000, start=start)))

    def test_numpy_scalars_are_numbers(self):
        response = corpuscle.respond(press(), np.float32(1000), "sa1", seed=np.int64(3), settings={"f_B": np.float64(25)})
        self.assertEqual(response.times.tolist(), corpuscle.respond(press(), 1000, "sa1", settings={"f_B": "25 Hz"}).times.tolist())


class TextsAreThoseOfTheCommandLine(unittest.TestCase):
    def compare(self, arguments, function, *values, **options):
        status, _, message = command_line(*arguments)
        self.assertIn(status, (1, 2), message)
        self.assertIn(error_of(function, *values, **options), message)

    def test_of_unknown_names(self):
        self.compare(["respond", "press", "--afferent", "sa9"], corpuscle.respond, "press", afferent="sa9")
        self.compare(["respond", "press", "--afferent", "no/such.cir"], corpuscle.respond, "press", afferent="no/such.cir")
        self.compare(["respond", "press", "--population", "foot"], corpuscle.population("foot").respond, "press")
        self.compare(["respond", "press", "--population", "grid 0x3"], corpuscle.grid(0, 3).respond, "press")

    def test_of_settings(self):
        for setting in ("sa1.f_B=fast", "sa1.f_B=-1Hz", "sa1.f_X=1"):
            status, _, message = command_line("respond", "press", "--afferent", "sa1", "--set", setting)
            self.assertEqual(status, 1)
            text = error_of(corpuscle.respond, "press", afferent="sa1", settings=[setting])
            self.assertIn(text.removeprefix(setting).lstrip(": "), message)

    def test_of_recordings(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bad.csv")
            with open(path, "w") as file:
                file.write("time_s,fz\n0,1\n0.001,x\n0.002,1\n")
            for options, named in (([], {}), (["--unit", "kg2"], {"unit": "kg2"}), (["--channel", "fq"], {"channel": "fq"})):
                self.compare(["respond", path, *options], corpuscle.read, path, **named)
            self.compare(["respond", os.path.join(folder, "none.csv")], corpuscle.read, os.path.join(folder, "none.csv"))

    def test_unknown_options_are_refused(self):
        self.assertIn("colour", error_of(corpuscle.read, "x.csv", colour="red"))
        with self.assertRaises(TypeError):
            corpuscle.respond("press", colour="red")
        with self.assertRaises(AttributeError):
            corpuscle.pres
        self.assertIn("there is no catalogue 'stimulus'; did you mean 'stimuli'?", error_of(corpuscle.catalogue, "stimulus"))
        self.assertIn("F_mx", error_of(corpuscle.press, F_mx="2 N"))

    def test_texts_with_nul_and_with_other_alphabets_are_refused(self):
        for name in ("sa1\0", "сa1", "", "\ud800"):
            for call in (lambda: corpuscle.respond("press", afferent=name), lambda: corpuscle.respond(name + "x", afferent="sa1"),
                         lambda: corpuscle.respond("press", afferent="sa1", settings={name: 1}), lambda: corpuscle.population(name + "x").respond("press"),
                         lambda: corpuscle.LiveSkin(name + "x"), lambda: corpuscle.read(name + "x"), lambda: corpuscle.stimulus(name + "x"),
                         lambda: corpuscle.catalogue(name)):
                error_of(call)

    def test_no_afferent_or_another_method_is_refused(self):
        self.assertIn("there is no afferent", error_of(corpuscle.respond, "press", afferent=[]))
        self.assertIn("euler", error_of(corpuscle.respond, "press", method="euler"))
        self.assertIn("sa1.f_B=10% needs --copies N, such as --copies 100", error_of(corpuscle.respond, "press", afferent="sa1", spread={"f_B": "10%"}))


class Results(unittest.TestCase):
    def setUp(self):
        self.response = corpuscle.respond(press(), 1000, "sa1")

    def test_bins_and_events_are_checked(self):
        for bin in (0, -1, np.nan, np.inf):
            self.assertIn("must be above 0", error_of(self.response.rate, bin))
            self.assertIn("must be above 0", error_of(self.response.psth, [0.2], bin=bin))
        for events in ([], [np.nan], [[0.1]], ["a"]):
            error_of(self.response.psth, events)
        error_of(self.response.psth, [0.1], before=-1, after=0.5)

    def test_trains_that_do_not_exist_are_refused(self):
        for which in (1, -2, 10**12, "fa1"):
            self.assertIn("there is no afferent", error_of(self.response.train, which))
        self.assertIn("there is no afferent of type 'fa1'; there are sa1", error_of(self.response.rate, type="fa1"))

    def test_windows_and_trains_of_measures_are_checked(self):
        self.assertIn("must end after it begins", error_of(corpuscle.measures, [0.1], 1, 0))
        self.assertIn("must end after it begins", error_of(corpuscle.measures, [0.1], 0, np.nan))
        self.assertIn("not in order", error_of(corpuscle.measures, [0.2, 0.1], 0, 1))
        self.assertIn("not in order", error_of(corpuscle.measures, [0.1, np.nan], 0, 1))
        self.assertEqual(corpuscle.measures([], 0, 1)["spikes"], 0)

    def test_a_psth_counts_the_spikes_around_each_event(self):
        times, rate = self.response.psth([0.2, 0.3], before=0.1, after=0.4, bin=0.05)
        train = self.response.train()
        expected = sum(np.histogram(train - e, np.linspace(-0.1, 0.4, 11))[0] for e in (0.2, 0.3))
        np.testing.assert_allclose(rate * 0.05 * 2, expected)
        np.testing.assert_allclose(times[0], -0.075)


if __name__ == "__main__":
    unittest.main()
