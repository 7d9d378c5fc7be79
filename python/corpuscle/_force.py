"""Force over time."""

from collections.abc import Iterable

import numpy as np

from . import _corpuscle
from . import _catalogue
from . import _neo
from ._options import count, name_of, number, options_of, path_of, real_array, settings_of, show_warnings, text


_MAX_CHANNELS = 1 << 22


class Force:
    """Force on one or more channels, evenly sampled.

    - samples: real numbers in newtons, shape [sample] or [sample, channel]. An array of float64 with any strides is not copied.
    - rate: samples a second, Hz.
    - channels: names of the channels, by default ch1, ch2 ...
    - start: time of the first sample, s.
    - name: of the force, for outputs.
    - notes, warnings: lists of texts about how a recording was read, and about its faults.

    Raises InputError for values that are not real numbers, another number of dimensions, or another number of names.
    """

    def __init__(self, samples, rate, channels=None, start=0.0, name="force", notes=(), warnings=()):
        self.samples = samples
        self.channels = [f"ch{k + 1}" for k in range(self._columns())] if channels is None else channels
        self.rate, self.start, self.name = rate, start, name
        self.notes, self.warnings = list(notes), list(warnings)
        self._origin = None  # how the library read or computed it

    def __setattr__(self, name, value):
        """Checks a field, which the user may change later."""
        if name == "samples":
            value = real_array(value, "force")
            if value.ndim not in (1, 2):
                raise _corpuscle.InputError(f"force: the array has {value.ndim} dimensions; it must have one, or two: [sample, channel]")
            if value.ndim == 2 and value.shape[1] > _MAX_CHANNELS:
                raise _corpuscle.InputError(f"force: {value.shape[1]} channels are too many; the rows of an array are samples, its columns are channels")
        elif name == "channels":
            value = [value] if isinstance(value, str) else value
            if not isinstance(value, Iterable):
                raise _corpuscle.InputError(f"channels = {value!r} is not a list of names")
            value = [text(c, "channels") for c in value]
            if len(value) != self._columns():
                raise _corpuscle.InputError(f"force: {len(value)} names for {self._columns()} channels")
        elif name in ("rate", "start"):
            value = number(value, name)
        elif name == "name":
            value = name_of(value, "name")
        object.__setattr__(self, name, value)

    def _columns(self):
        return 1 if self.samples.ndim == 1 else self.samples.shape[1]

    @classmethod
    def from_neo(cls, signal):
        """The Force of a neo.AnalogSignal in a unit of force. A channel has the name in the array annotation channel_names, if there is one.

        Raises InputError for another object, and for a unit that is not one of force.
        """
        return _neo.force_of(cls, signal)

    @property
    def times(self):
        """The time of each sample, s; shape [sample]."""
        return self.start + np.arange(len(self.samples)) / self.rate

    @property
    def duration(self):
        """Length of the force, s."""
        return len(self.samples) / self.rate

    @property
    def is_recording(self):
        """True if the force was read from a file."""
        return self._origin is not None and not isinstance(self, Stimulus)

    def __len__(self):
        return len(self.samples)

    def __array__(self, dtype=None):
        return self.samples if dtype is None else self.samples.astype(dtype)

    def __repr__(self):
        low, high = (self.samples.min(), self.samples.max()) if self.samples.size else (0.0, 0.0)
        return f"<Force {self.name}: {len(self.channels)} channel{'s' * (len(self.channels) > 1)}, {self.duration:.4g} s at {self.rate:g} Hz, {low:.3g} to {high:.3g} N>"

    def plot(self, ax=None):
        """Draws the force over time with matplotlib, and returns the axes."""
        if ax is None:
            import matplotlib.pyplot as plt
            ax = plt.subplots(figsize=(8, 2.5))[1]
        ax.plot(self.times, self.samples, linewidth=1)
        ax.set(xlabel="time (s)", ylabel="force (N)")
        return ax


class Stimulus(Force):
    """The force of a stimulus; settings: the texts with which it was computed, such as "press.F_max=2 N"."""

    def __init__(self, name, settings, rate, seed):
        self.settings = settings
        computed = _corpuscle.stimulus(name, settings, number(rate, "rate"), count(seed, "seed", 2**64 - 1))
        super().__init__(computed.samples[0], computed.rate, computed.channels, computed.start, computed.name)
        self._origin = computed.origin


def of_library(force):
    """A Force of the library as one of ours, without copying one channel."""
    columns = force.samples
    samples = columns[0] if len(columns) == 1 else np.column_stack(columns)
    out = Force(samples, force.rate, force.channels, force.start, force.name, force.notes, force.warnings)
    out._origin = force.origin
    return out


def read(path, by=None, label=None, **options):
    """Reads a recording and returns a Force: CSV, TSV, NPY, NPZ, HDF5, MATLAB 7.3, WAV and more (doc/recordings.md).

    path: of the file. Options are those of `corpuscle respond --help-all` for recordings, such as unit="mN", scale=0.002, rate=1000, channel=["fz"],
    lowpass="50 Hz", resample=1000, zero="0.5 s". A list gives an option several times. catalogue("formats") lists the formats.

    by: the column, or the columns, that identify the trials of a table in long format. Each trial is then a Force of its own, and the result is
    ForceTrials; label: the column of their labels.

    Raises InputError, with file and line where they are known. Shows a corpuscle.Warning for each fault of the recording; they are also in
    `warnings` of the Force.
    """
    if by is not None:
        from ._trials import read_trials
        return read_trials(path_of(path), by, label, options_of(options))
    if label is not None:
        raise _corpuscle.InputError("read: label needs by, the column that identifies the trials")
    force = of_library(_corpuscle.read_recording(path_of(path), options_of(options)))
    show_warnings([f"{force.name}: {w}" for w in force.warnings], 2)
    return force


def stimulus(name, rate=10e3, seed=0, **parameters):
    """Computes a stimulus, or a sum of stimuli ("press+noise"), and returns a Force of one channel in N.

    - name: of a stimulus. catalogue("stimuli") lists them.
    - rate: samples a second, Hz.
    - seed: of random stimuli.
    - parameters: such as F_max="2 N". A number is in the parameter's SI unit. They belong to the first stimulus of a sum.

    Raises InputError.
    """
    name = name_of(name, "stimulus")
    return Stimulus(name, settings_of(parameters, name.split("+")[0]), rate, seed)


def _identifier(name):
    return name.replace("-", "_")


def stimulus_names():
    """The names of the functions of all stimuli."""
    return [_identifier(e.name) for e in _catalogue.catalogue("stimuli")]


def stimulus_function(name):
    """The function of a stimulus of the catalogue."""
    found = [] if name.startswith("_") else [e for e in _catalogue.catalogue("stimuli") if _identifier(e.name) == name]
    if not found:
        raise AttributeError(f"module 'corpuscle' has no attribute '{name}'")
    entry = found[0]

    def function(rate=10e3, seed=0, **parameters):
        return stimulus(entry.name, rate, seed, **parameters)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = (f"The stimulus {entry.name}: {entry.description}. Returns a Force of one channel in N.\n\nrate: samples a second, Hz. "
                        f"seed: of random numbers. Parameters are numbers in SI units, or texts with a unit:\n\n{entry.parameter_text()}\n\n"
                        f"Source: {entry.source}. Raises InputError.")
    return function
