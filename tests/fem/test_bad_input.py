"""Bad input to the Python interface: one sentence each, before anything is computed."""

import math
import re

import pytest

from analytic import (
    Beam,
    Blade,
    Damping,
    FourierRamp,
    Gravity,
    Rectangle,
    SpeedRipple,
    TipForce,
    linear_modes,
)  # fmt: skip
from analytic.input_checks import RotbeamWarning
from rotbeam_exu import kicked, natural_frequencies, simulate

BEAM = Beam.reference()
STRIP = BEAM.with_shape(Rectangle())
TABLE = Blade.from_stations(
    [0.0, 8.0], [[5e6, 1e6, 1e6, 50.0, 60.0, 566.0]] * 2, [[0.2, 0, 0, 0]] * 2
)
ALIKE = BEAM.with_section_out_of_plane(1.0, 0.8)


def damped(blade, element, **damping):
    return {"blade": blade.with_damping(Damping(**damping)), "element": element}


TURNING = FourierRamp(omega=6.0, ramp_time=3.0, start=3.0)


def in_space(blade, **options):
    return {"blade": blade, "element": "space_exact", **options}


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"elements": 0}, "elements must be at least 1, got 0"),
        ({"elements": 1.5}, r"elements must be a whole number, got 1\.5"),
        ({"step": 0.0}, "step must be positive, got 0.0 s"),
        ({"step": math.nan}, "step must be finite, got nan s"),
        ({"step": 7e-4}, r"whole number of steps of 0.0007 s; try a step of 0\.000699986\d+ s"),
        ({"step": 0.1}, r"leaves 16\.8 steps in a period .* 1\.684 s: take 0\.0842 s or less"),
        ({"step": 0.2}, "ramp_time 3 s holds 15 steps of 0.2 s, .* take a step of 0.15 s or less"),
        ({"duration": -1.0}, "duration must be positive"),
        ({"duration": 2.0}, "duration 2 s ends before the steady rotation"),
        ({"element": "cabel"}, "unknown element 'cabel'; known are 'cable', .*'space_exact'"),
        ({"frame": "lab"}, "unknown frame 'lab'; known are 'inertial' and 'rotating'"),
        # Blades that an element does not model.
        ({"blade": BEAM.with_setting_angle(0.3)}, "the cosine 0.9553: take frame='rotating'"),
        (
            {"blade": BEAM.with_point_mass(0.1, 3.3).with_tip_mass(0.1), "elements": 1},
            "1 elements have no nodes at all point masses and kinks of this blade: take 2 or more",
        ),
        (
            {"blade": BEAM.with_hub_radius(1.0), "element": "linear"},
            "hub: take 'cable', 'exact' or",
        ),
        (
            {"blade": BEAM.with_taper(0.1), "element": "substructures"},
            "has a variable section: take",
        ),
        (damped(BEAM, "ancf3", bending=0.01), "take 'cable' or 'exact', or external damping"),
        (damped(BEAM, "ancf3", axial=0.01), "element 'ancf3' has no viscosity"),
        (damped(ALIKE, "space_cable", axial=0.01), "has damping .*: take 'space_exact', or exter"),
        (damped(BEAM, "cable", shear=0.01), "no damping of shear: .*, or take 'space_exact'"),
        (damped(BEAM, "linear", external=0.01), "has damping: take 'cable', 'exact' or 'ancf3'"),
        (damped(BEAM, "substructures", bending=0.01), "for the uniform beam .* has damping"),
        # In space.
        ({"blade": STRIP, "element": "space_cable"}, "element='space_exact'"),
        (in_space(STRIP, frame="rotating"), "frame='inertial'"),
        (in_space(BEAM), r"with_section_out_of_plane\(bending_ratio"),
        (in_space(STRIP.with_section_out_of_plane(1.0, math.inf)), "element='space_cable'"),
        (
            in_space(STRIP.with_tip_mass(0.5, inertia=0.1)),
            "at 8 m has an inertia of 0.1 .*: take an element of the plane, or analytic.spin_up",
        ),
        (
            in_space(STRIP.with_point_mass(0.5, 3.0, offset=(0.03, 0.04))),
            "at 3 m is 0.05 m from there: take analytic.spin_up_resp",
        ),
        (
            in_space(STRIP.with_offsets(mass=(0.01, 0.0)).with_tip_mass(0.5)),
            "at 8 m is 0.01 m from there: take analytic.spin_up_resp",
        ),
        ({"blade": STRIP.with_twist(0.1)}, "take element='space_exact'"),
        ({"blade": STRIP.with_tip_mass(0.5).with_twist(0.1)}, "take analytic.spin_up_response"),
        ({"blade": STRIP.with_kink(4.0, 0.1)}, "kink or offset: take element='space_exact'"),
        ({"blade": TABLE}, "a table of stations this .* the command line --element space_exact"),
        ({"blade": TABLE.with_tip_mass(0.5)}, "twists: take analytic.spin_up_response, or on the"),
        (in_space(STRIP.with_twist(0.1), spin_up=TURNING), "in its plane"),
        (in_space(STRIP.with_kink(4.0, 0.1), initial_state=kicked(STRIP)), "without kinks"),
        ({"loads": [Gravity(tilt=1.0)]}, "'cable' stays in the plane of rotation"),
        *(
            ({"element": name, "initial_state": kicked(STRIP)}, f"{name}' stays .* take element=")
            for name in ("cable", "exact", "ancf3", "linear", "substructures")
        ),
        # Loads.
        ({"loads": (TipForce(amplitude=1.0),)}, "the frequency of a tip force of 1 N: give"),
        ({"loads": (SpeedRipple(amplitude=1.0),)}, "needs the frequency of a ripple"),
        ({"loads": (SpeedRipple(amplitude=1.0, frequency=0.0),)}, "add the amplitude to omega"),
        ({"loads": (3.0,)}, "must be a .*SpeedRipple, TipForce, .*Gravity.*, got 3"),
        ({"loads": Gravity()}, r"as in loads=\(Gravity\(\),\), got Gravity"),
        ({"loads": None}, "loads must be several, .* got None"),
        (
            {"loads": (TipForce(amplitude=1.0, frequency=400.0),)},
            r"leaves 15\.7 steps in a period of a load, 0\.01571 s: take 0\.000785 s or less",
        ),
    ],
)
def test_simulate_refuses(spin_up, options, sentence):
    with pytest.raises((ValueError, TypeError), match=sentence):
        simulate(**{"blade": BEAM, "spin_up": spin_up, **options})


def test_natural_frequencies_refuse(beam):
    with pytest.raises(ValueError, match="omega must not be negative"):
        natural_frequencies(beam, -1.0)
    with pytest.raises(ValueError, match="count = 9 is more than the 5 modes"):
        natural_frequencies(beam, 1.0, elements=1, count=9)
    with pytest.warns(RotbeamWarning, match="40 rad/s is 14 times .* rpm"):
        natural_frequencies(beam, 40.0, elements=32)


def test_a_mesh_too_coarse_for_the_boundary_layer_is_noticed(beam, recwarn):
    """At w̄ = 60 sixteen elements are 2.3 % off; what the warning asks for is within 1e-3."""
    omega = 60.0 * beam.frequency_scale
    exact = linear_modes(beam, omega, 1).frequencies[0]
    off = natural_frequencies(beam, omega, elements=16)[0] / exact - 1.0
    sentence = next(str(w.message) for w in recwarn if "clamp" in str(w.message))
    assert off > 0.02
    asked = int(re.search(r"take (\d+) elements", sentence)[1])
    recwarn.clear()
    better = natural_frequencies(beam, omega, elements=asked)[0] / exact - 1.0
    assert abs(better) < 1e-3
    assert not any("clamp" in str(w.message) for w in recwarn)


def test_a_beam_too_stiff_for_double_precision_is_refused(beam, spin_up):
    stiff = Beam.from_stiffness(
        length=8.0, axial_stiffness=1e14, bending_stiffness=566.0, mass_per_length=0.2
    )
    with pytest.raises(ValueError, match=r"below 1e-11, .* lower the axial .* below 8\.84e\+11 N"):
        simulate(stiff, spin_up)
    with pytest.raises(ValueError, match="below 1e-11"):
        natural_frequencies(stiff, 6.0)
    softer = Beam.from_stiffness(
        length=8.0, axial_stiffness=8.8e11, bending_stiffness=566.0, mass_per_length=0.2
    )
    exact = linear_modes(softer, 6.0, 1).frequencies[0]
    # Sixteen cables; round-off adds 1e-6.
    assert natural_frequencies(softer, 6.0, count=1)[0] == pytest.approx(exact, rel=5e-5)
