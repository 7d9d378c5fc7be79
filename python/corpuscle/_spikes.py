"""Spike trains in files."""

from . import _corpuscle
from ._options import path_of, text


def _column(value):
    return "" if value is None else text(value, "column")


def trains_of(path, time=None, train=None):
    """(afferent, channel, times) of each train of a file."""
    return _corpuscle.read_spike_trains(path_of(path), _column(time), _column(train))


def read_spikes(path, time=None, train=None):
    """Reads the spike trains of a file: a dictionary from the name of the train to its spike times in s, shape [spike].

    - path: a file in any format that `corpuscle compare` reads: CSV, JSON, NPY, NPZ, address events (doc/events.md).
    - time, train: the columns of a table, by name or number from 1. By default they are found by their headings.

    A name is that of the afferent, or "afferent channel" if the file has several channels. Raises InputError, with file and line where they
    are known.
    """
    trains = trains_of(path, time, train)
    one_channel = len({channel for _, channel, _ in trains}) < 2
    return {afferent if one_channel or not channel else f"{afferent} {channel}": times for afferent, channel, times in trains}
