"""A line with the completed fraction and the time left, in a terminal or a notebook."""

import sys
import time

from ._corpuscle import InputError

_FIRST, _BETWEEN, _WIDTH = 1.0, 0.1, 32  # s before the line appears; s between two updates; characters of the bar


def _is_visible():
    """True in a terminal and in IPython."""
    ipython = sys.modules.get("IPython")
    return (ipython is not None and ipython.get_ipython() is not None) or (sys.stderr is not None and sys.stderr.isatty())


def _time_text(seconds):
    s = round(seconds)
    return f"{s} s" if s < 60 else f"{s // 60}:{s % 60:02} min" if s < 3600 else f"{s // 3600}:{s // 60 % 60:02} h"


def _is_notebook():
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")


class _Terminal:
    """A line on standard error."""

    def __init__(self):
        self._shown = 0

    def show(self, line):
        sys.stderr.write("\r" + line.ljust(self._shown))
        sys.stderr.flush()
        self._shown = len(line)

    def remove(self):
        sys.stderr.write("\r" + " " * self._shown + "\r")
        sys.stderr.flush()


class _Cell:
    """A line in the output of a notebook's cell."""

    def __init__(self):
        from IPython.display import HTML, display
        self._html, self._display, self._handle = HTML, display, None

    def show(self, line):
        content = self._html(f"<pre>{line}</pre>")
        if self._handle is None:
            self._handle = self._display(content, display_id=True)
        else:
            self._handle.update(content)

    def remove(self):
        self._handle.update(self._html(""))


class ProgressLine:
    """Called with the completed fraction, shows the line. Leaving it as a context removes the line."""

    def __init__(self):
        self._start = self._last = time.monotonic()
        self._output = None

    def __call__(self, fraction):
        now = time.monotonic()
        if now - self._start < _FIRST or now - self._last < _BETWEEN:
            return
        self._last = now
        full = int(min(max(fraction, 0.0), 1.0) * _WIDTH)
        elapsed = now - self._start
        left = f"{_time_text(elapsed / fraction - elapsed)} left" if fraction > 0 else "..."
        line = f"[{'=' * full}{' ' * (_WIDTH - full)}] {100 * fraction:3.0f} %  {left}"
        if self._output is None:
            self._output = _Cell() if _is_notebook() else _Terminal()
        self._output.show(line)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._output is not None:
            self._output.remove()


class _Given:
    """A function of the caller, or none."""

    def __init__(self, function):
        self._function = function

    def __enter__(self):
        return self._function

    def __exit__(self, *_):
        pass


def progress_of(progress):
    """A context whose value is the function that a run calls with its completed fraction. progress: a function; None: a line if standard error is a
    terminal, or in IPython; False: nothing."""
    if progress is None:
        return ProgressLine() if _is_visible() else _Given(None)
    if progress is False:
        return _Given(None)
    if not callable(progress):
        raise InputError(f"progress = {progress!r} is not a function")
    return _Given(progress)
