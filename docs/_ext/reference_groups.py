"""What the reference has a page on, grouped as the user works; a name is as it is imported."""

from __future__ import annotations

import pkgutil
from collections.abc import Iterator
from typing import NamedTuple


class Group(NamedTuple):
    """A group of the reference: its title, what it is for, and its names."""

    title: str
    purpose: str
    names: tuple[str, ...]


def _group(title: str, purpose: str, **names: str) -> Group:
    """Return a group; `names` by their module, a dot in which is written __."""
    found = ((m.replace("__", "."), n) for m, text in names.items() for n in text.split())
    return Group(title, purpose, tuple(f"{module}.{name}" for module, name in found))


GROUPS = (
    _group(
        "Beam and blade",
        "The rotating body: its lengths, sections, masses and damping.",
        analytic="Beam Blade Section PointMass Damping Rectangle Ellipse Tube Theory",
        analytic__section="OutOfPlane",
    ),
    _group(
        "Motion and loads",
        "The motion of the clamp, and the loads.",
        analytic="SpinUp FourierRamp SpeedTable SteadyRotation Gravity TipForce DistributedForce "
        "PointLoad LoadTable SpeedRipple",
    ),
    _group(
        "Linear vibration",
        "Small vibration about steady rotation.",
        analytic="linear_modes campbell damping_ratios steady_state state_space",
        analytic__exact__linear__damping="modal_damping",
        analytic__sensitivity="sensitivity Sensitivity parameters_of Parameter spread Spread "
        "campbell_spread sampled fit Fit Measured MeasuredFrequency MeasuredState "
        "MeasuredMotion",
        analytic__exact__linear__modes="LinearModes",
        analytic__exact__linear__campbell="Campbell Crossing",
    ),
    _group(
        "Backbone",
        "Exact frequency over amplitude: single orbits, a series, branches beyond folds.",
        analytic="periodic_orbits AmplitudeNotReachedError backbone backbone_curve",
        analytic__exact__free__orbits="Orbits",
        analytic__exact__free__backbone="Backbone",
        analytic__exact__continuum__state="BladeState",
        analytic__exact__free__curve="BackboneCurve",
        analytic__exact__free__branches="BackboneBranch",
        analytic__exact__free__leaving="LeavingBranch",
        analytic__exact__free__branch="SpecialPoint",
        analytic__exact__free__internal_resonance="Resonance",
    ),
    _group(
        "Forced response",
        "The response of damped blades to loads, through folds.",
        analytic="forced_response ResponseNotReachedError",
        analytic__exact__driven__forced_orbits="ForcedResponse",
    ),
    _group(
        "Spin-up",
        "The transient, exact and linear; the residual vibration, and ramps that avoid it.",
        analytic="spin_up_response residual_amplitude quiet_ramp_times design_ramp linear_response",
        analytic__exact__driven__response="SpinUpResponse",
        analytic__exact__continuum__state="SectionLoads",
        analytic__spin_up__quiet="QuietRamps",
        analytic__reduced__linear_frame="LinearResponse",
    ),
    _group(
        "Out of the plane",
        "Whether motion in the plane of rotation stays there.",
        analytic="stability_limit",
        analytic__exact__stability__growth="GrowthOutOfPlane",
        analytic__exact__free__stability_limit="StabilityLimit Tongue",
    ),
    _group(
        "Reduced models",
        "The models of the paper, and improved ones.",
        analytic="reduced_model VARIANTS Variant paper_table",
        analytic__reduced__model="ReducedModel",
        analytic__reduced__model_range="softening_speed",
    ),
    _group(
        "Exudyn",
        "The beam by finite elements: in the plane, in space, in a model of yours.",
        rotbeam_exu="simulate steady_oscillation natural_frequencies kicked SimulationError",
        rotbeam_exu__runs__oscillation="SteadyOscillation",
        rotbeam_exu__fem__linearization="Linearization",
        rotbeam_exu__fem="add_rotating_beam RotatingBeam",
        rotbeam_exu__fem__elements=(
            "Cable Exact Ancf3 Linear Substructures SpaceExact SpaceCable Formulation"
        ),
    ),
    _group(
        "Files and sweeps",
        "Saving and loading of runs, beams and grids of runs.",
        rotbeam_exu="dataset_of save load sweep",
        rotbeam_exu__sweeps__grid="failures",
        rotbeam_exu__files__beam_file="load_beam",
        rotbeam_exu__runs__shape="shape_of vibration_of",
        rotbeam_exu__files__vtk="save_vtk",
    ),
    _group(
        "Verification",
        "Judging another code, called from Python or read from files.",
        rotbeam_exu__verification__verify="verify",
        rotbeam_exu__verification__entries="formulation_entry",
        rotbeam_exu__verification__judgement="judged",
        rotbeam_exu__verification__program="Program",
        rotbeam_exu__verification__refining="Record until_decided",
        rotbeam_exu__verification__submission_files="read_submission write_submission",
    ),
    _group("Warnings", "Valid input that is probably not intended.", analytic="RotbeamWarning"),
)

DATA = {
    "analytic.VARIANTS": "The variants of the reduced model by name: CI, CE, FrI, FrE and, by "
    "polynomials, P3, P4 and P5 of the paper; FrC, FrM and FrM5 of this package.",
}
"""What names say that have no docstring of their own."""


def public_names() -> Iterator[str]:
    """Yield every name of the groups, as it is imported."""
    for group in GROUPS:
        yield from group.names


def page_of(name: str) -> str:
    """Return the name of a page; no two differ by case alone, which not every disk tells apart."""
    folded = [other.casefold() for other in public_names()]
    is_class = name.rpartition(".")[2][0].isupper()
    return name + "-class" * (is_class and folded.count(name.casefold()) > 1)


def role_of(name: str) -> str:
    """Return the role by which a page links to a name."""
    value = pkgutil.resolve_name(name)
    if not isinstance(value, type):
        return "func" if callable(value) else "data"
    return "exc" if issubclass(value, Exception) else "class"
