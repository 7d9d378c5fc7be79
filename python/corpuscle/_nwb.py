"""Responses as NWB files."""

from . import _corpuscle
from ._options import path_of, text
from ._trials import trials_of


def fields_of(fields):
    """Fields by name as texts: "experimenter=Doe, Jane"."""
    out = []
    for name, value in fields.items():
        if isinstance(value, dict):
            out += fields_of({f"{name}.{key}": v for key, v in value.items()})
        else:
            out += [f"{name}={text(v, name)}" for v in ([value] if isinstance(value, str) else value)]
    return out


def force_of(response):
    """The force of a response, computed again if it is a stimulus by name; None for a touch of a skin."""
    if response.force is not None:
        return response.force
    from ._force import Stimulus
    run = response._run
    parts = run.force.split("+")
    settings = [s for s in run.simulation.settings if s.split(".")[0] in parts]
    rate = run.rate or (1e3 if run.simulation.population else 10e3)
    try:
        return Stimulus(run.force, settings, rate, run.simulation.seed)
    except _corpuscle.InputError:  # a touch, which is not a stimulus
        return None


def write(response, path, trials, measured, overwrite, fields):
    """Writes the file."""
    force = force_of(response)
    compiled = response._compiled()
    simulation = response._run.simulation
    if measured is None:
        measured = response.force is not None and response.force.is_recording
    resolution = 1 / force.rate if simulation.sampled and force is not None else 1e-9
    _corpuscle.write_nwb(path_of(path), compiled, force, fields_of(fields), response._run.command(), bool(measured), resolution, simulation.seed,
                         [tuple(t) for t in trials_of(trials)], bool(overwrite))
