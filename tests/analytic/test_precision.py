"""A number is a number in whatever type it comes: half, single, extended precision, or a fraction.

All public functions check their numbers by `analytic.input_checks`; some stand here for all.
"""

from fractions import Fraction

import numpy as np
import pytest

from analytic import (
    Beam,
    Blade,
    Damping,
    FourierRamp,
    Gravity,
    PointMass,
    Rectangle,
    Section,
    SpeedTable,
    SpinUp,
    SteadyRotation,
    Theory,
    TipForce,
    forced_response,
    linear_modes,
    periodic_orbits,
    reduced_model,
    residual_amplitude,
    spin_up_response,
)
from analytic.section import OutOfPlane

BEAM = Beam.reference()
DAMPED = BEAM.with_damping(Damping(bending=0.0625, external=0.125))
SLOW = SpinUp(omega=2.0, ramp_time=3.0)

# Every number in them is exact in half precision; what comes out is the same to the last bit.
ANSWERS = {
    "shear": lambda n: linear_modes(BEAM, n(6), 2, theory=Theory(shear=n(0.25))).frequencies,
    "periodic_orbits": lambda n: periodic_orbits(BEAM, n(6), [n(0.25)]).frequency,
    "reduced_model": lambda n: reduced_model(BEAM, n(6), "FrM").frequency(n(0.125)),
    "forced_response": lambda n: forced_response(
        DAMPED, n(6), TipForce(amplitude=n(0.5)), [n(3.5), n(3.625)], functions=8
    ).amplitude,
    "spin_up_response": lambda n: spin_up_response(
        BEAM, SpinUp(omega=n(2), ramp_time=n(3)), [n(1), n(2)], tolerance=n(2**-10)
    ).q,
    "residual_amplitude": lambda n: residual_amplitude(BEAM, SLOW, [n(3), n(4)], corrected=True),
    "values": lambda n: [
        Gravity(n(9.75)), SteadyRotation(omega=n(6)), PointMass(position=n(1), mass=n(2)),
        OutOfPlane(bending_ratio=n(4), torsion_ratio=n(0.5), polar_inertia=n(0.125)),
        FourierRamp(omega=n(6), ramp_time=n(3), start=n(1), cosines=[n(-1)]),
        SpeedTable([n(0), n(1), n(2)], [n(0), n(2), n(3)]),
        BEAM.blade.with_shape(Rectangle(ratio=n(2), poisson_ratio=n(0.25))).section,
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
}  # fmt: skip


@pytest.mark.parametrize("name", ANSWERS)
def test_the_type_of_a_number_changes_no_bit(name):
    expected = ANSWERS[name](float)
    # Two kinds stand for all four where one answer takes a second.
    for kind in (np.float16, np.float32, np.longdouble, Fraction)[
        :: 3 if name == "forced_response" else 1
    ]:
        found = ANSWERS[name](kind)
        if isinstance(expected, list) or not np.ndim(expected):
            assert found == expected, kind
        else:
            assert np.array_equal(found, expected), kind
            assert found.dtype == expected.dtype
