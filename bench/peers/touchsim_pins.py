"""Depths (mm) of an indenter in TouchSim's skin for a force, and the pins that press this shape into it.

TouchSim's skin is an elastic half-space with E = 50 kPa and nu = 0.4 (touchsim/transduction.py of hsaal/touchsim), so a rigid indenter meets
the reduced modulus E* = E / (1 - nu^2) = 59.5 kPa. With this E*, the force and the depth below belong together in both programs. Lengths are
in mm, forces in N, pressures in MPa.
"""
import numpy as np

from touchsim_skin import import_touchsim

E_STAR = 0.05 / (1 - 0.4**2)  # MPa


def flat_depth(force, radius):
    """Depth of a flat punch: F = 2 a E* d."""
    return np.asarray(force) / (2 * radius * E_STAR)


def sphere_depth(force, radius, modulus=E_STAR):
    """Depth of a sphere (Hertz): d^3 = 9 F^2 / (16 R E*^2)."""
    return np.cbrt(9 * np.asarray(force)**2 / (16 * radius * modulus**2))


def lattice(low, high, pitch):
    """The middles of the square cells from `low` to `high` (x, y)."""
    low, high = (np.asarray(corner) // pitch for corner in (low, high))
    cells = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
    return pitch * (np.stack(cells, -1).reshape(-1, 2) + 0.5)


def sphere_pins(depth, path, radius, pitch):
    """Pins that are touched by a sphere, and the depth of each one over time (a row for each pin).

    A pin at the distance r from the middle of the contact is pressed max(0, d - r^2 / 2R) deep. TouchSim's own mechanics release pins that
    would pull at the skin, and leave those in Hertz's circle of contact.
    """
    path = np.broadcast_to(path, (len(depth), 2))
    reach = np.sqrt(2 * radius * depth.max())
    pins = lattice(path.min(0) - reach, path.max(0) + reach, pitch)
    pressed = np.maximum(0, depth - ((pins[:, None] - path)**2).sum(-1) / (2 * radius))
    return pins[pressed.any(1)], pressed[pressed.any(1)]


def grating_pins(centre, radius, period, ridge, shift, force, pitch):
    """Pins in a round patch of a grating with ridges along x that moves by `shift` (mm) along y, and their depths over time.

    A pin is as deep as its cell is covered by a ridge, so edges are as steep as the pitch. At each time all depths are scaled to give the
    force in TouchSim's own mechanics, in which force is proportional to depth.
    """
    pins = lattice(np.subtract(centre, radius), np.add(centre, radius), pitch)
    pins = pins[np.hypot(*(pins - centre).T) <= radius]

    def covered(y):
        """Length covered by ridges from 0 to y."""
        return ridge * np.floor(y / period) + np.minimum(y % period, ridge)

    edge = pins[:, 1:] - centre[1] - pitch / 2 - shift
    shape = (covered(edge + pitch) - covered(edge)) / pitch
    unscaled = import_touchsim().Stimulus(trace=shape, location=pins, pin_radius=pitch / 2)
    return pins, shape * force / unscaled._profile.sum(1)
