"""Start of a motion in time: straight, in the loaded steady state, or in a given state."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ...arrays import FloatArray
from ...blade import Blade
from ...input_checks import finite_number
from ...loads import Load
from ...motion import SteadyRotation, require_ramp
from ..continuum.loading import unit_load
from ..continuum.rotation import rotating_blade
from ..continuum.state import BladeState
from ..continuum.vectors import rotation_vectors
from ..linear.families import flap_shape

Start = str | Callable[[FloatArray], BladeState]
_LARGEST_KICK = 0.1
_CHANGES, _EXACT = 20, 1e-13  # of Newton's method
_OFF = 1e-3  # place over the length and angle, from which on a state is none of the blade


def require_bent(name: str, bent: float) -> float:
    """Return a start out of the plane, over L; refuse one that is not small."""
    if not abs(finite_number(name, bent)) <= _LARGEST_KICK:
        raise ValueError(
            f"{name} must be at most {_LARGEST_KICK:g} of the length, got {bent:g}: it is to be "
            "small, 1e-6 say"
        )
    return float(bent)


def checked_start(
    blade: Blade, spin_up: object, start: object, kick: float, bent: float
) -> tuple[float, float]:
    """Return the checked kick and bent; refuse a motion and a start that are none."""
    if not isinstance(spin_up, SteadyRotation):
        require_ramp(spin_up)
    if start not in ("straight", "steady") and not callable(start):
        raise ValueError(
            "start must be 'straight', 'steady', or a function that returns the BladeState at "
            f"points x, as lambda x: orbits.state(0, x), got {start!r}"
        )
    kick, bent = finite_number("kick", kick, "m/s"), require_bent("bent", bent)
    if not (kick or bent):
        return kick, bent
    if not blade.is_planar:
        raise ValueError(
            "kick and bent move a blade out of its plane, which this one leaves by itself: leave "
            "them out"
        )
    if start != "straight":
        raise ValueError(
            f"kick and bent are of a blade that starts straight, got {start!r}: leave start out"
        )
    return kick, bent


def started(
    blade: Blade,
    model: Any,
    speed: float,
    start: Start,
    loads: Sequence[Load],
    kick: float,
    bent: float,
) -> tuple[FloatArray, FloatArray]:
    """Return coordinates and rates (n,) of a start at a speed [rad/s]."""
    if callable(start):
        return _fitted(blade, model, start)
    held = tuple(unit_load(blade, load) for load in loads) if start == "steady" else ()
    steady = rotating_blade(blade, speed, model, loads=held)
    q, q_dot = steady.equilibrium, np.zeros(model.size)
    if bent:
        q = q + bent * flap_shape(model)
    if kick:
        q_dot = model.struck(kick / (blade.length * blade.frequency_scale))
    return q, q_dot


def _fitted(
    blade: Blade, model: Any, start: Callable[[FloatArray], BladeState]
) -> tuple[FloatArray, FloatArray]:
    """Return the state that agrees best with a given one in places and sections.

    By Gauss and Newton; of those that agree as well, the one of least change.
    """
    x, q, off = np.append(model.points, 1.0), np.zeros(model.size), np.inf
    given = start(blade.length * x)
    where, rate = given.place / blade.length, 1.0 / blade.frequency_scale
    for _ in range(_CHANGES):
        (place,), (section,) = model.standing(q[None], x)
        turns = rotation_vectors(given.section @ np.swapaxes(section, -1, -2))
        missing = np.stack((where - place, turns))
        off, before = float(np.abs(missing).max()), off
        onto = np.concatenate([part.real for part in model.moved(q, np.eye(model.size), x)])
        onto = onto.reshape(-1, model.size)
        change = np.linalg.lstsq(onto, missing.transpose(0, 2, 1).ravel())[0]
        if float(np.abs(change).max()) <= _EXACT or (off >= before and off < _OFF):
            break
        q = q + change
    if not off < _OFF:
        raise ValueError(
            f"the state to start from is {off:.1e} of the length, or rad, off the nearest one of "
            "this blade: give places from its clamp, in the turning frame, and sections in columns"
        )
    moving = np.stack((given.velocity / blade.length, given.spin)) * rate
    return q, np.linalg.lstsq(onto, moving.transpose(0, 2, 1).ravel())[0]
