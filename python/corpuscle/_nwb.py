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
    """The force of a response. That of a stimulus by name is computed again; that of a touch of a skin is the total force on the skin."""
    if response.force is not None:
        return response.force
    from ._force import Stimulus, of_library
    on_skin = response._compiled().skin_force
    if on_skin is not None:
        return of_library(on_skin)
    run = response._run
    parts = run.force.split("+")
    settings = [s for s in run.simulation.settings if s.split(".")[0] in parts]
    return Stimulus(run.force, settings, run.rate or 10e3, run.simulation.seed)


def write(response, path, trials, measured, overwrite, fields):
    """Writes the file."""
    force = force_of(response)
    compiled = response._compiled()
    simulation = response._run.simulation
    if measured is None:
        measured = response.force is not None and response.force.is_recording
    resolution = 1 / force.rate if simulation.sampled else 1e-9
    _corpuscle.write_nwb(path_of(path), compiled, force, fields_of(fields), response._run.command(), bool(measured), resolution, simulation.seed,
                         [tuple(t) for t in trials_of(trials)], bool(overwrite))
