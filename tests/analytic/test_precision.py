"""A number is a number in whatever type it comes: half, single, extended precision, or an int."""

import math
from fractions import Fraction

import numpy as np
import pytest

from analytic import (
    Beam,
    Blade,
    Damping,
    DistributedForce,
    FourierRamp,
    Gravity,
    PointMass,
    Rectangle,
    Section,
    SpeedRipple,
    SpeedTable,
    SpinUp,
    SteadyRotation,
    Theory,
    TipForce,
    Tube,
    backbone,
    backbone_curve,
    campbell,
    damping_ratios,
    forced_response,
    linear_modes,
    linear_response,
    paper_table,
    periodic_orbits,
    planar_stability,
    quiet_ramp_times,
    reduced_model,
    residual_amplitude,
    spin_up_response,
    stability_limit,
)
from analytic.exact.linear.unstretched import unstretched_frequencies  # fmt: skip
from analytic.exact.plane.growth import planar_note
from analytic.section import OutOfPlane

BEAM = Beam.reference()
STRIP = BEAM.with_shape(Rectangle())
SOFT_FLAP = BEAM.with_section_out_of_plane(0.01, math.inf)
DAMPED = BEAM.with_damping(Damping(bending=0.0625, external=0.125))
SLOW = SpinUp(omega=2.0, ramp_time=3.0)

# Every number in them is exact in half precision; what comes out is the same to the last bit.
ANSWERS = {
    "linear_modes": lambda n: linear_modes(BEAM, n(6), 2).frequencies,
    "flap": lambda n: linear_modes(STRIP, n(6), 2, plane="flap").frequencies,
    "torsion": lambda n: linear_modes(STRIP, n(6), 2, plane="torsion").frequencies,
    "shear": lambda n: linear_modes(BEAM, n(6), 2, theory=Theory(shear=n(0.25))).frequencies,
    "damping_ratios": lambda n: damping_ratios(DAMPED, n(6), 2),
    "campbell": lambda n: campbell(BEAM, [n(0), n(6)], 1, 2).frequencies,
    "unstretched": lambda n: unstretched_frequencies(BEAM, n(6), 2),
    "periodic_orbits": lambda n: periodic_orbits(BEAM, n(6), [n(0.25)]).frequency,
    "backbone_curve": lambda n: backbone_curve(BEAM, n(6), n(0.25), tolerance=n(2**-14)).frequency(
        n(0.125)
    ),
    "branch": lambda n: (
        backbone(BEAM, n(6), theory=Theory(extension=False), functions=8).branch(n(0.125)).frequency
    ),
    "reduced_model": lambda n: reduced_model(BEAM, n(6), "FrM").frequency(n(0.125)),
    "its exact frequency": lambda n: reduced_model(BEAM, n(6), "FrE").exact_frequency(n(0.125)),
    "forced_response": lambda n: forced_response(
        DAMPED, n(6), TipForce(amplitude=n(0.5)), [n(3.5), n(3.625)], functions=8
    ).amplitude,
    "weight": lambda n: forced_response(
        DAMPED, [n(6), n(6.25)], Gravity(n(9.75)), functions=8
    ).amplitude,
    "spin_up_response": lambda n: spin_up_response(
        BEAM, SpinUp(omega=n(2), ramp_time=n(3)), [n(1), n(2)], tolerance=n(2**-10)
    ).q,
    "linear_response": lambda n: linear_response(BEAM, SLOW, [n(1), n(2)], points=[n(4)]).q,
    "residual_amplitude": lambda n: residual_amplitude(BEAM, SLOW, [n(3), n(4)], corrected=True),
    "quiet_ramp_times": lambda n: quiet_ramp_times(
        BEAM, n(2), longest=n(5), tolerance=n(2**-12)
    ).ramp_times,
    "planar_stability": lambda n: planar_stability(STRIP, n(4), [n(0.25)]).growth_rate,
    "planar_note": lambda n: planar_note(STRIP, n(4), n(0.25)),
    "stability_limit": lambda n: [
        one.low for one in stability_limit(SOFT_FLAP, n(0), largest=n(0.5)).tongues
    ],
    "loads": lambda n: [
        SpeedRipple(amplitude=n(0.5), frequency=n(3)), DistributedForce(amplitude=n(0.5)),
        Gravity(n(9.75)), SteadyRotation(omega=n(6)), PointMass(position=n(1), mass=n(2)),
        OutOfPlane(bending_ratio=n(4), torsion_ratio=n(0.5), polar_inertia=n(0.125)),
        FourierRamp(omega=n(6), ramp_time=n(3), start=n(1), cosines=[n(-1)]),
        SpeedTable([n(0), n(1), n(2)], [n(0), n(2), n(3)]),
        Beam.from_stiffness(
            length=n(8), axial_stiffness=n(2048), bending_stiffness=n(512), mass_per_length=n(0.25)
        ),
    ],
    "motion": lambda n: [
        f(n(1.25))
        for one in (SLOW, SpeedTable([0.0, 1.0, 3.0], [0.0, 2.0, 3.0]), SteadyRotation(omega=6.0))
        for f in (one.angle, one.rate, one.acceleration)
    ],
    "motion at many instants": lambda n: np.concatenate([
        f(np.array([1.25, 3.5], dtype=n if n in (np.float16, np.float32, np.longdouble) else float))
        for one in (SLOW, FourierRamp(omega=6.0, ramp_time=3.0), SteadyRotation(omega=6.0))
        for f in (one.angle, one.rate, one.acceleration)
    ]),
    "blade": lambda n: Blade(
        length=n(8), hub_radius=n(0.5), setting_angle=n(0.25),
        section=Section(
            axial_stiffness=n(2048), bending_stiffness=(n(512), n(-256)), mass_per_length=n(0.25)
        ),
        damping=Damping(bending=n(0.125)),
    ).with_tip_mass(n(0.125)).frequencies_at_rest,
    "damping from a ratio": lambda n: Damping.from_ratio(BEAM, 1, n(0.0625)),
    "shapes": lambda n: [
        BEAM.blade.with_shape(Rectangle(ratio=n(2), poisson_ratio=n(0.25))).section,
        BEAM.blade.with_shape(Tube(poisson_ratio=n(0.25))).section, paper_table(5).rows[0],
    ],
    "a state": lambda n: periodic_orbits(BEAM, 6.0, [0.25]).state(0, [n(4), n(8)], phase=n(1)).v,
}  # fmt: skip


KINDS = (np.float16, np.float32, np.longdouble, Fraction)
# Two kinds stand for all four where one answer takes a second.
DEAR = {"quiet_ramp_times", "branch", "forced_response", "stability_limit", "planar_stability"}
# Residual amplitudes and the stability of a plane, above, take the same numbers.
SECONDS = {"quiet_ramp_times", "stability_limit", "planar_note"}


@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=pytest.mark.slow if one in SECONDS else ()) for one in ANSWERS]
)
def test_the_type_of_a_number_changes_no_bit(name):
    expected = ANSWERS[name](float)
    for kind in KINDS[:: 3 if name in DEAR else 1]:
        found = ANSWERS[name](kind)
        if isinstance(expected, (list, str)) or not np.ndim(expected):
            assert found == expected, kind
        else:
            assert np.array_equal(found, expected), kind
            assert found.dtype == expected.dtype
