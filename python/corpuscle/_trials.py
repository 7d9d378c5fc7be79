"""Trials: parts of a force, or forces of their own, whose responses are compared."""

import dataclasses
import os
import tempfile

import numpy as np

from . import _corpuscle
from ._force import Force
from ._options import number, path_of, real_array, show_warnings, text

@dataclasses.dataclass(frozen=True)
class Epoch:
    """A trial [start, stop) of a force, in s on its clock. Trials with the same label are averaged. It unpacks into the three."""

    start: float
    stop: float
    label: str = "trial"

    def __iter__(self):
        return iter((self.start, self.stop, self.label))


def trials(table, label=None):
    """Trials from a table, as a list of Epoch in order of time.

    - table: a path of a table start,stop,label or of an NWB file (doc/trials.md), a pandas DataFrame with these columns, or a sequence of
      (start, stop) or (start, stop, label).
    - label: the name of the column of the labels.

    Raises InputError, with file, line and value where they are known.
    """
    name = "" if label is None else text(label, "label")
    if isinstance(table, (str, os.PathLike)):
        return [Epoch(t.start, t.stop, t.label) for t in _corpuscle.read_trial_table(path_of(table), name)]
    if hasattr(table, "to_csv"):
        return [Epoch(t.start, t.stop, t.label) for t in _read_frame(table, name)]
    out = [_epoch(k, row) for k, row in enumerate(table)]
    if not out:
        raise _corpuscle.InputError("trials: there are none")
    return sorted(out, key=tuple)


def trials_of(table):
    """Trials from a table, or none."""
    return [] if isinstance(table, (list, tuple)) and not table else trials(table)


def _read_frame(table, label):
    """The trials of a DataFrame. The reader of files reads it, so that both have the same columns, units and errors."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "table.csv")
        table.to_csv(path, index=False)
        try:
            return _corpuscle.read_trial_table(path_of(path), label)
        except _corpuscle.InputError as error:
            raise _corpuscle.InputError(str(error).replace(path, "the table")) from None


def _epoch(k, row):
    row = tuple(row) if isinstance(row, Epoch) else row
    if isinstance(row, str) or not hasattr(row, "__len__") or len(row) not in (2, 3):
        raise _corpuscle.InputError(f"trials: {row!r} is not (start, stop) or (start, stop, label)")
    start, stop = number(row[0], f"start of trial {k + 1}"), number(row[1], f"stop of trial {k + 1}")
    if not (np.isfinite(start) and np.isfinite(stop) and start < stop):
        raise _corpuscle.InputError(f"trial {k + 1} stops at {stop:g} s, but starts at {start:g} s; stop must be after start")
    return Epoch(start, stop, text(row[2], "label") if len(row) == 3 else "trial")


class Contacts:
    """The contacts of a force: onsets and releases (s, shape [contact]; a release is infinite if the force ends in contact), the level and the
    noise at rest, and the thresholds of onset and release (N)."""

    def __init__(self, onsets, releases, level, noise, threshold, release):
        self.onsets, self.releases = onsets, releases
        self.level, self.noise, self.threshold, self.release = level, noise, threshold, release

    def __len__(self):
        return len(self.onsets)

    def trials(self, stop=None):
        """Each contact as an Epoch with the label "contact". stop: the end of the last one if the force ends in contact, s."""
        ends = np.where(np.isfinite(self.releases), self.releases, np.inf if stop is None else stop)
        return [Epoch(float(a), float(b), "contact") for a, b in zip(self.onsets, ends)]

    def __repr__(self):
        return f"<Contacts: {len(self)} above {self.threshold:.4g} N; level at rest {self.level:.4g} N, noise {self.noise:.4g} N>"


def contacts(force, threshold=None, rate=None):
    """Finds the contacts in a force, summed over its channels.

    - force: a Force, or an array in N of shape [sample] or [sample, channel] with `rate` in Hz.
    - threshold: of an onset, N. Default: five times the noise at rest, and at least 2 % of the rise (doc/trials.md).

    Returns Contacts. Raises InputError.
    """
    if not isinstance(force, Force):
        if rate is None:
            raise _corpuscle.InputError("contacts: the rate of the force is missing: rate=1000 (Hz)")
        force = Force(force, rate)
    threshold = None if threshold is None else number(threshold, "threshold")
    return Contacts(*_corpuscle.find_contacts(real_array(force.samples, "force"), force.rate, force.start, threshold))


def onsets(force, threshold=None, rate=None):
    """The times of the contact onsets of a force, s; shape [contact]. Arguments as of contacts()."""
    return contacts(force, threshold, rate).onsets


class Histogram(tuple):
    """A peri-stimulus time histogram over trials. It unpacks into (times, rate): the middles of the bins relative to the alignment in s, and the
    mean rate in Hz, both of shape [bin]. standard_error (Hz) and trials (those that cover the bin) have the same shape; edges has one more."""

    def __new__(cls, edges, rate, standard_error, trials):
        self = super().__new__(cls, ((edges[:-1] + edges[1:]) / 2, rate))
        self.edges, self.rate, self.standard_error, self.trials = edges, rate, standard_error, trials
        return self

    def __getnewargs__(self):
        return self.edges, self.rate, self.standard_error, self.trials


def analyse(sources, align, window, threshold):
    """TrialResponses of [(response, force or None, epochs)]."""
    if align not in ("start", "onset"):
        raise _corpuscle.InputError(f"align '{align}': write 'start' or 'onset'")
    if window is not None:
        if isinstance(window, str) or not hasattr(window, "__len__") or len(window) != 2:
            raise _corpuscle.InputError(f"window = {window!r}: write (from, to) in s, such as (-0.1, 0.5)")
        window = number(window[0], "window"), number(window[1], "window")
        if not window[0] < window[1]:
            raise _corpuscle.InputError(f"window = {window!r} must end after it begins")
    sources = list(sources)
    packed, forces = [], []
    for response, force, epochs in sources:
        if align == "onset" and force is None:
            raise _corpuscle.InputError("align='onset' needs the force: respond to a Force instead of the name of a stimulus")
        samples = None if force is None or align == "start" else real_array(force.samples, "force")
        packed.append((response.times, response.indices, response.names, response.channels, response.start, response.duration, samples,
                       1.0 if force is None else force.rate, [_corpuscle.Epoch(*e) for e in epochs]))
        forces.append(force)
    raw = _corpuscle.analyse_trials(packed, align == "onset", window, None if threshold is None else number(threshold, "threshold"))
    return TrialResponses(raw, forces, align, (sources, align, window, threshold))


class TrialResponses:
    """The responses of afferents to trials, aligned.

    - epochs: the trials, as Epoch. labels: their labels.
    - zeros: time 0 of each trial on the clock of its force, s. NaN without a contact onset.
    - starts, stops: the measured part of each trial, relative to its time 0, s.
    - names, channels: of the afferents.
    """

    def __init__(self, raw, forces, align, arguments):
        self._raw, self._forces, self._arguments = raw, forces, arguments
        self.align = align
        self.epochs = [Epoch(t.start, t.stop, t.label) for t in raw.trials]
        self.labels = [e.label for e in self.epochs]
        self.zeros, self.starts, self.stops = raw.zero, raw.start, raw.stop
        self.names, self.channels = ([n[k] for n in raw.names] for k in (0, 1))
        measures = [name for name, _, _ in _corpuscle.measure_catalogue()]
        self._keys = [f"{name}_{unit}" if unit else name for name, unit, _ in _corpuscle.measure_catalogue()]
        self._values = np.full((len(self.epochs), len(self.names), len(measures)), np.nan)
        self._spikes = {}
        for trial, afferent, times, values in raw.responses:
            self._values[trial, afferent] = values
            self._spikes[trial, afferent] = times
        self._measures = measures

    def __reduce__(self):
        """For copy and pickle: what they were computed from."""
        return analyse, self._arguments

    def __len__(self):
        """The number of trials."""
        return len(self.epochs)

    def measure(self, name):
        """A measure of every trial and afferent, shape [trial, afferent]; NaN where it is not defined. catalogue("measures") lists them."""
        if name not in self._measures:
            raise _corpuscle.InputError(f"there is no measure '{name}'; there are {', '.join(self._measures)}")
        return self._values[:, :, self._measures.index(name)]

    @property
    def rates(self):
        """Mean rate in Hz, shape [trial, afferent]."""
        return self.measure("mean_rate")

    @property
    def latencies(self):
        """Time from the alignment to the first spike after it in s, shape [trial, afferent]; NaN without one."""
        return self.measure("latency")

    def afferent(self, which=0):
        """The index of an afferent: by index, name, or name and channel ("sa1 fz")."""
        if isinstance(which, str):
            found = [k for k in range(len(self.names)) if which in (self.names[k], f"{self.names[k]} {self.channels[k]}")]
            if not found:
                raise _corpuscle.InputError(f"there is no afferent '{which}'; there are {', '.join(self.names[:8])}")
            return found[0]
        if not 0 <= which < len(self.names):
            raise _corpuscle.InputError(f"there is no afferent {which}; the last is {len(self.names) - 1}")
        return which

    def spikes(self, trial, which=0):
        """The spike times of an afferent in a trial, s, relative to the alignment."""
        if not 0 <= trial < len(self.epochs):
            raise _corpuscle.InputError(f"there is no trial {trial}; the last is {len(self.epochs) - 1}")
        return self._spikes.get((trial, self.afferent(which)), np.empty(0))

    def psth(self, bin=None, which=0, label=None):
        """The peri-stimulus time histogram of an afferent, as (times, rate) with standard_error and trials: see Histogram.

        - bin: s; by default 25 to 62 bins fill the window.
        - which: index or name of the afferent.
        - label: of the trials; by default that of the first trial.

        The rate is the mean over the trials that cover a bin.
        """
        bin = 0.0 if bin is None else number(bin, "bin")
        if bin < 0 or not np.isfinite(bin):
            raise _corpuscle.InputError(f"bin = {bin:g} s must be above 0")
        label, which = self.labels[0] if label is None else label, self.afferent(which)
        for name, afferent, start, stop, rate, error, count, _ in self._raw.histograms(bin):
            if name == label and afferent == which:
                return Histogram(np.append(start, stop[-1]), rate, error, np.array(count))
        raise _corpuscle.InputError(f"there is no label '{label}'; there are {', '.join(dict.fromkeys(self.labels))}")

    def to_pandas(self):
        """A row for each trial and afferent: trial, label, start_s, stop_s, zero_s, afferent, channel, and every measure."""
        import pandas
        rows = [{"trial": t + 1, "label": e.label, "start_s": e.start, "stop_s": e.stop, "zero_s": self.zeros[t], "from_s": self.starts[t],
                 "to_s": self.stops[t], "afferent": self.names[a], "channel": self.channels[a], **dict(zip(self._keys, self._values[t, a]))}
                for t, e in enumerate(self.epochs) for a in range(len(self.names))]
        return pandas.DataFrame(rows)

    def statistics(self):
        """Mean, standard deviation and number of trials of every measure, a row for each label and afferent, as a pandas DataFrame."""
        import pandas
        rows = []
        for label, afferent, mean, deviation, count in self._raw.labels:
            row = {"label": label, "afferent": self.names[afferent], "channel": self.channels[afferent]}
            for k, key in enumerate(self._keys):
                row.update({key: mean[k], f"{key}_sd": deviation[k], f"{key}_n": count[k]})
            rows.append(row)
        return pandas.DataFrame(rows)

    def plot(self, which=0, bin=None):
        """Draws force, raster and PSTH of an afferent with matplotlib, trials grouped by label, and returns the axes of the PSTH."""
        import matplotlib.pyplot as plt
        which = self.afferent(which)
        figure, (force_axes, raster, ax) = plt.subplots(3, 1, figsize=(8, 6), sharex=True, height_ratios=[1, 2, 1.5])
        labels = list(dict.fromkeys(self.labels))
        order = sorted(range(len(self)), key=lambda t: labels.index(self.labels[t]))
        color = {label: f"C{k}" for k, label in enumerate(labels)}
        for t in order:
            force = self._forces[self._raw.source[t]]
            if force is None or np.isnan(self.zeros[t]):
                continue
            total = force.samples if force.samples.ndim == 1 else force.samples.sum(axis=1)
            times = force.times - self.zeros[t]
            shown = (times >= self.starts[t]) & (times < self.stops[t])
            force_axes.plot(times[shown], total[shown], color=color[self.labels[t]], linewidth=0.8, alpha=0.6)
        force_axes.set_ylabel("force (N)")
        raster.eventplot([self.spikes(t, which) for t in order], colors=[color[self.labels[t]] for t in order], linelengths=0.8, linewidths=1)
        raster.invert_yaxis()
        raster.set(ylabel="trial", yticks=[])
        for label in labels:
            histogram = self.psth(bin, which, label)
            rate, error = histogram.rate, np.nan_to_num(histogram.standard_error)
            ax.stairs(rate, histogram.edges, color=color[label], label=label)
            ax.fill_between(histogram.edges[:-1], rate - error, rate + error, step="post", color=color[label], alpha=0.2, linewidth=0)
        ax.set(xlabel=f"time from {self.align} (s)", ylabel=f"{self.names[which]} (Hz)")
        ax.legend(frameon=False)
        for one in (force_axes, raster, ax):
            one.axvline(0, color="0.5", linewidth=0.8, linestyle=":")
        return ax

    def __repr__(self):
        plural = lambda n, noun: f"{n:,} {noun}{'s' * (n != 1)}"
        return f"<TrialResponses: {plural(len(self), 'trial')}, {plural(len(set(self.labels)), 'label')}, {plural(len(self.names), 'afferent')}, aligned to {self.align}>"


class ForceTrials:
    """Forces that are trials of one experiment: those of a table in long format (read(path, by="trial")), or of several files.

    - forces: Force objects, each with its own clock.
    - labels: one for each force, by default its name without the number at the end.

    It is a sequence of Force.
    """

    def __init__(self, forces, labels=None):
        self.forces = list(forces)
        if not self.forces or not all(isinstance(f, Force) for f in self.forces):
            raise _corpuscle.InputError("trials: there must be one or more Force objects")
        self.labels = [_label_of(f.name) for f in self.forces] if labels is None else [text(l, "labels") for l in labels]
        if len(self.labels) != len(self.forces):
            raise _corpuscle.InputError(f"trials: {len(self.labels)} labels for {len(self.forces)} forces")

    def __len__(self):
        return len(self.forces)

    def __getitem__(self, k):
        return self.forces[k]

    def respond(self, afferent=("sa1", "fa1"), *, align="start", window=None, threshold=None, seed=0, **options):
        """Simulates afferents on each force from rest, and returns TrialResponses.

        - afferent and options: as of respond(). Random numbers differ from trial to trial: trial k has the seed `seed` + k.
        - align, window, threshold: as of Response.trials().
        """
        from ._respond import respond
        responses = [respond(f, afferent=afferent, seed=seed + k, **options) for k, f in enumerate(self.forces)]
        return analyse([(r, f, [Epoch(r.start, r.start + r.duration, l)]) for r, f, l in zip(responses, self.forces, self.labels)], align, window,
                       threshold)

    def __repr__(self):
        return f"<ForceTrials: {len(self)} trials, {len(set(self.labels))} label{'s' * (len(set(self.labels)) != 1)}>"


def _label_of(name):
    base = name.rstrip("0123456789")
    return base[:-1] if base != name and len(base) > 1 and base[-1] in "_-. " else name


def read_trials(path, by, label, options):
    """The trials of a table in long format, as ForceTrials."""
    from ._force import of_library
    columns = [text(c, "by") for c in ([by] if isinstance(by, str) else by)]
    found = _corpuscle.read_recording_trials(path, columns, "" if label is None else text(label, "label"), options)
    forces = [of_library(force) for _, force in found]
    show_warnings(list(dict.fromkeys(f"{f.name}: {w}" for f in forces for w in f.warnings)), 3)
    return ForceTrials(forces, [name for name, _ in found])
