"""Refusals of blades, and of rotation speeds, for which an answer is not known."""

from __future__ import annotations

import math

from .blade import Blade
from .input_checks import shown
from .parts import UNDAMPED
from .theory import BERNOULLI_EULER, Theory, require_theory
from .warning import warn

_RPM_SUSPECT = 10.0
"""Rotation speeds above this many ω0 are taken for a slip in units; the benchmark ends near 4."""


def require_blade(blade: object) -> None:
    """Refuse a value that is neither a Beam nor a Blade."""
    if not isinstance(blade, Blade):
        raise TypeError(f"a Beam or a Blade is needed, got {shown(blade)}: as Beam.reference()")


def require_planar(
    blade: Blade,
    what: str = "this answer is of",
    remedy: str = "linear_modes, steady_state, periodic_orbits, forced_response or "
    "spin_up_response, which have it in space",
) -> None:
    """Refuse a blade whose motion leaves the plane of bending at once."""
    require_blade(blade)
    if not blade.is_planar:
        raise ValueError(
            f"{what} a straight blade in its plane, and this one has {_beyond(blade)}: "
            f"take {remedy}"
        )


def _beyond(blade: Blade) -> str:
    """Return what of a blade leaves the plane, in words."""
    if not blade.section.is_planar:
        return "stations that couple motion in the plane with other motion"
    return "a twist that varies, precone, prebend, sweep, kink or offset"


def require_out_of_plane(
    blade: Blade, theory: Theory = BERNOULLI_EULER, *, torsion: bool = True
) -> Blade:
    """Return the blade, refusing one whose section has no stiffness out of its plane.

    Its torsion is rigid where it is unknown and decides nothing.
    """
    require_planar(blade)
    section = blade.section
    if require_theory(theory).shear is not None:
        raise ValueError(
            "how slices shear out of the plane is left out of what grows there: take a theory "
            "without shear"
        )
    if section.needs_space(theory):
        raise ValueError(
            "stations that couple flap and torsion leave no plane to grow out of: take `stable` of "
            "periodic_orbits, which are in space"
        )
    ratios = section.out_of_plane
    if ratios is None and not section.knows_space:
        raise ValueError(
            "how this blade bends and twists out of its plane is unknown: give its section by "
            "blade.with_shape(Rectangle(height=..., width=...)) or "
            "blade.with_section_out_of_plane(bending_ratio, torsion_ratio)"
        )
    if blade.unit.setting != 1.0:
        raise ValueError(
            f"motion out of the plane is known for a blade that bends in the plane of rotation, "
            f"and this one is set at {blade.unit.angle:g} rad: take "
            f"blade.with_setting_angle({blade.setting_angle - blade.unit.angle})"
        )
    if torsion and ratios and ratios.torsion_ratio is None and ratios.bending_ratio != 1.0:
        raise ValueError(
            f"with a bending_ratio of {ratios.bending_ratio:g} the torsional stiffness decides "
            "whether the plane is stable, and it is unknown: give torsion_ratio, math.inf for a "
            "section that does not twist"
        )
    stays = ratios and (ratios.torsion_ratio == math.inf or ratios.bending_ratio == 1.0)
    if torsion and not stays and not section.turns_with_inertia:
        raise ValueError(
            "motion out of the plane is not known for a twist without inertia: give the "
            "section a rotary_inertia above zero, or leave it out for a homogeneous one"
        )
    return with_torsion(blade)


def with_torsion(blade: Blade) -> Blade:
    """Return the blade with its torsion rigid where a section that flaps leaves it unknown."""
    out = blade.section.out_of_plane
    if out is None or out.torsion_ratio is not None:
        return blade
    return blade.with_section_out_of_plane(out.bending_ratio, math.inf)


def undamped(blade: Blade) -> Blade:
    """Return the same without damping."""
    return blade.with_damping(UNDAMPED) if blade.damping else blade


def require_undamped(blade: Blade, what: str) -> None:
    """Refuse a damped blade where `what` has no damping."""
    require_blade(blade)
    if blade.damping:
        raise ValueError(
            f"{what}: take forced_response for the damped blade, or blade.with_damping(Damping()), "
            "which has none"
        )


def require_steady_state(blade: Blade, omega: float) -> None:
    """Refuse a rotation speed `omega` [rad/s] at which no stretched state exists."""
    if omega >= blade.burst_speed:
        raise ValueError(
            f"omega = {omega:g} rad/s leaves no steady state: this beam is stretched without "
            f"bound at {blade.burst_speed:.6g} rad/s; rotate slower or raise the axial stiffness "
            f"(EA = {blade.axial_stiffness:g} N)"
        )


def warn_if_rpm(blade: Blade, omega: float) -> None:
    """Warn where a rotation speed `omega` [rad/s] is so high that it may be meant in rpm."""
    require_blade(blade)
    ratio = omega / blade.omega_0
    if ratio > _RPM_SUSPECT:
        warn(
            f"omega = {omega:g} rad/s is {ratio:.0f} times the first natural frequency "
            f"({blade.omega_0:.3f} rad/s): rpm? {omega:g} rpm are {omega * math.pi / 30:.4g} rad/s"
        )
