"""From Python values to the numbers and texts that the library reads. What does not fit is an InputError that names the argument."""

import numbers
import os
import warnings
from collections.abc import Iterable

import numpy as np

from ._corpuscle import InputError

MAX_BINS = 10_000_000
_REAL_KINDS = "iuf"  # of numpy dtypes: integers and floats


class Warning(UserWarning):
    """A reason why a force or a response may be wrong."""


def show_warnings(texts, level):
    """Shows each text as a Python warning, at the line of the caller that is `level` calls above."""
    for one in texts:
        warnings.warn(one, Warning, stacklevel=level + 1)


def name_of(value, name):
    """A name or a path as text."""
    if not isinstance(value, (str, os.PathLike)):
        raise InputError(f"{name} = {value!r} is not a name")
    return text(os.fspath(value), name)


def text(value, name):
    """A value as text that the library can read."""
    out = str(value)
    if "\0" in out:
        raise InputError(f"{name}: {out!r} has a NUL character")
    if not out.isascii():
        try:
            out.encode()
        except UnicodeEncodeError:
            raise InputError(f"{name}: {out!r} is not valid Unicode") from None
    return out


def path_of(value):
    """A path as bytes, which need not be valid Unicode."""
    try:
        path = os.fsencode(value)
    except (TypeError, UnicodeEncodeError):
        raise InputError(f"{value!r} is not a path") from None
    if b"\0" in path:
        raise InputError(f"{value!r} has a NUL character")
    return path


def text_of(value):
    """A value as the command line has it: True is "true", 2.5 is "2.5", "2 N" stays."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    return text(value, "value")


def settings_of(settings, target=None):
    """Settings such as {"sa1.f_B": "25 Hz"}, or a list of texts, as texts "sa1.f_B=25 Hz". Names without a target belong to `target`."""
    if settings is None:
        return []
    if isinstance(settings, str):
        settings = [settings]
    if not isinstance(settings, dict):
        if not isinstance(settings, Iterable) or isinstance(settings, bytes):
            raise InputError(f'settings = {settings!r} must be a dictionary such as {{"sa1.f_B": "25 Hz"}}, or texts')
        return [name_of(s, "settings") for s in settings]
    full = lambda name: name if "." in name or target is None else f"{target}.{name}"
    return [f"{full(text(name, 'settings'))}={text_of(value)}" for name, value in settings.items()]


def options_of(options):
    """Keyword options as pairs of name and text: bad_fields="drop" is --bad-fields drop. A list gives an option several times."""
    pairs = []
    for name, value in options.items():
        if value is None:
            continue
        for one in value if isinstance(value, (list, tuple)) else [value]:
            pairs.append((text(name, "option").replace("_", "-"), text_of(one)))
    return pairs


def number(value, name):
    """A real number as a float."""
    if type(value) is float:
        return value
    if isinstance(value, (numbers.Real, np.number)) and not isinstance(value, (bool, np.complexfloating)):
        return float(value)
    if isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in _REAL_KINDS:
        return float(value)
    raise InputError(f"{name} = {value!r} is not a number")


def count(value, name, limit):
    """An integer from 0 to `limit`, ends included."""
    if type(value) is not int:
        if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Integral):
            raise InputError(f"{name} = {value!r} is not an integer")
        value = int(value)
    if not 0 <= value <= limit:
        raise InputError(f"{name} = {value} is outside [0, {limit}]")
    return value


def bin_count(length, bin):
    """The number of bins in a length, both in s: a finite real number, at least 0."""
    bins = max(length / bin, 0.0)
    if not bins <= MAX_BINS:
        raise InputError(f"{bins:.3g} bins are too many; the largest number is {MAX_BINS}")
    return bins


def real_array(values, name):
    """An array of float64 that the library can read: the array itself if it is one, otherwise a copy. Any strides and shape."""
    if type(values) is np.ndarray and values.dtype == np.float64 and values.dtype.isnative and values.flags.aligned:
        return values
    try:
        array = np.asarray(values)
        if array.dtype.kind == "O" and not any(isinstance(v, (str, bytes, bool, complex)) for v in array.flat):
            array = array.astype(np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from None
    if array.dtype.kind not in _REAL_KINDS:
        raise InputError(f"{name}: an array of {array.dtype} is not an array of real numbers; convert it: array.astype(float)")
    return np.require(array, np.float64, ["ALIGNED"])
