"""Force in, spikes out."""

import os
import time
from collections.abc import Iterable

from . import _corpuscle
from ._force import Force
from ._options import count, name_of, number, settings_of, show_warnings, text
from ._report import Run
from ._response import Response


def _simulation(settings, seed, threads, **options):
    simulation = _corpuscle.Simulation()
    simulation.settings = settings
    simulation.seed, simulation.threads = count(seed, "seed", 2**64 - 1), count(threads, "threads", 1024)
    for name, value in options.items():
        setattr(simulation, name, value)
    return simulation


def _run(force, rate, simulation, progress):
    if progress is not None and not callable(progress):
        raise _corpuscle.InputError(f"progress = {progress!r} is not a function")
    if isinstance(force, str):
        return _response(Run(text(force, "force"), 0.0 if rate is None else _positive(rate), simulation), None, progress)
    if not isinstance(force, Force):
        if rate is None:
            raise _corpuscle.InputError("respond: the rate of the force is missing: rate=1000 (Hz)")
        force = Force(force, rate)
    elif rate is not None and number(rate, "rate") != force.rate:
        raise _corpuscle.InputError(f"respond: rate={rate:g} Hz, but the force has {force.rate:g} Hz")
    return _response(Run(force, force.rate, simulation), force, progress)


def _response(run, force, progress):
    start = time.perf_counter()
    raw = run(progress)
    response = Response(raw, force, run, time.perf_counter() - start)
    texts = raw.warnings
    if texts:
        known = () if force is None else {*force.warnings, *(f"{force.name}: {w}" for w in force.warnings)}  # read() has shown them
        show_warnings([w for w in texts if w not in known], 4)
    return response


def _positive(rate):
    """A rate that is not 0, which the library takes for its default."""
    value = number(rate, "rate")
    if value == 0:
        raise _corpuscle.InputError("a rate of 0 Hz is outside [1e-06, 1e+12]")
    return value


def respond(force, rate=None, afferent=("sa1", "fa1"), *, settings=None, copies=0, spread=None, seed=0, noise=0.0, method="exact", sampled=False,
            single_precision=False, threads=0, progress=None):
    """Simulates afferents on every channel of a force, and returns a Response.

    - force: real numbers in newtons, shape [sample] or [sample, channel], with `rate` in Hz. Or a Force, or the name of a stimulus ("press").
    - afferent: a name or several, such as "sa1", "fa1-nerve", "sa1-circuit", "path/own.cir", "path/own.nir". afferents() lists them.
    - settings: {"sa1.f_B": "25 Hz"}. A number is in SI units. If there is one afferent, its name may be left out.
    - copies: number of copies of each afferent, which vary.
    - spread: the standard deviations of the copies, {"sa1.f_B": "10%"}.
    - seed: of all random numbers.
    - noise: current noise of each afferent, A.
    - method: "exact", or "backward-euler" as in the thesis.
    - sampled: spikes have the times of samples, as in the thesis.
    - single_precision: float instead of double, for many copies.
    - threads: the largest number of threads, 0 for one on each core. The response does not depend on it.
    - progress: a function that gets the completed fraction, 0 to 1, up to 20 times a second. If it returns False, KeyboardInterrupt is raised.
      An exception of the function ends the run.

    Raises InputError for a force, name, setting or value that is refused, NotConvergedError if a circuit has no solution. Ctrl-C ends the run.
    Shows a corpuscle.Warning for each reason why the response may be wrong; they are also in `warnings` of the response.
    """
    several = isinstance(afferent, Iterable) and not isinstance(afferent, (str, bytes, os.PathLike))
    names = [name_of(a, "afferent") for a in (afferent if several else [afferent])]
    if not names:
        raise _corpuscle.InputError("respond: there is no afferent")
    target = names[0] if len(names) == 1 else None
    if method not in ("exact", "backward-euler"):
        raise _corpuscle.InputError(f"method '{method}': write 'exact' or 'backward-euler'")
    simulation = _simulation(settings_of(settings, target), seed, threads)
    simulation.afferents = names
    # Most calls have the defaults, and each assignment costs a third of a microsecond.
    if copies or spread:
        simulation.copies, simulation.spreads = count(copies, "copies", 2**32 - 1), settings_of(spread, target)
    if noise:
        simulation.noise = number(noise, "noise")
    if sampled or single_precision or method != "exact":
        simulation.sampled, simulation.single_precision, simulation.backward_euler = bool(sampled), bool(single_precision), method != "exact"
    return _run(force, rate, simulation, progress)


class Population:
    """A skin: "hand", "fingertip", "grid 8x8" or a population file (doc/skin.md).

    settings: parameters of its classes, {"sa1.f_B": "25 Hz"}.
    """

    def __init__(self, name, settings=None):
        self.name, self.settings = name_of(name, "population"), settings_of(settings)

    def respond(self, force, rate=None, *, contact="", taxels="", settings=None, seed=0, threads=0, progress=None):
        """Simulates the skin under a force, and returns a Response.

        - force: the name of a touch ("stroke", "texture", "scan") or of a stimulus. Or a force of one channel in N, which an indenter presses
          on the skin. Or one with a channel for each site, or for each taxel.
        - contact: the indenter, "flat" (default), "sphere", "edge" or "grating". settings={"contact.radius": "5 mm"} changes it.
          catalogue("contact") lists indenters with their parameters, and touches.
        - taxels: path of the layout of the taxels (doc/taxels.md).
        - rate, settings, seed, threads, progress, and errors: as for respond().
        """
        simulation = _simulation(self.settings + settings_of(settings), seed, threads, population=self.name, contact=name_of(contact, "contact"),
                                 taxels=name_of(taxels, "taxels"))
        return _run(force, rate, simulation, progress)

    def __repr__(self):
        return f"<Population {self.name}>"


def population(name, settings=None):
    """A skin by its name or file."""
    return Population(name, settings)


def hand(settings=None):
    """A right hand with some 17,000 afferents of four classes."""
    return Population("hand", settings)


def fingertip(settings=None):
    """The tip of an index finger with some 1,000 afferents of four classes."""
    return Population("fingertip", settings)


def grid(rows, columns, settings=None):
    """A grid of sites 2 mm apart, with an SA-I and an FA-I afferent of the thesis at each."""
    return Population(f"grid {rows}x{columns}", settings)
