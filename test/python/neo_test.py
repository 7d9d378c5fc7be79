"""Responses as NWB files and as Neo objects, and forces from Neo, from Python."""

import os
import pickle
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

import corpuscle
import nwb_schema
from support import press

try:
    import h5py
except ImportError:
    h5py = None
try:
    import neo
    import quantities
except ImportError:
    neo = None

TRIALS = [(0.0, 0.5, "on"), (0.5, 1.0, "off")]


@unittest.skipIf(h5py is None, "h5py is not installed; Debian: python3-h5py")
class ToNwb(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "x.nwb")

    def test_spikes_force_and_trials_are_those_of_the_response(self):
        force = corpuscle.Force(np.column_stack([press(), press() / 2]), 1000, ["a", "b"], name="grip")
        response = corpuscle.respond(force, afferent=["sa1", "fa1"], settings={"sa1.f_B": "25 Hz"})
        response.to_nwb(self.path, trials=TRIALS, experimenter=["Doe, Jane"], subject={"subject_id": "m1"})
        with h5py.File(self.path) as nwb:
            trains = np.split(nwb["units/spike_times"][:], nwb["units/spike_times_index"][:-1])
            for k, train in enumerate(trains):
                np.testing.assert_array_equal(train, response.train(k))
            self.assertEqual(list(nwb["units/afferent"].asstr()[:]), response.names)
            np.testing.assert_array_equal(nwb["units/f_B"][:][[0, 2]], [25, 25])
            np.testing.assert_array_equal(nwb["stimulus/presentation/grip/data"][:], force.samples)
            self.assertEqual(list(nwb["intervals/trials/label"].asstr()[:]), ["on", "off"])
            np.testing.assert_array_equal(nwb["intervals/trials/stop_time"][:], [0.5, 1])
            self.assertEqual(nwb["general/experimenter"].asstr()[0], "Doe, Jane")
            self.assertIn("corpuscle.respond(<grip>", nwb["general/source_script"].asstr()[()])
        if not nwb_schema.missing():
            self.assertEqual(nwb_schema.errors(self.path), [])

    def test_a_stimulus_by_name_has_its_force(self):
        corpuscle.respond("press", 1000, "sa1", settings={"press.F_max": "2 N"}).to_nwb(self.path)
        with h5py.File(self.path) as nwb:
            np.testing.assert_array_equal(nwb["stimulus/presentation/press/data"][:], corpuscle.press(rate=1000, F_max=2).samples)

    def test_a_skin_has_positions_and_the_parameters_of_each_afferent(self):
        response = corpuscle.fingertip().respond(press(), 1000)
        response.to_nwb(self.path)
        with h5py.File(self.path) as nwb:
            np.testing.assert_array_equal(nwb["units/x"][:], response.positions[:, 0])
            first = response.types.index("fa1")
            self.assertEqual(nwb["units/k_A"][first], response.models[first]["k_A"])

    def test_a_copy_by_pickle_writes_the_same_file(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        response.to_nwb(self.path)
        other = os.path.join(self.folder.name, "y.nwb")
        pickle.loads(pickle.dumps(response)).to_nwb(other)
        with open(self.path, "rb") as a, open(other, "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_an_existing_file_is_kept(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        with open(self.path, "w") as file:
            file.write("mine")
        with self.assertRaisesRegex(corpuscle.InputError, "--overwrite"):
            response.to_nwb(self.path)
        with open(self.path) as file:
            self.assertEqual(file.read(), "mine")
        response.to_nwb(self.path, overwrite=True)
        self.assertEqual(list(corpuscle.read_spikes(self.path)), ["sa1"])

    def test_bad_arguments_are_refused(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        for message, options in {"there is no field 'experimnter'": {"experimnter": "x"}, "stop must be after start": {"trials": [(1, 0, "x")]},
                                 "is not .start, stop. or .start, stop, label.": {"trials": [1]}, "2000: write date": {"session_start_time": "2000"}}.items():
            with self.assertRaisesRegex(corpuscle.InputError, message):
                response.to_nwb(self.path, **options)
            self.assertFalse(os.path.exists(self.path))

    def test_files_are_read_again_to_the_bit(self):
        response = corpuscle.respond(press() * 1.1, 1000, ["sa1", "fa1"])
        response.to_nwb(self.path)
        for name, train in corpuscle.read_spikes(self.path).items():
            np.testing.assert_array_equal(train, response.train(name))
        force = corpuscle.read(self.path)
        np.testing.assert_array_equal(force.samples, press() * 1.1)
        self.assertEqual(force.rate, 1000)


@unittest.skipIf(neo is None, "neo is not installed; Debian: python3-neo")
class Neo(unittest.TestCase):
    def test_a_block_has_trains_force_and_trials(self):
        force = corpuscle.Force(np.column_stack([press(), press() / 2]), 1000, ["a", "b"], start=2.0, name="grip")
        response = corpuscle.respond(force, afferent=["sa1", "fa1"])
        segment = response.to_neo(trials=[(2.0, 2.5, "on")]).segments[0]
        self.assertEqual(len(segment.spiketrains), 4)
        for k, train in enumerate(segment.spiketrains):
            np.testing.assert_array_equal(train.rescale("s").magnitude, response.train(k))
            self.assertEqual(train.annotations["afferent_type"], response.types[k])
            self.assertEqual(train.annotations["channel"], response.channels[k])
        self.assertEqual(segment.spiketrains[0].annotations["f_B"], 20)
        signal = segment.analogsignals[0]
        np.testing.assert_array_equal(signal.rescale("N").magnitude, force.samples)
        self.assertEqual((float(signal.sampling_rate.rescale("Hz")), float(signal.t_start.rescale("s"))), (1000, 2))
        self.assertEqual(list(segment.epochs[0].labels), ["on"])
        np.testing.assert_array_equal(segment.epochs[0].durations.rescale("s").magnitude, [0.5])

    def test_a_touch_of_a_skin_has_its_total_force(self):
        response = corpuscle.fingertip().respond("scan", 1000)
        segment = response.to_neo().segments[0]
        force = segment.analogsignals[0]
        self.assertEqual((segment.name, force.name, float(force.sampling_rate.rescale("Hz"))), ("scan", "scan", 1000))
        self.assertAlmostEqual(float(force.rescale("N").magnitude.max()), 2, places=6)
        self.assertEqual(len(force), round(1000 * response.duration))

    def test_neo_computes_the_rates_of_measures(self):
        """A function of a library that others wrote, on a train of ours."""
        response = corpuscle.respond(press(), 1000, "sa1")
        train = response.to_neo().segments[0].spiketrains[0]
        intervals = np.diff(response.train())
        from neo.core import SpikeTrain
        self.assertIsInstance(train, SpikeTrain)
        np.testing.assert_allclose(np.diff(train.time_slice(0 * quantities.s, 1 * quantities.s).times.rescale("ms").magnitude), 1e3 * intervals, rtol=1e-9)

    def test_a_force_goes_to_neo_and_back(self):
        force = corpuscle.Force(np.column_stack([press(), press() / 2]), 250, ["a", "b"], start=0.5, name="grip")
        again = corpuscle.Force.from_neo(corpuscle.respond(force).to_neo().segments[0].analogsignals[0])
        np.testing.assert_array_equal(again.samples, force.samples)
        self.assertEqual((again.rate, again.start, again.channels, again.name), (250, 0.5, ["a", "b"], "grip"))
        dynes = neo.AnalogSignal(np.arange(5.0), units="dyne", sampling_rate=1 * quantities.kHz)
        np.testing.assert_allclose(corpuscle.Force.from_neo(dynes).samples, np.arange(5) * 1e-5)

    def test_other_signals_are_refused(self):
        with self.assertRaisesRegex(corpuscle.InputError, "is in V, which is not a unit of force"):
            corpuscle.Force.from_neo(neo.AnalogSignal(np.arange(5.0), units="V", sampling_rate=1 * quantities.kHz))
        with self.assertRaisesRegex(corpuscle.InputError, "a neo.AnalogSignal is expected, not ndarray"):
            corpuscle.Force.from_neo(np.arange(5.0))

    def test_a_hand_has_all_its_trains(self):
        block = corpuscle.fingertip().respond(press(), 1000).to_neo()
        self.assertEqual(len(block.segments[0].spiketrains), 998)
        self.assertIn("x_m", block.segments[0].spiketrains[0].annotations)


class WithoutNeo(unittest.TestCase):
    def test_the_error_names_the_package(self):
        with unittest.mock.patch.dict(sys.modules, {"neo": None}), self.assertRaisesRegex(ImportError, "apt-get install python3-neo"):
            corpuscle.respond(press(), 1000, "sa1").to_neo()


if __name__ == "__main__":
    unittest.main()
