"""How long results live, and copies of them."""

import copy
import gc
import pickle
import unittest

import corpuscle
import numpy as np
from support import press


class Responses(unittest.TestCase):
    def test_a_million_spikes_share_the_memory_of_the_library(self):
        response = corpuscle.respond(np.full(10000, 4.0), 1000, "sa1", copies=5000)
        self.assertGreater(len(response), 1_000_000)
        for values, again in ((response.times, response._raw.times), (response.indices, response._raw.indices)):
            self.assertTrue(np.shares_memory(values, again))
            self.assertFalse(values.flags.owndata)
            self.assertIs(values.base, response._raw)
            self.assertFalse(values.flags.writeable)
            with self.assertRaises(ValueError):
                values[0] = 1
        self.assertTrue((np.diff(response.times) >= 0).all())

    def test_arrays_live_longer_than_their_response(self):
        response = corpuscle.respond(press(), 1000, "sa1")
        times, indices, train, expected = response.times, response.indices, response.train(), response.times.tolist()
        del response
        gc.collect()
        garbage = [np.random.default_rng(0).random(len(expected)) for _ in range(1000)]  # would overwrite freed memory
        self.assertEqual(times.tolist(), expected)
        self.assertEqual(train.tolist(), expected)
        self.assertEqual(set(indices.tolist()), {0})
        self.assertEqual(len(garbage), 1000)

    def test_the_force_is_not_changed_and_not_kept_by_the_spikes(self):
        force = press()
        before = force.copy()
        response = corpuscle.respond(force, 1000, "sa1")
        expected = response.times.tolist()
        np.testing.assert_array_equal(force, before)
        force[:] = np.nan
        self.assertEqual(response.times.tolist(), expected)
        self.assertGreater(response.summary["work"]["spikes"], 0)

    def test_the_summary_of_a_skin_is_made_after_the_skin_is_gone(self):
        skin = corpuscle.grid(4, 4)
        response = skin.respond("press")
        del skin
        gc.collect()
        summary = response.summary
        self.assertEqual(summary, corpuscle.grid(4, 4).respond("press").summary)

    def test_copies_and_pickles_are_equal(self):
        for response in (corpuscle.respond(press(), 1000), corpuscle.grid(3, 3).respond("press")):
            for other in (copy.copy(response), copy.deepcopy(response), pickle.loads(pickle.dumps(response))):
                np.testing.assert_array_equal(other.times, response.times)
                np.testing.assert_array_equal(other.indices, response.indices)
                np.testing.assert_array_equal(other.positions, response.positions)
                self.assertEqual((other.names, other.types, other.channels, other.summary, other.warnings, other.duration),
                                 (response.names, response.types, response.channels, response.summary, response.warnings, response.duration))
                self.assertEqual(repr(other), repr(response))

    def test_forces_and_catalogues_are_copied(self):
        for force in (corpuscle.Force(press(), 1000, ["fz"]), corpuscle.press(F_max=2)):
            for other in (copy.deepcopy(force), pickle.loads(pickle.dumps(force))):
                np.testing.assert_array_equal(other.samples, force.samples)
                self.assertEqual((other.rate, other.channels, other.name), (force.rate, force.channels, force.name))
        self.assertEqual(pickle.loads(pickle.dumps(corpuscle.afferents())), corpuscle.afferents())

    def test_the_compiled_objects_refuse_pickle_and_copy(self):
        raw = corpuscle.respond(press(), 1000)._raw
        for function in (pickle.dumps, copy.copy, copy.deepcopy):
            with self.assertRaises(TypeError):
                function(raw)


class LiveSkins(unittest.TestCase):
    def run_skin(self, skin, forces):
        return [spike for force in forces for spike in skin.push([force] * skin.frame_size)]

    def test_saved_copied_and_pickled_skins_continue_with_the_same_spikes(self):
        skin = corpuscle.LiveSkin("grid 2x2", settings={"sa1.f_B": "25 Hz"})
        self.run_skin(skin, press()[:300])
        others = [copy.deepcopy(skin), copy.copy(skin), pickle.loads(pickle.dumps(skin)),
                  corpuscle.LiveSkin("grid 2x2", settings={"sa1.f_B": "25 Hz"})]
        others[-1].resume(skin.save())
        expected = self.run_skin(skin, press()[300:])
        self.assertGreater(len(expected), 5)
        for other in others:
            self.assertEqual(self.run_skin(other, press()[300:]), expected)

    def test_other_bytes_are_refused(self):
        skin = corpuscle.LiveSkin("grid 2x2")
        state = skin.save()
        for bad in (b"", b"x" * 100, state[:-1], state + b"x", corpuscle.LiveSkin("grid 3x3").save()):
            with self.assertRaises(corpuscle.InputError):
                skin.resume(bad)
        self.assertEqual(len(skin.push(np.zeros(4))), 0)

    def test_indexes_beyond_the_end_are_refused(self):
        skin = corpuscle.LiveSkin("sa1,fa1")
        self.assertIn("sa1", skin.name(0))
        for function in (skin.name, skin.site):
            for index in (2, -1, 2**32 - 1, 2**32, 1.5):
                with self.assertRaises(corpuscle.InputError):
                    function(index)


if __name__ == "__main__":
    unittest.main()
