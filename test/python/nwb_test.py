"""NWB files: valid against the published schema, with the numbers of spikes.csv, and read by libraries that others wrote."""

import csv
import os
import pickle
import shutil
import tempfile
import unittest

import numpy as np

import nwb_schema
from support import command_line

try:
    import h5py
except ImportError:
    h5py = None

RUNS = {
    "channels": ["press", "--rate", "1kHz", "-a", "sa1,fa1"],
    "copies": ["press", "--rate", "1kHz", "-a", "sa1", "--copies", "4", "--spread", "sa1.f_B=10%"],
    "netlist": ["press", "--rate", "1kHz", "-a", "sa1-circuit"],
    "skin": ["press", "--population", "grid 3x2"],
    "hand": ["press", "--population", "fingertip"],
}


def written(folder, name, *options):
    out = os.path.join(folder, name)
    status, _, errors = command_line("respond", *RUNS[name], "-q", "--nwb", "--out", out, *options)
    assert status == 0, errors
    return out


@unittest.skipIf(h5py is None, "h5py is not installed; Debian: python3-h5py")
class NwbFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.outputs = {name: written(cls.folder, name) for name in RUNS}

    def file(self, name):
        return os.path.join(self.outputs[name], "response.nwb")

    def test_the_units_have_the_spikes_of_the_table(self):
        for name, out in self.outputs.items():
            expected = {}
            with open(os.path.join(out, "spikes.csv")) as table:
                for row in csv.DictReader(table):
                    expected.setdefault((row["afferent"], row["channel"]), []).append(float(row["time_s"]))
            self.assertTrue(expected)
            with h5py.File(self.file(name)) as nwb:
                units = nwb["units"]
                trains = np.split(units["spike_times"][:], units["spike_times_index"][:-1])
                intervals = units["obs_intervals"][:]
                names = list(zip(units["afferent"].asstr()[:], units["channel"].asstr()[:]))
                self.assertEqual(list(units["id"][:]), list(range(len(names))))
            for unit, train, (begin, end) in zip(names, trains, intervals):
                np.testing.assert_allclose(train, expected.pop(unit, []), atol=6e-10, rtol=0)
                self.assertTrue(np.all(np.diff(train) > 0) and np.all((train >= begin) & (train <= end)))
            self.assertFalse(expected)

    def test_each_column_is_among_the_names_of_columns(self):
        """The validator does not notice a missing name, and readers then do not see the column."""
        for name in RUNS:
            with h5py.File(self.file(name)) as nwb:
                units = nwb["units"]
                columns = {c for c in units if c != "id" and not c.endswith("_index")}
                self.assertEqual(set(units.attrs["colnames"]), columns)
                for column in columns:
                    self.assertIn("description", units[column].attrs)

    def test_parameters_are_those_of_each_copy(self):
        with open(os.path.join(self.outputs["copies"], "copies.csv")) as table:
            expected = [float(row["f_B_Hz"]) for row in csv.DictReader(table)]
        with h5py.File(self.file("copies")) as nwb:
            self.assertEqual(list(nwb["units/f_B"][:]), expected)
            self.assertEqual(nwb["units/afferent_type"].asstr()[0], "sa1")
            self.assertIn("(Hz)", nwb["units/f_B"].attrs["description"])

    def test_the_force_is_in_newtons(self):
        with h5py.File(self.file("channels")) as nwb:
            series = nwb["stimulus/presentation/press"]
            self.assertEqual(series["data"].attrs["unit"], "N")
            self.assertEqual(series["starting_time"].attrs["rate"], 1000)
            force = series["data"][:]
        import corpuscle
        np.testing.assert_array_equal(force, corpuscle.press(rate=1000).samples)

    def test_a_measured_force_of_several_channels_is_an_acquisition(self):
        path = os.path.join(self.folder, "grip.csv")
        force = np.round(np.column_stack([np.linspace(0, 3, 12000), np.linspace(3, 0, 12000)]), 6)
        np.savetxt(path, np.column_stack([5 + np.arange(12000) / 1000, force]), delimiter=",", header="time_s,thumb_N,index_N", comments="", fmt="%.6f")
        out = os.path.join(self.folder, "grip")
        status, _, errors = command_line("respond", path, "-q", "--nwb", "--out", out)
        self.assertEqual(status, 0, errors)
        with h5py.File(os.path.join(out, "response.nwb")) as nwb:
            series = nwb["acquisition/grip"]
            np.testing.assert_array_equal(series["data"][:], force)
            self.assertEqual(list(series["data"].attrs["channels"]), ["thumb", "index"])
            self.assertEqual(series["starting_time"][()], 5)

    def test_trials_are_intervals(self):
        table = os.path.join(self.folder, "trials.csv")
        with open(table, "w") as file:
            file.write("start,stop,label\n0,0.5,press\n0.5,1,release\n")
        out = os.path.join(self.folder, "trials")
        status, _, errors = command_line("respond", "press", "-q", "--trials", table, "--nwb", "--out", out)
        self.assertEqual(status, 0, errors)
        with h5py.File(os.path.join(out, "response.nwb")) as nwb:
            trials = nwb["intervals/trials"]
            self.assertEqual([list(trials[c][:]) for c in ("start_time", "stop_time")], [[0, 0.5], [0.5, 1]])
            self.assertEqual(list(trials["label"].asstr()[:]), ["press", "release"])
            self.assertEqual(list(trials.attrs["colnames"]), ["start_time", "stop_time", "label"])
        if not nwb_schema.missing():
            self.assertEqual(nwb_schema.errors(os.path.join(out, "response.nwb")), [])

    def test_the_force_of_a_touch_in_python_is_that_of_the_command_line(self):
        import corpuscle
        cases = [("texture", "hand", ["--seed", "3"], {}, 3), ("scan", "fingertip", ["--set", "ramp-hold.F_max=1N"], {"ramp-hold.F_max": "1 N"}, 0),
                 ("press", "grid 3x2", [], {}, 0)]
        for touch, skin, options, settings, seed in cases:
            out = os.path.join(self.folder, "touch-" + touch)
            status, _, errors = command_line("respond", touch, "--population", skin, "-q", "--nwb", "--out", out, *options)
            self.assertEqual(status, 0, errors)
            path = os.path.join(self.folder, touch + ".nwb")
            response = corpuscle.population(skin).respond(touch, seed=seed, settings=settings)
            pickle.loads(pickle.dumps(response)).to_nwb(path)
            with h5py.File(os.path.join(out, "response.nwb")) as expected, h5py.File(path) as found:
                series = [nwb["stimulus/presentation/" + touch] for nwb in (expected, found)]
                self.assertGreater(series[0]["data"][:].max(), 0.1)
                for one in (lambda s: s["data"][:], lambda s: s["data"].attrs["unit"], lambda s: list(s["data"].attrs["channels"]),
                            lambda s: s["starting_time"].attrs["rate"], lambda s: s.attrs["description"]):
                    np.testing.assert_array_equal(one(series[1]), one(series[0]))
                np.testing.assert_array_equal(found["units/spike_times"][:], expected["units/spike_times"][:])

    def test_trials_are_read_as_they_were_written(self):
        import corpuscle
        force = corpuscle.press(rate=1000)
        response = corpuscle.respond(force, afferent="sa1")
        written = [corpuscle.Epoch(0.1, 0.1 + 0.2, "tap, \u00e9"), corpuscle.Epoch(1 / 3, 0.7, "press")]
        path = os.path.join(self.folder, "own.nwb")
        response.to_nwb(path, trials=written)
        read = corpuscle.trials(path)
        self.assertEqual([tuple(t) for t in read], [tuple(t) for t in written])
        own, table = response.trials(path), response.trials(written)
        self.assertEqual(own.labels, table.labels)
        np.testing.assert_array_equal(own.rates, table.rates)

    def test_trials_of_h5py_are_read(self):
        import corpuscle
        path = os.path.join(self.folder, "h5py.nwb")
        with h5py.File(path, "w") as nwb:
            nwb.attrs["neurodata_type"] = "NWBFile"
            trials = nwb.create_group("intervals/trials")
            trials["id"] = np.arange(3)
            trials["start_time"], trials["stop_time"] = np.array([3, 0.5, 1]), np.array([4, 1, 2], dtype="f4")
            trials.create_dataset("condition", data=["rough", "smooth", "gr\u00fcn"], dtype=h5py.string_dtype(), chunks=(2,), compression="gzip")
            trials["correct"] = np.array([True, False, True])
            trials["block"] = np.array([1, 1, 2], dtype="u1")
            trials["tags"], trials["tags_index"] = np.array([b"a", b"b"]), np.array([0, 1, 2], dtype="u1")
        times = [(0.5, 1), (1, 2), (3, 4)]
        for label, labels in {None: ["smooth", "gr\u00fcn", "rough"], "correct": ["FALSE", "TRUE", "TRUE"], "block": ["1", "2", "1"]}.items():
            read = corpuscle.trials(path, label=label)
            self.assertEqual([tuple(t) for t in read], [(*t, name) for t, name in zip(times, labels)])
        for label, reason in {"tags": "has not one value for each trial", "texture": "there are: block, condition, correct"}.items():
            with self.assertRaisesRegex(corpuscle.InputError, reason):
                corpuscle.trials(path, label=label)
        force = os.path.join(self.folder, "five_seconds.csv")
        np.savetxt(force, np.sin(np.arange(500)), header="force_N", comments="")
        status, _, errors = command_line("respond", force, "--rate", "100Hz", "--abs", "--trials", path, "--label", "block")
        self.assertEqual(status, 0, errors)
        self.assertIn("'condition', 'correct', 'tags' are not used", errors)

    def test_the_file_of_the_trials_is_not_replaced(self):
        out = os.path.join(self.folder, "both")
        table = os.path.join(self.folder, "both.csv")
        with open(table, "w") as file:
            file.write("start,stop,label\n0,0.5,press\n")
        status, _, errors = command_line("respond", "press", "-q", "--trials", table, "--nwb", "--out", out)
        self.assertEqual(status, 0, errors)
        status, _, errors = command_line("respond", "press", "-q", "--trials", os.path.join(out, "response.nwb"), "--nwb", "--overwrite", "--out", out)
        self.assertEqual(status, 2)
        self.assertIn("would replace an input", errors)

    def test_positions_are_in_metres(self):
        with h5py.File(self.file("skin")) as nwb:
            self.assertEqual(sorted(set(np.round(nwb["units/x"][:], 6))), [0.0, 0.002])

    def test_equal_runs_give_equal_bytes(self):
        for name in ("copies", "hand"):
            with open(self.file(name), "rb") as file:
                first = file.read()
            for options in (["--threads", "1"], ["--threads", "3", "--npz"]):
                shutil.rmtree(os.path.join(self.folder, "again"), ignore_errors=True)
                os.rename(written(self.folder, name, *options, "--overwrite"), os.path.join(self.folder, "again"))
                with open(os.path.join(self.folder, "again", "response.nwb"), "rb") as file:
                    self.assertEqual(file.read(), first)
                shutil.copytree(os.path.join(self.folder, "again"), self.outputs[name])

    def test_fields_are_those_that_the_user_gives(self):
        out = os.path.join(self.folder, "fields")
        status, _, errors = command_line("respond", "press", "-q", "--nwb", "--out", out, "--nwb-field", "session_start_time=2024-03-01T12:00:00+01:00",
                                         "--nwb-field", "experimenter=Doe, Jane", "--nwb-field", "experimenter=Roe, Richard", "--nwb-field",
                                         "identifier=run 7", "--nwb-field", "subject.subject_id=none", "--nwb-field", "lab=Touch", "--seed", "7")
        self.assertEqual(status, 0, errors)
        with h5py.File(os.path.join(out, "response.nwb")) as nwb:
            text = lambda path: nwb[path].asstr()[()]
            self.assertEqual(text("session_start_time"), "2024-03-01T12:00:00+01:00")
            self.assertEqual(list(text("general/experimenter")), ["Doe, Jane", "Roe, Richard"])
            self.assertEqual((text("identifier"), text("general/lab"), text("general/subject/subject_id")), ("run 7", "Touch", "none"))
            self.assertIn("seed 7", text("general/notes"))
            self.assertEqual(text("general/source_script"), "corpuscle respond press --seed 7")
        if not nwb_schema.missing():
            self.assertEqual(nwb_schema.errors(os.path.join(out, "response.nwb")), [])

    def test_wrong_fields_are_refused_with_a_remedy(self):
        for field, reason in {"session_start_time=2024-03-01 12:00": "write date, time and time zone", "experimnter=x": "did you mean 'experimenter'",
                              "lab": "write FIELD=TEXT", "session_start_time=2999-01-01T00:00:00Z": "is in the future"}.items():
            status, _, errors = command_line("respond", "press", "--nwb", "--out", os.path.join(self.folder, "none"), "--nwb-field", field)
            self.assertEqual(status, 2, field)
            self.assertIn(reason, errors)
            self.assertFalse(os.path.exists(os.path.join(self.folder, "none")))

    def test_two_spikes_at_one_time_are_refused(self):
        out = os.path.join(self.folder, "equal")
        status, _, errors = command_line("respond", "press", "-a", "sa1", "--rate", "200Hz", "--sampled", "--set", "sa1.V_th=20mV", "--set",
                                         "sa1.V_reset=0", "--nwb", "-q", "--out", out)
        self.assertEqual(status, 1)
        self.assertRegex(errors, r"response.nwb: sa1 on press has two spikes at .* s. NWB needs different times .* or set a refractory time: --set sa1.t_ref=5ms")
        self.assertFalse(os.path.exists(out))


@unittest.skipIf(h5py is None or nwb_schema.missing(), nwb_schema.missing() or "h5py is not installed; Debian: python3-h5py")
class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.outputs = {name: written(cls.folder, name) for name in RUNS}

    def test_every_file_is_valid(self):
        for name, out in self.outputs.items():
            self.assertEqual(nwb_schema.errors(os.path.join(out, "response.nwb")), [], name)

    def test_the_validator_notices_each_missing_part(self):
        """Otherwise the test above could not fail."""
        def remove_attribute(path, attribute):
            return lambda nwb: nwb[path].attrs.__delitem__(attribute)

        mutations = {path: lambda nwb, path=path: nwb.__delitem__(path) for path in
                     ("identifier", "session_description", "session_start_time", "timestamps_reference_time", "file_create_date", "analysis", "general",
                      "acquisition", "processing", "stimulus", "units/id")}
        for path, attribute in {"stimulus/presentation/press/starting_time": "rate", "stimulus/presentation/press/data": "unit", "units": "colnames",
                                "units/spike_times_index": "target", "units/afferent": "description"}.items():
            mutations[f"{path} {attribute}"] = remove_attribute(path, attribute)

        def integer_times(nwb):
            times = nwb["units/spike_times"]
            attributes = dict(times.attrs)
            del nwb["units/spike_times"]
            nwb["units/spike_times"] = np.arange(len(times) if times else 3)
            nwb["units/spike_times"].attrs.update(attributes)

        mutations["spike times as integers"] = integer_times
        for name, mutate in mutations.items():
            path = os.path.join(self.folder, "mutated.nwb")
            shutil.copy(os.path.join(self.outputs["channels"], "response.nwb"), path)
            with h5py.File(path, "r+") as nwb:
                mutate(nwb)
            try:
                found = nwb_schema.errors(path)
            except Exception as error:  # hdmf cannot read some files at all
                found = [error]
            self.assertNotEqual(found, [], name)

    def test_hdmf_reads_the_numbers(self):
        with nwb_schema.opened(os.path.join(self.outputs["channels"], "response.nwb")) as builder:
            units = builder["units"]
            self.assertEqual(units.attributes["neurodata_type"], "Units")
            with open(os.path.join(self.outputs["channels"], "spikes.csv")) as table:
                expected = sorted(float(row["time_s"]) for row in csv.DictReader(table))
            np.testing.assert_allclose(sorted(units["spike_times"].data[:]), expected, atol=6e-10, rtol=0)
            target = units["spike_times_index"].attributes["target"]
            self.assertEqual(target.name, "spike_times")


if __name__ == "__main__":
    unittest.main()
