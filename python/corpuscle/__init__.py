"""Artificial touch: force goes in, nerve-like spikes come out.

    import corpuscle
    force = corpuscle.read("grip.csv", unit="mN")
    response = corpuscle.respond(force, afferent="fa1-nerve")
    response.plot()

Forces are in newtons, times in seconds, rates in hertz, positions in metres. Errors are `corpuscle.InputError` (a ValueError) with the text
of the command line. Each stimulus of the catalogue is a function: corpuscle.press(F_max="2 N").
"""

from ._corpuscle import InputError, NotConvergedError
from ._catalogue import Catalogue, Entry, Parameter, afferents, catalogue, catalogues
from ._circuit import Circuit, CircuitAnalysis, CircuitPlot, CircuitResult, circuit
from ._compare import Comparison, compare
from ._export import export
from ._fit import Fit, fit
from ._force import Force, Stimulus, read, stimulus
from ._live import LiveSkin
from ._respond import Population, fingertip, grid, hand, population, respond
from ._nir import NirGraph, NirNode, nir
from ._options import Warning  # not in __all__, because it would hide the built-in name
from ._response import Response, measures
from ._spikes import read_spikes
from ._sweep import SweepQuantity, SweepResult, read_sweep, sweep
from ._trials import Contacts, Epoch, ForceTrials, Histogram, TrialResponses, contacts, onsets, trials
from . import _force

__all__ = [
    "Catalogue", "Circuit", "CircuitAnalysis", "CircuitPlot", "CircuitResult", "Comparison", "Contacts", "Entry", "Epoch", "Fit", "Force",
    "ForceTrials", "Histogram", "InputError", "LiveSkin", "NirGraph", "NirNode", "NotConvergedError", "Parameter", "Population", "Response", "Stimulus",
    "SweepQuantity", "SweepResult", "TrialResponses", "afferents", "catalogue", "catalogues", "circuit", "compare", "contacts", "export",
    "fingertip", "fit", "grid", "hand", "measures", "nir", "onsets", "population", "read", "read_spikes", "read_sweep", "respond", "stimulus",
    "sweep", "trials",
]

InputError.__module__ = NotConvergedError.__module__ = Warning.__module__ = __name__  # the public name, for tracebacks


def __getattr__(name):
    """The function of a stimulus."""
    function = globals()[name] = _force.stimulus_function(name)
    return function


def __dir__():
    return sorted({*globals(), *_force.stimulus_names()})
