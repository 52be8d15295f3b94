"""What `rotbeam run` says of its own error: mesh and step apart, against the exact beam."""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest

from analytic import Beam, SpinUp, linear_modes, periodic_orbits
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.fem.elements import Ancf3, Exact
from rotbeam_exu.verification.assessment import assess
from tests.beams import irregular

OMEGA = 6.0


def assessed(elements, frequency=3.7225, amplitude=0.32, element="cable"):
    spin_up = SpinUp(omega=OMEGA, ramp_time=3.0)
    case = RunCase(blade=Beam.reference(), spin_up=spin_up, elements=elements, element=element)
    return assess(case, SimpleNamespace(frequency=frequency, amplitude=amplitude))


def test_the_mesh_error_falls_with_the_fourth_power_of_the_element():
    errors = [assessed(elements).mesh_error for elements in (8, 16, 32)]
    assert errors[1] == pytest.approx(1.25e-5, rel=0.05)
    # Cubic elements: 1/16 for half the length, to the next order.
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(16.0, rel=0.1)


def test_shear_and_rotary_inertia_are_no_error_of_an_element_that_has_them():
    found = assessed(8, element=Exact(nodes=3))
    bare = linear_modes(Beam.reference(), OMEGA, 1).frequencies[0]
    # They are worth 4.8e-5, which no mesh would take away.
    assert found.exact_omega_n / bare - 1.0 == pytest.approx(-4.8e-5, rel=0.02)
    assert 0.0 < found.mesh_error < 1e-5
    assert not found.elsewhere
    assert abs(found.refined_error / found.mesh_error) == pytest.approx(1.0 / 16.0, rel=0.2)


def test_an_element_that_locks_is_not_told_to_take_a_finer_mesh():
    sentence, *_ = assessed(4, element=Ancf3(law="coupled")).warnings(4, 1e-3)
    assert "no mesh mends it" in sentence
    assert "more elements" not in sentence


def test_an_exact_run_on_an_exact_mesh_has_no_error():
    orbit = periodic_orbits(Beam.reference(), OMEGA, [0.2])
    found = assessed(4, frequency=float(orbit.frequency[0]), amplitude=0.2)
    found = replace(found, omega_n=found.exact_omega_n, refined_omega_n=found.exact_omega_n)
    assert found.error == 0.0
    assert found.effect == pytest.approx(orbit.frequency[0] / orbit.omega_n - 1.0, abs=1e-12)
    assert found.warnings(16, 1e-3) == []


def test_each_error_above_a_hundredth_of_the_effect_is_named_with_its_own_remedy():
    found = assessed(16)
    effect = found.effect
    exact = found.exact_omega_n
    fine = replace(found, omega_n=exact, refined_omega_n=exact, frequency=found.exact_frequency)
    assert fine.warnings(16, 1e-3) == []
    for share, warned in ((0.009, False), (0.011, True)):
        mesh = replace(
            fine,
            omega_n=fine.exact_omega_n * (1.0 + share * effect),
            frequency=fine.exact_frequency * (1.0 + share * effect),
        )
        step = replace(fine, frequency=fine.exact_frequency * (1.0 + share * effect))
        for one, remedy in ((mesh, "more elements than 16"), (step, "smaller step than 0.001 s")):
            sentences = one.warnings(16, 1e-3)
            assert len(sentences) == warned
            assert all(remedy in sentence and "1.1%" in sentence for sentence in sentences)


def test_where_the_swing_is_small_a_ramp_that_leaves_more_is_a_remedy_too():
    small, large = assessed(8, amplitude=0.02), assessed(8)
    assert all("ramp that leaves more than 0.02 L" in one for one in small.warnings(8, 1e-3))
    assert "times the nonlinear effect" in small.warnings(8, 1e-3)[0]
    assert not any("ramp" in one for one in large.warnings(8, 1e-3))


def test_an_orbit_that_cannot_be_had_is_a_line_and_no_failure():
    found = assessed(4, amplitude=1.2)
    assert math.isnan(found.exact_frequency)
    assert math.isnan(found.step_error)
    titles = dict(found.lines())
    assert titles["exact ω_NL"].startswith("cannot be had: ")
    assert found.warnings(4, 1e-3) == []


@pytest.mark.filterwarnings("ignore:at x")  # of the trapeze effect
def test_twice_the_elements_on_many_stations_are_no_sign_of_another_limit():
    """16 elements cross the stations and 32 are cut by them, which leaves most of 1.8e-3."""
    blade = irregular(3, 0.005, 27)
    case = RunCase(
        blade=blade, spin_up=SpinUp(omega=2.6, ramp_time=3.0), element="space_exact",
        elements=16, duration=6.0, step=0.02,
    )  # fmt: skip
    exact = linear_modes(blade, 2.6, 1, theory=case.model.theory_of(blade)).frequencies[0]
    swing = SimpleNamespace(frequency=exact, amplitude=0.01)
    coarse, finer = (assess(replace(case, elements=n), swing, exact=False) for n in (16, 32))
    assert finer.mesh_error > 0.5 * coarse.mesh_error
    assert not coarse.elsewhere
