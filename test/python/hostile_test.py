"""Arguments, objects and processes that break other programs: an exception or an answer, never a crash or a wait without end."""

import os
import signal
import tempfile
import threading
import time
import unittest
import warnings

import corpuscle
import numpy as np
from support import ROOT, error_of, press


class TypesOfArguments(unittest.TestCase):
    def test_of_names_and_settings(self):
        self.assertIn("afferent = 5 is not a name", error_of(corpuscle.respond, "press", afferent=5))
        self.assertIn("afferent = None is not a name", error_of(corpuscle.respond, "press", afferent=None))
        self.assertIn("afferent = b'sa1' is not a name", error_of(corpuscle.respond, "press", afferent=[b"sa1"]))
        for settings in (5, 2.5, object(), b"sa1.f_B=1", [1], [None]):
            error_of(corpuscle.respond, "press", afferent="sa1", settings=settings)
        for name in (None, 5, b"hand", [], {}):
            for call in (corpuscle.population, corpuscle.LiveSkin, corpuscle.stimulus, corpuscle.catalogue):
                with self.subTest(name=name, call=call.__name__):
                    self.assertIn("is not a name", error_of(call, name))

    def test_an_afferent_that_is_given_twice_is_refused_with_the_text_of_the_command_line(self):
        self.assertEqual(error_of(corpuscle.respond, "press", afferent=["sa1", "sa1"]), "--afferent sa1: sa1 is given twice")

    def test_of_states(self):
        skin = corpuscle.LiveSkin("sa1")
        for state in (10**12, -1, 0, "abc", None, [1, 2], 2.5):
            self.assertIn("is not the bytes of save()", error_of(skin.resume, state))
        for state in (b"", bytearray(skin.save())[:-1], memoryview(skin.save())[1:]):
            error_of(skin.resume, state)
        skin.resume(bytearray(skin.save()))

    def test_of_indexes_and_windows(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        for which in (0.5, None, [0], 1j, True):
            self.assertIn("is not an integer", error_of(response.train, which))
        for length in (np.nan, np.inf, 1e300, -1e300, "x", None):
            error_of(response.psth, [0.1], before=length)
            error_of(response.psth, [0.1], after=length)

    def test_fields_of_a_force_that_were_changed_are_checked_again(self):
        for name, value in (("samples", None), ("samples", np.zeros((2, 2, 2))), ("samples", np.zeros(0)), ("samples", np.array(["x"])), ("rate", "x"),
                            ("rate", -1.0), ("start", None), ("start", np.nan), ("channels", None), ("channels", []), ("name", None), ("name", "\ud800")):
            force = corpuscle.Force(press(), 1000)
            with self.subTest(name=name, value=value), self.assertRaises(corpuscle.InputError):
                setattr(force, name, value)
                corpuscle.respond(force, afferent="sa1")
        force.samples = [1, 2, 3]
        self.assertEqual(corpuscle.respond(force, afferent="sa1").duration, 0.003)


class TextsWithNul(unittest.TestCase):
    def test_a_path_is_not_cut_at_a_nul(self):
        with tempfile.TemporaryDirectory() as folder:
            def write(name, text):
                path = os.path.join(folder, name)
                with open(path, "w") as file:
                    file.write(text)
                return path + "\0.csv"
            with open(f"{ROOT}/skins/fingertip.toml") as file:
                population = write("own.toml", file.read())
            recording = write("force.csv", "F_N\n" + "1\n" * 100)
            layout = write("layout.csv", "name,x_mm,y_mm\nF,0,0\n")
            netlist = f"{ROOT}/circuits/sa1-circuit.cir\0x"
            for call in (lambda: corpuscle.population(population).respond("press"), lambda: corpuscle.LiveSkin(population),
                         lambda: corpuscle.read(recording, rate=1000), lambda: corpuscle.read(recording[:-5], rate=1000, layout=layout),
                         lambda: corpuscle.hand().respond(press(), 1000, taxels=layout), lambda: corpuscle.LiveSkin("hand", taxels=layout),
                         lambda: corpuscle.respond("press", afferent=netlist), lambda: corpuscle.respond("press", settings={"sa1.f_B": "20\0Hz"}),
                         lambda: corpuscle.hand().respond("press", contact="flat\0x")):
                with self.assertRaises(corpuscle.InputError):
                    call()


class Sizes(unittest.TestCase):
    def test_counts_that_no_machine_can_hold_are_refused_at_once(self):
        start = time.process_time()
        self.assertIn("--copies 4294967295: the largest number is 1000000", error_of(corpuscle.respond, "press", afferent="sa1", copies=2**32 - 1))
        self.assertIn("too many", error_of(corpuscle.respond, np.zeros((2, 5000)), 1000, "sa1", copies=10**6))
        self.assertIn("1 to 4194304 sites", error_of(corpuscle.LiveSkin, "sa1", channels=2**32 - 1))
        self.assertIn("1 to 4194304 sites", error_of(corpuscle.LiveSkin, "sa1", channels=0))
        self.assertIn("1000000000 channels are too many", error_of(corpuscle.respond, np.broadcast_to(0.0, (2, 10**9)), 1000))
        for call in (lambda: corpuscle.LiveSkin("grid 100000x100000"), lambda: corpuscle.grid(10**9, 10**9).respond("press"),
                     lambda: corpuscle.grid(-1, 3).respond("press"), lambda: corpuscle.grid("a", None).respond("press")):
            error_of(call)
        self.assertLess(time.process_time() - start, 10)

    def test_bins_that_no_machine_can_hold_are_refused(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        for bin in (1e-9, 1e-300):
            self.assertIn("bins are too many", error_of(response.rate, bin))
            self.assertIn("bins are too many", error_of(response.psth, [0.1], bin=bin))

    def test_forces_at_the_ends_of_their_types_are_simulated(self):
        for force in (np.full(10, 65504, np.float16), np.full(10, 2**64 - 1, np.uint64), np.full(10, 1e308), np.full(10, -1e308), np.full(10, 5e-324),
                      np.full(10, np.finfo(np.longdouble).tiny)):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", corpuscle.Warning)
                response = corpuscle.respond(force, 1000, "sa1")
            self.assertTrue(np.isfinite(response.times).all())
        with np.errstate(over="ignore"):
            largest = np.full(10, np.finfo(np.longdouble).max)
            error_of(corpuscle.respond, largest, 1000, "sa1")  # infinite as a double


class ObjectsThatMisbehave(unittest.TestCase):
    def test_an_array_interface_that_raises_or_lies(self):
        class Raises:
            def __array__(self, *arguments, **options):
                raise KeyError("no array")

        class Lies:
            def __array__(self, *arguments, **options):
                return "text"

        with self.assertRaisesRegex(KeyError, "no array"):
            corpuscle.respond(Raises(), 1000)
        error_of(corpuscle.respond, Lies(), 1000)

    def test_a_list_that_changes_while_it_is_read(self):
        class Clears:
            def __init__(self, values):
                self.values = values

            def __float__(self):
                self.values.clear()
                return 1.0

        values = []
        values.extend(Clears(values) for _ in range(100))
        self.assertEqual(corpuscle.respond(values, 1000, "sa1").duration, 0.1)
        frame = []
        frame.extend(Clears(frame) for _ in range(4))
        self.assertEqual(corpuscle.LiveSkin("grid 2x2").push(frame), [])

    def test_objects_that_were_not_initialised(self):
        for kind, use in ((corpuscle.LiveSkin, lambda s: s.push([1.0])), (corpuscle.Response, lambda r: r.times), (corpuscle.Force, lambda f: f.times),
                          (corpuscle.Population, lambda p: p.respond("press")), (corpuscle.Stimulus, lambda f: corpuscle.respond(f))):
            with self.subTest(kind=kind), self.assertRaises((TypeError, AttributeError)):
                use(kind.__new__(kind))

    def test_a_force_that_another_thread_writes(self):
        force, done = np.full(200000, 1.0), threading.Event()

        def write():
            while not done.is_set():
                force[:] = 2.0
                force[:] = 1.0

        writer = threading.Thread(target=write)
        writer.start()
        try:
            response = corpuscle.respond(force, 1000, "sa1", copies=50)
        finally:
            done.set()
            writer.join()
        self.assertGreater(len(response), 0)


class ThreadsOnOneObject(unittest.TestCase):
    def together(self, function, count=6):
        """The results of a function that runs in several threads at once."""
        results, errors = [], []

        def run():
            try:
                results.append(function())
            except Exception as error:
                errors.append(error)

        threads = [threading.Thread(target=run) for _ in range(count)]
        for t in threads:
            t.start()
        for t in threads:
            t.join(60)
        self.assertEqual(errors, [])
        self.assertEqual(len(results), count)
        return results

    def test_of_a_live_skin(self):
        skin, frame = corpuscle.LiveSkin("grid 4x4"), np.full(16, 2.0)
        self.together(lambda: [skin.push(frame) for _ in range(200)] and skin.save())
        self.assertEqual(skin.frames, 1200)
        other = corpuscle.LiveSkin("grid 4x4")
        for _ in range(1200):
            other.push(frame)
        self.assertEqual(skin.save(), other.save())

    def test_of_a_response_and_a_population(self):
        response = corpuscle.respond("press", afferent=["sa1", "fa1"])
        results = self.together(lambda: (response.train("sa1").tolist(), response.summary, response.notes, response._repr_html_()))
        self.assertTrue(all(r == results[0] for r in results))
        skin = corpuscle.fingertip()
        results = self.together(lambda: skin.respond("press").times.tolist())
        self.assertTrue(all(r == results[0] for r in results))


class Forks(unittest.TestCase):
    def in_child(self, function, seconds=60):
        """The exit status of a forked child that calls the function. A child that hangs is killed, which fails the test."""
        child = os.fork()
        if child == 0:
            status = 1
            try:
                signal.alarm(seconds)
                status = 0 if function() else 2
            finally:
                os._exit(status)
        self.assertGreater(child, 0)
        return os.waitpid(child, 0)[1]

    def simulate(self):
        return corpuscle.respond(press(), 1000, "sa1", copies=300, spread={"f_B": "10%"}, threads=2).times.tolist()

    def test_a_child_simulates_on_threads(self):
        expected = self.simulate()
        self.assertEqual(self.in_child(lambda: self.simulate() == expected), 0)

    def test_a_child_of_a_process_in_which_a_run_is_going_on_simulates(self):
        expected, done = self.simulate(), threading.Event()

        def run():
            while not done.is_set():
                self.simulate()

        other = threading.Thread(target=run)
        other.start()
        try:
            for _ in range(5):
                self.assertEqual(self.in_child(lambda: self.simulate() == expected), 0)
        finally:
            done.set()
            other.join()

    def test_a_child_continues_a_live_skin_and_a_response_of_its_parent(self):
        skin, response = corpuscle.LiveSkin("grid 2x2"), corpuscle.hand().respond("press")
        expected = response.summary
        again = pickle_free_copy(response)
        self.assertEqual(self.in_child(lambda: skin.push([1.0] * 4) == [] and again.summary == expected and len(again._repr_html_()) > 1000), 0)
        self.assertEqual(skin.frames, 0)


def pickle_free_copy(response):
    """The same compiled response in a new object, whose fields have not been read."""
    return corpuscle.Response(response._raw, response.force, response._run)


if __name__ == "__main__":
    unittest.main()
