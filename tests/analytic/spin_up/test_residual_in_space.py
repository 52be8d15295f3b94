"""The residual amplitude of a blade in space: closed form, exact transient, limits."""

import numpy as np
import pytest

from analytic import (
    Blade,
    Damping,
    Section,
    SpinUp,
    Theory,
    design_ramp,
    linear_modes,
    quiet_ramp_times,
    residual_amplitude,
)
from analytic.spin_up.modes_over_speed import excited_modes
from analytic.spin_up.residual import exact_residuals, modes_for, residuals

EXACT = Theory()
SECTION = Section(axial_stiffness=1e4, bending_stiffness=1.0, mass_per_length=1.0)
STRAIGHT = Blade(length=1.0, section=SECTION).with_section_out_of_plane(0.25, 0.2)
TWISTED = STRAIGHT.with_twist(0.4).with_precone(0.05).with_offsets(mass=(0.03, 0.01))
MODES = ("flap 1", "lag 1")


def both(blade, spin_up):
    """Return Z of both modes by the closed form, and by the exact transient."""
    modes, T = modes_for(blade, spin_up, EXACT, MODES), np.array([spin_up.ramp_time])
    return residuals(blade, spin_up, modes, T)[:, 0], exact_residuals(
        blade, spin_up, MODES, EXACT, 1e-7
    )[0]


def test_closed_form_and_exact_transient_agree_as_ramps_get_longer(fitted_order):
    """Eq. 1 leaves ~T⁻³ of each mode; the phase of either, too, is right in the limit.

    Without the inertia of the moving steady state 0.4 of flap would be left at T = 16, without the
    phase of modes in time 0.03 of lag.
    """
    assert excited_modes(TWISTED, 2.0, 2, EXACT) == MODES
    times = np.array([8.0, 12.0, 16.0])
    found = np.array([both(TWISTED, SpinUp(omega=2.0, ramp_time=T)) for T in times])
    errors = np.abs(found[:, 0] - found[:, 1]) * times[:, None] ** 3
    assert (np.abs(found[:, 1]) * times[:, None] ** 3).max(axis=0) == pytest.approx([4, 1], rel=0.3)
    for k, most in enumerate((0.05, 0.01)):
        assert fitted_order(1.0 / times, errors[:, k]) > 1.0
        assert errors[2, k] < most


@pytest.mark.parametrize("times", [None, [6.0, 8.0]])
def test_the_plane_is_the_limit(times):
    """The twist is so small that its square is below round-off."""
    spin_up = SpinUp(omega=2.0, ramp_time=6.0)
    for more in ({}, {"all_modes": True}, {"mode": "lag 2"}):
        plane, space = (
            residual_amplitude(blade, spin_up, times, **more)
            for blade in (STRAIGHT, STRAIGHT.with_twist(1e-9))
        )
        np.testing.assert_allclose(space, plane, rtol=1e-9)


def test_all_modes_together_are_half_peak_to_peak_of_the_tip():
    """Flap is most of the motion in both directions; 0.15 is for large swings."""
    spin_up = SpinUp(omega=2.0, ramp_time=12.0)
    for mode in MODES:
        closed = residual_amplitude(TWISTED, spin_up, mode=mode, all_modes=True)
        exact = residual_amplitude(TWISTED, spin_up, mode=mode, exact=True, tolerance=1e-5)
        assert closed == pytest.approx(exact, rel=0.15)


def test_shear_is_seen():
    """With it the blade is softer, and its quiet ramps are longer, as its periods are."""
    theory = Theory(shear=0.003, rotary_inertia=True)
    periods = [
        1.0 / linear_modes(TWISTED, 1.0, 2, theory=one).frequencies[1] for one in (EXACT, theory)
    ]
    t = np.linspace(6.0, 8.0, 401)
    quiet = [
        t[residual_amplitude(TWISTED, SpinUp(omega=2.0, ramp_time=8.0), t, theory=one).argmin()]
        for one in (EXACT, theory)
    ]
    assert quiet[1] / quiet[0] == pytest.approx(periods[1] / periods[0], abs=2e-3)
    assert quiet[1] / quiet[0] > 1.01


@pytest.mark.slow
def test_a_quiet_ramp_leaves_less_than_those_around():
    found = quiet_ramp_times(TWISTED, 2.0, shortest=2.0, longest=5.0, tolerance=1e-5)
    assert found.mode == "lag 1"
    T, left = found.ramp_times[-1], found.left[-1]
    for off in (-0.05, 0.05):
        spin_up = SpinUp(omega=2.0, ramp_time=T + off)
        assert abs(exact_residuals(TWISTED, spin_up, ("lag 1",), EXACT)[0][0]) > left


@pytest.mark.slow
def test_a_designed_ramp_leaves_flap_and_lag_at_rest():
    ramp = design_ramp(TWISTED, 2.0, 5.0)
    designed, plain = (
        np.abs(exact_residuals(TWISTED, one, MODES, EXACT)[0])
        for one in (ramp, SpinUp(omega=2.0, ramp_time=5.0))
    )
    assert designed.max() < 1e-6  # where its corrections end
    assert plain.min() > 1e-3


def test_damping_takes_its_share_of_each_mode():
    """The closed form with damping is right, and that without is not."""
    damped = TWISTED.with_damping(Damping(bending=0.02, out_of_plane=0.02, torsion=0.02))
    closed, exact = both(damped, SpinUp(omega=2.0, ramp_time=12.0))
    free = both(TWISTED, SpinUp(omega=2.0, ramp_time=12.0))[0]
    assert np.abs(closed - exact).max() * 12.0**3 < 0.15
    assert (np.abs(free - exact) * 12.0**3 > 0.25).all()


def test_bad_input():
    spin_up = SpinUp(omega=2.0, ramp_time=6.0)
    with pytest.raises(ValueError, match="corrected=True is of a straight blade in its plane"):
        residual_amplitude(TWISTED, spin_up, corrected=True)
    with pytest.raises(ValueError, match="leave out all_modes, or corrected"):
        residual_amplitude(STRAIGHT, spin_up, corrected=True, all_modes=True)
    with pytest.raises(ValueError, match="corrected=True is of the orbit of lag 1, and mode is"):
        residual_amplitude(STRAIGHT, spin_up, mode="lag 2", corrected=True)
    with pytest.raises(ValueError, match=r"no change of the speed excites flap 1.*ask for lag 1"):
        residual_amplitude(STRAIGHT, spin_up, mode="flap 1")
    with pytest.raises(ValueError, match="mode must be a name"):
        quiet_ramp_times(TWISTED, 2.0, mode="edge")
    with pytest.raises(ValueError, match="shortest must be positive"):
        quiet_ramp_times(TWISTED, 2.0, shortest=-1.0)
    with pytest.raises(ValueError, match="largest is of a straight blade in its plane"):
        design_ramp(TWISTED, 2.0, 5.0, largest=0.2)
    with pytest.raises(TypeError, match="all_modes must be"):
        residual_amplitude(TWISTED, spin_up, all_modes="yes")
