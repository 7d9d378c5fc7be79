"""The catalogues: afferents, stimuli, measures ... with every parameter. They are those of `corpuscle list`."""

import dataclasses
import html

from . import _corpuscle
from ._options import name_of


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter. default, low and high are in `unit`; low and high are infinite if there is no limit."""

    name: str
    unit: str
    default: float
    low: float
    high: float
    description: str
    source: str

    def __str__(self):
        return f"{self.name} = {self.default:g}{self.unit and ' ' + self.unit} [{self.low:g}, {self.high:g}]: {self.description}"


@dataclasses.dataclass(frozen=True)
class Entry:
    """An entry of a catalogue. detail: composition of an afferent, unit of a measure, extensions of a format."""

    name: str
    detail: str
    description: str
    source: str
    parameters: tuple

    def parameter_text(self):
        """The parameters, one a line: name, default with unit, range, description."""
        return "\n".join(f"    {p}" for p in self.parameters)

    def __str__(self):
        head = f"{self.name}{self.detail and f' ({self.detail})'}: {self.description}"
        return "\n".join([head, *(f"    source: {self.source}" for _ in [0] if self.source), *(f"    {p}" for p in self.parameters)])


class Catalogue(tuple):
    """Entries in order. catalogue["sa1"] finds one by name; printed, or in a notebook, it is a table."""

    def __getitem__(self, key):
        if not isinstance(key, str):
            return tuple.__getitem__(self, key)
        for entry in self:
            if entry.name == key:
                return entry
        raise KeyError(key)

    def names(self):
        """The names of the entries."""
        return [e.name for e in self]

    def __repr__(self):
        width = max((len(e.name) for e in self), default=0)
        return "\n".join(f"{e.name:{width}}  {e.description}" for e in self)

    def _repr_html_(self):
        cells = lambda *values: "".join(f"<td style='text-align:left'>{html.escape(v)}</td>" for v in values)
        rows = "".join(f"<tr>{cells(e.name, e.detail, e.description, e.source)}</tr>" for e in self)
        return f"<table><tr><th>name</th><th>detail</th><th>description</th><th>source</th></tr>{rows}</table>"


def catalogues():
    """The names of all catalogues: "afferents", "stimuli", "measures" ..."""
    return _corpuscle.catalogues()


def catalogue(name):
    """The entries of one catalogue, with all parameters. Raises InputError if there is no such catalogue."""
    return Catalogue(Entry(n, detail, description, source, tuple(Parameter(*p) for p in parameters))
                     for n, detail, description, source, parameters in _corpuscle.catalogue(name_of(name, "catalogue")))


def afferents():
    """All afferents with a name: models, calibrated afferents and chips, with every parameter."""
    return catalogue("afferents")
