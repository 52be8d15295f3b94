"""Ways to write nearly the same blade: every verb's result has the same type, shapes and numbers.

Almost no twist, precone, prebend, sweep, offset or setting angle; a table of equal stations; an
angle as a setting or a twist. The slenderness is 1e-3: any inertia of the sections is seen.
"""

import numpy as np
import pytest

from analytic import (
    Beam,
    Blade,
    Damping,
    Rectangle,
    SpinUp,
    Theory,
    TipForce,
    backbone,
    backbone_curve,
    campbell,
    damping_ratios,
    forced_response,
    linear_modes,
    periodic_orbits,
    spin_up_response,
    steady_state,
)
from tests.beams import unit_beam

SMALL = 1e-12  # of which some shapes have a thousand times as much
R, G, MU, SPEED = 0.3, 0.2, 1e-3, 1.5
PLANAR = unit_beam(MU).with_section_out_of_plane(R, G)
X, PHASES = [0.0, 0.4, 1.0], [0.5, 2.0]
INERT = Theory(rotary_inertia=True)


def stations():
    """The same blade by a table, which tells the inertia of the sections."""
    stiffness = [1.0 / MU, 1.0 / MU, 1.0 / MU, G, R, 1.0]
    mass = [1.0, (1.0 + R) * MU, R * MU, MU]
    return Blade.from_stations([0.0, 0.5, 1.0], [stiffness] * 3, [mass] * 3)


LIMITS = {
    "twist": PLANAR.with_twist(SMALL),
    "setting": PLANAR.with_setting_angle(SMALL),
    "precone": PLANAR.with_precone(SMALL),
    "prebend": PLANAR.with_prebend(SMALL),
    "sweep": PLANAR.with_sweep(SMALL),
    "mass offset": PLANAR.with_offsets(mass=(SMALL, SMALL)),
    "tension offset": PLANAR.with_offsets(tension=(SMALL, SMALL)),
    "stations": stations(),
}


def modes(blade, theory):
    found = linear_modes(blade, SPEED, 8, theory=theory)
    return {
        "type": type(found), "names": found.names, "frequencies": found.frequencies,
        "shares": found.shares, "shapes": np.abs(found.shapes(X)),
    }  # fmt: skip


def diagram(blade, theory):
    found = campbell(blade, [0.0, SPEED], 4, 1, theory=theory)
    return {"type": type(found), "names": found.names, "frequencies": found.frequencies}


def damping(blade, theory):
    damped = blade.with_damping(Damping(bending=0.01, external=0.05))
    return {"ratios": damping_ratios(damped, SPEED, 4, theory=theory)}


def state(blade, theory):
    found = steady_state(blade, SPEED, theory=theory)
    loads = found.section_loads(X)
    return {
        "type": type(found), "tip": found.tip, "axis": found.axis(X), "twist": found.twist,
        "force": loads.force, "moment": loads.moment,
    }  # fmt: skip


def followed(blade, theory):
    return periodic_orbits(blade, SPEED, [0.05, 0.1], theory=theory)


def orbits(blade, theory):
    found = followed(blade, theory)
    names = "amplitude", "frequency", "omega_n", "harmonics", "lambda_omega", "lag", "flap", "twist"
    return {name: getattr(found, name) for name in names} | {
        "type": type(found), "tip": found.tip(1, PHASES), "axis": found.axis(1, X, PHASES),
    }  # fmt: skip


def stability(blade, theory):
    found = periodic_orbits(blade, 4.0, [0.02, 0.08], theory=theory)
    return {"stable": found.stable.astype(float)}


def loads_of_orbits(blade, theory):
    loads = followed(blade, theory).section_loads(1, X, PHASES)
    return {"type": type(loads), "force": loads.force, "moment": loads.moment}


def states_of_orbits(blade, theory):
    state = followed(blade, theory).state(1, X, 1.0)
    return {"type": type(state)} | vars(state)


def curve(blade, theory):
    found = backbone_curve(blade, SPEED, up_to=0.1, theory=theory)
    return {
        "type": type(found), "frequency": found.frequency([0.03, 0.1]),
        "harmonic": found.first_harmonic([0.1]),
    }  # fmt: skip


def branch(blade, theory):
    found = backbone(blade, SPEED, theory=theory).branch(up_to=0.1)
    return {"type": type(found), "frequency": found.frequency[[0, -1]]}


def path_of_orbits(blade, theory):
    of = backbone(blade, SPEED, theory=theory)
    return {"type": type(of), "names": (of.mode, of.name), "omega_n": of.omega_n}


def response(blade, theory):
    blade = blade.with_damping(Damping(external=0.2))
    found = forced_response(
        blade, SPEED, TipForce(amplitude=0.02), [3.5, 3.6], gauge="lag", theory=theory
    )
    ends = [0, -1]  # the curve chooses its points between them
    return {
        "type": type(found), "frequency": found.frequency[ends],
        "amplitude": found.amplitude[ends], "phase": found.phase[ends],
        "tip": found.tip(0, PHASES),
    }  # fmt: skip


def spin_up(blade, theory):
    found = spin_up_response(
        blade, SpinUp(omega=1.0, ramp_time=2.0), [1.0, 2.0], tolerance=1e-8, theory=theory,
        points=X,
    )  # fmt: skip
    names = "q", "tip", "axis", "lag", "flap"
    return {"type": type(found)} | {name: getattr(found, name) for name in names}


def require_same(verb, blade, theory, within, *, planar=PLANAR, of_planar=None):
    """Compare two results entry by entry, each on the scale of its largest value and of 1."""
    known, found = verb(planar, of_planar or theory), verb(blade, theory)
    for name, value in known.items():
        if name in ("type", "names"):
            assert found[name] == value
            continue
        one, other = np.asarray(value), np.asarray(found[name])
        assert one.shape == other.shape, name
        scale = max(1.0, float(np.abs(one).max()))
        assert other == pytest.approx(one, abs=within * scale), name


THEORIES = {
    "as it is": Theory(), "no trapeze": Theory(trapeze=False), "rotary inertia": INERT,
    "rigid axis": Theory(extension=False), "shear": Theory(shear=0.3),
}  # fmt: skip


@pytest.mark.parametrize("theory", THEORIES.values(), ids=THEORIES)
@pytest.mark.parametrize("verb", [modes, damping, state])
def test_a_blade_that_is_hardly_twisted_is_the_planar_blade(verb, theory):
    require_same(verb, LIMITS["twist"], theory, 1e-8)


@pytest.mark.parametrize("limit", LIMITS)
@pytest.mark.parametrize("verb", [modes, damping, state])
def test_all_limits_are_the_planar_blade(verb, limit):
    """A table tells the inertia of its sections, which the others have by the theory."""
    of_planar = INERT if limit == "stations" else None
    require_same(verb, LIMITS[limit], Theory(), 1e-8, of_planar=of_planar)


@pytest.mark.parametrize("limit", LIMITS)
@pytest.mark.parametrize("verb", [orbits, curve])
def test_orbits_in_all_limits_are_those_of_the_planar_blade(verb, limit):
    """λ_ω, extrapolated from them, is known to 4e-9 of its own."""
    of_planar = INERT if limit == "stations" else None
    require_same(verb, LIMITS[limit], Theory(), 1e-7, of_planar=of_planar)


@pytest.mark.parametrize(
    "verb", [response, spin_up, diagram, loads_of_orbits, path_of_orbits, branch]
)
def test_other_verbs_of_a_blade_that_is_hardly_twisted(verb):
    require_same(verb, LIMITS["twist"], Theory(), 1e-7)


def test_states_of_a_blade_that_is_hardly_twisted():
    """Strains at single points are known less well than what is integrated from them."""
    require_same(states_of_orbits, LIMITS["twist"], Theory(), 1e-6)


def test_orbits_of_a_strip_that_leave_the_plane_are_unstable_in_the_limit():
    strip = Beam.reference().with_shape(Rectangle())
    require_same(stability, strip.with_twist(SMALL), Theory(), 1e-7, planar=strip)


@pytest.mark.parametrize("verb", [modes, state, orbits])
def test_a_setting_angle_is_a_twist_of_the_whole_blade(verb):
    one, other = PLANAR.with_setting_angle(0.4), PLANAR.with_twist((0.4,))
    require_same(verb, other, Theory(), 1e-12, planar=one)
