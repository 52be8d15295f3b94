"""The spin-up in Exudyn: `simulate` builds, integrates, checks a run; `kicked` starts it."""

from __future__ import annotations

import json
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from analytic import Blade, SteadyRotation, linear_modes
from analytic.arrays import FloatArray
from analytic.blade_checks import require_planar, warn_if_rpm
from analytic.exact.continuum.planar_kinematics import set_at
from analytic.exact.continuum.state import BladeState
from analytic.exact.driven.start import require_bent
from analytic.exact.linear.steady_state import stretched_state
from analytic.input_checks import points_of_beam
from analytic.lazily import integrate, interpolate
from analytic.loads import Load
from analytic.motion import SpeedChange
from analytic.warning import warn

from ..lazily import xr
from ..runs import Frame
from ..runs.attributes import versions
from ..runs.check import SimulationError, check_run, remedy
from . import drive
from .case import RunCase
from .columns import columns
from .elements import Formulation
from .mesh import Mesh
from .rotating_beam import add_rotating_beam
from .solver import Sensors, described, exudyn_system, solve
from .units import Units

_ROUND_OFF = 1e-13  # of a planar state's size, which its setting angle leaves
_ALONG, _BETWEEN = 401, 8
"""Points of a mode's spline, and pieces of an element over which the kick is integrated."""


def simulate(
    blade: Blade,
    spin_up: SpeedChange | SteadyRotation,
    *,
    element: str | Formulation = "cable",
    elements: int = 16,
    duration: float = 15.0,
    step: float = 1e-3,
    frame: Frame = "inertial",
    loads: Sequence[Load] = (),
    initial_state: Callable[[FloatArray], BladeState] | None = None,
    stations: ArrayLike = (),
    progress: Callable[[float], None] | None = None,
) -> xr.Dataset:
    """Spin the beam up and let it oscillate (Secs. 2 and 6), damped as the blade is.

    Solved in the beam's own units, so that any beam is as well resolved as the paper's; samples
    are kept at least 200 times a period of ω_n. Exudyn cannot be left in mid-run: an interpreter
    that exits while another thread simulates aborts the process, so join such threads first.

    Parameters
    ----------
    blade : Blade
        The beam; in space with a section out of the plane, as ``beam.with_shape(Rectangle())``.
    spin_up : SpinUp, FourierRamp, SpeedTable or SteadyRotation
        Prescribed rotation of the clamped end: Eq. 1, another change of the speed, or a constant
        speed from the start.
    element : str or Formulation
        Beam formulation: a key of `rotbeam_exu.fem.elements.FORMULATIONS`, or an instance with its
        options, such as `Exact(nodes=3)`. It lives in the plane, or in space: "space_exact", for
        blades with twist, precone, prebend and sweep, and "space_cable".
    elements : int
        Number of elements, of equal length between the stations of the section.
    duration : float
        End of the run [s]; longer than the ramp.
    step : float
        Step size of the integrator [s]; `duration` holds a whole number of them.
    frame : {"inertial", "rotating"}
        Coordinates of the model. Inertial: generalized-α with spectral radius 0.9 on a rheonomic
        constraint. Rotating: inertial forces on a beam at a resting clamp, trapezoidal rule; only
        there may a planar element have a setting angle. The step error of the paper's beam at 2, 6
        and 8 rad/s is then 3.5, 14 and 19 times smaller.
    loads : sequence of SpeedRipple, TipForce, DistributedForce and Gravity
        Loads on the blade from t = 0 on; harmonic loads with their frequency. The frame of the
        clamp includes the ripples of its speed.
    initial_state : callable, optional
        Gives the state at material points x [m] at t = 0, as
        ``lambda x: backbone.state(i, x)`` of `analytic.periodic_orbits` does. By default the beam
        is straight and at rest in the frame of the clamp, and stretched if a change of the speed
        begins in rotation. `kicked` bends it out of its plane.
    stations : array_like
        Material points [m], from 0 to L, at which the run keeps places, sections, strains, force
        and moment over `time` and `station`: see `rotbeam_exu.runs.shape.shape_of`.
    progress : callable, optional
        Called with the fraction done, from 0 to 1, about a hundred times.

    Returns
    -------
    Dataset
        Over `time` [s]: q [m] and q_dot [m/s] of the tip (Eq. 16), tip_x, tip_y [m] in the
        plane of rotation and the inertial frame, angle [rad], kinetic_energy, elastic_energy,
        jacobi_energy = E - θ' L_z [J], clamp_residual [m], direction_residual [-], axial_strain
        [-] (largest along the beam). With loads or damping also supplied_energy [J]: the integral
        from t = 0 of -θ'' L_z, of the power of the loads and of what damping takes, by which
        jacobi_energy changes. Forces of the clamp's constraints: root_force_x (tension) to
        root_force_z [N] and root_moment_x to root_moment_z [N m] of the blade on the clamp, in the
        clamp's frame, zero out of the plane of bending of an element of the plane; clamp_torque
        [N m] of the clamp on the blade about the axis of rotation. In space also w [m] and
        w_dot [m/s] of the tip out of the plane, normal to the clamp, whose frame the precone tilts;
        twist [rad] of the tip's section about its normal; axis [m], the places of the nodes,
        (time, node, direction) in that frame.
        The attributes hold every input, versions, settings, wall time and the verdict.
        Whether planar motion so large is stable, `periodic_orbits(...).stable` computes.

    Raises
    ------
    ValueError, TypeError
        If an input is refused.
    SimulationError
        If the solver fails, or the run does not pass the checks of `rotbeam_exu.runs.check`.
    KeyboardInterrupt
        On Ctrl-C, at the next step.

    Examples
    --------
    >>> from analytic import Beam, SpinUp
    >>> from rotbeam_exu import simulate
    >>> motion = SpinUp(omega=2.0, ramp_time=3.0)
    >>> run = simulate(Beam.reference(), motion, elements=4, duration=8.0, step=4e-3)
    >>> print(f"{run.q.min().item():.3f} m, {run.attrs['verdict']}")
    -2.200 m, passed
    """
    case = RunCase(
        blade=blade, spin_up=spin_up, element=element, elements=elements, duration=duration,
        step=step, frame=frame, loads=loads,
    )  # fmt: skip
    return run_case(case, initial_state=initial_state, stations=stations, progress=progress)


def run_case(
    case: RunCase,
    *,
    initial_state: Callable[[FloatArray], BladeState] | None = None,
    stations: ArrayLike = (),
    progress: Callable[[float], None] | None = None,
) -> xr.Dataset:
    """Return what `simulate` does, of a case."""
    warn_if_rpm(case.blade, case.spin_up.fastest)
    units, model = Units.of(case.blade, case.step), case.model
    kept = points_of_beam("stations", stations, case.blade.length)
    with exudyn_system() as mbs:
        built = add_rotating_beam(
            mbs, units.blade(case.blade), units.rotation(case.spin_up), element=model,
            elements=case.elements, frame=case.frame, loads=units.loads(case.loads),
        )  # fmt: skip
        sensors = Sensors(mbs, built.chain, built.clamp, kept.size > 0)
        if start := _start(case, units, built.chain.reference(mbs), initial_state):
            inertial = case.frame == "inertial"
            drive.set_state(
                mbs, built.chain, model, *start,
                angle=case.rotation.angle(0.0) if inertial else 0.0,
                rate=units.time * case.rotation.rate(0.0) if inertial else 0.0,
            )  # fmt: skip
        mbs.Assemble()
        step, every = case.step / units.time, case.steps_and_sampling[1]
        settings = built.solver_settings(
            duration=case.steps_and_sampling[0] * step, step=step, every=every
        )
        started = clock.perf_counter()
        cause = solve(mbs, settings, progress)
        wall_time = clock.perf_counter() - started
        trajectory = sensors.read()
    run = columns(case, units, built, trajectory, kept)
    run.attrs = {
        **case.describe(),
        "divergence_speed": model.divergence_speed(case.blade, case.elements),
        "settings": json.dumps(described(settings, case.frame, every)),
        "versions": json.dumps(versions()),
        "wall_time": wall_time,
    }
    return _checked(run, cause)


def _start(
    case: RunCase,
    units: Units,
    reference: FloatArray,
    initial_state: Callable[[FloatArray], BladeState] | None,
) -> tuple[FloatArray, FloatArray] | None:
    """Return coordinates and velocities in the frame of the clamp, unless it starts straight."""
    turning = case.ramp_time and getattr(case.spin_up, "start", 0.0)
    if initial_state is None and turning:
        require_planar(case.blade)
        initial_state = partial(stretched_state, case.blade, turning)
    if initial_state is None:
        return None
    if case.blade.line.kinks:
        raise ValueError(
            "initial_state is of a blade without kinks, for a node there has a section between "
            "those of both sides: leave it out, and the blade starts straight"
        )
    nodes = (len(reference) - 1) // case.elements + 1
    mesh = Mesh(blade=case.blade, elements=case.elements, nodes_of_element=nodes)
    state = initial_state(mesh.places)
    if not case.model.leaves_plane:
        state = state.seen_from(set_at(case.blade.setting_angle))
        for name in ("place", "velocity", "slope", "slope_rate"):
            apart = np.abs(getattr(state, name))
            if (largest := float(apart[:, 2].max())) > _ROUND_OFF * apart.max():
                raise ValueError(
                    f"element {case.model.name!r} stays in the plane of bending, out of which "
                    f"the {name} of initial_state is up to {largest:.3g}: take "
                    "element='space_exact'"
                )
    state, model = units.state(state), case.model
    blade = units.blade(case.blade)
    frame = model.line_frame(blade) if model.leaves_plane else np.eye(3)
    # The hub is in the plane of rotation, out of which the precone lifts the blade.
    state = state.seen_from(frame.T)
    state = replace(state, place=state.place + blade.unit.hub * np.eye(3)[0])
    at, moving = model.coordinates(state)
    arms = -model.arms(blade, case.elements)  # from the line to the nodes
    return model.line(arms, at), model.line(arms, at, moving)


def _checked(run: xr.Dataset, cause: BaseException | None) -> xr.Dataset:
    """Return the run with its verdict, or raise with the run attached."""
    try:
        run.attrs["verdict"] = check_run(run)
        if cause is not None:
            end = run.attrs["duration"]
            raise SimulationError(f"the solver gave up at its last step: {remedy(run, end)}")
    except SimulationError as error:
        run.attrs["verdict"] = str(error)
        error.part = run
        raise error from cause
    omega, divergence_speed = run.attrs["omega"], run.attrs["divergence_speed"]
    if omega > divergence_speed:
        warn(
            f"omega = {omega:g} rad/s is above the divergence speed, {divergence_speed:.6g} rad/s, "
            f"of {run.attrs['elements']} {run.attrs['element']!r} elements: their steady "
            "rotation is unstable, and what keeps the oscillation bounded is not the beam; take "
            "more elements"
        )
    return run


def kicked(
    blade: Blade,
    kick: float = 1e-6,
    planar: Callable[[FloatArray], BladeState] | None = None,
    *,
    by_mode: bool = False,
) -> Callable[[FloatArray], BladeState]:
    """Return the `initial_state` for `simulate` of a blade that is bent out of its plane.

    By an arc, w = kick L (x/L)² of small ones, at rest: its tangents are turned out of the plane by
    2 kick x/L. An arc is no mode: it has a share of each, so that whatever grows has something to
    grow from. It bends and does not stretch, which of a slender blade would take all its energy.

    Parameters
    ----------
    blade : Blade
    kick : float
        Deflection of the tip out of the plane over L.
    planar : callable, optional
        Planar state onto which the kick is put, as ``lambda x: backbone.state(i, x)``; the
        straight blade at rest by default.
    by_mode : bool
        Bend it by the first flap mode at rest, as `spin_up_response(bent=)` does. No other wave is
        excited, but elements that shear need small steps if the blade is very slender.

    Raises
    ------
    ValueError
        If the kick is more than a tenth of the length.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, Tube
    >>> from rotbeam_exu import kicked, simulate
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> tube = Beam.reference().with_shape(Tube())
    >>> settings = {"element": "space_exact", "elements": 4, "duration": 1.5, "step": 5e-3}
    >>> run = simulate(tube, motion, initial_state=kicked(tube, 1e-3), **settings)
    >>> print(f"q {run.q.min().item():.3f} m, w at most {abs(run.w).max().item():.4f} m")
    q -4.652 m, w at most 0.0080 m
    """
    require_planar(blade)
    require_bent("kick", kick)
    slope: Callable[[FloatArray], FloatArray] = lambda x: 2.0 * x / blade.length  # noqa: E731
    if by_mode:
        along = np.linspace(0.0, blade.length, _ALONG)
        mode = linear_modes(blade, 0.0, 1, only="flap").shapes(along)[2, :, 0].real
        slope = interpolate.CubicSpline(along, blade.length * mode).derivative()

    def state(x: FloatArray) -> BladeState:
        fine = np.linspace(0.0, blade.length, _BETWEEN * (x.size - 1) + 1)
        start = (planar or partial(stretched_state, blade, 0.0))(fine)
        tilt = kick * slope(fine)[:, None]
        c, s, normal = np.cos(tilt), np.sin(tilt), start.section[:, :, 2]
        # The change of the slope turns the tangent, and keeps its length.
        length = np.linalg.norm(start.slope, axis=1, keepdims=True)
        bent = c * start.slope + s * length * normal
        moved = integrate.cumulative_simpson(bent - start.slope, x=fine, initial=0.0, axis=0)
        first, second = start.section[:, :, 0], start.section[:, :, 1]
        section = np.stack((c * first + s * normal, second, c * normal - s * first), axis=2)
        whole = replace(start, place=start.place + moved, slope=bent, section=section)
        return BladeState(**{name: part[::_BETWEEN] for name, part in vars(whole).items()})

    return state
