"""The stimuli of touchsim_responses.py: force for Corpuscle, pins for TouchSim, and the times at which responses are counted."""
import dataclasses
import typing

import numpy as np

from touchsim_pins import E_STAR, flat_depth, grating_pins, sphere_depth, sphere_pins

RATE = 5000  # Hz, of both programs; TouchSim's neurons always step at this rate
CENTRE = np.array([0.0, 12.0])  # mm, on the fingertip
PLACES = np.array([[-4.0, 8.0], [4.0, 8.0], [-4.0, 15.0], [4.0, 15.0]])  # mm, of the small probe, which touches few afferents at a time
PITCH = 0.5  # mm, of Corpuscle's sites and of TouchSim's pins


@dataclasses.dataclass
class Stimulus:
    name: str
    group: str
    force: np.ndarray  # N
    contact: list  # options of Corpuscle's contact
    pins: typing.Callable  # returns positions (mm), depths (mm, a row for each pin) and the radius of a pin (mm)
    radius: float  # mm, of the contact
    windows: dict  # part -> (from, to), s
    path: np.ndarray = dataclasses.field(default_factory=lambda: CENTRE[None])  # of the contact, mm


def contact_options(indenter, radius, place=CENTRE, **settings):
    settings = {"radius": f"{radius}mm", "x": f"{place[0]}mm", "y": f"{place[1]}mm"} | settings
    if indenter == "sphere":
        settings["E_star"] = f"{1e3 * E_STAR}kPa"
    return ["--contact", indenter] + [word for key, value in settings.items() for word in ("--set", f"contact.{key}={value}")]


def ramp_hold(rest, up, hold, down, after):
    """A trapezoid of height 1, sampled."""
    t = np.arange(round((rest + up + hold + down + after) * RATE)) / RATE
    return t, np.interp(t, np.cumsum([rest, up, hold, down]), [0, 1, 1, 0])


def probe(name, group, depth, windows):
    """A flat probe with this depth (mm) over time, a single pin in TouchSim, at each of the places."""
    radius = 0.5
    for place in PLACES:
        yield Stimulus(name, group, depth / flat_depth(1, radius), contact_options("flat", radius, place),
                       lambda place=place: (place[None], depth[None], radius), radius, windows, place[None])


def ramp_windows(up, hold):
    return {"onset": (0.1, 0.1 + up + 0.02), "steady": (0.1 + up + 0.1, 0.1 + up + hold)}


def ramps():
    hold = 0.5
    for depth in (0.1, 0.3, 1.0):
        for speed in (2, 10, 50):  # mm/s
            up = depth / speed
            _, shape = ramp_hold(0.1, up, hold, up, 0.2)
            yield from probe(f"ramp {depth:g} mm, {speed} mm/s", "ramp", depth * shape, ramp_windows(up, hold))


def presses():
    radius, hold = 5, 0.5
    for force, up in ((0.05, 0.1), (0.5, 0.1), (0.5, 0.02)):
        _, shape = ramp_hold(0.1, up, hold, up, 0.2)
        depth = sphere_depth(force * shape, radius)
        yield Stimulus(f"sphere {force:g} N in {1e3 * up:g} ms", "press", force * shape, contact_options("sphere", radius),
                       lambda d=depth: (*sphere_pins(d, CENTRE, radius, PITCH), PITCH / 2), np.sqrt(radius * depth.max()),
                       ramp_windows(up, hold))


def sines():
    for frequency in (5, 10, 20, 40, 80, 160, 300):
        for amplitude in (5, 25, 125):  # um
            t, preload = ramp_hold(0.0, 0.1, 0.8, 0.1, 0.1)
            vibration = np.where((t >= 0.3) & (t < 0.8), np.sin(2 * np.pi * frequency * (t - 0.3)), 0)
            yield from probe(f"sine {frequency} Hz, {amplitude} um", "sine", 0.5 * preload + 1e-3 * amplitude * vibration,
                             {"onset": (0.3, 0.4), "steady": (0.4, 0.8)})


def gratings():
    """Without the vibration that Corpuscle adds to a sliding grating: TouchSim's pins have none."""
    radius, load, speed, hold = 4, 0.3, 40, 0.6  # mm, N, mm/s, s
    for period in (1, 2, 4):
        t, shape = ramp_hold(0.1, 0.05, hold, 0.05, 0.1)

        def pins(period=period, force=load * shape, shift=speed * t):
            return *grating_pins(CENTRE, radius, period, period / 2, shift, force, PITCH / 2), PITCH / 4

        yield Stimulus(f"grating {period} mm, {speed} mm/s", "grating", load * shape,
                       contact_options("grating", radius, period=f"{period}mm", ridge=f"{period / 2}mm", speed=f"{speed}mm/s", vibration=0),
                       pins, radius, {"onset": (0.1, 0.17), "steady": (0.25, 0.15 + hold)})


def strokes():
    radius, force, start, length = 8, 0.3, 5, 13  # mm, N, mm, mm
    for speed in (20, 80):
        t, shape = ramp_hold(0.05, 0.05, length / speed + 0.05, 0.05, 0.1)
        path = np.stack([np.zeros_like(t), start + np.clip(speed * (t - 0.1), 0, length)], -1)
        depth = sphere_depth(force * shape, radius)
        moves = {"x": "0mm", "y": f"{start}mm", "x1": "0mm", "y1": f"{start + length}mm", "t_start": "0.1s", "t_move": f"{length / speed}s"}
        yield Stimulus(f"stroke {speed} mm/s", "stroke", force * shape, contact_options("sphere", radius, **moves),
                       lambda d=depth, p=path: (*sphere_pins(d, p, radius, PITCH), PITCH / 2), np.sqrt(radius * depth.max()),
                       {"onset": (0.05, 0.12), "steady": (0.12, 0.1 + length / speed)}, path[::50])


def all_stimuli():
    """The stimuli; those with the same name are the same touch at different places, and stand together."""
    return [*ramps(), *presses(), *sines(), *gratings(), *strokes()]
