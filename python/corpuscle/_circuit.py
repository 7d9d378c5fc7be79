"""Netlists: their analyses and curves."""


import html

import numpy as np

from . import _corpuscle
from ._display import figure_html, plural, table_html
from ._options import path_of, settings_of, show_warnings, text, text_of
from ._progress import progress_of

_SHOWN = 12  # rows of a table in a notebook


class CircuitPlot:
    """The curves of one analysis at the same points. plot["v(out)"] is an array."""

    def __init__(self, raw):
        self._raw = raw
        self.name, self.analysis = raw.name, raw.analysis
        self.has_sweep, self.is_complex, self.inner_points = raw.has_sweep, raw.is_complex, raw.inner_points
        self.names = raw.names
        self._units = dict(zip(self.names, raw.units))

    @property
    def units(self):
        """The unit of each curve: "V", "A", "s", "Hz", "C" (degrees Celsius); "" if unknown."""
        return dict(self._units)

    @property
    def sweep(self):
        """The swept quantity: time in s, frequency in Hz, or the values of .dc; shape [point]. None for an operating point."""
        return self[self.names[0]] if self.has_sweep else None

    def __getitem__(self, name):
        """A curve: float64, or complex128 for an .ac; shape [point], of an operating point []. Curves of `names` show memory of the library and
        are read-only; "v(a,b)", "vdb(out)", "vp(out)" (radians) and expressions such as "v(a)*i(v1)" are computed. Raises InputError."""
        values = self._raw.curve(text(name, "curve"))[0]
        return values if self.has_sweep or len(values) != 1 else values.reshape(())

    def __contains__(self, name):
        try:
            self._raw.curve(text(name, "curve"))
        except _corpuscle.InputError:
            return False
        return True

    def __iter__(self):
        return iter(self.names)

    def __len__(self):
        """The number of points."""
        return self[self.names[0]].size if self.names else 0

    def keys(self):
        """The names of the curves."""
        return self.names

    def to_pandas(self):
        """A row for each point, a column for each curve."""
        import pandas
        return pandas.DataFrame({name: np.atleast_1d(self[name]) for name in self.names})

    def plot(self, *names, ax=None, label=""):
        """Draws curves over the swept quantity with matplotlib, and returns the axes: by default all voltages, otherwise the named curves. A complex
        curve is drawn as its magnitude in dB. Raises InputError for an operating point."""
        if not self.has_sweep:
            raise _corpuscle.InputError(f"{self.name}: there is no swept quantity to draw over; read the values: to_pandas()")
        chosen = names or [n for n in self.names[1:] if self._units[n].startswith("V")] or self.names[1:]
        curves = [(n, self[n]) for n in chosen]  # before a figure is made: a wrong name is an error
        if ax is None:
            import matplotlib.pyplot as plt
            ax = plt.subplots(figsize=(8, 3))[1]
        with np.errstate(divide="ignore"):
            for name, values in curves:
                complex_values = np.iscomplexobj(values)
                ax.plot(self.sweep, 20 * np.log10(np.abs(values)) if complex_values else values, linewidth=1,
                        label=" ".join(filter(None, [f"|{name}|" if complex_values else name, label])))
        units = list(dict.fromkeys(self._units.get(n, "") for n in chosen))
        ylabel = "dB" if any(np.iscomplexobj(v) for _, v in curves) else ", ".join(filter(None, units))
        ax.set(xlabel=self._label(self.names[0]), ylabel=ylabel)
        if self.names[0] == "frequency":
            ax.set_xscale("log")
        if len(curves) <= 12:
            ax.legend(fontsize="small")
        return ax

    def _label(self, name):
        return f"{name} ({self._units[name]})" if self._units[name] else name

    def __repr__(self):
        return f"<CircuitPlot {self.name}: {plural(len(self), 'point')} of {plural(len(self.names), 'curve')}>"

    def _repr_html_(self):
        if not self.has_sweep:
            rows = [(n, f"{np.atleast_1d(self[n])[0]:.6g}", self._units[n]) for n in self.names[:200]]
            return table_html(["", "value", "unit"], rows)
        rows = [[f"{self[n][k]:.6g}" for n in self.names[:_SHOWN]] for k in range(min(len(self), _SHOWN))]
        more = f"<p>{html.escape(plural(len(self), 'point'))} of {html.escape(plural(len(self.names), 'curve'))}</p>"
        return figure_html(self.plot) + table_html([self._label(n) for n in self.names[:_SHOWN]], rows) + more


class CircuitAnalysis:
    """An analysis that was run. name: "op"; report: the text that `corpuscle run` prints; counters: {"steps": 120.0}; spikes: spike times in s of a
    .tran with .spike, otherwise None."""

    def __init__(self, name, report, counters, spikes):
        self.name, self.report, self.counters, self.spikes = name, report, dict(counters), spikes

    def __repr__(self):
        return f"<CircuitAnalysis {self.name}>\n{self.report}"


class CircuitResult:
    """The results of a run. result["v(out)"] is an array.

    A netlist with .step or .mc has several variants: `steps` has a result for each, and the other members are empty.
    """

    def __init__(self, raw):
        self.title, self.step = raw.title, raw.step
        self.error = raw.error
        self.warnings = raw.warnings
        self.plots = [CircuitPlot(p) for p in raw.plots]
        self.analyses = [CircuitAnalysis(*a) for a in raw.analyses]
        self.expectations = [dict(zip(("name", "actual", "expected", "tolerance", "met"), e)) for e in raw.expectations]
        self.steps = [CircuitResult(s) for s in raw.steps]
        self._measures = dict(raw.measures)

    def _plot_of(self, name):
        """The first plot that has a curve."""
        if self.steps:
            raise _corpuscle.InputError(f"'{name}': the result has {len(self.steps)} steps; take the curve of one: steps[0]")
        if self.error:
            raise _corpuscle.NotConvergedError(self.error)
        for plot in self.plots:
            if name.lower() in plot.names:
                return plot
        return next((plot for plot in self.plots if name in plot), self.plots[0])

    def __getitem__(self, name):
        """A curve of the first plot that has it, see CircuitPlot.__getitem__. Raises InputError."""
        name = text(name, "curve")
        return self._plot_of(name)[name]

    def __contains__(self, name):
        return any(name in plot for plot in self.plots)

    def __iter__(self):
        return iter(self.names)

    def __len__(self):
        """The number of points of the first plot."""
        return len(self.plots[0]) if self.plots else 0

    @property
    def names(self):
        """The names of all curves."""
        return list(dict.fromkeys(n for plot in self.plots for n in plot.names))

    def keys(self):
        """The names of all curves."""
        return self.names

    @property
    def units(self):
        """The unit of each curve: "V", "A", "s", "Hz", "C" (degrees Celsius); "" if unknown."""
        return {n: u for plot in reversed(self.plots) for n, u in plot.units.items()}

    @property
    def time(self):
        """The times of the points of a .tran, s; shape [point]."""
        return self["time"]

    @property
    def frequency(self):
        """The frequencies of an .ac or .noise, Hz; shape [point]."""
        return self["frequency"]

    @property
    def sweep(self):
        """The swept quantity of the first plot: time in s, frequency in Hz, or the values of .dc; None for an operating point."""
        return self.plots[0].sweep if self.plots else None

    @property
    def spikes(self):
        """The spike times of the first .tran with .spike, s; shape [spike]. None if there is none."""
        return next((a.spikes for a in self.analyses if a.spikes is not None), None)

    @property
    def report(self):
        """The texts that `corpuscle run` prints: operating points of the devices, noise by device, work of the transient."""
        return "\n".join(a.report for a in self.analyses)

    @property
    def measures(self):
        """The numbers of the analyses, of .four and of .meas, in SI units; NaN where nothing was found. With steps: an array of each, shape [step]."""
        if not self.steps:
            return dict(self._measures)
        names = dict.fromkeys(n for s in self.steps for n in s._measures)
        return {n: np.array([s._measures.get(n, np.nan) for s in self.steps]) for n in names}

    def to_pandas(self):
        """The first plot: a row for each point, a column for each curve; with steps also the column step. Without curves: the measures."""
        import pandas
        if not self.steps:
            return self.plots[0].to_pandas() if self.plots else pandas.DataFrame([self._measures])
        tables = [(s, s.to_pandas()) for s in self.steps if not s.error]
        for step, table in tables:
            table.insert(0, "step", step.step)
        return pandas.concat([table for _, table in tables], ignore_index=True)

    def plot(self, *names, ax=None):
        """Draws curves of the first plot with matplotlib, for each step, and returns the axes: by default all voltages. See CircuitPlot.plot()."""
        shown = [s for s in self.steps if not s.error] or [self]
        if names and not self.steps:
            return self._plot_of(text(names[0], "curve")).plot(*names, ax=ax)
        for result in shown:
            if not result.plots:
                raise _corpuscle.InputError("the result has no curves to draw")
            ax = result.plots[0].plot(*names, ax=ax, label=result.step)
        return ax

    def __repr__(self):
        if self.error:
            return f"<CircuitResult {self.step}: {self.error}>"
        head = ", ".join([*(f".{p.analysis} {plural(len(p), 'point')}" for p in self.plots), *([plural(len(self.steps), "step")] if self.steps else [])])
        lines = [f"<CircuitResult {self.title}: {head}>", *(f"    {n} = {v:.6e}" for n, v in self._measures.items())]
        return "\n".join(lines)

    def _repr_html_(self):
        if self.error:
            return f"<p>{html.escape(self.step)}: {html.escape(self.error)}</p>"
        parts = [f"<p><b>{html.escape(self.title)}</b></p>", *(f"<p>warning: {html.escape(w)}</p>" for w in self.warnings)]
        if self.steps:
            measures = self.measures
            rows = [[s.step, *(f"{measures[n][k]:.6g}" for n in measures)] for k, s in enumerate(self.steps[:50])]
            drawable = any(s.plots and s.plots[0].has_sweep for s in self.steps) and len(self.steps) <= 50
            return "".join(parts) + (figure_html(self.plot) if drawable else "") + table_html(["step", *measures], rows)
        if self._measures:
            parts.append(table_html(["measure", "value"], [(n, f"{v:.6g}") for n, v in self._measures.items()]))
        return "".join(parts + [p._repr_html_() for p in self.plots])


def _shown(raw):
    """The result, whose warnings are shown."""
    result = CircuitResult(raw)
    show_warnings([w for one in (result, *result.steps) for w in one.warnings], 3)
    return result


class Circuit:
    """A netlist that was read. Each analysis is a method; run() runs all analyses of the netlist. See circuit()."""

    def __init__(self, source, settings=None, *, temp=None, corner=None, supply=None, mismatch=None, probe=None):
        source = source.encode(errors="replace") if isinstance(source, str) and "\n" in source else path_of(source)
        named = {"temp": temp, "corner": corner, "supply": supply, "mismatch": mismatch}
        texts = [*settings_of(settings), *(f"{n}={text_of(v)}" for n, v in named.items() if v is not None)]
        probes = [text(p, "probe") for p in ([] if probe is None else [probe] if isinstance(probe, str) else probe)]
        self._arguments = source, texts, probes
        self._read()

    def _read(self):
        source, texts, probes = self._arguments
        is_text = b"\n" in source
        self._raw = _corpuscle.Circuit.from_text(source, texts, probes, "netlist") if is_text else _corpuscle.Circuit(source, texts, probes)

    def __getstate__(self):
        """For copy and pickle: what it was made with. The file is then read again."""
        return self._arguments

    def __setstate__(self, arguments):
        self._arguments = arguments
        self._read()

    @property
    def name(self):
        """The path or name of the netlist."""
        return self._raw.name

    @property
    def title(self):
        """The first line of the netlist."""
        return self._raw.title

    @property
    def nodes(self):
        """The names of the nodes, without ground."""
        return self._raw.nodes

    @property
    def elements(self):
        """The names of the elements, with the path of their subcircuit: "x1.m1"."""
        return self._raw.elements

    def run(self, progress=None):
        """Runs all analyses of the netlist, in order, then its .meas and .expect, and returns a CircuitResult.

        progress: a function of the completed fraction, 0 to 1; returns False to stop. None: a line in a terminal or in IPython; False: nothing.

        Raises InputError; NotConvergedError, which says when, where and which device.
        """
        with progress_of(progress) as function:
            return _shown(self._raw.run(function))

    def __repr__(self):
        return f"<Circuit {self.title}: {plural(len(self.elements), 'element')}, {plural(len(self.nodes), 'node')}>"


def _analysis_method(name, usage, description):
    def method(self, *words, progress=None):
        with progress_of(progress) as function:
            return _shown(self._raw.analyse(name, [text_of(w) for w in words], function))

    method.__name__, method.__qualname__ = name, f"Circuit.{name}"
    words = usage.split(" ", 1)
    method.__doc__ = (f"Analysis: {description}. Returns a CircuitResult.\n\nwords: those of the directive `{usage}`, as numbers in SI units or as texts"
                      f" (\"1m\", \"1meg\"). Without words,\nthe netlist's own {words[0]}{' or a plain one' * (name == 'op')}. progress: see run().\n\n"
                      f"Raises InputError; NotConvergedError, which says when, where and which device.")
    return method


for _name, _usage, _description in _corpuscle.circuit_analyses():
    setattr(Circuit, _name, _analysis_method(_name, _usage, _description))


def circuit(source, settings=None, *, temp=None, corner=None, supply=None, mismatch=None, probe=None):
    """Reads a SPICE netlist and returns a Circuit.

    - source: path of a file, a netlist of the catalogue ("sa1-circuit"), or the text of a netlist, which has several lines: the first is the title.
    - settings: {"C_u": "4pF", "summer.N3B": "8x4"}: values of .param lines, of devices and of their parameters. Numbers are in SI units.
    - temp: degrees Celsius.
    - corner: section of the process library: "tt", "ss", "ff" ...
    - supply: of the circuit's .param supply: "0.65V".
    - mismatch: seed of one mismatched chip: 7, or "7/41" for chip 41 of this seed.
    - probe: curves to record in addition to those of the netlist: ["v(a,b)", "i(N3B)"].

    Raises InputError with file, line and column.
    """
    return Circuit(source, settings, temp=temp, corner=corner, supply=supply, mismatch=mismatch, probe=probe)
