"""Sweeps: one circuit, or one afferent, simulated many times with different values."""

import dataclasses
import functools
import html
import json

import numpy as np

from . import _corpuscle
from ._display import figure_html, plural, table_html
from ._options import count, path_of, text
from ._progress import progress_of

_SHOWN = 12  # rows of a table in a notebook


@dataclasses.dataclass(frozen=True)
class SweepQuantity:
    """An axis or a measure of a sweep. labels: of an axis such as the corner, whose value k means labels[k]; low, high: limits that an item must meet."""

    name: str
    unit: str
    description: str
    labels: list
    low: float | None
    high: float | None

    def heading(self):
        """The name with the unit."""
        return f"{self.name} ({self.unit})" if self.unit else self.name


class SweepResult:
    """The results of a sweep: a row for each finished item, in order. result["spikes"] is the column of an axis or a measure.

    Printed, it is the text of `corpuscle sweep show`. See sweep() and read_sweep().
    """

    def __init__(self, raw):
        self._raw = raw
        self.title, self.item_count = raw.title, raw.item_count
        self.axes = {q.name: q for q in (SweepQuantity(*fields) for fields in raw.axes)}
        self.measures = {q.name: q for q in (SweepQuantity(*fields) for fields in raw.measures)}

    def __getstate__(self):
        """For copy and pickle: the path of the results file, which is then read again."""
        return self._raw.results

    def __setstate__(self, path):
        self.__init__(_corpuscle.SweepRecords(path))

    @property
    def path(self):
        """The path of the results file."""
        return self._raw.results.decode(errors="surrogateescape")

    @property
    def items(self):
        """The number of each row's item in the sweep, from 0; int64, shape [row]."""
        return self._raw.items

    @property
    def ended(self):
        """How each row's item ended: "done", "truncated" (at its limit of iterations) or "diverged"."""
        return self._raw.ends

    @property
    def failures(self):
        """The items that did not end normally, at most 1,000: a list of (item, reason)."""
        return self._raw.failures

    @functools.cached_property
    def summary(self):
        """The document of `corpuscle sweep show --json`: yields, distributions, influences, with confidence intervals."""
        return json.loads(self._raw.summary())

    def __getitem__(self, name):
        """The values of an axis or a measure in SI units, float64, shape [row]; NaN where an item has no value. It shows memory of the library. The
        values of an axis with labels are their indices. Raises InputError."""
        name = text(name, "sweep")
        for known, values in ((list(self.axes), self._raw.axis_values), (list(self.measures), self._raw.measure_values)):
            if name in known:
                return values(known.index(name))
        raise _corpuscle.InputError(f"there is no axis or measure '{name}'; there are {', '.join([*self.axes, *self.measures])}")

    def __contains__(self, name):
        return name in self.axes or name in self.measures

    def __iter__(self):
        return iter([*self.axes, *self.measures])

    def __len__(self):
        """The number of finished items."""
        return len(self.items)

    def to_pandas(self):
        """A row for each finished item: item, ended, then the axes and the measures in SI units. Axes with labels are categories."""
        import pandas
        columns = {"item": self.items, "ended": pandas.Categorical(self.ended)}
        for name, axis in self.axes.items():
            columns[name] = pandas.Categorical.from_codes(self[name].astype(int), axis.labels) if axis.labels else self[name]
        return pandas.DataFrame({**columns, **{name: self[name] for name in self.measures}})

    def plot(self, measure=None, axis=None, ax=None):
        """Draws a measure over an axis with matplotlib, and returns the axes: the mean at each value, with the standard deviation. Without an axis in
        the sweep: a histogram.

        measure: by default the first. axis: by default the first. Raises InputError.
        """
        measure = next(iter(self.measures), None) if measure is None else text(measure, "measure")
        if measure not in self.measures:
            raise _corpuscle.InputError(f"there is no measure '{measure}'; there are {', '.join(self.measures)}")
        axis = next(iter(self.axes), None) if axis is None else text(axis, "axis")
        if axis is not None and axis not in self.axes:
            raise _corpuscle.InputError(f"there is no axis '{axis}'; there are {', '.join(self.axes)}")
        y = self[measure]
        if ax is None:
            import matplotlib.pyplot as plt
            ax = plt.subplots(figsize=(8, 3))[1]
        if axis is None:
            ax.hist(y[np.isfinite(y)], bins="auto" if np.ptp(y[np.isfinite(y)]) > 0 else 1) if np.isfinite(y).any() else None
            ax.set(xlabel=self.measures[measure].heading(), ylabel="items")
            return ax
        self._draw(ax, self[axis], y, self.axes[axis])
        ax.set(xlabel=self.axes[axis].heading(), ylabel=self.measures[measure].heading())
        return ax

    @staticmethod
    def _draw(ax, x, y, axis):
        good = np.isfinite(x) & np.isfinite(y)
        values, index = np.unique(x[good], return_inverse=True)
        if len(values) > 64:  # a sampled axis
            ax.plot(x[good], y[good], ".", markersize=3)
            return
        groups = [y[good][index == k] for k in range(len(values))]
        ax.errorbar(values, [g.mean() for g in groups], [g.std(ddof=1) if len(g) > 1 else 0 for g in groups], marker="o", markersize=4, capsize=3)
        if axis.labels:
            ax.set_xticks(range(len(axis.labels)), axis.labels)

    def __repr__(self):
        return self._raw.text().rstrip("\n")

    def _repr_html_(self):
        table = self.to_pandas()
        shown = table.head(_SHOWN)
        cell = lambda v: f"{v:.6g}" if isinstance(v, float) else v
        heading = ["item", "ended", *(q.heading() for q in [*self.axes.values(), *self.measures.values()])]
        lines = f"<p><b>{html.escape(self.title)}</b>: {plural(len(self), 'finished item')} of {self.item_count:,}</p>"
        picture = figure_html(self.plot) if len(self) and self.measures else ""
        return lines + picture + table_html(heading, ([cell(v) for v in row] for row in shown.itertuples(index=False)))


def sweep(source, results=None, *, seed=None, samples=None, threads=0, shard=None, progress=None):
    """Runs a sweep, and returns a SweepResult. Items that are already in the results file are not simulated again, so the same call resumes a sweep.

    - source: path of a sweep file (TOML, doc/sweeps.md) or of a netlist with .step and .mc; or the text of a sweep file, which has several lines.
    - results: path of the results file (SQLite). By default the name of the sweep file with .sqlite, in the current directory; of a text sweep.sqlite.
    - seed, samples: instead of those of the file. samples: at each point.
    - threads: 0: one for each core. The results do not depend on it.
    - shard: "1/3": one of three parts.
    - progress: a function of the completed fraction, 0 to 1; returns False to stop. None: a line in a terminal or in IPython; False: nothing.

    Raises InputError, with file, line and column; NotConvergedError if no item converged. Ctrl-C keeps the finished items.
    """
    is_text = isinstance(source, str) and "\n" in source
    source = source.encode(errors="replace") if is_text else path_of(source)
    seed = None if seed is None else count(seed, "seed", 2**64 - 1)
    samples = None if samples is None else count(samples, "samples", 2**53)
    if samples == 0:
        raise _corpuscle.InputError("samples = 0 must be above 0")
    with progress_of(progress) as function:
        return SweepResult(_corpuscle.sweep(source, is_text, b"" if results is None else path_of(results), "" if shard is None else text(shard, "shard"),
                                            seed, samples, count(threads, "threads", 1024), function))


def read_sweep(path):
    """Reads a results file of a sweep, also while the sweep runs, and returns a SweepResult. Raises InputError."""
    return SweepResult(_corpuscle.SweepRecords(path_of(path)))
