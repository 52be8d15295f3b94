"""Kratos: the corotational beam of its structural mechanics, its clamp led by an angle."""

import sys
from importlib.metadata import version
from pathlib import Path

import KratosMultiphysics as kratos  # noqa: N813
from KratosMultiphysics import StructuralMechanicsApplication as structural  # noqa: N813

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, take_part

from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.submission import Declaration

TOLERANCE, ITERATIONS = 1e-7, 20
"""Newton's tolerance of the residual, over the first one and over EI/L²: at 1e-6 what is left hides
the order of small steps, and round-off of EA leaves 1e-8 N. After 20 iterations Kratos goes on."""

UNKNOWNS = {
    "DISPLACEMENT_X": "REACTION_X", "DISPLACEMENT_Y": "REACTION_Y",
    "ROTATION_Z": "REACTION_MOMENT_Z",
}  # fmt: skip


def build(case: Case, n: int):
    """Lay n elements along the beam, with consistent mass, and return solver, part and model."""
    beam, model = case.blade, kratos.Model()
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
    section[structural.CROSS_AREA] = beam.area
    section[structural.I33] = beam.second_moment
    section[kratos.COMPUTE_LUMPED_MASS_MATRIX] = False
    section[kratos.CONSTITUTIVE_LAW] = structural.BeamConstitutiveLaw()
    for i in range(n + 1):
        part.CreateNewNode(i + 1, beam.length * i / n, 0.0, 0.0)
    for unknown, reaction in UNKNOWNS.items():
        dof = getattr(kratos, unknown)
        kratos.VariableUtils().AddDof(dof, getattr(kratos, reaction), part)
        part.Nodes[1].Fix(dof)
    for i in range(n):
        part.CreateNewElement("CrBeamElement2D2N", i + 1, [i + 1, i + 2], section)
    scale = beam.bending_stiffness / beam.length**2
    criterion = kratos.ResidualCriteria(TOLERANCE, TOLERANCE * scale)
    solver = kratos.ResidualBasedNewtonRaphsonStrategy(
        part,
        kratos.ResidualBasedBossakDisplacementScheme(0.0),
        criterion,
        kratos.ResidualBasedBlockBuilderAndSolver(kratos.SkylineLUFactorizationSolver()),
        ITERATIONS,
        False,  # reactions
        False,  # new degrees of freedom in each step
        True,  # move the mesh
    )
    for one in (criterion, solver):
        one.SetEchoLevel(0)
    solver.Initialize()
    return solver, part, model  # which owns the part


def history(case: Case, n: int, h: float):
    """Lead the clamp by its angle at each step."""
    kratos.Logger.GetDefaultOutput().SetSeverity(kratos.Logger.Severity.WARNING)
    solver, part, _model = build(case, n)
    every, tip = round(SPACING / h), [complex(case.blade.length)]
    for k in range(1, round(case.duration / SPACING) * every + 1):
        part.CloneTimeStep(k * h)
        part.ProcessInfo[kratos.STEP] = k
        solver.InitializeSolutionStep()
        solver.Predict()
        part.Nodes[1].SetSolutionStepValue(kratos.ROTATION_Z, float(case.rotation.angle(k * h)))
        solver.SolveSolutionStep()
        solver.FinalizeSolutionStep()
        if k % every == 0:
            u = part.Nodes[n + 1].GetSolutionStepValue(kratos.DISPLACEMENT)
            tip.append(complex(case.blade.length + u[0], u[1]))
    return across(case, tip)


if __name__ == "__main__":
    told = Declaration(
        code="Kratos", version=version("KratosMultiphysics"), licence="BSD-4-Clause",
        url="https://github.com/KratosMultiphysics/Kratos", order=2.0, order_in_step=2.0,
        element="CrBeamElement2D2N, corotational; Bossak's scheme, alpha = 0",
    )  # fmt: skip
    runs = [(16, 1e-3), (32, 1e-3), (64, 1e-3), (32, 2e-3), (32, 5e-4)]
    take_part(__file__, told, history, {"S1": runs})
