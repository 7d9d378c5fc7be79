"""Models for other simulators."""

import os
from collections.abc import Mapping

from . import _corpuscle
from ._corpuscle import InputError
from ._options import name_of, path_of, settings_of, show_warnings


_KIT_KEYS = ("card", "map", "nch", "pch", "hv_nch", "hv_pch")


def export(subject, target, path=None, *, settings=None, kit=None):
    """Writes an afferent or a netlist for another simulator (doc/export.md), and returns the text, or the bytes of a file that is not text.

    - subject: an afferent ("sa1", "sa1b+izhikevich"), or the path of a netlist.
    - target: "brian2", "neuron", "verilog-a", "nir"; "ngspice" for netlists.
    - path: also write the text to this file, which must not exist.
    - settings: parameters, {"f_B": "25 Hz"} or {"sa1.f_B": 25}.
    - kit: transistors of a foundry's kit for "ngspice" (doc/kits.md), {"card": "bsim3.lib", "map": "bsim", "nch": "nmos1", "pch": "pmos1"}.

    Each part of a netlist that the simulator lacks is a corpuscle.Warning. Raises InputError, with the reason and a remedy, if the subject cannot be exported.
    """
    subject = name_of(subject, "subject")
    data, warnings, is_text = _corpuscle.export_model(subject, name_of(target, "target"), settings_of(settings, subject), _kit_of(kit, path))
    show_warnings(warnings, 2)
    if path is not None:
        try:
            with open(path_of(path), "xb") as file:
                file.write(data)
        except FileExistsError:
            raise InputError(f"{os.fsdecode(path)}: this file exists; name another, or remove it") from None
    return data.decode() if is_text else data


def _kit_of(kit, path):
    """A kit as texts, with the file of the deck."""
    if kit is None:
        return {}
    if not isinstance(kit, Mapping):
        raise InputError(f'kit = {kit!r} is not a dictionary; write {{"card": "bsim3.lib", "nch": "nmos1", "pch": "pmos1"}}')
    for key in kit:
        if key not in _KIT_KEYS:
            raise InputError(f"kit: there is no {key!r} (there are {', '.join(_KIT_KEYS)})")
    deck = {} if path is None else {"deck": os.fsdecode(path_of(path))}
    return {key: name_of(value, f"kit: {key}") for key, value in kit.items()} | deck
