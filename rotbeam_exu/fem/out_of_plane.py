"""The spin-up in space: `simulate_3d` kicks the blade out of its plane and sees what grows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np

from analytic import AnyBlade, SpinUp, SteadyRotation
from analytic.arrays import FloatArray
from analytic.exact.beam.state import BeamState
from analytic.input_checks import finite_number
from analytic.lazily import integrate

from ..lazily import xr
from ..runs.check import SimulationError
from .case import Case
from .elements import Formulation, formulation
from .frame import Frame
from .simulation import run_case

_LARGEST_KICK = 0.1
_SMALL_KICK = 1e-6
"""With it a blade of slenderness 1e-8 starts at steps at which it does not with 1e-4."""

_BETWEEN = 8
"""Pieces of an element over which the kick is integrated."""


def simulate_3d(
    blade: AnyBlade,
    motion: SpinUp | SteadyRotation,
    *,
    element: str | Formulation = "exact",
    elements: int = 16,
    duration: float = 15.0,
    step: float = 1e-3,
    frame: Frame = "inertial",
    kick: float = _SMALL_KICK,
    initial_state: Callable[[FloatArray], BeamState] | None = None,
    progress: Callable[[float], None] | None = None,
) -> xr.Dataset:
    """Spin the blade up in space, starting a little out of the plane of rotation.

    As `simulate`, with nodes that leave the plane and a clamp that holds all directions. Undamped.

    Parameters
    ----------
    blade : Blade
        With a section out of the plane: ``beam.with_shape(Rectangle())`` or
        ``beam.with_section_out_of_plane(...)``; set at no angle, without point masses.
    motion : SpinUp or SteadyRotation
        Prescribed rotation of the clamped end.
    element : {"exact", "cable"} or Formulation
        The geometrically exact beam, sheared and twisted, or the cable, which has no torsion and
        bends alike in all directions.
    frame : {"inertial", "rotating"}
        As in `simulate`; the rotating one is for the cable.
    kick : float
        Deflection out of the plane at t = 0, at rest: an arc, w = kick L (x/L)² of small ones,
        that does not stretch the blade.
    initial_state : callable, optional
        Planar state at t = 0, as of `simulate`, onto which the kick is put.
    elements, duration, step, progress
        As in `simulate`.

    Returns
    -------
    Dataset
        What `simulate` returns, with w [m] and w_dot [m/s] of the tip out of the plane and, but
        for the cable, twist [rad] of the tip's section about its normal. Attributes also hold kick.

    Raises
    ------
    ValueError, TypeError
        If an input is refused.
    SimulationError
        If the solver fails, or the run does not pass the checks of `rotbeam_exu.runs.check`.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, Tube
    >>> from rotbeam_exu import simulate_3d
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> tube = Beam.reference().with_shape(Tube())
    >>> run = simulate_3d(tube, motion, elements=4, duration=1.5, step=5e-3, kick=1e-3)
    >>> print(f"q {run.q.min().item():.3f} m, w at most {abs(run.w).max().item():.4f} m")
    q -4.652 m, w at most 0.0080 m
    """
    model = formulation(element, in_space=True)
    kick = finite_number("kick", kick)
    if abs(kick) > _LARGEST_KICK:
        raise ValueError(
            f"kick must be at most {_LARGEST_KICK:g} of the length, got {kick:g}: it is to be "
            "small, 1e-6 say"
        )
    case = Case(
        beam=blade, spin_up=motion, element=model, elements=elements, duration=duration,
        step=step, frame=frame,
    )  # fmt: skip

    def start(x: FloatArray) -> SpaceState:
        return kicked(initial_state, x, blade.length, kick)

    try:
        run = run_case(case, initial_state=start, progress=progress)
    except SimulationError as error:
        if error.run is None or error.run["time"].size > 1 or abs(kick) <= _SMALL_KICK:
            raise
        told = SimulationError(f"{error}, or kick=1e-6: {kick:g} is much for so slender a blade")
        told.run = error.run.assign_attrs(verdict=str(told), kick=kick)
        raise told from error
    return run.assign_attrs(kick=kick)


@dataclass(frozen=True, kw_only=True)
class SpaceState(BeamState):
    """State of the blade at material points in the frame of the clamp: r = (x + u, v, w).

    Sections are turned about their tangent by nothing, in motion as at rest.

    Attributes
    ----------
    w : ndarray (points,)
        Displacement along the axis of rotation [m].
    w_slope : ndarray (points,)
        Its derivative to x, w' [-].
    w_dot, w_slope_dot : ndarray (points,)
        Their rates [m/s, 1/s].
    """

    w: FloatArray
    w_slope: FloatArray
    w_dot: FloatArray
    w_slope_dot: FloatArray


def kicked(
    planar: Callable[[FloatArray], BeamState] | None, x: FloatArray, length: float, kick: float
) -> SpaceState:
    """Return a planar state, or the straight blade at rest, bent out of its plane by an arc.

    Its tangents are turned out of the plane by 2 kick x/L, and w = kick L (x/L)² of small kicks.
    An arc is no mode: it has a share of each, so that whatever grows has something to grow from.
    It bends and does not stretch, which of a slender blade would take all its energy.
    `x` (nodes,) goes from 0 to the length evenly [m].
    """
    fine = np.linspace(0.0, length, _BETWEEN * (x.size - 1) + 1)
    zero = np.zeros(fine.size)
    at_rest = dict.fromkeys((one.name for one in fields(BeamState)), zero)
    state = BeamState(**at_rest) if planar is None else planar(fine)
    tilt = 2.0 * kick * fine / length
    # What is added to the slopes (u', v', w') turns the tangent, and leaves it as long as it was.
    tangent = np.stack((1.0 + state.u_slope, state.v_slope))
    added = np.vstack((tangent * (np.cos(tilt) - 1.0), np.hypot(*tangent) * np.sin(tilt)))
    u_slope, v_slope, w_slope = added
    u, v, w = integrate.cumulative_simpson(added, x=fine, initial=0.0)
    bent = vars(state) | {
        "u": state.u + u, "v": state.v + v, "w": w,
        "u_slope": state.u_slope + u_slope, "v_slope": state.v_slope + v_slope,
        "w_slope": w_slope, "w_dot": zero, "w_slope_dot": zero,
    }  # fmt: skip
    nodes = slice(None, None, _BETWEEN)
    return SpaceState(**{name: np.add(value, zero)[nodes] for name, value in bent.items()})
