"""Spin-up of the exact beam, or another change of its speed, refined until two solutions agree."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import points_of_beam, positive, times_from_rest
from ...loads import Load, loads_in_time, rippled
from ...motion import SpeedChange, SteadyRotation
from ...settled import KNOWN, settled
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ...warning import warn
from ..continuum.discretization import continuum_of
from ..continuum.rotation import SteadyBlade, finer_blades, rotating_blade
from ..continuum.state import Driven
from .response import SpinUpResponse
from .start import Start, checked_start, started
from .transient import BladeMotion, drive, grid_of, integrated

_TOLERANCE = 1e-8
_DIGITS = (3.0, 8.0)  # of the tolerance, by which the first solution is chosen
_A_DIGIT, _MORE_FUNCTIONS = 2, 4  # functions for θ, and from one refinement to the next
_MANY_CELLS = 16
_INSTANTS = 64  # of a motion, whose forces make functions of a table
_LEAST = 0.01  # of the tolerance, by which steps are chosen, that the error is at least
_LEFT = 0.1  # of the tolerance, what functions leave of strains
_MODES = 3  # by which functions of a table are chosen
_STEPS = (0.1, 0.075)  # up to 6 digits and at 8, in units of 1/√(EI/mL³), at most ten times 1/w̄
_SHORTER = 1.5  # from one refinement to the next
_REFINEMENTS = 7
_SLOW = 0.5  # of the change before, above which waves are what is left, and more cost more
_WITHIN = 0.2  # of the tolerance in space, for the first steps
_FINER, _AGAIN = 5.0, 3.0  # times smaller for the second, and for each after it
_TAIL = 5.0  # of it, for the last coordinates of what is resolved
_FINEST = 1e-11  # the least tolerance that round-off leaves in reach
_ROUND_OFF = 1e-13  # of the tip's position over the length


@one_thread
def spin_up_response(
    blade: Blade,
    spin_up: SpeedChange | SteadyRotation,
    times: float | ArrayLike,
    *,
    tolerance: float | None = None,
    theory: Theory = BERNOULLI_EULER,
    points: ArrayLike = (),
    loads: Sequence[Load] = (),
    start: Start = "straight",
    kick: float = 0.0,
    bent: float = 0.0,
) -> SpinUpResponse:
    """Return the exact response of the beam, damped or not, that does not swing before t = 0.

    Radau collocation of order 15 in the rotating frame, with the centrifugal, Coriolis and Euler
    forces of the spin-up; step and functions are refined together until two solutions agree. In
    space each solution chooses its steps by the tolerance.

    Parameters
    ----------
    blade : Blade
    spin_up : SpinUp, FourierRamp, SpeedTable or SteadyRotation
        Before it the beam turns at its speed at t = 0.
    times : array_like
        Times of the response [s], ascending, not before 0.
    tolerance : float, optional
        Largest error of the tip's position over the largest |q|; by default 1e-8, of a blade from
        stations 1e-6. Rates in space are known to ten times that of the largest.
    theory : Theory
        Extension, shear and rotary inertia.
    points : array_like
        Material points [m], from 0 to L, whose positions are wanted as well, to draw the beam.
    loads : sequence of loads
        What acts from t = 0 on: gravity, forces and ripples, each with its frequency.
    start : {"straight", "steady"} or callable
        State at t = 0. "straight", as the speed alone has it, lets loads that act at once excite
        every wave; "steady" is the steady state under the loads as they are at t = 0. A function
        returns the `BladeState` at points x [m], as `simulate` takes it: of an orbit
        ``lambda x: orbits.state(0, x)``, of a response before ``lambda x: found.state(-1, x)``.
    kick : float
        Speed of the tip out of the plane at t = 0 [m/s], of a planar blade that is still straight:
        its points move as `analytic.exact.continuum.state.flap_of_kick` has it.
    bent : float
        Deflection of the tip out of the plane over L, from which a planar blade starts at rest. Its
        curvature is that of the first flap mode at rest, which excites no other wave.

    Raises
    ------
    ValueError
        If the times are not ascending from 0 on, the tolerance is below 1e-11, a point is beyond
        the beam, or the final speed leaves no steady state.
    RuntimeError
        If the response is not known to 1e-3; short of the tolerance a warning comes with it.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, spin_up_response
    >>> motion = SpinUp(omega=6.0, ramp_time=3.0)
    >>> found = spin_up_response(Beam.reference(), motion, [1.0, 2.0, 3.0], tolerance=1e-4)
    >>> print(found.q.round(4))
    [-2.0782 -3.9266  1.442 ]
    """
    time = times_from_rest(times)
    kick, bent = checked_start(blade, spin_up, start, kick, bent)
    warn_if_rpm(blade, spin_up.fastest)
    loads = loads_in_time(loads)
    rotation = rippled(spin_up, loads)
    along = points_of_beam("points", points, blade.length)
    at_fastest = partial(_at_fastest, blade, spin_up, theory, loads, leaves=bool(kick or bent))
    steady = at_fastest(math.ceil(_A_DIGIT * _DIGITS[0]))
    controlled, by_answers = steady.model.has_dear_tangent, steady.model.answers
    # The kinks of a table leave an algebraic tail.
    table = blade.unit.cells.size > _MANY_CELLS
    tolerance = _checked(tolerance, max(_TOLERANCE, steady.model.tolerance))
    digits = float(np.clip(-math.log10(tolerance), *_DIGITS))
    functions = math.ceil(_A_DIGIT * digits)
    more = max(functions // 2 if table else _MORE_FUNCTIONS, steady.model.blade.panel_count)
    steady = _settled(steady, tolerance) if by_answers else at_fastest(functions)
    coarser, error, size = None, math.inf, 0.0
    within = _WITHIN * tolerance if controlled else None
    for level in range(_REFINEMENTS):
        if level and by_answers:
            steady = _resolving(steady, coarser, partial(drive, blade, rotation, loads), tolerance)
        elif level:
            steady = at_fastest(functions)
        model = steady.model
        q, q_dot = started(blade, model, spin_up.start, start, loads, kick, bent)
        if callable(start) and controlled and not (level or table or by_answers):
            # Functions that do not resolve the start swing about it in waves of their own.
            functions = max(model.needed(q[None], tolerance), model.bending + more)
            continue
        grid = _grid(blade, spin_up, float(time[-1]), digits, None if controlled else level)
        finer = integrated(blade, rotation, loads, model, grid, time, along, q, q_dot, within)
        functions = model.bending + more
        if finer is None:
            coarser = None
            continue
        if within is not None:
            if not (level or table or by_answers):
                needed = model.needed(finer.steps.at(time)[0], _TAIL * tolerance)
                if needed > model.bending:
                    functions = needed
                    continue
            within /= _FINER if coarser is None else _AGAIN
        if coarser is not None:
            # At constant speed a blade at rest in its frame deflects by round-off.
            change, size = _change(coarser, finer, (not spin_up.ramp_time) * _ROUND_OFF / tolerance)
            before, error = error, max(change, controlled * _LEAST * tolerance)
            if error <= tolerance or (controlled and level > 2 and error > _SLOW * before):
                break
        coarser = finer
    waves = bool(loads) and not any(blade.damping.of_strains)
    finer = _known(finer, tolerance, error, size, time[-1], waves=waves)
    return SpinUpResponse(
        blade=blade,
        spin_up=spin_up,
        loads=loads,
        start=start,
        kick=kick,
        bent=bent,
        theory=theory,
        tolerance=tolerance,
        time=time,
        points=blade.length * along,
        q=blade.length * finer.q,
        q_dot=blade.length * blade.frequency_scale * finer.q_dot,
        tip=blade.length * finer.tip,
        axis=blade.length * finer.axis,
        twist=finer.twist,
        error=error,
        steps=finer.steps.lengths.size,
        functions=model.bending,
        model=model,
        steps_taken=finer.steps,
    )


def _at_fastest(
    blade: Blade,
    spin_up: SpeedChange | SteadyRotation,
    theory: Theory,
    loads: Sequence[Load],
    functions: int,
    *,
    leaves: bool,
) -> SteadyBlade:
    """Return the blade at its fastest, on so many functions; refuse a speed that tears it."""
    model = continuum_of(
        blade, theory, functions, functions, axial=functions // 2, loads=loads, leaves=leaves
    )
    return rotating_blade(blade, spin_up.fastest, model)


def _checked(tolerance: float | None, default: float) -> float:
    if tolerance is None:
        return default
    if positive("tolerance", tolerance) < _FINEST:
        raise ValueError(
            f"tolerance must be at least {_FINEST:g}, which round-off allows, got {tolerance:g}"
        )
    return float(tolerance)


def _settled(steady: SteadyBlade, tolerance: float) -> SteadyBlade:
    """Return a blade on functions by which its lowest modes and its steady state settle."""
    found, *_ = settled(
        lambda one: one, finer_blades(steady), tolerance, _numbers, "", "", left=math.inf
    )
    return found


def _resolving(
    steady: SteadyBlade,
    motion: BladeMotion | None,
    drive_of: Callable[[Any], Callable[[FloatArray], Driven]],
    tolerance: float,
) -> SteadyBlade:
    """Return a table's blade on functions from the forces that its motion causes, or its modes.

    Forces of modes alone, taken again and again, are slow to make functions for a motion.
    """
    if motion is None or not motion.steps.lengths.size:
        return steady.refined()
    model: Any = steady.model
    ends = motion.steps.ends[1:]
    few = ends[np.unique(np.linspace(0, ends.size - 1, _INSTANTS).astype(int))]
    q, *rates = motion.steps.at(few)
    caused = model.forces_caused(q, *rates, drive_of(model)(few))
    energy = np.sum(q * (q @ model.functions.stiffness), axis=1).max()
    return steady.onto(caused / math.sqrt(energy or 1.0), _LEFT * tolerance)


def _numbers(steady: SteadyBlade) -> FloatArray:
    """Return logarithms of the lowest frequencies, and the tip's place and turn."""
    turn = steady.model.tip_turn(steady.equilibrium[None])
    return np.concatenate((np.log(steady.vibration[0][:_MODES]), steady.tip, turn))


def _change(coarser: BladeMotion, finer: BladeMotion, least: float) -> tuple[float, float]:
    """Return the largest change of the tip's place and twist over the largest |q|, and that."""
    size = max(float(np.abs(finer.tip[:, 1:]).max()), least)
    changes = finer.tip - coarser.tip, finer.twist - coarser.twist
    return max(float(np.abs(change).max()) for change in changes) / (size or 1.0), size


def _known(
    finer: BladeMotion | None, tolerance: float, error: float, size: float, end: float, *,
    waves: bool,
) -> BladeMotion:  # fmt: skip
    """Return the finest solution, with a warning short of the tolerance; refuse an unknown one."""
    if finer is not None and error <= tolerance:
        return finer
    sentence = _what_to_try(tolerance, error, size, end, waves=waves)
    if finer is None or not error <= KNOWN:
        raise RuntimeError(sentence)
    warn(sentence)
    return finer


def _what_to_try(tolerance: float, error: float, size: float, end: float, *, waves: bool) -> str:
    """Return a sentence on two solutions that differ by `error` times `size`."""
    if math.isinf(error):
        why = f"Newton's method fails before t = {end:g} s; take a longer ramp"
    elif error * size < _ROUND_OFF:
        why = (
            f"until t = {end:g} s the beam deflects by {size:.1e} of its length only, which "
            f"round-off drowns; ask for later times as well"
        )
    else:
        enough = f"tolerance={10.0 * error:.0e} or " * (10.0 * error <= KNOWN)
        why = (
            f"the finest two solutions differ by {error:.1e} of the largest deflection; take "
            f"{enough}a longer ramp"
        )
    if waves:
        why += (
            "; a load that jumps excites waves of all lengths, which damping of the blade's "
            "strains takes away, as with Damping(bending=t, out_of_plane=t, torsion=t, axial=t, "
            "shear=t) and t = 1e-4 s"
        )
    return f"the response does not settle to {tolerance:g}: {why}"


def _grid(
    blade: Blade,
    spin_up: SpeedChange | SteadyRotation,
    end: float,
    digits: float,
    level: int | None,
) -> FloatArray:
    """Return the ends of steps [s], or without a level of stretches that are cut into steps.

    One of them is the end of the ramp, where Eq. 1 has a kink, as others may.
    """
    corners = sorted({0.0, min(spin_up.ramp_time, end), end})
    # A short ramp still has to be seen as the smooth curve it is.
    lengths: tuple[float, ...] = spin_up.shortest_wave, end
    if level is not None:
        rate = spin_up.fastest / blade.frequency_scale
        first = float(np.interp(digits, (6.0, 8.0), _STEPS)) / _SHORTER**level
        longest = first * min(1.0, 10.0 / rate if rate else 1.0) / blade.frequency_scale
        lengths = min(longest, spin_up.shortest_wave / 4.0), longest
    if not spin_up.ramp_time:
        lengths = lengths[1:]
    parts = zip(pairwise(corners), lengths, strict=False)
    return grid_of(corners, [math.ceil((b - a) / step) for (a, b), step in parts])
