"""Blades as values, their equations of motion and frequencies, and those that are refused."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from analytic import Blade, PointMass, Section, Theory, linear_modes, reduced_model
from analytic.exact.continuum.planar import Continuum
from analytic.exact.continuum.planar_rotation import continuum
from analytic.exact.continuum.state import Driven
from analytic.input_checks import RotbeamWarning
from analytic.quadrature import gauss_points
from analytic.unit_blade import UNIFORM
from tests.beams import UNIT

HUB_AND_ALL = UNIT.with_hub_radius(0.5).with_tip_mass(0.3, 0.02).with_taper(0.2, 0.3)
FLAP = 0.5 * math.pi


def lag(blade, *speeds):
    return [
        linear_modes(blade, w, 1, theory=Theory(extension=False)).frequencies[0] for w in speeds
    ]


# Converged to the digits printed by another code, which shares nothing with this one.
LAG = [
    (UNIT.with_hub_radius(0.1), (1, 2, 4, 8), (3.5653093, 3.7071591, 4.2035350, 5.6050692)),
    (UNIT.with_tip_mass(0.5), (0, 2, 4, 8), (2.0162990, 2.1898275, 2.5566268, 3.3103344)),
    (UNIT.with_tip_mass(1.0, 0.1), (4,), (2.0230279,)),
    (UNIT.with_taper(height=0.5), (0, 4, 10), (3.8237848, 4.3081132, 5.6820445)),
    (UNIT.with_taper(width=0.5), (0, 4, 10), (4.3151703, 4.6722333, 5.8585246)),
    (UNIT.with_setting_angle(math.pi / 4), (4,), (4.8158323,)),
]


@pytest.mark.parametrize(("blade", "speeds", "frequencies"), LAG, ids=range(len(LAG)))
def test_lag_frequencies_to_all_printed_digits(blade, speeds, frequencies):
    assert lag(blade, *speeds) == pytest.approx(frequencies, rel=2e-8)


def test_published_frequencies_of_a_tip_mass_at_rest():
    found = linear_modes(
        UNIT.with_tip_mass(1.0), 0.0, 5, theory=Theory(extension=False)
    ).frequencies
    published = [1.557298, 16.25009, 50.89584, 105.1983, 179.2320]
    assert found == pytest.approx(published, rel=5e-7)


@pytest.mark.parametrize(
    "blade",
    [
        UNIT,
        UNIT.with_hub_radius(0.1),
        UNIT.with_tip_mass(0.5),
        UNIT.with_hub_radius(1.0).with_tip_mass(0.5),
        UNIT.with_taper(height=0.5),
        UNIT.with_hub_radius(2.0).with_tip_mass(0.3).with_taper(0.2, 0.3),
    ],
)
def test_flap_squared_is_lag_squared_and_the_speed_squared(blade):
    """What the rotation adds to the frequency of flap and lag differs by w̄² only."""
    w = 6.0
    in_plane, out = (
        linear_modes(
            blade.with_setting_angle(psi), w, 3, theory=Theory(extension=False)
        ).frequencies
        for psi in (0.0, FLAP)
    )
    # The digits that `linear_modes` settles, of the largest square.
    assert out**2 - in_plane**2 == pytest.approx(w**2, abs=2e-9 * out[-1] ** 2)


def test_a_turning_inertia_is_not_softened_by_the_rotation():
    """So that flap² - lag² is below w̄², by the share of the inertia in the mode's mass."""
    blade, w = UNIT.with_tip_mass(0.5, 0.1), 0.1
    in_plane, out = (
        linear_modes(blade.with_setting_angle(psi), w, 1, theory=Theory(extension=False))
        for psi in (0.0, FLAP)
    )
    x, weights = gauss_points(20)
    moving = weights @ in_plane.shapes(x)[1, :, 0].real ** 2 + 0.5
    near, tip = in_plane.shapes([1.0 - 1e-5, 1.0])[1, :, 0].real
    turning = 0.1 * ((tip - near) / 1e-5) ** 2
    # To first order in w̄², at which lag and flap have one mode.
    apart = out.frequencies[0] ** 2 - in_plane.frequencies[0] ** 2
    assert apart == pytest.approx(moving / (moving + turning) * w**2, rel=w**2)


@pytest.mark.parametrize("shear_share", [None, 0.3])
@pytest.mark.parametrize("psi", [0.0, 0.7, FLAP])
def test_the_tangent_is_the_derivative_of_the_residual(psi, shear_share):
    """A blade with all there is, and with inertia of its sections."""
    unit = replace(HUB_AND_ALL.with_setting_angle(psi).unit, rotary=1e-2)
    model = Continuum(1e-3, 6, 4, blade=unit, shear=shear_share)
    rng = np.random.default_rng(0)
    state = [0.3 * rng.standard_normal((2, model.size)) for _ in range(3)]
    by = Driven(np.array([1.3, 0.7]), np.array([0.4, -0.2]))
    tangent = model.tangent(*state, by)
    h = 1e-6
    for k, matrix in enumerate((tangent.stiffness, tangent.damping, tangent.mass)):
        for j in range(model.size):
            there, back = (
                [s + sign * h * (i == k) * np.eye(model.size)[j] for i, s in enumerate(state)]
                for sign in (1.0, -1.0)
            )
            column = (model.residual(*there, by) - model.residual(*back, by)) / (2.0 * h)
            # Central differences: h² times third derivatives, and round-off over h.
            assert column == pytest.approx(matrix[:, :, j], abs=1e-8)


@pytest.mark.parametrize("shear_share", [None, 0.3])
@pytest.mark.parametrize("psi", [0.0, 0.7, FLAP])
def test_a_free_motion_conserves_the_jacobi_integral(psi, shear_share):
    """The residual is that of the energies: its power, 0 then, is the rate of the integral."""
    blade = HUB_AND_ALL.with_setting_angle(psi).unit
    model = Continuum(1e-2, 5, 3, blade=blade, shear=shear_share)
    rng = np.random.default_rng(1)
    q, q_dot, q_ddot = (0.2 * rng.standard_normal((1, model.size)) for _ in range(3))
    w, h = 1.7, 1e-5
    power = np.sum(q_dot * model.residual(q, q_dot, q_ddot, Driven(w)))
    after, before = (
        model.kinetic_energy(q + s * h * q_dot + 0.5 * h**2 * q_ddot, q_dot + s * h * q_ddot)
        + model.amended_potential(q + s * h * q_dot + 0.5 * h**2 * q_ddot, w)
        for s in (1.0, -1.0)
    )
    assert (after - before) / (2.0 * h) == pytest.approx(power, abs=1e-7)


def test_a_blade_that_is_the_beam_has_its_numbers(beam):
    blade = beam
    assert (blade.mass, blade.omega_0, blade.burst_speed) == pytest.approx(
        (beam.mass, beam.omega_0, beam.burst_speed), rel=1e-13
    )
    for variant in ("CI", "FrE", "FrM"):
        one, other = (reduced_model(b, 6.0, variant) for b in (beam, blade))
        assert one.lambda_omega == pytest.approx(other.lambda_omega, rel=1e-12)
    assert linear_modes(blade, 6.0).frequencies == pytest.approx(
        linear_modes(beam, 6.0).frequencies, rel=1e-13
    )
    # By Galerkin's method, which shares no mode shape with Frobenius' series.
    almost = beam.with_hub_radius(1e-12)
    assert reduced_model(almost, 6.0, "FrM").lambda_omega == pytest.approx(
        reduced_model(beam, 6.0, "FrM").lambda_omega, rel=1e-10
    )


def test_blades_are_values():
    one = UNIT.with_point_mass(0.1, 0.5).with_taper(0.1)
    same = UNIT.with_point_mass(0.1, 0.5).with_taper(0.1)
    assert one == same
    assert hash(one) == hash(same)
    assert pickle.loads(pickle.dumps(one)) == one
    assert len({one, same, UNIT}) == 2
    assert "0.1 kg at 0.5 m" in str(one)
    stations = np.array([[0.0, 2.0], [1.0, 1.0]])
    section = Section(axial_stiffness=1e9, bending_stiffness=stations, mass_per_length=1.0)
    assert section.bending_stiffness == ((0.0, 2.0), (1.0, 1.0))
    assert PointMass(position=np.float64(1.0), mass=1).position == 1.0


def test_energy_norm_of_the_coordinates_is_the_elastic_energy():
    model = continuum(1e-3, 8, 6)
    rng = np.random.default_rng(5)
    q = 0.2 * rng.normal(size=model.size)
    x, weights = gauss_points(30)
    h = 1e-6
    slope, ahead, behind = (model.slope(q, at) for at in (x, x + h, x - h))
    curvature = (slope.conj() * (ahead - behind) / (2.0 * h)).imag / np.abs(slope) ** 2
    energy = 0.5 * weights @ (curvature**2 + (np.abs(slope) - 1.0) ** 2 / 1e-3)
    assert energy == pytest.approx(0.5 * q @ q, rel=1e-7)


@pytest.mark.parametrize("shear", [None, 0.3])
def test_rates_and_gradients_of_a_shape_are_those_of_differences(shear):
    """Tip, slope and section; the curvature and e' are derivatives to x."""
    model = continuum(1e-2, 6, 5, UNIFORM, shear)
    q, q_dot = 0.3 * np.random.default_rng(4).normal(size=(2, 3, model.size))
    x, h = np.array([0.2, 0.7]), 1e-6

    def rate(of):
        return (of(q + h * q_dot) - of(q - h * q_dot)) / (2.0 * h)

    assert model.tip_rate(q, q_dot) == pytest.approx(rate(model.tip), abs=1e-8)
    gradient = np.sum(model.tip_gradient(q) * q_dot[:, None], axis=2)
    assert gradient == pytest.approx(rate(model.tip), abs=1e-8)
    slope = rate(lambda at: model.slope(at, x))
    assert model.slope_rate(q, q_dot, x) == pytest.approx(slope, abs=1e-8)

    def angle(at, x):
        section = model.standing(at, x)[1]
        return np.arctan2(section[..., 1, 0], section[..., 0, 0])

    turns = [model.moved(*pair, x)[1][2, :, 0] for pair in zip(q, q_dot[:, None], strict=True)]
    assert np.real(turns) == pytest.approx(rate(lambda at: angle(at, x)), abs=1e-8)
    curvature, extension, change = (one[0] for one in model.bent(q[:1]))
    places = [model.points + step for step in (h, 0.0, -h)]
    slopes = np.array([model.slope(q[:1], at)[0] for at in places])
    angles = np.array([angle(q[:1], at)[0] for at in places])
    stretches = (slopes * np.exp(-1j * angles)).real
    assert curvature == pytest.approx((angles[0] - angles[2]) / (2.0 * h), abs=1e-6)
    assert extension == pytest.approx(stretches[1] - 1.0, abs=1e-12)
    assert change == pytest.approx((stretches[0] - stretches[2]) / (2.0 * h), abs=1e-6)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: UNIT.with_hub_radius(-1.0), "hub_radius must not be negative"),
        (lambda: UNIT.with_tip_mass(-1.0), "mass must not be negative"),
        (lambda: UNIT.with_tip_mass(2000.0), "2e\\+03 times the blade's 1 kg: give it in kg"),
        (lambda: UNIT.with_point_mass(0.1, 1.5), "is beyond the tip at 1 m: take a position from"),
        (lambda: UNIT.with_point_mass(0.1, 0.0), "does not move with the blade: leave it out, it"),
        (lambda: UNIT.with_point_mass(0.1, -0.5), "position must not be negative.*from the clamp"),
        (lambda: UNIT.with_taper(1.0), "axial_stiffness vanishes at x = 1 m"),
        (lambda: UNIT.with_taper(height=1.5), "vanishes at x = 0\\.6"),
        (lambda: reduced_model(HUB_AND_ALL, 1.0, "FrE"), "a hub and point masses and a variable"),
    ],
)  # fmt: skip
def test_bad_blades_are_refused(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()


@pytest.mark.parametrize(
    ("profile", "sentence"),
    [
        (((0.0, 1.0), (0.5, 1.0), (0.4, 1.0)), "ascend, but 0.4 m comes after 0.5 m: sort them"),
        (((0.0, 1.0), (0.5, 1.0), (0.5, 2.0), (0.5, 3.0), (1.0, 2.0)),
         "0.5 m comes after 0.5 m: sort them, and set equal ones apart"),
        (((0.0, 1.0),), "has one station, at 0 m: give two at least, or a number"),
        (((0.0, 1.0), (0.5, math.nan), (1.0, 1.0)), "NaN: leave the station out if its cell is"),
        (((0.0, 1.0), (math.inf, 1.0)), "bending_stiffness\\[1\\] must be finite, got inf m"),
        (((0.0, "1.0"), (1.0, "2.0")), "is the text '1.0': read numbers, as numpy.loadtxt does"),
        ("blade.csv", "bending_stiffness must be a number in N m\\^2, got 'blade.csv'"),
        (((0.0, 1.0, 2.0),), "must be a station \\(x, value\\), got"),
        ((), "is empty: give a number, coefficients or stations"),
        (((0.0, 1.0), (0.5, 1.0)), "run from 0 to 0.5 m: give them from 0 to the length, 1 m"),
        (((-0.1, 1.0), (1.0, 1.0)), "run from -0.1 to 1 m: give them from 0 to the length, 1 m"),
        (((0.0, 1.0), (0.8, 0.0), (1.0, 1.0)), "vanishes at x = 0.8 m, where it is 0: end the"),
        # Between the points of any grid.
        (((0.0, 1.0), (0.123, 1.0), (0.1231, -1.0), (0.1232, 1.0), (1.0, 1.0)), "at x = 0.1231 m"),
        (-1.0, "bending_stiffness must be positive at the clamp, got -1"),
    ],
)  # fmt: skip
def test_bad_profiles_are_refused(profile, sentence):
    with pytest.raises((ValueError, TypeError), match=sentence):
        Blade(
            length=1.0,
            section=Section(axial_stiffness=1.0, mass_per_length=1.0, bending_stiffness=profile),
        )


def test_a_setting_angle_in_degrees_is_warned_of():
    with pytest.warns(RotbeamWarning, match=r"degrees\? 45 degrees are 0.7854 rad"):
        UNIT.with_setting_angle(45.0)


def test_a_stocky_blade_on_a_hub_is_warned_of():
    stocky = Blade(length=1.0, section=Section(
        axial_stiffness=1e5, bending_stiffness=1.0, mass_per_length=1.0))  # fmt: skip
    with pytest.warns(RotbeamWarning, match="FrM is inextensible"):
        reduced_model(stocky.with_hub_radius(5.0), 5.0, "FrM")
