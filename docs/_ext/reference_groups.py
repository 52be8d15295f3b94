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
        "What turns: its lengths, sections, masses and damping.",
        analytic="Beam Blade Section PointMass Damping Rectangle Ellipse Circle Tube OutOfPlane "
        "AnyBlade Theory",
    ),
    _group(
        "Motion and loads",
        "How its clamp turns, and what acts on it.",
        analytic="SpinUp FourierRamp SpeedTable SteadyRotation Gravity TipForce DistributedForce "
        "SpeedRipple",
    ),
    _group(
        "Linear vibration",
        "Small vibration about steady rotation.",
        analytic="linear_modes LinearModes TorsionModes campbell Campbell Crossing damping_ratios "
        "unstretched_frequencies steady_state",
    ),
    _group(
        "Backbone",
        "Frequency against amplitude, exactly: orbit by orbit, as a series, beyond folds.",
        analytic="periodic_orbits Orbits BeamState AmplitudeNotReachedError backbone Backbone "
        "backbone_curve BackboneCurve BackboneBranch Resonance",
    ),
    _group(
        "Forced response",
        "Damped and driven, through the folds.",
        analytic="forced_response ForcedResponse SpecialPoint ResponseNotReachedError",
    ),
    _group(
        "Spin-up",
        "The transient, exactly and linear, what a ramp leaves, and ramps that leave nothing.",
        analytic="spin_up_response SpinUpResponse residual_amplitude "
        "quiet_ramp_times QuietRamps design_ramp linear_response LinearResponse",
    ),
    _group(
        "Out of the plane",
        "Whether motion in the plane of rotation stays there.",
        analytic="planar_stability PlanarStability stability_limit StabilityLimit Tongue",
    ),
    _group(
        "Reduced models",
        "The models of the paper, and those that repair them.",
        analytic="reduced_model ReducedModel VARIANTS Variant softening_speed "
        "divergence_speed paper_table",
    ),
    _group(
        "Exudyn",
        "The beam by finite elements: in the plane, in space, in a model of yours.",
        rotbeam_exu="simulate steady_oscillation SteadyOscillation natural_frequencies "
        "steady_stretch growth_rate divergence_speed simulate_3d flap_frequencies "
        "growth_rate_of GrowthRate ray_traced SimulationError",
        rotbeam_exu__fem="add_rotating_beam RotatingBeam",
        rotbeam_exu__fem__elements="Cable Exact Ancf3 Linear Substructures Formulation",
    ),
    _group(
        "Files and sweeps",
        "Runs, beams and grids of runs, kept and read again.",
        rotbeam_exu="dataset_of save load sweep",
        rotbeam_exu__sweeps__grid="failures",
        rotbeam_exu__files__beam_file="load_beam",
    ),
    _group(
        "Verification",
        "Judging another code, called from Python or read from files.",
        rotbeam_exu__verification__verify="verify",
        rotbeam_exu__verification__entries="formulation_entry",
        rotbeam_exu__verification__judgement="judged",
        rotbeam_exu__verification__submission_files="read_submission write_submission",
    ),
    _group(
        "Warnings", "What is legal, and probably not what was meant.", analytic="RotbeamWarning"
    ),
)

DATA = {
    "analytic.AnyBlade": "What theory and simulation take: a `Beam` or a `Blade`.",
    "analytic.VARIANTS": "The variants of the reduced model by name: CI, CE, FrI, FrE and, by "
    "polynomials, P3, P4 and P5 of the paper; FrC, FrM and FrM5, which are ours.",
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
