"""Parameters of an afferent from recorded spikes, or from published numbers (doc/fit.md)."""

import html
import json
import os

import numpy as np

from . import _corpuscle
from ._force import Force
from ._options import count, number, path_of, real_array, settings_of, text
from ._response import Response
from ._spikes import read_spikes


class Fit:
    """The result of a fit.

    - afferent: its name.
    - parameters: for each fitted parameter an object with name, unit, start, value, low, high (the 95 % interval; None if the data do not
      determine the parameter) and is_at_bound.
    - score, start_score: after and before the fit. 0 is equal; 1 is as far as silence, or, of targets, at the ends of their ranges.
    - test_score: of the held-out data, or None.
    - is_interrupted: the progress function ended the search; the values are the best so far, and intervals are missing.
    - warnings: reasons why the result may be wrong.
    """

    def __init__(self, raw):
        self._raw = raw
        for name in ("afferent", "parameters", "score", "start_score", "test_score", "is_interrupted", "warnings"):
            setattr(self, name, getattr(raw, name))

    @property
    def settings(self):
        """The fitted values for respond(afferent=fit.afferent, settings=fit.settings)."""
        return list(self._raw.settings)

    @property
    def document(self):
        """The document of `corpuscle fit afferent --json`."""
        return json.loads(self._raw.document)

    def __getitem__(self, name):
        """The fitted value of a parameter, in its unit."""
        for p in self.parameters:
            if p.name == name:
                return p.value
        raise KeyError(name)

    def to_pandas(self):
        """A row for each parameter: parameter, unit, start, value, low, high, is_at_bound."""
        import pandas
        names = ("name", "unit", "start", "value", "low", "high", "is_at_bound")
        return pandas.DataFrame([{n: getattr(p, n) for n in names} for p in self.parameters]).rename(columns={"name": "parameter"})

    def save(self, path):
        """Writes the fitted values as a sweep file with [set], as `corpuscle fit afferent -o` does. An existing file is not replaced."""
        try:
            with open(path, "x", encoding="utf-8") as file:
                file.write(self._raw.settings_file)
        except FileExistsError:
            raise _corpuscle.InputError(f"{os.fspath(path)}: exists; delete it or choose another name") from None

    def _rows(self):
        interval = lambda p: "not identified" if p.low is None else f"{p.low:.4g} to {p.high:.4g}"
        yield "parameter", "unit", "start", "value", "95 % interval"
        for p in self.parameters:
            yield p.name, p.unit, f"{p.start:.4g}", f"{p.value:.4g}", interval(p) + (", at its bound" if p.is_at_bound else "")

    def _score(self):
        return f"{self.afferent}: score {self.score:.3g}, before {self.start_score:.3g}" + (
            "" if self.test_score is None else f", held out {self.test_score:.3g}")

    def __repr__(self):
        rows = list(self._rows())
        widths = [max(len(row[k]) for row in rows) for k in range(5)]
        return "\n".join([self._score()] + ["  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows])

    def _repr_html_(self):
        rows = ["".join(f"<{'td' if k else 'th'}>{html.escape(cell)}</{'td' if k else 'th'}>" for cell in row) for k, row in enumerate(self._rows())]
        return f"<p>{html.escape(self._score())}</p><table>" + "".join(f"<tr>{row}</tr>" for row in rows) + "</table>"


def _trains_of(spikes, train):
    """(trains, name of their file) of the spikes of one recording."""
    if isinstance(spikes, Response):
        spikes, file = spikes.spikes, "the response"
        spikes = spikes if isinstance(spikes, dict) else {"": spikes}
    elif isinstance(spikes, (str, os.PathLike)):
        spikes, file = read_spikes(spikes), os.fspath(spikes)
    elif isinstance(spikes, dict):
        file = "spikes"
    else:
        repetitions = spikes if isinstance(spikes, (list, tuple)) and spikes and not np.isscalar(spikes[0]) else [spikes]
        trains = [real_array(one, "spikes") for one in repetitions]
        if any(one.ndim != 1 for one in trains):
            raise _corpuscle.InputError("spikes: an array of spike times must have one dimension: [spike]; give a list of arrays for repetitions")
        return trains, "spikes"
    if train is not None:
        wanted = [text(t, "train") for t in ([train] if isinstance(train, str) else train)]
        for name in wanted:
            if name not in spikes:
                raise _corpuscle.InputError(f"train '{name}': {file} has no such train; it has {', '.join(list(spikes)[:8])}")
        return [real_array(spikes[name], name) for name in wanted], file
    if len(spikes) != 1:
        raise _corpuscle.InputError(f"{file} has {len(spikes)} trains; choose those of one afferent: train=\"{next(iter(spikes), '')}\"")
    return [real_array(t, "spikes") for t in spikes.values()], file


def _bounds_of(bounds):
    """{"f_B": ("5 Hz", "50 Hz")} as texts "f_B=5 Hz:50 Hz"."""
    if bounds is None:
        return []
    pairs = bounds.items() if hasattr(bounds, "items") else None
    if pairs is None:
        return [text(b, "bounds") for b in ([bounds] if isinstance(bounds, str) else bounds)]
    out = []
    for name, ends in pairs:
        if not isinstance(ends, (list, tuple)) or len(ends) != 2:
            raise _corpuscle.InputError(f"bounds: '{name}' has {ends!r}; write (low, high)")
        low, high = settings_of({"low": ends[0], "high": ends[1]})
        out.append(f"{text(name, 'bounds')}={low[4:]}:{high[5:]}")
    return out


def fit(force=None, spikes=None, rate=None, *, targets=None, afferent="sa1", free=(), bounds=None, settings=None, train=None, tau=0.01, delay=0.0,
        hold_out=0.0, points=256, starts=8, evaluations=400, seed=1, threads=0, progress=None):
    """Fits parameters of an afferent to the spikes that were recorded under a force, and returns a Fit.

    - force: newtons of one channel, shape [sample], with `rate` in Hz; or a Force. Or a list of pairs (force, spikes), one for each recording.
    - spikes: spike times in s in the time of the force, shape [spike]. Or a list of such arrays for repetitions, the path of a spike file, or a
      Response.
    - train: names of the trains to use, if a file or Response has several.
    - targets: instead of force and spikes, the path of a table of published numbers. `rate` is then the sample rate of its stimuli.
    - afferent: one of equations.
    - free: names of the parameters to fit, ["k_A", "f_B"].
    - bounds: of parameters, {"f_B": ("5 Hz", "50 Hz")}.
    - settings: parameters that are kept, and starts of the search.
    - tau: width of the Gaussian that smooths the spikes, s.
    - delay: conduction delay, s, which is subtracted from the recorded times.
    - hold_out: fraction of the data that is not fitted, but scored: 0 to 0.9.
    - points, starts, evaluations, seed: of the search. The result does not depend on threads.
    - progress: a function that gets the completed fraction, 0 to 1, 20 times a second. If it returns False, the Fit has the best values so
      far. Ctrl-C ends the search.

    Raises InputError.
    """
    names = lambda values: [text(v, "free") for v in ([values] if isinstance(values, str) else values)]
    if progress is not None and not callable(progress):
        raise _corpuscle.InputError(f"progress = {progress!r} is not a function")
    task = _corpuscle.FitTask()
    afferent = text(afferent, "afferent")
    task.set_options(afferent, names(free), _bounds_of(bounds), settings_of(settings, afferent), number(tau, "tau"), number(delay, "delay"),
                     number(hold_out, "hold_out"), 0.0 if rate is None else number(rate, "rate"))
    task.set_search(*(count(value, name, 10**6) for name, value in (("points", points), ("starts", starts), ("evaluations", evaluations))),
                    count(seed, "seed", 2**64 - 1), count(threads, "threads", 1024))
    if targets is not None:
        if force is not None or spikes is not None:
            raise _corpuscle.InputError("fit: give either a force with its spikes, or targets")
        task.targets = path_of(targets)
        return Fit(task.run(progress))
    pairs = force if spikes is None and isinstance(force, (list, tuple)) else [(force, spikes)]
    for one in pairs:
        if not isinstance(one, (list, tuple)) or len(one) != 2 or one[0] is None or one[1] is None:
            raise _corpuscle.InputError("fit: there are no data; give a force and its spikes, a list of such pairs, or targets")
        _add(task, *one, rate, train)
    return Fit(task.run(progress))


def _add(task, force, spikes, rate, train):
    if not isinstance(force, Force):
        if rate is None:
            raise _corpuscle.InputError("fit: the rate of the force is missing: rate=1000 (Hz)")
        force = Force(force, rate)
    trains, file = _trains_of(spikes, train)
    task.add(force.samples, force.rate, force.start, force.channels, force.name, [t.tolist() for t in trains], file)
