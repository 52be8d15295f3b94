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
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import util
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from analytic import Beam
from analytic.arrays import FloatArray
from analytic.input_checks import positive, whole_number
from analytic.motion import Rotation
from analytic.warning import warn

from ...lazily import xr
from ...runs.attributes import beam_attributes, motion_attributes
from ...runs.check import SimulationError
from ...runs.resolution import require_resolved_ramp, sampling
from ..cases import Case
from ..verify import Entry


@dataclass(frozen=True, kw_only=True)
class Kratos:
    """The co-rotational beam of KratosMultiphysics, as a `Code` of spin-ups of the uniform beam.

    Parameters
    ----------
    tolerance : float
        Newton's tolerance, of the residual over the first one of the step and of its root mean
        square over EI/L². At 1e-6, as Exudyn's here, the remaining error hides the order of small
        steps; round-off of the axial force EA leaves about 1e-8 N.
    iterations : int
        Newton iterations after which Kratos takes the step as it is and goes on.
    """

    tolerance: float = 1e-7
    iterations: int = 20

    name: ClassVar[str] = "kratos"
    package: ClassVar[str] = "KratosMultiphysics with its StructuralMechanicsApplication"

    def is_installed(self) -> bool:
        """Say whether the package is at hand, without importing it: it would print a banner."""
        found = util.find_spec("KratosMultiphysics")
        return found is not None and any(
            (Path(place) / "StructuralMechanicsApplication").is_dir()
            for place in found.submodule_search_locations or ()
        )

    def entry(self) -> Entry:
        """Return the code with its mesh and step."""
        return Entry(name=self.name, simulate=self, elements=32, step=5e-4, order=2.0)

    def __call__(self, case: Case, *, elements: int = 32, step: float = 5e-4) -> xr.Dataset:
        """Spin the beam up, as `Code` does; RotbeamWarning if steps did not converge.

        The attributes hold the inputs, wall time, and how many steps did not converge.
        SimulationError if the blade is no uniform beam, or if the tip leaves its reach.
        """
        beam, spin_up = case.blade.uniform, case.rotation
        if case.loads or not case.is_spun_up:
            raise NotImplementedError("the adapter to Kratos takes spin-ups without loads")
        if beam is None:
            raise SimulationError("the adapter to Kratos takes the uniform Beam, not a Blade")
        elements, step = whole_number("elements", elements), positive("step", step, "s")
        require_resolved_ramp(case.ramp_time, step)
        duration = case.whole_duration(step)
        steps = round(positive("duration", duration, "s") / step)
        every = sampling(beam, spin_up.omega, steps, step)
        strategy, part, kratos, _model = _assembled(beam, elements, self.tolerance, self.iterations)
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
                    f"the tip's distance from the clamp is {math.hypot(x, y):.4g} m at "
                    f"t = {t:.6g} s, beyond the beam's {beam.length:g} m: take a smaller step than "
                    f"{step:g} s"
                )
        verdict = f"{unconverged} of {steps} steps did not converge to {self.tolerance:g}"
        if unconverged:
            warn(f"{verdict}; Kratos went on all the same")
        attrs = {
            **beam_attributes(beam),
            "omega": spin_up.omega,
            "ramp_time": case.ramp_time,
            **motion_attributes(spin_up),
            "element": self.name,
            "elements": elements,
            "duration": duration,
            "step": step,
            "tolerance": self.tolerance,
            "iterations_per_step": newton / steps,
            "unconverged_steps": unconverged,
            "wall_time": clock.perf_counter() - started,
            "verdict": verdict if unconverged else "passed",
        }
        columns = {"q": ("time", q), "q_dot": ("time", q_dot)}
        return xr.Dataset(columns, {"time": ("time", time)}, attrs)


def _turned_to(angle: float, root: Any, strategy: Any, kratos: Any) -> bool:
    """Solve for the step at whose end the clamp stands at `angle`; say whether it converged."""
    strategy.InitializeSolutionStep()
    strategy.Predict()
    root.SetSolutionStepValue(kratos.ROTATION_Z, angle)
    converged = bool(strategy.SolveSolutionStep())
    strategy.FinalizeSolutionStep()
    return converged


def _from_the_clamp(
    position: tuple[float, float], velocity: tuple[float, float], spin_up: Rotation, t: float
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
