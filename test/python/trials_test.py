"""Trials from Python: the numbers of the command line, closed forms, and errors."""

import csv
import json
import os
import pickle
import tempfile
import unittest

import numpy as np

import corpuscle
from support import ROOT, command_line

TOUCH = os.path.join(ROOT, "examples", "data", "touch.csv")
LONG = os.path.join(ROOT, "examples", "data", "loggers", "trials.csv")


class Trials(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.table = os.path.join(self.folder, "epochs.csv")
        with open(self.table, "w") as file:
            file.write("start_ms,stop_ms,label\n300,1500,tap\n1500,6000,press\n")
        self.force = corpuscle.read(TOUCH, deadband="20 mN")
        self.response = corpuscle.respond(self.force, afferent=["sa1-nerve", "fa1-nerve"])

    def rows_of_command(self, *options):
        status, _, errors = command_line("respond", TOUCH, "--deadband", "20mN", "-a", "sa1-nerve,fa1-nerve", *options, "--bin", "20ms", "-o",
                                         os.path.join(self.folder, "out"), "--overwrite")
        self.assertEqual(status, 0, errors)

        def read(name):
            with open(os.path.join(self.folder, "out", name)) as file:
                return list(csv.DictReader(file))

        return read("trials.csv"), read("psth.csv")

    def test_the_numbers_are_those_of_the_command_line(self):
        for options, arguments in [(["--trials", self.table], {"epochs": self.table}),
                                   (["--trials", self.table, "--align", "onset", "--window", "-0.1..0.4"],
                                    {"epochs": self.table, "align": "onset", "window": (-0.1, 0.4)}),
                                   (["--trials", "onset", "--window", "-0.1..0.3"], {"window": (-0.1, 0.3)})]:
            with self.subTest(options=options):
                rows, bins = self.rows_of_command(*options)
                responses = self.response.trials(**arguments)
                frame = responses.to_pandas()
                self.assertEqual(len(frame), len(rows))
                for row, (_, own) in zip(rows, frame.iterrows()):
                    for key, value in row.items():
                        if key not in ("label", "input", "afferent", "channel"):
                            expected = float(value) if value else np.nan
                            np.testing.assert_allclose(own[key], expected, rtol=1e-8, atol=1e-9, err_msg=key) if key in own else self.fail(key)
                        elif key != "input":
                            self.assertEqual(own[key], value)
                for label in dict.fromkeys(responses.labels):
                    for name in responses.names:
                        expected = [b for b in bins if b["label"] == label and b["afferent"] == name]
                        times, rate = histogram = responses.psth(0.02, name, label)
                        np.testing.assert_allclose(rate, [float(b["rate_Hz"] or "nan") for b in expected], rtol=1e-5)
                        np.testing.assert_allclose(histogram.standard_error, [float(b["standard_error_Hz"] or "nan") for b in expected], rtol=1e-5)
                        np.testing.assert_allclose(times, [(float(b["from_s"]) + float(b["to_s"])) / 2 for b in expected], atol=1e-8)

    def test_trials_that_cover_a_force_count_every_spike_once(self):
        edges = np.linspace(0, 6, 14)
        responses = self.response.trials(list(zip(edges[:-1], edges[1:])))
        counts = responses.measure("spikes").sum(axis=0)
        self.assertEqual(list(counts), [len(self.response.train(0)), len(self.response.train(1))])

    def test_a_psth_over_trials_agrees_with_that_around_events(self):
        events = [0.5, 0.95]
        responses = self.response.trials([(e, e + 0.4) for e in events], window=(-0.1, 0.3))
        times, rate = responses.psth(bin=0.01)
        expected_times, expected = self.response.psth(events, before=0.1, after=0.3)
        np.testing.assert_allclose(times, expected_times, atol=1e-12)
        np.testing.assert_allclose(rate, expected, atol=1e-9)

    def test_onsets_are_where_a_ramp_crosses_the_threshold(self):
        t = np.arange(2000) / 1000
        ramp = np.clip(4 * (t - 0.5), 0, 2) * (t < 1.5)
        np.testing.assert_allclose(corpuscle.onsets(ramp, 0.2, rate=1000), [0.55], atol=1e-9)
        found = corpuscle.contacts(corpuscle.Force(np.column_stack([ramp, ramp]), 1000, start=10), 0.4)
        np.testing.assert_allclose(found.onsets, [10.55], atol=1e-9)
        np.testing.assert_allclose(found.releases, [11.5], atol=1e-9)
        self.assertEqual(len(corpuscle.onsets(np.zeros(100), rate=1000)), 0)

    def test_a_table_in_long_format_is_one_force_for_each_trial(self):
        forces = corpuscle.read(LONG, by="trial")
        self.assertEqual(len(forces), 2)
        self.assertEqual([f.name for f in forces], ["trials trial 1", "trials trial 2"])
        responses = forces.respond("sa1", align="onset", window=(-0.1, 0.5))
        status, out, errors = command_line("respond", LONG, "--by", "trial", "--align", "onset", "--window", "-0.1..0.5", "-a", "sa1", "--json")
        self.assertEqual(status, 0, errors)
        document = json.loads(out)["trials"]
        for t, row in enumerate(document["responses"]):
            np.testing.assert_array_equal(responses.spikes(t), row["times_s"])
            self.assertEqual(responses.rates[t, 0], row["mean_rate_Hz"])
        mean = responses.statistics()
        self.assertEqual(mean["spikes"][0], document["labels"][0]["spikes"]["mean"])

    def test_an_afferent_with_random_numbers_differs_between_equal_trials(self):
        responses = corpuscle.ForceTrials([self.force, self.force]).respond("sa1-nerve")
        self.assertGreater(len(responses.spikes(0)), 20)
        self.assertFalse(np.array_equal(responses.spikes(0), responses.spikes(1)))

    def test_trials_come_from_paths_frames_and_tuples(self):
        import pandas
        expected = [corpuscle.Epoch(0.3, 1.5, "tap"), corpuscle.Epoch(1.5, 6.0, "press")]
        self.assertEqual(corpuscle.trials(self.table), expected)
        frame = pandas.DataFrame({"onset": [1.5, 0.3], "duration": [4.5, 1.2], "trial_type": ["press", "tap"]})
        for read, epoch in zip(corpuscle.trials(frame), expected):
            np.testing.assert_allclose((read.start, read.stop), (epoch.start, epoch.stop))
            self.assertEqual(read.label, epoch.label)
        self.assertEqual(corpuscle.trials([(1.5, 6, "press"), (0.3, 1.5, "tap")]), expected)

    def test_a_data_frame_has_the_columns_and_units_of_a_file(self):
        import pandas
        path = os.path.join(ROOT, "examples", "data", "touch_trials.csv")
        self.assertEqual(corpuscle.trials(pandas.read_csv(path)), corpuscle.trials(path))   # start_s, stop_s
        self.assertEqual(corpuscle.trials(pandas.DataFrame({"Begin_ms": [250.0], "end_time": [0.5], "class": ["x"]})), [corpuscle.Epoch(0.25, 0.5, "x")])
        third = 1 / 3
        self.assertEqual(corpuscle.trials(pandas.DataFrame({"start": [third], "stop": [1.0], "texture": ["rough"]}), label="texture"),
                         [corpuscle.Epoch(third, 1.0, "rough")])
        for match, columns in (("the table:1", {"begins": [0.0], "stop": [1.0]}), ("the table:2.*nan", {"start": ["nan"], "stop": [1.0]}), ("the table", {"start": [], "stop": []})):
            with self.subTest(match), self.assertRaisesRegex(corpuscle.InputError, match):
                corpuscle.trials(pandas.DataFrame(columns))

    def test_a_calibration_is_an_option_of_read(self):
        path = os.path.join(self.folder, "counts.csv")
        with open(path, "w") as file:
            file.write("time_s,fz\n" + "".join(f"{k / 100},{812 if k < 100 else 2140}\n" for k in range(200)))
        for text in ("zero=812,load=2140@2N", "zero=0s..1s,load=1s..2s@2N"):
            force = corpuscle.read(path, calibrate=text)
            np.testing.assert_allclose(force.samples[[0, -1]], [0, 2], atol=1e-9)
            self.assertIn("--offset 812 --scale 0.00150602", " ".join(force.notes))

    def test_it_plots_and_prints(self):
        responses = self.response.trials(self.table)
        self.assertEqual(responses.plot().get_xlabel(), "time from start (s)")
        self.assertEqual(repr(responses), "<TrialResponses: 2 trials, 2 labels, 2 afferents, aligned to start>")

    def test_a_pickled_response_has_the_same_trials(self):
        copy = pickle.loads(pickle.dumps(self.response))
        responses = self.response.trials(self.table)
        np.testing.assert_array_equal(copy.trials(self.table).rates, responses.rates)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(responses)).rates, responses.rates)

    def test_bad_input_is_an_error_with_the_text_of_the_command_line(self):
        with open(self.table, "w") as file:
            file.write("start,stop,label\n0,1,a\n2,x,b\n")
        errors = command_line("respond", TOUCH, "--trials", self.table)[2]
        with self.assertRaises(corpuscle.InputError) as caught:
            corpuscle.trials(self.table)
        self.assertIn(str(caught.exception), errors)
        for call, message in [(lambda: self.response.trials([(7, 8, "late")]), "outside of the recording"),
                              (lambda: self.response.trials([(2, 1)]), "stop must be after start"),
                              (lambda: self.response.trials([(1, float("nan"))]), "stop must be after start"),
                              (lambda: self.response.trials([3]), "is not \\(start, stop\\)"),
                              (lambda: self.response.trials([]), "there are none"),
                              (lambda: self.response.trials([(0, 1)], align="middle"), "write 'start' or 'onset'"),
                              (lambda: self.response.trials([(0, 1)], window=(1, 0)), "must end after it begins"),
                              (lambda: self.response.trials([(0, 1)], window="x"), "write \\(from, to\\)"),
                              (lambda: self.response.trials(threshold=99), "there is no contact"),
                              (lambda: self.response.trials([(0, 1)]).psth(bin=-1), "must be above 0"),
                              (lambda: self.response.trials([(0, 1)]).psth(bin=1e-9), "use longer bins"),
                              (lambda: self.response.trials([(0, 1)]).psth(label="z"), "there is no label 'z'"),
                              (lambda: self.response.trials([(0, 1)]).measure("z"), "there is no measure 'z'"),
                              (lambda: self.response.trials([(0, 1)]).spikes(5), "there is no trial 5"),
                              (lambda: corpuscle.respond("press").trials(), "contacts need the force"),
                              (lambda: corpuscle.respond("press").trials([(0, 1)], align="onset"), "needs the force"),
                              (lambda: corpuscle.onsets(np.zeros(3)), "rate"),
                              (lambda: corpuscle.read(LONG, by="tral"), "did you mean 'trial'"),
                              (lambda: corpuscle.read(LONG, label="trial"), "label needs by"),
                              (lambda: corpuscle.read(LONG, calibrate="load=3"), "zero=812,load=2140@2N"),
                              (lambda: corpuscle.ForceTrials([]), "one or more Force")]:
            with self.assertRaisesRegex(corpuscle.InputError, message):
                call()


if __name__ == "__main__":
    unittest.main()
