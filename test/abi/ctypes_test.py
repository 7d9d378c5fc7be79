"""The C interface from Python's ctypes: the same numbers as the command line."""

import ctypes as c
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

library = c.CDLL(os.environ["CORPUSCLE_LIBRARY"])
ROOT = pathlib.Path(os.environ["CORPUSCLE_ROOT"])
TOUCH = ROOT / "examples" / "data" / "touch.csv"


class Simulation(c.Structure):
    _fields_ = [("size", c.c_size_t), ("afferents", c.c_char_p), ("population", c.c_char_p), ("contact", c.c_char_p), ("taxels", c.c_char_p),
                ("settings", c.POINTER(c.c_char_p)), ("setting_count", c.c_size_t), ("spreads", c.POINTER(c.c_char_p)),
                ("spread_count", c.c_size_t), ("seed", c.c_uint64), ("noise", c.c_double), ("copies", c.c_uint32), ("threads", c.c_uint32),
                ("flags", c.c_uint32), ("unused", c.c_uint32), ("progress", c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_double)), ("user", c.c_void_p)]


class Spike(c.Structure):
    _fields_ = [("time", c.c_double), ("afferent", c.c_uint32), ("address", c.c_uint32)]


SINK = c.CFUNCTYPE(None, c.c_void_p, c.POINTER(Spike))
for name in ("corpuscle_version", "corpuscle_error", "corpuscle_response_afferent_name", "corpuscle_response_afferent_channel",
             "corpuscle_response_summary", "corpuscle_afferent_name"):
    getattr(library, name).restype = c.c_char_p
for name in ("corpuscle_stimulus", "corpuscle_read", "corpuscle_respond", "corpuscle_respond_force", "corpuscle_respond_stimulus", "corpuscle_create"):
    getattr(library, name).restype = c.c_void_p
for name in ("corpuscle_response_spikes", "corpuscle_response_afferents", "corpuscle_force_samples", "corpuscle_sites"):
    getattr(library, name).restype = c.c_size_t
library.corpuscle_response_times.restype = c.POINTER(c.c_double)
library.corpuscle_response_indices.restype = c.POINTER(c.c_uint32)
library.corpuscle_force_channel.restype = c.POINTER(c.c_double)


def texts(*all):
    return (c.c_char_p * len(all))(*[t.encode() for t in all])


def simulation(afferents=None, **members):
    return Simulation(size=c.sizeof(Simulation), afferents=afferents, **members)


def trains(response):
    """The spike times of each afferent, by afferent and channel, as in the document of the command line."""
    response = c.c_void_p(response)
    times, indices = library.corpuscle_response_times(response), library.corpuscle_response_indices(response)
    out = [{"afferent": library.corpuscle_response_afferent_name(response, k).decode(),
            "channel": library.corpuscle_response_afferent_channel(response, k).decode(), "times_s": []}
           for k in range(library.corpuscle_response_afferents(response))]
    for k in range(library.corpuscle_response_spikes(response)):
        out[indices[k]]["times_s"].append(times[k])
    library.corpuscle_response_destroy(response)
    return out


def program(*arguments):
    done = subprocess.run([os.environ["CORPUSCLE_PROGRAM"], "respond", *map(str, arguments), "--json", "--quiet"], capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else done.stderr


class Ctypes(unittest.TestCase):
    def error(self):
        return library.corpuscle_error().decode()

    def test_a_stimulus_with_settings(self):
        settings = texts("press.F_max=2N", "sa1.f_B=25Hz")
        response = library.corpuscle_respond_stimulus(b"press", c.c_double(0), c.byref(simulation(b"sa1,fa1", settings=settings, setting_count=2)))
        self.assertTrue(response, self.error())
        found = trains(response)
        self.assertGreater(len(found[0]["times_s"]), 5)
        self.assertEqual(found, program("press", "--afferent", "sa1,fa1", "--set", "press.F_max=2N", "--set", "sa1.f_B=25Hz")["spikes"])

    def test_a_recording_that_is_read_with_options(self):
        options = texts("deadband=20mN")
        force = library.corpuscle_read(str(TOUCH).encode(), options, c.c_size_t(1))
        self.assertTrue(force, self.error())
        response = library.corpuscle_respond_force(c.c_void_p(force), c.byref(simulation(b"sa1-nerve,fa1-nerve")))
        self.assertTrue(response, self.error())
        self.assertEqual(trains(response), program(TOUCH, "--deadband", "20mN", "--afferent", "sa1-nerve,fa1-nerve")["spikes"])
        library.corpuscle_force_destroy(c.c_void_p(force))

    def test_an_array(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "force.csv")
            rows = [(min(k / 100, 2), 1 if 200 < k < 600 else 0) for k in range(1000)]
            file.write_text("ch1,ch2\n" + "".join(f"{a!r},{b!r}\n" for a, b in rows))
            array = (c.c_double * 2000)(*[v for row in rows for v in row])
            response = library.corpuscle_respond(array, c.c_size_t(1000), c.c_size_t(2), c.c_double(1000), c.byref(simulation(b"sa1,fa1")))
            self.assertTrue(response, self.error())
            self.assertEqual(trains(response), program(file, "--rate", "1kHz", "--afferent", "sa1,fa1")["spikes"])

    def test_a_skin_with_embedded_files(self):
        response = library.corpuscle_respond_stimulus(b"press", c.c_double(0), c.byref(simulation(population=b"fingertip", contact=b"sphere")))
        self.assertTrue(response, self.error())
        found = [t for t in trains(response) if t["times_s"]]
        self.assertGreater(len(found), 100)
        self.assertEqual(found, program("press", "--population", "fingertip", "--contact", "sphere")["spikes"])

    def test_a_live_skin_and_its_end(self):
        skin = c.c_void_p(library.corpuscle_create(b"sa1,fa1", c.c_double(1000), c.c_size_t(2)))
        self.assertTrue(skin, self.error())
        times = []
        sink = SINK(lambda user, spike: times.append(spike[0].time))
        rows = [(0 if k < 100 else 1.5, min(k / 100, 2)) for k in range(600)]
        for row in rows:
            self.assertEqual(library.corpuscle_push(skin, (c.c_double * 2)(*row), c.c_size_t(2), sink, None), 0, self.error())
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "force.csv")
            file.write_text("a,b\n" + "".join(f"{a!r},{b!r}\n" for a, b in rows))
            spikes = program(file, "--rate", "1kHz", "--afferent", "sa1,fa1")["spikes"]
        self.assertEqual(times, sorted(t for train in spikes for t in train["times_s"]))
        library.corpuscle_destroy(skin)
        self.assertEqual(library.corpuscle_push(skin, (c.c_double * 2)(0, 0), c.c_size_t(2), sink, None), -2)
        self.assertIn("has been destroyed", self.error())

    def test_errors_are_those_of_the_command_line(self):
        settings = texts("sa1.f_B=-1Hz")
        self.assertFalse(library.corpuscle_respond_stimulus(b"press", c.c_double(0), c.byref(simulation(b"sa1", settings=settings, setting_count=1))))
        self.assertEqual(library.corpuscle_error_code(), -1)
        self.assertIn(self.error(), program("press", "--afferent", "sa1", "--set", "sa1.f_B=-1Hz"))

    def test_a_sound_which_a_helper_program_reads(self):
        """The library finds the helper program without any program of ours beside it."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "press.au")
            samples = [min(k / 100, 0.9) for k in range(1000)]
            file.write_bytes(struct.pack(">4s5I1000d", b".snd", 24, 8000, 7, 1000, 1, *samples))
            force = library.corpuscle_read(str(file).encode(), texts("scale=2"), c.c_size_t(1))
            self.assertTrue(force, self.error())
            found = library.corpuscle_force_channel(c.c_void_p(force), c.c_size_t(0))
            self.assertEqual(found[: library.corpuscle_force_samples(c.c_void_p(force))], [2 * v for v in samples])
            response = library.corpuscle_respond_force(c.c_void_p(force), None)
            self.assertEqual(trains(response), program(file, "--scale", "2")["spikes"])
            library.corpuscle_force_destroy(c.c_void_p(force))


if __name__ == "__main__":
    unittest.main()
