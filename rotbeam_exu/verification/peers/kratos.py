"""KratosMultiphysics: its co-rotational beam in the plane, with a prescribed clamp.

Another element, another integrator, other hands. CrBeamElement2D2N is a two-node linear beam in a
frame that rides on its chord; Newmark's trapezoidal rule (Bossak's scheme with α = 0) integrates
it, with a consistent mass matrix.
"""

from __future__ import annotations

import math
import os
import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from analytic import AnyBlade, Beam, SpinUp
from analytic.arrays import FloatArray
from analytic.input_checks import positive, whole_number
from analytic.warning import warn

from ...lazily import xr
from ...resolution import require_resolved_ramp, sampling
from ...verdict import SimulationError, beam_attributes, motion_attributes


def simulate(
    beam: AnyBlade,
    spin_up: SpinUp,
    *,
    elements: int = 32,
    duration: float = 15.0,
    step: float = 5e-4,
    tolerance: float = 1e-7,
    iterations: int = 20,
    progress: Callable[[float], None] | None = None,
) -> xr.Dataset:
    """Spin the beam up in Kratos.

    Parameters
    ----------
    beam, spin_up, elements, duration, step, progress
        As for `rotbeam_exu.simulate`.
    tolerance : float
        Newton's tolerance, of the residual over the first one of the step and of its root mean
        square over EI/L². At 1e-6, as Exudyn's here, what it leaves hides the order of small steps;
        round-off of the axial force EA leaves about 1e-8 N.
    iterations : int
        Newton iterations after which Kratos takes the step as it is and goes on.

    Returns
    -------
    Dataset
        q [m] and q_dot [m/s] (Eq. 16) over `time` [s]. The attributes hold the inputs, wall time,
        and how many steps did not converge.

    Raises
    ------
    SimulationError
        If a number is not finite, or the tip leaves the reach of the beam.

    Warns
    -----
    RotbeamWarning
        If steps did not converge.
    """
    straight = beam.uniform
    if straight is None:
        raise SimulationError("the adapter to Kratos takes the uniform Beam, not a Blade")
    elements, step = whole_number("elements", elements), positive("step", step, "s")
    require_resolved_ramp(spin_up.ramp_time, step)
    steps = round(positive("duration", duration, "s") / step)
    every = sampling(beam, spin_up.omega, steps, step)
    strategy, part, kratos, _model = _assembled(straight, elements, tolerance, iterations)
    root, tip = part.Nodes[1], part.Nodes[elements + 1]
    time: FloatArray = step * np.arange(0.0, steps + 1.0, every)
    q, q_dot = np.zeros(time.size), np.zeros(time.size)
    unconverged, newton, started = 0, 0, clock.perf_counter()
    for k in range(1, steps + 1):
        t = k * step
        part.CloneTimeStep(t)
        part.ProcessInfo[kratos.STEP] = k
        unconverged += not _turned_to(spin_up.angle(t), root, strategy, kratos)
        newton += part.ProcessInfo[kratos.NL_ITERATION_NUMBER]
        if k % every:
            continue
        u = tip.GetSolutionStepValue(kratos.DISPLACEMENT)
        v = tip.GetSolutionStepValue(kratos.VELOCITY)
        x, y = beam.length + u[0], u[1]
        q[k // every], q_dot[k // every] = _from_the_clamp((x, y), (v[0], v[1]), spin_up, t)
        if not math.hypot(x, y) < 1.05 * beam.length:
            raise SimulationError(
                f"the tip's distance from the clamp is {math.hypot(x, y):.4g} m at t = {t:.6g} s, "
                f"beyond the beam's {beam.length:g} m: take a smaller step than {step:g} s"
            )
        if progress:
            progress(k / steps)
    wall_time = clock.perf_counter() - started
    verdict = f"{unconverged} of {steps} steps did not converge to {tolerance:g}"
    if unconverged:
        warn(f"{verdict}; Kratos went on all the same")
    run = _dataset(time, q, q_dot)
    run.attrs = {
        **beam_attributes(beam),
        "omega": spin_up.omega,
        "ramp_time": spin_up.ramp_time,
        **motion_attributes(spin_up),
        "element": "kratos",
        "elements": elements,
        "duration": duration,
        "step": step,
        "tolerance": tolerance,
        "iterations_per_step": newton / steps,
        "unconverged_steps": unconverged,
        "wall_time": wall_time,
        "verdict": verdict if unconverged else "passed",
    }
    return run


def _dataset(time: FloatArray, q: FloatArray, q_dot: FloatArray) -> xr.Dataset:
    return xr.Dataset(
        {
            "q": ("time", q, {"units": "m", "long_name": "tip displacement q"}),
            "q_dot": ("time", q_dot, {"units": "m/s", "long_name": "tip velocity dq/dt"}),
        },
        coords={"time": ("time", time, {"units": "s", "long_name": "time"})},
    )


def _turned_to(angle: float, root: Any, strategy: Any, kratos: Any) -> bool:
    """Solve for the step at whose end the clamp stands at `angle`; say whether it converged."""
    strategy.InitializeSolutionStep()
    strategy.Predict()
    root.SetSolutionStepValue(kratos.ROTATION_Z, angle)
    converged = bool(strategy.SolveSolutionStep())
    strategy.FinalizeSolutionStep()
    return converged


def _from_the_clamp(
    position: tuple[float, float], velocity: tuple[float, float], spin_up: SpinUp, t: float
) -> tuple[float, float]:
    """Return q and q̇ of Eq. 16 from the tip's position and velocity in the inertial frame."""
    (x, y), (u, v), angle = position, velocity, spin_up.angle(t)
    sine, cosine = math.sin(angle), math.cos(angle)
    return (
        cosine * y - sine * x,
        cosine * v - sine * u - spin_up.rate(t) * (cosine * x + sine * y),
    )


def _assembled(beam: Beam, elements: int, tolerance: float, iterations: int) -> tuple[Any, ...]:
    """Return the solver's strategy, the model part, the module, and the model, which owns all."""
    with _quiet():
        import KratosMultiphysics as kratos  # noqa: N813, PLC0415
        from KratosMultiphysics import StructuralMechanicsApplication  # noqa: PLC0415

        kratos.Logger.GetDefaultOutput().SetSeverity(kratos.Logger.Severity.WARNING)
    model = kratos.Model()
    part = model.CreateModelPart("beam")
    part.SetBufferSize(2)
    part.ProcessInfo[kratos.DOMAIN_SIZE] = 2
    for name in (
        "DISPLACEMENT", "REACTION", "ROTATION", "REACTION_MOMENT", "VELOCITY", "ACCELERATION",
        "ANGULAR_VELOCITY", "ANGULAR_ACCELERATION", "VOLUME_ACCELERATION",
    ):  # fmt: skip
        part.AddNodalSolutionStepVariable(getattr(kratos, name))
    section = part.GetProperties()[0]
    section[kratos.YOUNG_MODULUS] = beam.youngs_modulus
    section[kratos.POISSON_RATIO] = 0.3
    section[kratos.DENSITY] = beam.density
    section[StructuralMechanicsApplication.CROSS_AREA] = beam.area
    section[StructuralMechanicsApplication.I33] = beam.second_moment
    section[kratos.COMPUTE_LUMPED_MASS_MATRIX] = False
    section[kratos.CONSTITUTIVE_LAW] = StructuralMechanicsApplication.BeamConstitutiveLaw()
    for i in range(elements + 1):
        part.CreateNewNode(i + 1, beam.length * i / elements, 0.0, 0.0)
    unknowns = ("DISPLACEMENT_X", "DISPLACEMENT_Y", "ROTATION_Z")
    reactions = ("REACTION_X", "REACTION_Y", "REACTION_MOMENT_Z")
    for unknown, reaction in zip(unknowns, reactions, strict=True):
        dof = getattr(kratos, unknown)
        kratos.VariableUtils().AddDof(dof, getattr(kratos, reaction), part)
        part.Nodes[1].Fix(dof)
    for i in range(elements):
        part.CreateNewElement("CrBeamElement2D2N", i + 1, [i + 1, i + 2], section)
    scale = beam.bending_stiffness / beam.length**2
    criterion = kratos.ResidualCriteria(tolerance, tolerance * scale)
    criterion.SetEchoLevel(0)
    strategy = kratos.ResidualBasedNewtonRaphsonStrategy(
        part,
        kratos.ResidualBasedBossakDisplacementScheme(0.0),
        criterion,
        kratos.ResidualBasedBlockBuilderAndSolver(kratos.SkylineLUFactorizationSolver()),
        iterations,
        False,  # reactions
        False,  # new degrees of freedom in each step
        True,  # move the mesh
    )
    strategy.SetEchoLevel(0)
    strategy.Initialize()
    return strategy, part, kratos, model


@contextmanager
def _quiet() -> Iterator[None]:
    """Send what C++ writes to the standard output, a banner, nowhere."""
    sys.stdout.flush()
    kept = os.dup(1)
    with open(os.devnull, "wb") as nowhere:  # noqa: PTH123
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
