"""What is taken for a number, and what is not: arrays, quantities with units, round-off."""

import numpy as np
import pytest
import xarray as xr

from analytic import Beam, Blade, Rectangle, Section, linear_modes, periodic_orbits, reduced_model
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
