"""Ways to write one blade: numbers, coefficients, stations, a table of columns or matrices, shapes.

Whatever a verb answers to one of them it answers to all: the same numbers, or the same sentence.
"""

from functools import cache

import numpy as np
import pytest

from analytic import (
    Blade,
    Damping,
    Gravity,
    Rectangle,
    Section,
    SpinUp,
    Theory,
    backbone,
    design_ramp,
    forced_response,
    linear_response,
    periodic_orbits,
    quiet_ramp_times,
    reduced_model,
    residual_amplitude,
    stability_limit,
)
from analytic.exact.free.planar_orbits import growth_rates
from analytic.section import OutOfPlane
from tests.analytic.exact import test_limits as limits
from tests.analytic.exact.test_limits import SPEED, require_same

PLACES = np.array([0.0, 0.5, 1.0])
BAR = Rectangle(height=0.08, width=0.06)
E, RHO = 12.0 / BAR.height**3 / BAR.width, 1.0 / BAR.height / BAR.width  # EI and m are 1


def columns(tip):
    """Stiffness and mass at three places of a bar whose material softens to a share at the tip."""
    share = 1.0 + (tip - 1.0) * PLACES
    return [np.outer(share, part) for part in BAR.of_material(E, RHO)]


def by_section(tip, profile):
    """The blade by profiles of what a Section takes, of values at three places."""
    S, M = columns(tip)
    out = OutOfPlane(bending_ratio=S[0, 4] / S[0, 5], torsion_ratio=S[0, 3] / S[0, 5])
    axial, bending, mass, turning = map(profile, (S[:, 0], S[:, 5], M[:, 0], M[:, 3]))
    section = Section(
        axial_stiffness=axial, bending_stiffness=bending, mass_per_length=mass,
        rotary_inertia=turning, out_of_plane=out,
    )  # fmt: skip
    return Blade(length=1.0, section=section)


def by_table(tip, places=(0, 1, 2), **more):
    S, M = (part[list(places)] for part in columns(tip))
    return Blade.from_stations(PLACES[list(places)], S, M, **more)


def by_matrices(tip, interpolation):
    table = by_table(tip).section
    return Blade.from_stations(table.x, table.stiffness, table.mass, interpolation=interpolation)


def by_shapes(tip):
    share = 1.0 + (tip - 1.0) * PLACES
    return Blade.from_shapes(PLACES, [BAR] * 3, E * share, RHO * share)


def stations(values):
    return tuple(zip(PLACES.tolist(), values.tolist(), strict=True))


WAYS = {
    "coefficients": lambda tip: by_section(tip, lambda v: (v[0], v[2] - v[0])),
    "stations": lambda tip: by_section(tip, stations),
    "table": by_table,
    "table of its ends": lambda tip: by_table(tip, (0, 2)),
    "matrices": lambda tip: by_matrices(tip, "components"),
    "matrices about the line": lambda tip: by_matrices(tip, "matrix"),
    "shapes": by_shapes,
    "turned and set back": lambda tip: by_table(tip, twist=0.3).with_setting_angle(-0.3),
}
TIPS = {"uniform": 1.0, "linear": 0.6}


def whole(blade):
    """The same with a hub and a mass at its tip."""
    return blade.with_hub_radius(0.1).with_tip_mass(0.05)


def reduced(blade, theory):
    found = [reduced_model(blade, SPEED, name).oscillator for name in ("FrM", "FrC")]
    return {"numbers": [(one.w_n, one.g1, one.g2) for one in found]}


def paper(blade, theory):
    return {"ω_n": reduced_model(blade, SPEED, "FrE").omega_n}


def residual(blade, theory):
    motion = SpinUp(omega=1.0, ramp_time=2.0)
    damped = blade.with_damping(Damping(bending=0.01))
    return {
        "left": residual_amplitude(damped, motion, [1.0, 2.0], corrected=True),
        "exact": residual_amplitude(damped, motion, exact=True, tolerance=1e-8),
    }


def quiet(blade, theory):
    found = quiet_ramp_times(blade, 1.0, longest=4.0, tolerance=1e-6)
    return {"linear": found.linear, "left": found.left, "times": found.ramp_times}


def design(blade, theory):
    found = design_ramp(blade, 1.0, 6.0)
    return {"cosines": found.cosines, "sines": found.sines}


def frame(blade, theory):
    found = linear_response(blade, SpinUp(omega=1.0, ramp_time=2.0), [1.0, 2.0], points=[0.5])
    return {"q": found.q, "axis": found.axis}


def growth(blade, theory):
    damped = blade.with_damping(Damping(bending=0.001))
    found = periodic_orbits(blade, SPEED, [0.2], theory=theory)
    space = found.out_of_plane(0.001, blade_damping=damped.damping)
    return {
        "names": found.covers, "stable": found.stable * 1.0, "multipliers": space.multipliers,
        "rates": growth_rates(damped, SPEED, np.array([0.05]), 0.01),
    }  # fmt: skip


def limit(blade, theory):
    found = stability_limit(blade, SPEED, theory=theory, largest=0.011)
    return {"type": str(found)}


def branch(blade, theory):
    found = backbone(blade, SPEED, theory=theory).branch(up_to=0.1)
    return {"type": type(found), "frequency": found.frequency[[0, -1]]}


def weight(blade, theory):
    damped = blade.with_damping(Damping(external=0.5))
    found = forced_response(damped, [0.5, 0.6], Gravity(0.1), theory=theory)
    return {"amplitude": found.amplitude[[0, -1]], "names": found.covers}


def blade_itself(blade, theory):
    names = "mass", "omega_0", "burst_speed", "slenderness", "frequencies_at_rest", "is_planar"
    found = {name: np.asarray(getattr(blade, name), dtype=float) for name in names}
    return found | {"frequencies_at_rest": found["frequencies_at_rest"][:12]}


CHEAP = (
    limits.modes, limits.damping, limits.state, limits.orbits, limits.curve,
    limits.loads_of_orbits, limits.path_of_orbits, reduced, paper, frame, weight, blade_itself,
)  # fmt: skip
DEAR = (
    limits.diagram, limits.response, limits.spin_up, residual, quiet, design, growth, limit, branch
)  # fmt: skip
WITHIN = {design: 1e-5}  # of which it leaves 1e-5 after exact transients; else 1e-8


@cache
def answer(verb, blade, theory):
    """What a verb says: its numbers, or its sentence where it refuses."""
    try:
        return verb(blade, theory)
    except ValueError as refusal:
        return {"type": str(refusal)}


def require_one_answer(verb, tip, ways):
    first, *others = (whole(WAYS[way](tip)) for way in ways)
    for other in others:
        require_same(
            lambda *one: answer(verb, *one), other, Theory(), WITHIN.get(verb, 1e-8), planar=first
        )


@pytest.mark.filterwarnings("ignore::analytic.RotbeamWarning")
@pytest.mark.parametrize("verb", CHEAP)
@pytest.mark.parametrize("tip", TIPS.values(), ids=TIPS)
def test_all_ways_have_one_answer(verb, tip):
    require_one_answer(verb, tip, WAYS)


@pytest.mark.filterwarnings("ignore::analytic.RotbeamWarning")
@pytest.mark.parametrize("verb", DEAR)
def test_a_table_has_the_answer_of_coefficients(verb):
    require_one_answer(verb, TIPS["linear"], ("coefficients", "table"))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::analytic.RotbeamWarning")
@pytest.mark.parametrize("verb", DEAR)
@pytest.mark.parametrize("tip", TIPS.values(), ids=TIPS)
def test_all_ways_have_one_answer_that_takes_time(verb, tip):
    require_one_answer(verb, tip, WAYS)


@pytest.mark.parametrize("softer", [True, False], ids=["all varies", "flap and torsion vary"])
def test_growth_where_flap_and_torsion_vary_otherwise_is_that_in_space(softer):
    """Multipliers of the Hill equation, far from 1, to what half a thousandth of a phase is.

    A twist of 1e-12 rad that varies leaves the plane: its orbits are in space.
    """
    along, mu = (1.0 - 0.4 * PLACES if softer else np.ones(3)), 1e-6
    flap, torsion = 0.1 + 0.1 * PLACES, 0.1 - 0.05 * PLACES
    ratios = np.stack([*(1.0 / mu * np.ones((3, 3))), torsion, flap, np.ones(3)], axis=1)
    turning = np.stack([np.ones(3) / mu, 1.0 + flap, flap, np.ones(3)], axis=1)
    S, M = along[:, None] * ratios, mu * along[:, None] * turning
    table = Blade.from_stations(PLACES, S, M)
    orbits = periodic_orbits(table, 2.0, [0.4])
    found = np.concatenate([orbits.multipliers[0], orbits.out_of_plane().multipliers[0]])
    space = periodic_orbits(
        table.with_twist(tuple(zip(PLACES, [0.0, 1e-12, 0.0], strict=True))), 2.0, [0.4]
    )
    assert orbits.stable[0] == space.stable[0] == False  # noqa: E712
    for one in space.multipliers[0]:
        nearest = found[np.argmin(np.abs(np.log(found / one)))]
        assert np.log(nearest) == pytest.approx(np.log(one), abs=5e-3)
