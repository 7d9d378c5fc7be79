"""Spike trains compared with one another."""

import html
import json
import os

import numpy as np

from . import _corpuscle
from ._circuit import CircuitResult
from ._display import figure_html, table_html
from ._options import number, path_of, real_array, text
from ._progress import progress_of
from ._response import Response
from ._spikes import trains_of

_FIELDS = ("a", "b", "spikes_a", "spikes_b", "matched", "missing", "extra", "max_shift_s", "rms_shift_s", "victor_purpura", "victor_purpura_per_spike",
           "van_rossum")


class Comparison:
    """How the spike trains of two results differ. Printed, it is the table of `corpuscle compare`.

    - pairs: a dictionary for each pair of trains, with the names a and b.
    - spikes_a, spikes_b, matched: numbers of spikes. missing are those of a without a match, extra are those of b without one.
    - max_shift_s, rms_shift_s: of matched spikes, s; NaN if there are none.
    - victor_purpura, van_rossum: distances. victor_purpura_per_spike: 0 to 1.
    - total: the same of all pairs together.
    """

    def __init__(self, rows, table, document):
        self.pairs = [dict(zip(_FIELDS, row)) for row in rows[:-1]]
        self.total = dict(zip(_FIELDS, rows[-1]))
        self._table, self._document = table, document

    @property
    def document(self):
        """The document of `corpuscle compare --json`."""
        return json.loads(self._document)

    def to_pandas(self):
        """A row for each pair of trains."""
        import pandas
        return pandas.DataFrame(self.pairs, columns=list(_FIELDS))

    def plot(self, ax=None):
        """Draws the matched, missing and extra spikes of each pair with matplotlib, and returns the axes."""
        if ax is None:
            import matplotlib.pyplot as plt
            ax = plt.subplots(figsize=(8, 3))[1]
        names = [p["a"] if p["a"] == p["b"] else f"{p['a']} - {p['b']}" for p in self.pairs]
        left = np.zeros(len(names))
        for field, color in (("matched", "C0"), ("missing", "C3"), ("extra", "C1")):
            values = np.array([p[field] for p in self.pairs], dtype=float)
            ax.barh(range(len(names)), values, left=left, label=field, color=color)
            left += values
        if len(names) <= 30:
            ax.set_yticks(range(len(names)), names)
        ax.invert_yaxis()
        ax.set(xlabel="spikes")
        ax.legend(fontsize="small")
        return ax

    def __repr__(self):
        return self._table.rstrip("\n")

    def _repr_html_(self):
        cell = lambda v: f"{v:.6g}" if isinstance(v, float) else v
        rows = [[cell(v) for v in p.values()] for p in self.pairs[:50]]
        settings = self._table.rstrip("\n").rsplit("\n", 1)[-1]
        return (figure_html(self.plot) if self.pairs else "") + table_html(_FIELDS, rows) + f"<p>{html.escape(settings)}</p>"


def _is_path(value):
    return isinstance(value, (str, bytes, os.PathLike))


def _trains(value, name):
    """The trains of an argument: (afferent, channel, times) of each."""
    if _is_path(value):
        return trains_of(value)
    if isinstance(value, Response):
        return [(value.names[k], value.channels[k], value.train(k)) for k in range(len(value.names))]
    if isinstance(value, CircuitResult):
        if value.spikes is None:
            raise _corpuscle.InputError(f"{name}: the result has no spikes; the netlist needs a line such as .spike v(s) 0.35")
        return [("", "", value.spikes)]
    if isinstance(value, dict):
        return [(text(train, name), "", _times(times, name)) for train, times in value.items()]
    return [("", "", _times(value, name))]


def _times(value, name):
    times = real_array(value, name)
    if times.ndim != 1:
        raise _corpuscle.InputError(f"{name}: the array has {times.ndim} dimensions; it must have one: [spike]")
    return times


def compare(a, b, *, pairs=(), by_order=False, window=5e-3, cost=100.0, tau=10e-3, progress=None):
    """Compares spike trains, as `corpuscle compare` does, and returns a Comparison. a is the reference.

    - a, b: each a Response, a path of a spike file, a dictionary from names to spike times in s, one array of times, or the result of a circuit with .spike.
    - pairs: {"sa1": "sa1-kim"}, or texts such as "sa1=sa1-kim": which train of a is compared with which of b. By default trains of equal name; two single
      trains are compared even if their names differ.
    - by_order: compares the first train of a with the first of b, and so on.
    - window: the longest time between matching spikes, s.
    - cost: of moving a spike in the Victor-Purpura distance, 1/s.
    - tau: the time constant of the van Rossum distance, s.
    - progress: a function of the completed fraction, 0 to 1; returns False to stop. None: a line in a terminal or in IPython; False: nothing.

    Raises InputError.
    """
    settings = _corpuscle.ComparisonSettings()
    items = pairs.items() if isinstance(pairs, dict) else None
    settings.pairs = [f"{text(x, 'pairs')}={text(y, 'pairs')}" for x, y in items] if items is not None else [
        text(p, "pairs") for p in ([pairs] if isinstance(pairs, str) else pairs)]
    settings.by_order = bool(by_order)
    settings.window, settings.cost, settings.tau = number(window, "window"), number(cost, "cost"), number(tau, "tau")
    with progress_of(progress) as function:
        if _is_path(a) and _is_path(b):
            return Comparison(*_corpuscle.compare_files(path_of(a), path_of(b), settings, function))
        return Comparison(*_corpuscle.compare(_trains(a, "a"), _trains(b, "b"), settings, function))
