"""The files of the program, read by libraries and programs that others wrote; the numbers are those of the response."""

import csv
import json
import os
import shutil
import subprocess
import tempfile
import unittest
import wave

import numpy as np

import corpuscle
from support import command_line

NAMES = ["sa1", "fa1"]


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        response = corpuscle.respond("press", 1000, NAMES)
        cls.trains = {name: response.train(name) for name in NAMES}
        cls.addresses = dict(enumerate(NAMES))

    def written(self, name, *options):
        out = os.path.join(self.folder, "out")
        status, _, errors = command_line("respond", "press", "--rate", "1kHz", "-a", ",".join(NAMES), "-q", "--out", out, *options)
        self.assertEqual(status, 0, errors)
        return os.path.join(out, name)

    def expect(self, trains, tolerance):
        self.assertEqual(sorted(trains), sorted(NAMES))
        for name, train in trains.items():
            np.testing.assert_allclose(train, self.trains[name], rtol=0, atol=tolerance)

    def test_csv(self):
        trains = {}
        with open(self.written("spikes.csv")) as file:
            for row in csv.DictReader(file):
                trains.setdefault(row["afferent"], []).append(float(row["time_s"]))
        self.expect(trains, 6e-10)

    def test_json_lines(self):
        trains = {}
        with open(self.written("spikes.jsonl", "--events", "jsonl")) as file:
            for event in map(json.loads, file):
                trains.setdefault(event["afferent"], []).append(event["time_s"])
        self.expect(trains, 6e-10)

    def test_npz_has_the_arrays_of_spikeinterface(self):
        with np.load(self.written("spikes.npz", "--npz")) as arrays:
            self.assertEqual((list(arrays["unit_ids"]), list(arrays["num_segment"])), ([0, 1], [1]))
            times = arrays["spike_indexes_seg0"] / arrays["sampling_frequency"][0]
            labels = arrays["spike_labels_seg0"]
            self.assertTrue(np.all(np.diff(arrays["spike_indexes_seg0"]) >= 0))
            self.expect({NAMES[k]: times[labels == k] for k in (0, 1)}, 6e-7)
            self.expect({NAMES[k]: arrays["spike_times_seg0"][labels == k] for k in (0, 1)}, 0)

    def test_aedat2(self):
        with open(self.written("spikes.aedat", "--events", "aedat2"), "rb") as file:
            bytes = file.read()
        start = 0
        while bytes[start:start + 1] == b"#":  # the lines of the header
            start = bytes.index(b"\n", start) + 1
        events = np.frombuffer(bytes, dtype=[("address", ">u4"), ("time", ">u4")], offset=start)
        self.expect({name: events["time"][events["address"] == a] / 1e6 for a, name in self.addresses.items()}, 1.1e-6)

    def test_aer_in_numpy_as_the_document_says(self):
        path = self.written("spikes.aer", "--events", "aer")
        head = np.fromfile(path, "<i8", 4)
        begin = 32 + (int(head[3]) >> 32)
        spikes = np.fromfile(path, [("step", "<i8"), ("place", "<u4"), ("address", "<u4")], offset=begin)
        time = (spikes["step"] - 1 + (spikes["place"] + 1.0) / 2**32) * head[2] / head[1]
        self.expect({name: time[spikes["address"] == a] for a, name in self.addresses.items()}, 1e-12)

    def test_wav_has_a_click_at_each_spike(self):
        with wave.open(self.written("spikes.wav", "--wav")) as sound:
            self.assertEqual((sound.getframerate(), sound.getnchannels(), sound.getsampwidth()), (44100, 2, 2))
            frames = np.frombuffer(sound.readframes(sound.getnframes()), dtype="<i2").reshape(-1, 2)
        for channel, name in enumerate(NAMES):  # the first afferent is at the left, the last at the right
            loud = np.abs(frames[:, channel].astype(int)) > 0
            for t in self.trains[name]:
                self.assertTrue(loud[int(round(t * 44100)):][:44].any(), (name, t))
            self.assertFalse(loud[:int(44100 * self.trains[name][0]) - 1].any())

    def test_ngspice_loads_the_raw_file_of_a_circuit(self):
        if not shutil.which("ngspice"):
            self.skipTest("ngspice is not installed; Debian: ngspice")
        netlist = os.path.join(self.folder, "rc.cir")
        with open(netlist, "w") as file:
            file.write("rc\nV1 in 0 pulse(0 1 0 1u 1u 1 2)\nR1 in out 1k\nC1 out 0 1u\n.tran 10u 5m\n.end\n")
        raw = os.path.join(self.folder, "rc.raw")
        status, _, errors = command_line("run", netlist, "-q", "-o", raw)
        self.assertEqual(status, 0, errors)
        script = os.path.join(self.folder, "load.cir")
        with open(script, "w") as file:
            file.write(f"load\n.control\nset noaskquit\nload {raw}\nset wr_singlescale\nset numdgt=15\nwrdata {self.folder}/loaded.txt v(out)\nquit\n.endc\n.end\n")
        subprocess.run(["ngspice", "-b", script], capture_output=True, timeout=60)
        time, out = np.loadtxt(os.path.join(self.folder, "loaded.txt"), unpack=True)
        self.assertGreater(len(time), 50)
        np.testing.assert_allclose(out[time > 1e-5], 1 - np.exp(-(time[time > 1e-5] - 5e-7) / 1e-3), atol=1e-3)
        table = os.path.join(self.folder, "rc.csv")
        self.assertEqual(command_line("run", netlist, "-q", "-o", table)[0], 0)
        with open(table) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(time))
        np.testing.assert_allclose(out, [float(row["v(out)"]) for row in rows], rtol=1e-8, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
