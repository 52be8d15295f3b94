"""Our variants: consistent foreshortening (FrC), other modes (FrM); limits of all models."""

import dataclasses

import numpy as np
import pytest
from scipy.linalg import eigh

from analytic import VARIANTS, Beam, Theory, Variant, linear_modes, periodic_orbits, reduced_model
from analytic.beam import BETA_1
from analytic.quadrature import gauss_points
from analytic.reduced.any_blade import blade_oscillator
from analytic.reduced.lagrangian import energy_coefficients
from analytic.reduced.model_range import model_at, softening_speed
from analytic.reduced.shapes import CantileverMode, rotating_mode
from analytic.shape_functions import blade_functions
from analytic.unit_blade import UNIFORM
from tests.beams import clamped_basis, deflection_matrices, unit_beam

STATIC = Variant(name="static", shape="rotating", axial="static")


@pytest.mark.parametrize(
    ("variant", "digits", "values"),
    [
        ("FrI", 7, (0.1127159, 0.3829904, 0.6529699, 0.8987163)),
        ("FrE", 7, (-0.0084660, 0.0103964, 0.0235487, 0.0306940)),
        (STATIC, 7, (-0.0143771, -0.0056942, 0.0006103, 0.0044149)),
        ("FrC", 8, (-0.01437251, -0.00567923, 0.00063832, 0.00445903)),
        ("FrM", 8, (-0.00897923, 0.00873523, 0.01966067, 0.02382273)),
    ],
    ids=["FrI", "FrE", "exact elongation", "FrC", "FrM"],
)
def test_lambda_omega_to_all_shown_digits(beam, variant, digits, values):
    for omega, value in zip((2.0, 4.0, 6.0, 8.0), values, strict=True):
        assert round(reduced_model(beam, omega, variant).lambda_omega, digits) == value


def test_consistent_foreshortening_of_the_cantilever_mode():
    """g1 = 10.1102 + 2.86208 Ω², where Eq. 43 has 10.110 - 7.1034 Ω²."""
    c = energy_coefficients(CantileverMode(), "consistent")
    assert c.cubic_bending == pytest.approx(10.1102, abs=5e-5)
    assert c.cubic_spin * BETA_1**4 == pytest.approx(2.86208, abs=5e-6)


def coupling_by_definition(w_bar, count):
    """Return D of every polynomial about Frobenius' mode, by nested quadrature."""
    x, weights = gauss_points(48)
    mode = rotating_mode(w_bar)
    inner = x[:, np.newaxis] * x
    basis = clamped_basis(count, inner.ravel()).slope.reshape(48, 48, count)
    # A(φ) = -½ ∫₀ˣ φ₁' φ' dξ for every basis function.
    a_basis = -0.5 * x[:, np.newaxis] * np.einsum("ijk,ij,j->ik", basis, mode.slope(inner), weights)
    phi, phi_1 = clamped_basis(count, x).value, mode.deflection(x)
    d = weights @ (a_basis * phi_1[:, np.newaxis] - mode.foreshortening(x)[:, np.newaxis] * phi)
    return d, weights @ phi_1**2


@pytest.mark.parametrize("w_bar", [2.0, 6.0, 12.0])
def test_one_solve_is_the_sum_over_modes(w_bar):
    """Mode by mode, with the mode by power series: nothing is shared with the solve."""
    K, M = deflection_matrices(w_bar, 20)
    # M is nearly singular, so the modes come from M c = K c / w̄_j², normalized to cᵀ K c = 1.
    reciprocal, vectors = eigh(M, K)
    reciprocal, vectors = reciprocal[::-1], vectors[:, ::-1]
    d, M_1 = coupling_by_definition(w_bar, 20)
    D = vectors.T @ d
    assert abs(D[0]) < 1e-10 * np.abs(D).max()
    terms = 4 * w_bar**2 * D**2 / M_1 / (1 - 4 * rotating_mode(w_bar).w_n ** 2 * reciprocal)
    one_mode, all_modes = (blade_oscillator(UNIFORM, w_bar, flag).oscillator for flag in (0, 1))
    expected = (all_modes.g2 - one_mode.g2) / 4
    assert terms.sum() == pytest.approx(expected, rel=1e-10)
    # Every mode but the first pushes toward softening, and the second does not carry it alone.
    assert (terms[1:] >= 0).all()
    assert terms[1] < 0.9999 * expected


@pytest.mark.parametrize("w_bar", [0.0, 3.0, 9.7])
def test_frc_is_the_lagrangian_with_the_rotating_mode(w_bar):
    """By Sec. 5's mode and the energy of Sec. 3: another route to w̄_n, g1 and g2."""
    terms = energy_coefficients(rotating_mode(w_bar), "consistent")
    found = blade_oscillator(UNIFORM, w_bar, False).oscillator
    assert found.w_n**2 == pytest.approx(terms.omega_n_squared(w_bar, 0.0), rel=1e-12)
    assert found.g1 == pytest.approx(terms.g1(w_bar), rel=2e-12)
    assert found.g2 == pytest.approx(terms.g2, rel=1e-12)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize("w_bar", [100.0, 500.0])
def test_frm_goes_far_beyond_the_power_series(w_bar):
    beam = unit_beam(1e-9)
    model = reduced_model(beam, w_bar, "FrM")
    orbits = periodic_orbits(beam, w_bar, [0.05], theory=Theory(extension=False))
    assert model.omega_n == pytest.approx(orbits.omega_n, rel=1e-10)
    # What a shift of 4e-5 leaves of an orbit's frequency, settled to 1e-12 or so.
    assert model.lambda_omega == pytest.approx(orbits.lambda_omega, abs=1e-8)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize("w_bar", [40.0, 200.0])
def test_many_point_masses_do_not_let_functions_confirm_themselves(beam, w_bar):
    """Masses cut the blade into panels, and more functions mean more on every one."""
    blade = beam
    for k in range(1, 13):
        blade = blade.with_point_mass(0.02 * beam.mass, k * beam.length / 12.0)
    omega = w_bar * beam.frequency_scale
    exact = linear_modes(
        blade, omega, 1, theory=Theory(extension=False), functions=100
    ).frequencies[0]
    # 36 functions, three on each panel, are 4e-4 and 12 % off.
    assert reduced_model(blade, omega, "FrM").omega_n == pytest.approx(exact, rel=1e-9)


def test_hardening_turns_to_softening(beam):
    found = {
        name: softening_speed(beam, name)
        for name in ("CI", "CE", "FrI", "FrE", "P3", "P4", "P5", "FrC", "FrM")
    }
    turns = {name: None if omega is None else omega / beam.omega_0 for name, omega in found.items()}
    assert turns["FrM"] == pytest.approx(1.021902, abs=5e-7)
    assert found["FrM"] == pytest.approx(2.97295, abs=5e-6)
    # Eq. 64's numerator, 3.3504 Ω² - 0.23963, to its digits; Tables 1 and 3 exactly, though their
    # Ω refers to the shape's own ω0.
    assert turns["CI"] == pytest.approx(np.sqrt(0.23963 / 3.3504), rel=2e-5)
    assert turns["P3"] == pytest.approx(np.sqrt(34408 / 106855 * 140 / 11) / BETA_1**2, rel=1e-9)
    assert turns["P5"] == pytest.approx(
        np.sqrt(660934414291675 / 16545041526500300 * 32670 / 2641) / BETA_1**2, rel=1e-9
    )
    # Table 2 softens from rest, and the cantilever mode with elongation never does.
    assert turns["P4"] is None
    assert turns["CE"] is None
    assert turns["FrE"] == pytest.approx(turns["FrM"], rel=0.04)
    assert turns["FrC"] > 1.9


def test_no_other_mode_of_the_cantilever_comes_near_2_omega_n():
    found = [blade_functions(UNIFORM, 24).first_mode(w) for w in np.linspace(0.0, 30.0, 61)]
    assert min(mode.others[0] / (2 * mode.w_n) for mode in found) > 3.0


def test_tip_of_frm_carries_the_other_modes(beam):
    """It vanishes at rest; in rotation the tip's share is that of p in (K + M d²/dτ²) p = f."""
    assert reduced_model(beam, 0.0, "FrM").perturbation.h2 == pytest.approx(0.0, abs=1e-14)
    assert reduced_model(beam, 6.0, "FrC").perturbation.h2 == 0.0
    model = reduced_model(beam, 6.0, "FrM")
    w_bar = 6.0 / beam.frequency_scale
    K, M = deflection_matrices(w_bar, 14)
    force = 4 * w_bar * coupling_by_definition(w_bar, 14)[0]
    # Forced at 2ω_n, mode by mode.
    reciprocal, vectors = eigh(M, K)
    p = vectors @ (vectors.T @ force / (1 - 4 * model.w_n**2 * reciprocal))
    tip = clamped_basis(14, np.array([1.0])).value[0]
    # q q̇ of q = a cos ψ is -½ω_n a² sin 2ψ.
    assert model.perturbation.h2 == pytest.approx(0.5 * model.w_n * (tip @ p), rel=1e-8)


BEAM = Beam.reference()


@pytest.mark.parametrize("variant", ["CI", "CE", "FrI", "FrE", "FrC", "FrM"])
def test_at_rest(beam, variant):
    model = reduced_model(beam, 0.0, variant)
    assert model.omega_n == pytest.approx(beam.omega_0, rel=1e-13)
    # By 30-digit quadrature of the same integrals.
    assert model.lambda_omega == pytest.approx(-0.01938354688117, abs=1e-13)
    assert model.oscillator.lambda_x == pytest.approx(0.04626775131107, abs=1e-13)


@pytest.mark.parametrize("variant", list(VARIANTS))
def test_slow_rotation_approaches_rest_quadratically(fitted_order, beam, variant):
    rest = model_at(beam, 0.0, VARIANTS[variant]).lambda_omega
    speeds = np.array([0.01, 0.02, 0.04])
    change = [
        abs(model_at(beam, s * beam.omega_0, VARIANTS[variant]).lambda_omega - rest) for s in speeds
    ]
    assert fitted_order(speeds, change) == pytest.approx(2.0, abs=0.02)


@pytest.mark.parametrize("shape", [CantileverMode(), rotating_mode(7.0)], ids=["C", "Fr"])
def test_stiff_axis_makes_exact_elongation_the_consistent_foreshortening(shape):
    static, consistent = (energy_coefficients(shape, a) for a in ("static", "consistent"))
    assert static.omega_n_squared(7.0, 0.0) == consistent.omega_n_squared(7.0, 0.0)
    assert static.g1(7.0) == pytest.approx(consistent.g1(7.0), rel=1e-13)
    assert static.g2 == consistent.g2
    # The paper's sine and its inextensible line do not reach that limit.
    for axial in ("sine", "inextensible"):
        assert abs(energy_coefficients(shape, axial).g1(7.0) / consistent.g1(7.0) - 1) > 0.05


def test_difference_to_the_consistent_model_falls_with_slenderness(fitted_order):
    slenderness = np.array([1e-7, 1e-6, 1e-5])
    differences = []
    for mu in slenderness:
        beam = dataclasses.replace(BEAM, second_moment=mu * BEAM.area * BEAM.length**2)
        omega = 2.0 * beam.omega_0
        differences.append(
            abs(
                reduced_model(beam, omega, STATIC).lambda_omega
                - reduced_model(beam, omega, "FrC").lambda_omega
            )
        )
    assert fitted_order(slenderness, differences) == pytest.approx(1, abs=0.01)
