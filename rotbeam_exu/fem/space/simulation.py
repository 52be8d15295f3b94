"""The spin-up in space: `simulate_3d` kicks the blade out of its plane and sees what grows."""

from __future__ import annotations

from collections.abc import Callable

from analytic import AnyBlade, BeamState, SpinUp, SteadyRotation
from analytic.arrays import FloatArray
from analytic.input_checks import finite_number

from ...lazily import xr
from ...verdict import SimulationError
from ..case import Case
from ..frame import Frame
from ..simulation import run_case
from .columns import space_columns
from .elements import SpaceFormulation, space_formulation
from .state import SpaceState, kicked

_LARGEST_KICK = 0.1
_SMALL_KICK = 1e-6
"""With it a blade of slenderness 1e-8 starts at steps at which it does not with 1e-4."""


def simulate_3d(
    blade: AnyBlade,
    motion: SpinUp | SteadyRotation,
    *,
    element: str | SpaceFormulation = "exact",
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
    element : {"exact", "cable"} or SpaceFormulation
        The geometrically exact beam, sheared and twisted, or the cable, which has no torsion and
        bends alike in all directions.
    elements : int
        Number of elements of equal length.
    duration, step : float
        End of the run and step size [s].
    frame : {"inertial", "rotating"}
        As in `simulate`; the rotating one is for the cable.
    kick : float
        Deflection out of the plane at t = 0, at rest: an arc, w = kick L (x/L)² of small ones,
        that does not stretch the blade.
    initial_state : callable, optional
        Planar state at t = 0, as of `simulate`, onto which the kick is put.
    progress : callable, optional
        Called with the fraction done.

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
        If the solver fails, or the run does not pass the checks of `rotbeam_exu.verdict`.

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
    model = space_formulation(element)
    _require_modeled(blade, model, frame)
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
        run = run_case(case, initial_state=start, progress=progress, pack=space_columns)
    except SimulationError as error:
        if error.run is None or error.run["time"].size > 1 or abs(kick) <= _SMALL_KICK:
            raise
        told = SimulationError(f"{error}, or kick=1e-6: {kick:g} is much for so slender a blade")
        told.run = error.run.assign_attrs(verdict=str(told), kick=kick)
        raise told from error
    return run.assign_attrs(kick=kick)


def _require_modeled(blade: AnyBlade, model: SpaceFormulation, frame: Frame) -> None:
    """Refuse what the elements in space do not model."""
    model.require_section(blade)
    unit = blade.unit
    if any(unit.damping):
        raise ValueError(
            "simulate_3d is for undamped blades, as Exudyn's geometrically exact beam ignores its "
            f"damping: this one has {unit.differences}; take "
            "blade.with_damping(Damping())"
        )
    if unit.masses:
        raise ValueError(
            f"simulate_3d is for blades without point masses, and this one has {unit.differences}"
        )
    if frame in ("inertial", "rotating") and frame not in model.frames:
        raise ValueError(
            f"element {model.name!r} is solved in the {' or '.join(model.frames)} frame, its "
            f"inertia being no constant matrix: take frame={model.frames[0]!r}"
        )
