"""What is taken for a number, and what is not: arrays, quantities with units, round-off."""

from fractions import Fraction

import numpy as np
import pytest
import xarray as xr

from analytic import (
    Beam,
    Blade,
    FourierRamp,
    Rectangle,
    Section,
    SpeedTable,
    SpinUp,
    SteadyRotation,
    linear_modes,
    periodic_orbits,
    reduced_model,
    residual_amplitude,
)
from analytic.input_checks import (
    finite_array,
    finite_values,
    points_of_beam,
    positive,
    rotation_speed,
    whole_number,
)

_SCALES = {
    "m": {"meter": 1.0, "millimeter": 1e-3},
    "N": {"kilonewton": 1e3},
    "Pa": {"gigapascal": 1e9},
    "rad": {"degree": np.pi / 180.0},
    "rad/s": {"radian / second": 1.0, "revolutions_per_minute": np.pi / 30.0, "hertz": 1.0},
}


class Quantity:
    """A number with a unit, as units libraries have it: angles count as plain numbers."""

    def __init__(self, magnitude, units):
        self.magnitude, self.units = magnitude, type("Unit", (), {"__str__": lambda _: units})()

    def to(self, unit):
        try:
            return Quantity(self.magnitude * _SCALES[unit][str(self.units)], unit)
        except KeyError:
            raise LookupError(f"cannot convert {self.units}") from None


def test_quantities_are_converted():
    assert rotation_speed(Quantity(60, "revolutions_per_minute")) == pytest.approx(2.0 * np.pi)
    assert positive("length", Quantity(800.0, "millimeter"), "m") == pytest.approx(0.8)
    at = finite_values("x", [Quantity(1, "meter"), Quantity(2.0, "millimeter")], "m")
    assert at == pytest.approx([1.0, 0.002])
    at = finite_values("x", Quantity(np.array([1.0, 2.0]), "millimeter"), "m")
    assert at == pytest.approx([0.001, 0.002])
    omega = Quantity(60.0, "revolutions_per_minute")
    beam = Beam.reference()
    assert reduced_model(beam, omega).omega_n == reduced_model(beam, 2.0 * np.pi).omega_n


def test_a_blade_takes_quantities():
    """In profiles, along stations, and one for all of them; those of another kind are refused."""
    EA, L = Quantity(5e3, "kilonewton"), Quantity(8000.0, "millimeter")
    rest = {"bending_stiffness": 566.0, "mass_per_length": 0.2}
    section = Section(axial_stiffness=[(0.0, EA), (L, 4e6)], **rest)
    assert section == Section(axial_stiffness=[(0.0, 5e6), (8.0, 4e6)], **rest)
    assert Section(axial_stiffness=EA, **rest).axial_stiffness == 5e6
    strip = Rectangle(height=Quantity(80.0, "millimeter"), width=0.01)
    blade = Blade.from_shapes(
        Quantity(np.array([0.0, 2000.0]), "millimeter"), [strip, strip],
        Quantity(70.0, "gigapascal"), 2700.0, twist=Quantity(np.array([0.0, 10.0]), "degree"),
    )  # fmt: skip
    by_hand = Blade.from_shapes([0.0, 2.0], [strip, strip], 7e10, 2700.0, twist=[0.0, np.pi / 18.0])
    assert blade == by_hand
    with pytest.raises(ValueError, match="bending_stiffness must be a quantity in N m.2, got"):
        Section(axial_stiffness=5e6, bending_stiffness=EA, mass_per_length=0.2)


def test_quantities_of_another_kind_are_refused():
    with pytest.raises(ValueError, match="length must be a quantity in m, got hertz"):
        positive("length", Quantity(1.0, "hertz"), "m")
    # Turns per second, or radians? A library that takes angles for numbers does not ask.
    with pytest.raises(ValueError, match="in rad/s, got hertz, which names no angle"):
        rotation_speed(Quantity(1.0, "hertz"))


def test_arrays_that_are_labelled_with_their_units():
    labelled = xr.DataArray([1.0, 2.0], attrs={"units": "m"})
    assert finite_values("x", labelled, "m").tolist() == [1.0, 2.0]
    with pytest.raises(ValueError, match="x must be in m, got units 'mm': convert it first"):
        finite_values("x", labelled.assign_attrs(units="mm"), "m")
    plain = xr.DataArray([0.1], attrs={"units": "1"})
    assert finite_values("amplitudes", plain).tolist() == [0.1]


@pytest.mark.parametrize(
    "values",
    [
        b"12",
        np.array(["1"]),
        True,
        [[1.0, 2.0], [3.0]],
        [None],
        1j,
    ],
    ids=lambda values: type(values).__name__,  # reprs hold addresses
)
def test_what_numpy_would_take_for_numbers(values):
    with pytest.raises(TypeError, match="x must be numbers in m, got"):
        finite_array("x", values, "m")


def test_numbers_of_numpy_come_out_as_those_of_python():
    assert type(whole_number("n", np.int16(3))) is int
    assert type(positive("length", np.float32(0.5), "m")) is float
    modes = linear_modes(Beam.reference(), np.int64(4), np.int32(2))
    assert type(modes.omega) is float
    assert modes.frequencies.shape == (2,)


def answers(n):
    """Answers to numbers of type `n`, each exact in half precision."""
    spin_up = SpinUp(omega=n(2), ramp_time=n(3))
    table = SpeedTable([n(0), n(1), n(3)], [n(0), n(2), n(3)])
    steady, ramp = SteadyRotation(omega=n(6)), FourierRamp(omega=n(6), ramp_time=n(3))
    section = Section(
        axial_stiffness=n(2048), bending_stiffness=(n(512), n(-256)), mass_per_length=n(0.25)
    )
    yield from (spin_up, table, steady, ramp, section)
    for motion in (spin_up, table, steady):
        yield motion.angle(n(1.25)), motion.rate(n(1.25)), motion.acceleration(n(1.25))
    yield Blade(length=n(8), section=section, hub_radius=n(0.5)).with_tip_mass(n(0.125)).omega_0
    yield reduced_model(Beam.reference(), n(6), "FrM").frequency(n(0.125))
    yield residual_amplitude(Beam.reference(), spin_up, [n(3), n(4)], corrected=True).tolist()
    several = np.array([1.25, 3.5], dtype=object if n is Fraction else n)
    yield reduced_model(Beam.reference(), 6.0).frequency(several / 32).tolist()
    for motion in (spin_up, ramp, steady) if n is not Fraction else ():
        yield motion.angle(several).tolist(), motion.acceleration(several).dtype


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.longdouble, Fraction])
def test_the_type_of_a_number_changes_no_bit(kind):
    expected = list(answers(float))
    found = list(answers(kind))
    assert found == expected[: len(found)]


def test_points_are_put_on_the_ends_within_round_off():
    inside = points_of_beam("x", [-1e-13, 4.0, 8.0 + 1e-13], 8.0)
    assert inside.tolist() == [0.0, 0.5, 1.0]
    # In any units: a reed in meters, a blade in millimeters.
    for length in (0.05, 6e4):
        with pytest.raises(ValueError, match="must lie on the beam"):
            points_of_beam("x", length * (1.0 + 1e-9), length)


def test_the_doors_of_the_exact_beam(beam):
    with pytest.raises(TypeError, match=r"got a masked array: .* by \.compressed\(\)"):
        periodic_orbits(beam, 4.0, np.ma.array([0.1, 0.2], mask=[False, True]))
    backbone = periodic_orbits(beam, 4.0, [0.1])
    with pytest.raises(ValueError, match="phase must be finite"):
        backbone.state(0, 1.0, np.nan)
    with pytest.raises(ValueError, match="t must be finite"):
        backbone.response([0.0, np.inf], 0)
    with pytest.raises(IndexError, match="orbit 1 is none of the 1"):
        backbone.orbit(1)
