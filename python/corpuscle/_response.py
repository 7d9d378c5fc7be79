"""The response of a run: spikes, and numbers and pictures of them."""

import functools
import json
import numbers

import numpy as np

from . import _corpuscle
from . import _neo
from . import _nwb
from . import _report
from ._options import bin_count, number, real_array

_FIELDS = ("times", "indices", "names", "types", "channels", "positions", "start", "duration", "notes", "warnings")


def measures(train, start, stop):
    """All measures of a spike train in the window [start, stop), as a dictionary; NaN where a measure is not defined.

    train: spike times in s, in order, shape [spike]; start, stop: s.

    Raises InputError for a window that does not end after it begins.
    """
    train = real_array(train, "train")
    if train.ndim != 1:
        raise _corpuscle.InputError(f"train: the array has {train.ndim} dimensions; it must have one: [spike]")
    if not np.all(np.diff(train) >= 0):
        raise _corpuscle.InputError("train: the spike times are not in order")
    values = _corpuscle.measure_train(train, number(start, "start"), number(stop, "stop"))
    return {name: value for (name, _, _), value in zip(_corpuscle.measure_catalogue(), values)}


measures.__doc__ = (measures.__doc__ or "") + "\n    The measures:\n\n" + "\n".join(
    f"        {name}{unit and f' ({unit})'}: {description}" for name, unit, description in _corpuscle.measure_catalogue()) + "\n"


def _positive(value, name):
    value = number(value, name)
    if not 0 < value < np.inf:
        raise _corpuscle.InputError(f"{name} = {value:g} s must be above 0")
    return value


class _RawField(functools.cached_property):
    """A field of the compiled response, converted when it is first read."""

    def __init__(self, name, doc):
        super().__init__(lambda self: getattr(self._raw, name))
        self.__doc__ = doc


class Response:
    """The spikes of all afferents of a run."""

    times = _RawField("times", "Spike times in s, in order; float64, shape [spike]. It shows memory of the library, and is read-only.")
    indices = _RawField("indices", "For each spike, the index of its afferent; uint32, shape [spike]. It shows memory of the library.")
    names = _RawField("names", "The name of each afferent: \"sa1\"; of a copy or in a skin \"sa1#17\".")
    types = _RawField("types", "The name of each afferent without the number of the copy.")
    channels = _RawField("channels", "The channel, or the region of the skin, of each afferent.")
    positions = _RawField("positions", "The position of each afferent in a skin, m, shape [afferent, 2]; NaN on channels.")
    start = _RawField("start", "Time of the first sample of the force, s.")
    duration = _RawField("duration", "Length of the force, s.")
    warnings = _RawField("warnings", "Reasons why the response may be wrong, with the texts of the command line.")

    def __init__(self, raw, force, run=None, seconds=0.0):
        self._raw, self.force, self._run, self._seconds = raw, force, run, seconds

    @functools.cached_property
    def notes(self):
        """Notes about the force and the run, with the texts of the command line. If an afferent never fired, they say which force it needs."""
        return self._raw.notes + self._raw.silence_notes()

    def __getstate__(self):
        """For copy and pickle: all fields, with the memory of the arrays."""
        return {"_raw": None, "_run": self._run, "_seconds": self._seconds, "force": self.force, "summary": self.summary, **{name: getattr(self, name) for name in _FIELDS}}

    @functools.cached_property
    def summary(self):
        """The document of summary.json: every measure of every afferent, parameters, input, warnings."""
        return json.loads(self._raw.summary())

    @functools.cached_property
    def _trains(self):
        order = np.argsort(self.indices, kind="stable")
        ends = np.searchsorted(self.indices[order], np.arange(len(self.names) + 1))
        times = self.times[order]
        return [times[ends[k]:ends[k + 1]] for k in range(len(self.names))]

    def __len__(self):
        """The number of spikes."""
        return len(self.times)

    def label(self, k):
        """The name of afferent k, with its channel if there are several."""
        return f"{self.names[k]} {self.channels[k]}" if len(set(self.channels)) > 1 and np.isnan(self.positions[k, 0]) else self.names[k]

    def train(self, which=0):
        """The spike times of one afferent, s: by index, or by name."""
        if isinstance(which, str):
            found = [k for k in range(len(self.names)) if which in (self.names[k], self.label(k))]
            if not found:
                raise _corpuscle.InputError(f"there is no afferent '{which}'; there are {', '.join(self.names[:8])}" + (" ..." if len(self.names) > 8 else ""))
            which = found[0]
        if isinstance(which, (bool, np.bool_)) or not isinstance(which, numbers.Integral):
            raise _corpuscle.InputError(f"which = {which!r} is not an integer")
        if not -len(self.names) <= which < len(self.names):
            raise _corpuscle.InputError(f"there is no afferent {which}; the last is {len(self.names) - 1}")
        return self._trains[which]

    @property
    def spikes(self):
        """The spike times in s: an array if there is one afferent, otherwise a dictionary by afferent."""
        return self._trains[0] if len(self.names) == 1 else {self.label(k): self._trains[k] for k in range(len(self.names))}

    def rate(self, bin=0.02, type=None):
        """The firing rate over time: (times of the bins' middles in s, mean rate of the afferents in Hz), both of shape [bin].

        bin: s. type: only the afferents of this type, "sa1".
        """
        bin = _positive(bin, "bin")
        chosen = np.array([type is None or t == type for t in self.types])
        if not chosen.any():
            raise _corpuscle.InputError(f"there is no afferent of type '{type}'; there are {', '.join(dict.fromkeys(self.types))}")
        edges = self.start + np.arange(int(np.ceil(bin_count(self.duration, bin))) + 1) * bin
        counts = np.histogram(self.times[chosen[self.indices]], edges)[0]
        return (edges[:-1] + edges[1:]) / 2, counts / (bin * chosen.sum())

    def psth(self, events, before=0.1, after=0.5, bin=0.01, which=0):
        """The peri-stimulus time histogram of an afferent: (times relative to the events in s, rate in Hz), both of shape [bin].

        - events: their times, s.
        - before, after: length of the histogram on both sides of an event, s.
        - bin: width of a bin, s.
        - which: index or name of the afferent.
        """
        events = np.atleast_1d(real_array(events, "events"))
        if events.ndim != 1 or len(events) == 0 or not np.isfinite(events).all():
            raise _corpuscle.InputError("events: there must be one or more finite times, in one dimension")
        bin = _positive(bin, "bin")
        before, after = number(before, "before"), number(after, "after")
        edges = -before + np.arange(int(round(bin_count(before + after, bin))) + 1) * bin
        if len(edges) < 2:
            raise _corpuscle.InputError("psth: before + after must be at least one bin")
        train = self.train(which)
        counts = np.zeros(len(edges) - 1, dtype=np.int64)
        for event in events:
            first, last = np.searchsorted(train, [event + edges[0], event + edges[-1]])
            counts += np.histogram(train[first:last] - event, edges)[0]
        return (edges[:-1] + edges[1:]) / 2, counts / (bin * len(events))

    def trials(self, epochs=None, align="start", window=None, threshold=None):
        """The responses to parts of the force, as TrialResponses.

        - epochs: as of corpuscle.trials(): (start, stop, label) in s, a DataFrame or a path. None: each contact of the force.
        - align: time 0 of a trial: its "start", or its first contact "onset".
        - window: (from, to), the measured time around it, s. None: the complete trial.
        - threshold: of a contact onset, N. None: from the noise at rest.

        Raises InputError for a trial outside of the force.
        """
        from . import _trials
        if epochs is None:
            if self.force is None:
                raise _corpuscle.InputError("trials: contacts need the force: respond to a Force instead of the name of a stimulus, or give epochs")
            found = _trials.contacts(self.force, threshold).trials(self.start + self.duration)
            if not found:
                raise _corpuscle.InputError("trials: there is no contact in the force; give a lower threshold, or epochs")
        else:
            found = _trials.trials(epochs)
        return _trials.analyse([(self, self.force, found)], align, window, threshold)

    def measures(self, start=None, stop=None):
        """All measures of each afferent in the window [start, stop) in s (default: the whole force), as a pandas DataFrame."""
        import pandas
        start = self.start if start is None else start
        stop = self.start + self.duration if stop is None else stop
        rows = [{"afferent": self.names[k], "channel": self.channels[k], **measures(self._trains[k], start, stop)} for k in range(len(self.names))]
        return pandas.DataFrame(rows)

    def to_pandas(self):
        """A row for each spike: time_s, afferent, type, channel."""
        import pandas
        pick = lambda values: pandas.Categorical.from_codes(*self._codes(values))
        return pandas.DataFrame({"time_s": self.times, "afferent": pick(self.names), "type": pick(self.types), "channel": pick(self.channels)})

    def _codes(self, values):
        categories, codes = np.unique(np.asarray(values, dtype=object).astype(str), return_inverse=True)
        return codes[self.indices], categories

    @functools.cached_property
    def models(self):
        """The models: for each afferent a dictionary with "model", "properties", and each of its parameters by name, in SI units."""
        names, properties, parameters = self._compiled().models()
        out = [{"model": name, "properties": text} for name, text in zip(names, properties)]
        for name, _, _, values in parameters:
            for k in np.flatnonzero(~np.isnan(values)):
                out[k].setdefault(name, float(values[k]))
        return out

    def _compiled(self):
        """The compiled response. That of a copied or pickled response is simulated again."""
        if self._raw is None:
            self._raw = self._run()
        return self._raw

    def to_nwb(self, path, *, trials=(), measured=None, overwrite=False, **fields):
        """Writes spikes, force and parameters as an NWB 2 file (doc/formats.md).

        - path: of the file. An existing file is replaced only if overwrite=True.
        - trials: of the session, as for trials().
        - measured: True if the force was measured. By default it is if it was read from a file.
        - fields: of NWB, by their names: session_start_time="2026-03-01T12:00:00+01:00", experimenter=["Doe, Jane"], subject={"subject_id": "m1"}.

        Raises InputError for a response that NWB cannot express, such as two spikes of an afferent at one time.
        """
        _nwb.write(self, path, trials, measured, overwrite, fields)

    def to_neo(self, trials=()):
        """A neo.Block with one segment: a SpikeTrain for each afferent, annotated with its names, model and parameters, the force as an
        AnalogSignal in N, and an Epoch of the trials, which are given as for trials().

        Raises ImportError if neo is not installed (Debian: python3-neo).
        """
        return _neo.block_of(self, trials)

    def plot(self, ax=None, max_rows=200):
        """Draws force and spikes with matplotlib, and returns the axes of the raster."""
        import matplotlib.pyplot as plt
        force_axes = None
        if ax is None:
            figure, (force_axes, ax) = plt.subplots(2, 1, figsize=(8, 4), sharex=True, height_ratios=[1, 2])
            if self.force is None:
                force_axes.remove()
            else:
                self.force.plot(force_axes)
                force_axes.set_xlabel("")
        active = [k for k in range(len(self.names)) if len(self._trains[k])] or [0]
        rows = active if len(active) <= max_rows else [active[int(i)] for i in np.linspace(0, len(active) - 1, max_rows)]
        types = list(dict.fromkeys(self.types))
        ax.eventplot([self._trains[k] for k in rows], colors=[f"C{types.index(self.types[k])}" for k in rows], linelengths=0.8, linewidths=1)
        if len(rows) <= 20:
            ax.set_yticks(range(len(rows)), [self.label(k) for k in rows])
        else:
            ax.set_ylabel(f"{len(rows)} of {len(active)} active afferents")
        ax.invert_yaxis()
        ax.set(xlabel="time (s)", xlim=(self.start, self.start + self.duration))
        return ax

    def report(self, path):
        """Writes the report page of `corpuscle respond --report`: self-contained HTML with force, spikes, rates, currents and parameters.

        path: of the page, which must end in .html. An earlier report page is replaced, another file is not. The run is simulated again. Raises
        InputError for another path, and if the force or a file of the run has changed.
        """
        _report.write(self, path)

    def _repr_html_(self):
        """The report in a notebook, at most 2 MB. A run that took more than 5 s is not repeated: only text is shown."""
        return _report.display(self)

    def __repr__(self):
        plural = lambda n, noun: f"{n:,} {noun}{'s' * (n != 1)}"
        return f"<Response: {plural(len(self), 'spike')} of {plural(len(self.names), 'afferent')} in {self.duration:.4g} s>"
