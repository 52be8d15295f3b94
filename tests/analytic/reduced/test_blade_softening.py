"""λ of hub, masses, taper and setting, in closed form and by exact orbits."""

import math
import warnings

import pytest

from analytic import Blade, Section, Theory, periodic_orbits, reduced_model
from analytic.input_checks import RotbeamWarning
from tests.beams import UNIT

FLAP = 0.5 * math.pi


BACKBONES = [
    (UNIT.with_hub_radius(0.5), 2, 4.0303159, 0.00277992, -0.000968,
     (0.999972, 0.999884, 0.999726, 0.999474)),
    (UNIT.with_hub_radius(1.0), 6, 8.5483527, 0.05566458, 0.042729,
     (0.999441, 0.997737, 0.994800, 0.990465)),
    (UNIT.with_hub_radius(5.0), 2, 6.6471464, 0.04001529, 0.037099,
     (0.999597, 0.998361, 0.996204, 0.992985)),
    (UNIT.with_tip_mass(0.5), 4, 2.5566268, 0.02047189, 0.000171,
     (0.999795, 0.999168, 0.998091, 0.996502)),
    (UNIT.with_tip_mass(1.0), 0, 1.5572979, -0.02404413, -0.024044,
     (1.000241, 1.000976, 1.002238, 1.004095)),
    (UNIT.with_tip_mass(1.0, 0.1), 4, 2.0230279, 0.02882529, 0.005548,
     (0.999711, 0.998827, 0.997303, 0.995045)),
    (UNIT.with_hub_radius(1.0).with_tip_mass(0.5), 2, 3.1543064, 0.03907575, 0.030266,
     (0.999607, 0.998405, 0.996316, 0.993180)),
    (UNIT.with_taper(width=0.5), 8, 5.4409021, 0.01936820, -0.001220,
     (0.999806, 0.999214, 0.998196, 0.996697)),
    (UNIT.with_taper(height=0.5), 2, 3.9604557, -0.01641008, -0.022822,
     (1.000165, 1.000666, 1.001525, 1.002785)),
]  # fmt: skip


@pytest.mark.parametrize(
    ("blade", "w", "omega_n", "coefficient", "alone", "ratios"), BACKBONES, ids=range(9)
)
def test_softening_of_every_blade_to_all_printed_digits(
    blade, w, omega_n, coefficient, alone, ratios
):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RotbeamWarning)  # of resonances, at larger amplitudes
        frm, frc = (reduced_model(blade, w, name) for name in ("FrM", "FrC"))
        orbits = periodic_orbits(blade, w, [0.1, 0.2, 0.3, 0.4], theory=Theory(extension=False))
    assert frm.omega_n == pytest.approx(omega_n, rel=1e-7 / 2.0)
    assert frm.lambda_omega == pytest.approx(coefficient, abs=1e-8)
    assert frc.lambda_omega == pytest.approx(alone, abs=1e-6)
    assert orbits.lambda_omega == pytest.approx(coefficient, abs=1e-6)
    assert orbits.frequency / orbits.omega_n == pytest.approx(ratios, abs=1e-6)


@pytest.mark.parametrize(
    ("w", "coefficient"),
    [(0, -0.019383), (1, 0.004096), (2, 0.054402), (4, 0.138560), (8, 0.199522)],
)
def test_softening_of_flap(w, coefficient):
    found = reduced_model(UNIT.with_setting_angle(FLAP), w, "FrM")
    assert found.lambda_omega == pytest.approx(coefficient, abs=1e-6)


def test_softening_half_way_between_lag_and_flap():
    blade = UNIT.with_setting_angle(0.5 * FLAP)
    found = reduced_model(blade, 4.0, "FrM")
    assert found.omega_n == pytest.approx(4.8158323, rel=1e-8)
    assert found.lambda_omega == pytest.approx(0.0964149, abs=5e-8)
    exact = periodic_orbits(blade, 4.0, [0.05], theory=Theory(extension=False))
    assert exact.lambda_omega == pytest.approx(0.0964149, abs=1e-6)


def test_a_hub_makes_the_extension_count():
    """At δ = 5, w̄ = 10 and the paper's μ it raises λ by 3.1e-4, a hundred times what it does
    without a hub."""
    mu = 1.758e-6
    section = Section(axial_stiffness=1.0 / mu, bending_stiffness=1.0, mass_per_length=1.0)
    blade = Blade(length=1.0, section=section, hub_radius=5.0)
    stretched, not_stretched = (
        periodic_orbits(blade, 10.0, [0.05], theory=Theory(extension=not rigid)).lambda_omega
        for rigid in (False, True)
    )
    assert stretched - not_stretched == pytest.approx(3.1e-4, abs=0.05e-4)  # to its two digits
    assert reduced_model(blade, 10.0, "FrM").lambda_omega == pytest.approx(not_stretched, abs=1e-7)


@pytest.mark.parametrize("w", [1.5, 3.0])
def test_frm_knows_the_inertia_of_the_sections(w):
    section = Section(axial_stiffness=1e9, bending_stiffness=1.0, mass_per_length=1.0,
                      rotary_inertia=0.01)  # fmt: skip
    blade = Blade(length=1.0, section=section, hub_radius=0.5).with_taper(0.1, 0.3)
    model = reduced_model(blade, w, "FrM")
    exact = periodic_orbits(blade, w, [0.05], theory=Theory(extension=False))
    assert model.omega_n == pytest.approx(exact.omega_n, rel=1e-12)
    assert model.lambda_omega == pytest.approx(exact.lambda_omega, abs=1e-6)
