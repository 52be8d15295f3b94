"""Derivatives of frequencies: closed forms, laws of similarity, and modes that are solved anew."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Beam, Blade, Rectangle, Theory, linear_modes
from analytic.sensitivity import parameters_of, sensitivity
from tests.beams import irregular, unit_beam

STIFF, HEAVY = ("EA", "GJ", "EI2", "EI3"), ("m", "j1", "j2", "j3")
TABLE = irregular(3, 0.01, 4)
STRIP = (
    unit_beam(1e-3).with_section_out_of_plane(0.25, 0.2).with_twist(0.4).with_precone(0.05)
    .with_hub_radius(0.2).with_tip_mass(0.1)
)  # fmt: skip


def anew(omega, parameter, count, theory, change=1e-2, tolerance=1e-9):
    """The same derivatives by modes of four other blades, of which a millionth is noise."""
    change *= parameter.size
    solved = [
        linear_modes(
            parameter.changed(parameter.value + k * change), omega, count,
            theory=theory, tolerance=tolerance,
        ).frequencies
        for k in (-2, -1, 1, 2)
    ]  # fmt: skip
    return np.array([1.0, -8.0, 8.0, -1.0]) / 12.0 @ np.array(solved) / change


def test_a_beam_at_rest_by_closed_forms():
    """ω ∝ √(EI/m) of the slender beam; a mass M at the tip takes 2ω M/(mL), by Rayleigh."""
    beam = Beam.reference()
    modes = linear_modes(beam, 0.0, 3, theory=Theory(extension=False))
    found = sensitivity(modes, ["EI3", "m", "hub_radius"])
    np.testing.assert_allclose(found.relative[:, :2], [[0.5, -0.5]] * 3, atol=1e-9)
    np.testing.assert_allclose(found.derivatives[:, 2], 0.0, atol=1e-9)
    light = beam.with_tip_mass(1e-9 * beam.mass)
    modes = linear_modes(light, 0.0, 3, theory=Theory(extension=False))
    slope = sensitivity(modes, ["point_mass[0]"]).derivatives[:, 0] * beam.mass / modes.frequencies
    np.testing.assert_allclose(slope, -2.0, rtol=1e-5)


@pytest.mark.parametrize("name", ["strip", "table"])
def test_units_of_time_and_mass(name):
    """All stiffness times λ is time over √λ: its sum is half of ω - Ω dω/dΩ, of masses less."""
    blade, omega, count = (STRIP, 3.0, 4) if name == "strip" else (TABLE, 2.0, 3)
    tolerance = 1e-9
    modes = linear_modes(blade, omega, count, tolerance=tolerance)
    found = sensitivity(modes)
    at = [
        linear_modes(blade, omega * (1.0 + k), count, tolerance=tolerance).frequencies
        for k in (-0.02, -0.01, 0.01, 0.02)
    ]
    over_speed = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0 @ np.array(at) / 0.01
    half = 0.5 * (modes.frequencies - over_speed)
    columns = dict(zip(found.names, found.derivatives.T, strict=True))
    stiff = sum(columns[one] for one in STIFF)
    heavy = sum(columns[one] for one in HEAVY if one in columns)
    if name == "strip":
        heavy = heavy + columns["point_mass[0]"] * 0.1
    np.testing.assert_allclose(stiff, half, atol=3e-6 * modes.frequencies.max())
    np.testing.assert_allclose(heavy, -half, atol=3e-6 * modes.frequencies.max())
    for one in (*STIFF, *HEAVY, "tension2", "center3") if name == "table" else ():
        whole, values = columns[one], parameters_of(blade, Theory())
        several = [n for n in found.names if n.startswith(f"{one}[")]
        factor = [values[n].value if values[one].value else 1.0 for n in several]
        parts = sum(f * columns[n] for f, n in zip(factor, several, strict=True))
        np.testing.assert_allclose(parts, whole, rtol=1e-8, atol=1e-12)


def test_a_strip_in_space_against_modes_solved_anew():
    modes = linear_modes(STRIP, 3.0, 4, tolerance=1e-10)
    found, known = sensitivity(modes), parameters_of(STRIP, Theory())
    assert found.names == (*known, "omega")
    for name, column in zip(known, found.derivatives.T, strict=False):
        # Torsion 1 and lag 2 are near each other.
        expected = anew(3.0, known[name], 4, Theory(), 2e-3, 1e-10)
        size = known[name].size / modes.frequencies
        np.testing.assert_allclose(column * size, expected * size, atol=5e-6, err_msg=name)


CASES = {
    "a table": (TABLE, Theory(), ("EI2[2]", "m[3]", "tension3[2]", "center2[3]", "twist[1]")),
    "that shears": (TABLE, Theory(shear=True), ("GA2[2]", "twist[2]")),
    "without extension": (TABLE, Theory(extension=False), ("tension3", "setting_angle", "precone")),
    "bent": (STRIP.with_prebend(0.2).with_sweep(0.1), Theory(), ("setting_angle", "EI2", "m")),
}


@pytest.mark.parametrize("name", CASES)
def test_against_modes_solved_anew(name):
    blade, theory, names = CASES[name]
    modes = linear_modes(blade, 2.0, 2, theory=theory, tolerance=1e-9)
    found, known = sensitivity(modes, names), parameters_of(blade, theory)
    for one, column in zip(names, found.derivatives.T, strict=True):
        size = known[one].size / modes.frequencies
        expected = anew(2.0, known[one], 2, theory)
        # Of local numbers the strains of functions tell less than of frequencies.
        np.testing.assert_allclose(column * size, expected * size, atol=5e-6, err_msg=one)


def test_matrices_that_are_linear_about_the_line():
    """Their sections between two stations have another change than centers that are linear."""
    table = irregular(3, 0.001, 4)
    blade = table.with_section(replace(table.table, interpolation="matrix"))
    modes = linear_modes(blade, 1.0, 2, tolerance=1e-9)
    (column,) = sensitivity(modes, ["EI2[2]"]).derivatives.T
    parameter = parameters_of(blade, Theory())["EI2[2]"]
    size = parameter.size / modes.frequencies
    np.testing.assert_allclose(column * size, anew(1.0, parameter, 2, Theory()) * size, atol=3e-6)


@pytest.mark.parametrize("angle", [0.5, np.pi / 2])
def test_a_set_blade_that_is_known_in_its_plane(angle):
    """It bends in this plane alone, whatever the plane of rotation is."""
    blade = unit_beam(1e-4).with_setting_angle(angle).with_hub_radius(0.2)
    modes = linear_modes(blade, 3.0, 2)
    known = parameters_of(blade, Theory())
    found = sensitivity(modes)
    assert tuple(known) == ("EA", "EI3", "m", "hub_radius", "setting_angle")
    assert found.names == (*known, "omega")
    for name, column in zip(known, found.derivatives.T, strict=False):
        size = known[name].size / modes.frequencies
        expected = anew(3.0, known[name], 2, Theory())
        np.testing.assert_allclose(column * size, expected * size, atol=1e-4, err_msg=name)


@pytest.mark.parametrize("theory", [Theory(), Theory(shear=0.3)])
def test_many_modes_of_a_planar_beam(theory):
    """Flap, which is stiff beside it, comes between them: at rest ω ∝ √E all the same."""
    beam = Beam.reference()
    modes = linear_modes(beam, 0.0, 9, theory=theory)
    found = sensitivity(modes, ["EA", "EI3"]).relative.sum(axis=1)
    np.testing.assert_allclose(found, 0.5, atol=1e-5)


def test_where_a_mass_lowers_flap_2():
    """As the page says: most near the middle of this blade; at the tip a mass raises it."""
    shapes = [Rectangle(height=0.08, width=0.012)] * 6
    x = np.linspace(0.0, 2.0, 6)
    rotor = Blade.from_shapes(x, shapes, youngs_modulus=7e10, density=2700.0)
    names = [f"m[{k}]" for k in range(1, 6)]
    found = sensitivity(linear_modes(rotor, 60.0, 4), names)
    per_mass = found.derivatives[found.outputs.index("flap 2")] / [0.4, 0.4, 0.4, 0.4, 0.2]
    assert np.argmin(per_mass) == 1
    assert np.all(per_mass[-2:] > 0.0)


def test_what_is_asked_by_name():
    found = sensitivity(linear_modes(STRIP, 3.0, 2), ["GJ", "EA"])
    assert found.names == ("GJ", "EA")
    assert found.of("lag 1", "EA") == found.derivatives[0, 1]
    with pytest.raises(ValueError, match=r"there is no 'lag 7': known are lag 1, flap 1"):
        found.of("lag 7", "EA")
    with pytest.raises(ValueError, match=r"the blade has no parameter 'GA2'; it has EA, EI3, m"):
        sensitivity(linear_modes(STRIP, 3.0, 2), ["GA2"])
    planar = linear_modes(Beam.reference(), 2.0, 2)
    assert "EI2" not in sensitivity(planar).names
    with pytest.raises(ValueError, match=r"the blade has no parameter 'EI2'; it has EA, EI3, m"):
        sensitivity(planar, ["EI2"])
    with pytest.raises(TypeError, match=r"parameters must be names, as \['EI3'\], got 'EI3'"):
        sensitivity(planar, "EI3")
    with pytest.raises(TypeError, match=r"a Beam or a Blade is needed"):
        parameters_of(3.0, Theory())
    with pytest.raises(TypeError, match=r"theory must be a Theory"):
        parameters_of(STRIP, "Timoshenko")


@pytest.mark.parametrize("blade", [STRIP, TABLE, Beam.reference().with_hub_radius(0.5)])
def test_the_speed(blade):
    """The slope of a Campbell diagram; a blade at rest has none."""
    omega = 3.0
    found = sensitivity(linear_modes(blade, omega, 3), ["omega"])
    ahead, behind = (linear_modes(blade, omega + step, 3).frequencies for step in (1e-2, -1e-2))
    np.testing.assert_allclose(found.derivatives[:, 0], (ahead - behind) / 2e-2, atol=2e-5)
    still = sensitivity(linear_modes(blade, 0.0, 3), ["omega"])
    np.testing.assert_allclose(still.derivatives, 0.0, atol=1e-7)
