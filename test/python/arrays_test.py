"""Arrays of every layout and type: the same spikes, or an error."""

import unittest

import corpuscle
import numpy as np
from support import press


def spikes(force, rate=1000.0):
    response = corpuscle.respond(force, rate, "sa1")
    return [response.train(k).tolist() for k in range(len(response.names))]


class ArraysOfEveryLayout(unittest.TestCase):
    def setUp(self):
        self.one = press()
        self.two = np.column_stack([press(), 0.5 * press()])
        self.expected = spikes(self.one) + spikes(self.two[:, 1].copy())
        self.assertGreater(len(self.expected[0]), 3)

    def test_a_list_and_a_tuple_are_arrays(self):
        self.assertEqual(spikes(self.one.tolist()), self.expected[:1])
        self.assertEqual(spikes(tuple(self.one)), self.expected[:1])

    def test_two_channels_in_c_and_fortran_order_give_the_same(self):
        self.assertEqual(spikes(self.two), self.expected)
        self.assertEqual(spikes(np.asfortranarray(self.two)), self.expected)
        self.assertEqual(spikes(np.array(self.two.T).T), self.expected)

    def test_strides_are_followed(self):
        wide = np.full((len(self.one), 5), 99.0)
        wide[:, 3] = self.one
        self.assertEqual(spikes(wide[:, 3]), self.expected[:1])
        self.assertEqual(spikes(wide[:, 3:4]), self.expected[:1])
        tall = np.repeat(self.one, 3)
        self.assertEqual(spikes(tall[::3]), self.expected[:1])

    def test_negative_strides_are_followed(self):
        self.assertEqual(spikes(self.one[::-1].copy()[::-1]), self.expected[:1])
        self.assertEqual(spikes(self.two[::-1, ::-1].copy()[::-1, ::-1]), self.expected)

    def test_a_broadcast_array_is_a_constant_force(self):
        self.assertEqual(spikes(np.broadcast_to(2.0, 1000)), spikes(np.full(1000, 2.0)))

    def test_read_only_and_big_endian_and_unaligned_arrays_are_read(self):
        frozen = self.one.copy()
        frozen.flags.writeable = False
        self.assertEqual(spikes(frozen), self.expected[:1])
        self.assertEqual(spikes(self.one.astype(">f8")), self.expected[:1])
        packed = np.zeros(len(self.one), dtype=[("flag", "i1"), ("force", "f8"), ("other", "f4")])
        packed["force"] = self.one
        self.assertFalse(packed["force"].flags.aligned)
        self.assertEqual(spikes(packed["force"]), self.expected[:1])

    def test_a_float64_array_is_not_copied(self):
        for array in (self.one, self.one[::-2], self.two, self.two.T.copy().T):
            self.assertTrue(np.shares_memory(corpuscle.Force(array, 1000).samples, array))

    def test_random_layouts_give_what_a_plain_copy_gives(self):
        random = np.random.default_rng(1)
        for _ in range(150):
            dtype = random.choice(["<f8", ">f8", "<f4", ">f4", "i2", "u1"])
            base = (4 * random.random((60, 3, 3))).astype(dtype).repeat(10, axis=0)
            base = np.asfortranarray(base) if random.random() < 0.5 else base
            view = base.transpose(random.permutation(3)) if random.random() < 0.2 else base
            view = view[tuple(slice(None, None, int(random.choice([-2, -1, 1, 2, 3]))) for _ in range(3))]
            view = view[:, int(random.integers(view.shape[1]))]
            view = view[:, int(random.integers(view.shape[1]))] if random.random() < 0.5 else view
            self.assertEqual(spikes(view), spikes(np.array(view, dtype=np.float64, order="C")), (dtype, view.strides))

    def test_numpy_subclasses_and_pandas_are_arrays(self):
        import pandas
        self.assertEqual(spikes(pandas.Series(self.one)), self.expected[:1])
        self.assertEqual(spikes(pandas.DataFrame(self.two)), self.expected)
        self.assertEqual(spikes(np.ma.masked_array(self.one)), self.expected[:1])


class TypesOfNumbers(unittest.TestCase):
    def test_numbers_of_other_types_are_converted(self):
        whole = np.where(press() > 1, 2, 0)
        expected = spikes(whole.astype(float))
        for dtype in (np.int8, np.uint8, np.int64, np.uint64, np.float16, np.float32, np.longdouble, object):
            self.assertEqual(spikes(whole.astype(dtype)), expected, dtype)

    def test_values_that_are_not_real_numbers_are_refused(self):
        for values in ([True, False], np.zeros(5, complex), ["1", "2"], [b"1"], [None, "x"], [object()], np.zeros(5, "datetime64[s]"),
                       np.array([1.0, "2"], object), np.array([1.0, True], object), np.array([1.0, 2j], object), np.zeros(3, [("a", "f8")]), {"a": 1}, {1.0, 2.0}, [[1.0, 2.0], [3.0]]):
            with self.assertRaises(corpuscle.InputError, msg=repr(values)):
                corpuscle.respond(values, 1000, "sa1")

    def test_nan_and_infinity_are_refused_with_the_sample(self):
        for value in (np.nan, np.inf, -np.inf, None):
            force = press().astype(object)
            force[7] = value
            with self.assertRaisesRegex(corpuscle.InputError, "'ch1': the force of sample 7 is not a finite number"):
                corpuscle.respond(force, 1000, "sa1")

    def test_arrays_of_other_shapes_are_refused(self):
        for shape in ((), (2, 3, 4), (1, 1, 1, 1)):
            with self.assertRaisesRegex(corpuscle.InputError, f"the array has {len(shape)} dimensions"):
                corpuscle.respond(np.zeros(shape), 1000, "sa1")

    def test_arrays_without_samples_or_channels_are_refused(self):
        for shape in ((0,), (0, 2), (10, 0), (0, 0)):
            with self.assertRaisesRegex(corpuscle.InputError, "the force has no samples"):
                corpuscle.respond(np.zeros(shape), 1000, "sa1")

    def test_one_sample_is_a_force(self):
        self.assertEqual(len(corpuscle.respond(np.zeros(1), 1000, "sa1")), 0)
        self.assertEqual(len(corpuscle.respond(np.zeros((1, 3)), 1000, "sa1").names), 3)


class Frames(unittest.TestCase):
    def setUp(self):
        self.skin = corpuscle.LiveSkin("grid 2x3")

    def test_a_frame_of_another_size_is_refused(self):
        for size in (0, 5, 7, 6000):
            with self.assertRaisesRegex(corpuscle.InputError, "6"):
                self.skin.push(np.zeros(size))
        self.assertEqual(self.skin.frames, 0)

    def test_a_frame_that_is_not_of_finite_real_numbers_is_refused(self):
        for frame in ([np.nan] * 6, np.zeros(6, complex), ["a"] * 6, [None] * 6, [True] * 6, None):
            with self.assertRaises(corpuscle.InputError, msg=repr(frame)):
                self.skin.push(frame)

    def test_frames_of_any_layout_give_the_same_spikes(self):
        other = corpuscle.LiveSkin("grid 2x3")
        wide = np.zeros(12)
        total = 0
        for force in press():
            wide[::2] = force
            expected = self.skin.push([force] * 6)
            self.assertEqual(other.push(wide[::2][::-1]), expected)
            total += len(expected)
        self.assertGreater(total, 10)


if __name__ == "__main__":
    unittest.main()
