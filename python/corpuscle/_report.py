"""Report pages and notebook displays of responses. Both simulate the run again, because a page shows currents that a run does not record."""

import copy
import html
import os

import numpy as np

from . import _corpuscle
from ._options import path_of

MAX_SECONDS = 5       # a run that took longer is not repeated for a notebook
MAX_BYTES = 2_000_000  # of a notebook's output
_HEIGHT = 640         # of a page in a notebook, pixels


class Run:
    """A run that can be repeated. force: a Force, or the name of a stimulus or touch with `rate` in Hz, 0 for the default."""

    def __init__(self, force, rate, simulation):
        self.force, self.rate, self.simulation = force, rate, simulation

    def __call__(self, progress=None):
        force = self.force
        if isinstance(force, str):
            return _corpuscle.respond_to(force, self.simulation, self.rate, progress)
        return _corpuscle.respond(force.samples, force.rate, force.start, force.channels, force.name, force._origin, self.simulation, progress)

    def command(self):
        """The run as a call of this package."""
        s = self.simulation
        afferents = [os.path.basename(name) for name in s.afferents]  # without directories, which a published page would reveal
        force = repr(self.force) if isinstance(self.force, str) else f"<{self.force.name}>"
        rate = [f"rate={self.rate:g}"] if isinstance(self.force, str) and self.rate else []
        shown = lambda *names: [f"{name}={getattr(s, name)!r}" for name in names if getattr(s, name)]
        settings = shown("settings", "copies", "spreads", "seed", "noise", "sampled", "single_precision")
        method = ["method='backward-euler'"] if s.backward_euler else []
        if s.population:
            return f"corpuscle.population({os.path.basename(s.population)!r}).respond({', '.join([force, *rate, *shown('contact', 'taxels'), *settings])})"
        return f"corpuscle.respond({', '.join([force, *rate, f'afferent={afferents!r}', *settings, *method])})"

    def page(self, response, detail):
        """The report page, as text. Raises InputError if the run now gives other spikes than the response has."""
        simulation = copy.copy(self.simulation)
        simulation.report = detail
        again = Run(self.force, self.rate, simulation)()
        if not (np.array_equal(again.times, response.times) and np.array_equal(again.indices, response.indices)):
            raise _corpuscle.InputError("report: the force, or a file of the run, has changed since the run; simulate it again")
        return again.report(self.command())


def write(response, path):
    """Writes the page of a response."""
    path = path_of(path)
    _corpuscle.check_report(path)
    _corpuscle.write_report(path, response._run.page(response, _corpuscle.ReportDetail.complete))


def display(response):
    """The response in a notebook, as HTML: a line of text, and the report page in a frame. Without a page, also warnings and the reason."""
    lines, frame = [repr(response)], ""
    try:
        frame = _frame(response)
    except _corpuscle.InputError as error:
        lines += [*(f"Warning: {w}" for w in response.warnings), str(error)]
    return "".join(f"<div>{html.escape(line, quote=False)}</div>" for line in lines) + frame


def _frame(response):
    """The frame with the page. Raises InputError if there is none."""
    if response._seconds > MAX_SECONDS:
        raise _corpuscle.InputError(f'The run took {response._seconds:.0f} s, and its report takes as long: response.report("page.html") writes it.')
    page = response._run.page(response, _corpuscle.ReportDetail.brief).replace("&", "&amp;").replace("'", "&#39;")
    if not page or len(page.encode()) > MAX_BYTES:
        raise _corpuscle.InputError('The report is too large for a notebook: response.report("page.html") writes it.')
    return (f"<iframe srcdoc='{page}' title='report' sandbox='allow-scripts allow-downloads' "
            f"style='width:100%;height:{_HEIGHT}px;border:1px solid #8884;border-radius:6px'></iframe>")
