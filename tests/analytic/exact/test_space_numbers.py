"""The blade in space against numbers of two other codes, and against limits with an answer.

The tables are from two codes that share no formula with this one or each other: Galerkin's method
and collocation of the strong form, which agree to 1e-10 of a frequency.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import integrate

from analytic import (
    Beam,
    Blade,
    Damping,
    Section,
    SpinUp,
    Theory,
    campbell,
    damping_ratios,
    linear_modes,
    spin_up_response,
    steady_state,
)
from analytic.exact.continuum.space import SpaceContinuum
from tests.beams import unit_beam

PLAIN = Theory(extension=False, trapeze=False)
SOLID = Theory(extension=False, trapeze=False, rotary_inertia=True)
BEAM = unit_beam(1e-4)
BLADE = BEAM.with_section_out_of_plane(1.0 / 16.0, 0.08)

# Bending ratio, twist [degrees], hub, speed, frequencies.
TWISTED = """
0.25    30  0  0   1.7622602  3.4792923 11.1693299 21.4488637 31.7116057 56.5845262
0.25    30  1  4   6.2996237  6.7612195 19.0580229 26.3318307 40.8495588 64.0429511
0.25    90  0  0   1.7949864  3.2425094 12.2648859 18.7302866 36.4828711 48.9233788
0.01    45  1  2   3.2216440  4.1971518  8.4384955 13.0696640 20.7854306 25.3895334
0.01    90  0  8   4.5445134  8.1083739 20.3758312 24.2173883 37.7369421 44.1311689
0.0029  60  0  4   3.6630651  4.0611939 10.6244455 14.4036777 21.6827294 27.5074541
"""
# Twist, precone and setting angle [degrees], hub, speed, more, tip, frequencies.
WHOLE = """
30 0   0  0   1 -      1.000000000  0.000000000  0.000000000 1.3946017 3.3616840  6.4132597 15.1794013
30 5   0  0   1 -      0.998618693  0.004328382 -0.049363718 1.3932379 3.3524267  6.4065512 15.1690860
0  5   0  0   2 -      0.997315264  0.000000000 -0.070353965 2.3131255 3.6017348  7.4954976 17.5527216
30 5   0  0   4 -      0.996710828  0.002526872 -0.079278305 3.8295648 4.2944626 11.6568829 20.7609740
30 2.5 45 0.1 4 -      0.999132460  0.020389872 -0.035288256 2.9174655 5.4320617 11.7731182 21.3766495
30 0   0  0.1 2 tip    0.999882811 -0.004464488 -0.011238708 2.3288374 2.7926795  7.4946018 14.1297712
30 2.5 10 0.1 2 center 0.997105295 -0.003514097 -0.071491061 2.3695593 3.6184947  7.5746560 15.8729379
0  0   0  0.1 4 tip    0.999705815 -0.017040276  0.000000000 3.4074961 4.4486638 12.0316209 18.8840654
"""  # noqa: E501


@pytest.mark.parametrize("row", TWISTED.strip().splitlines())
def test_frequencies_of_twisted_blades_that_are_rigid_in_torsion(row):
    ratio, twist, hub, w, *known = map(float, row.split())
    blade = BEAM.with_section_out_of_plane(ratio, math.inf).with_twist(math.radians(twist))
    found = linear_modes(blade.with_hub_radius(hub), w, 6, theory=PLAIN)
    # Of seven decimals, half the last.
    assert found.frequencies == pytest.approx(np.array(known), abs=6e-8)
    assert found.shares.sum(axis=1) == pytest.approx(1.0, abs=0.05)  # the rest is along the blade


@pytest.mark.parametrize("row", WHOLE.strip().splitlines())
def test_frequencies_and_steady_tips_with_torsion_precone_setting_and_offsets(row):
    twist, cone, psi, hub, w, more, *known = row.split()
    blade = (
        BLADE.with_twist(math.radians(float(twist)))
        .with_precone(math.radians(float(cone)))
        .with_setting_angle(math.radians(float(psi)))
        .with_hub_radius(float(hub))
    )
    if more == "tip":
        blade = blade.with_tip_mass(0.2, offset=(0.05, 0.0))
    if more == "center":
        blade = blade.with_offsets(mass=(0.05, 0.0))
    tip, frequencies = np.array(known[:3], float), np.array(known[3:], float)
    state = steady_state(blade, float(w), theory=SOLID)
    assert state.tip == pytest.approx(tip, abs=6e-10)
    assert state.error <= 1e-9
    assert state.axis([0.0, 1.0])[1] == pytest.approx(state.tip, abs=1e-12)
    found = linear_modes(blade, float(w), 4, theory=SOLID)
    assert found.frequencies == pytest.approx(frequencies, abs=6e-8)


@pytest.mark.parametrize(
    ("theory", "bending", "torsion", "untwist"),
    [
        (PLAIN, [3.846673, 4.294556, 11.664284], None, 0.0),
        (SOLID, [3.846798, 4.294072, 11.660217], 43.22143, -2.912e-3),
        (replace(SOLID, trapeze=True), [3.847727, 4.293885, 11.657860], 43.41947, -6.546e-3),
    ],
)
def test_propeller_moment_and_trapeze_effect(theory, bending, torsion, untwist):
    blade = BLADE.with_twist(math.radians(30.0))
    modes = linear_modes(blade, 4.0, 7, theory=theory)
    assert modes.frequencies[:3] == pytest.approx(bending, abs=6e-7)
    if torsion is not None:
        assert modes.frequencies[6] == pytest.approx(torsion, abs=6e-6)
        assert modes.shares[6, 2] > 0.99
    model, q = modes.model, modes.steady.equilibrium
    K = model.strains.K[0] @ q
    assert model.weights @ K == pytest.approx(untwist, abs=6e-7)
    assert steady_state(blade, 4.0, theory=theory).twist == pytest.approx(untwist, abs=6e-7)


@pytest.mark.parametrize("trapeze", [False, "elastic", True])
def test_tension_and_the_propeller_moment_twist_a_straight_blade(trapeze):
    """An ordinary differential equation for torque, tension and twist, by SciPy.

    (GJ + k²N) φ' = T - k²N θ' with the initial twist θ, whose part "elastic" leaves out, as BeamDyn
    does: its torque and twist of such a blade follow from this equation to 3e-10.
    """
    w, hub, twist, mu, ratio, GJ = 3.0, 0.1, 0.6, 1e-3, 1.0 / 16.0, 0.08
    blade = unit_beam(mu).with_section_out_of_plane(ratio, GJ).with_twist(twist)
    theory = Theory(trapeze=trapeze, rotary_inertia=True)
    k2, shared = (1.0 + ratio) * mu * bool(trapeze), twist * (trapeze is True)

    def rates(x, y):
        r, N, phi, T = y
        bent = (T - k2 * N * shared) / (GJ + k2 * N)
        shorter = k2 * bent * (shared + 0.5 * bent)
        turned = twist * x + phi
        couple = (1.0 - ratio) * mu * w**2 * np.sin(turned) * np.cos(turned)
        return np.stack((1.0 + mu * N - shorter, -(w**2) * r, bent, couple))

    def ends(root, tip):
        return np.array([root[0] - hub, tip[1], root[2], tip[3]])

    x = np.linspace(0.0, 1.0, 41)
    guess = np.stack((hub + x, w**2 * (1.0 - x), 0.0 * x, 0.0 * x))
    known = integrate.solve_bvp(rates, ends, x, guess, tol=1e-9)
    r, N, phi, T = known.sol([0.0, 1.0])
    found = steady_state(blade.with_hub_radius(hub), w, theory=theory)
    assert found.twist == pytest.approx(phi[1], rel=1e-7)
    assert found.tip[0] == pytest.approx(r[1] - hub, rel=1e-9)
    loads = found.section_loads([0.0])
    assert loads.moment[0, 0] == pytest.approx(T[0], rel=1e-7)
    assert loads.force[0, 0] == pytest.approx(N[0], rel=1e-8)


def test_an_unloaded_blade_has_no_twist_however_it_is_bent():
    blade = BLADE.with_twist(0.5).with_prebend(0.3).with_sweep(0.2).with_precone(0.1)
    assert abs(steady_state(blade, 0.0).twist) < 1e-13
    # A moment about the line of a straight blade twists it by its length over GJ.
    turned = steady_state(BLADE, 0.0, moment=(0.01, 0.0, 0.0), theory=PLAIN).twist
    assert turned == pytest.approx(0.01 / 0.08, rel=1e-9)


@pytest.mark.parametrize(
    ("inertia", "known"),
    [(False, [62.078, 305.481, 949.945, 1221.868]), (True, [62.035, 305.286, 948.202, 1214.672])],
)
def test_the_twisted_blade_of_carnegie(inertia, known):
    """Carnegie (1959), rigid in torsion, without and with the inertia of its sections, in Hz."""
    width, height, modulus = 0.0254, 0.0017272, 206.85e9
    area, lag = width * height, width**3 * height / 12.0
    strip = Beam.from_stiffness(
        length=0.1524,
        axial_stiffness=modulus * area,
        bending_stiffness=modulus * lag,
        mass_per_length=7857.6 * area,
    )
    ratio = (height / width) ** 2
    blade = strip.with_section_out_of_plane(ratio, math.inf).with_twist(math.pi / 4.0)
    theory = Theory(extension=False, trapeze=False, rotary_inertia=inertia)
    found = linear_modes(blade, 0.0, 4, theory=theory).frequencies / (2.0 * math.pi)
    assert found == pytest.approx(known, abs=6e-4)  # half the last digit


def test_equal_stiffness_both_ways_is_blind_to_twist_and_setting():
    """Flap² = lag² + w̄², whatever the twist: Wright's relation of uniform blades.

    Lag alone and flap alone, alike to the last digit; a bar of twice the length turns half.
    """
    x = np.linspace(0.0, 1.0, 5)
    round_, planar = (
        BEAM.with_section_out_of_plane(1.0, 0.5),
        linear_modes(BEAM, 4.0, 1, theory=PLAIN),
    )
    lag, known = planar.frequencies[0], planar.shapes(x)[1, :, 0].real
    for blade in (round_.with_twist(1.0), round_.with_setting_angle(0.7)):
        found = linear_modes(blade, 4.0, 2, theory=PLAIN)
        assert found.frequencies == pytest.approx([lag, math.hypot(lag, 4.0)], rel=1e-9)
    _, lag, flap, _ = found.shapes(x)
    assert lag == pytest.approx(np.outer(known, [1.0, 0.0]), abs=1e-8)
    assert flap == pytest.approx(np.outer(known, [0.0, 1.0]), abs=1e-8)
    assert found.names == ("lag 1", "flap 1")
    assert found.shares == pytest.approx(np.eye(4)[[1, 0]], abs=1e-9)
    assert found.error <= 1e-9
    turns = []
    for length in (1.0, 2.0):
        bar = Beam.from_stiffness(
            length=length, axial_stiffness=1e4, bending_stiffness=length**2, mass_per_length=1.0
        )
        blade = bar.with_section_out_of_plane(0.0625, 0.08).with_offsets(mass=(0.05 * length, 0.0))
        modes = linear_modes(blade, 2.0 * bar.frequency_scale, 2, theory=SOLID)
        turns.append(modes.shapes(length * x)[3])
        larger = np.abs(modes.shapes(length)[1:3]).max(axis=0)
        assert larger == pytest.approx(np.ones(larger.shape))
    # Flap comes first, and turns a blade whose centers of mass lie behind it.
    assert turns[0][:, 0] == pytest.approx(2.0 * turns[1][:, 0], rel=1e-7)
    assert abs(turns[0][-1, 0]) > 1e-2


def test_torsion_alone_has_the_rotary_inertia_that_is_told():
    """j2 and j3 as r to 1, with or without what a theory adds; told to be zero, no mode."""

    def first(told, theory):
        section = Section(
            mass_per_length=1.0, axial_stiffness=1e4, bending_stiffness=1.0, rotary_inertia=told
        )
        blade = Blade(length=1.0, section=section).with_section_out_of_plane(0.0625, 0.08)
        return linear_modes(blade, 0.0, 1, only="torsion", theory=theory).frequencies[0]

    known = 0.5 * math.pi * math.sqrt(0.08 / (1.0625 * 2e-4))
    for theory in (Theory(), Theory(trapeze=False)):
        assert first(2e-4, theory) == pytest.approx(known, rel=1e-9)
        with pytest.raises(ValueError, match="has 0 torsion modes"):
            first(0.0, theory)


SPIN_UP = np.array([
    [0.99863931, -0.03629164, 0.02635214], [0.99770500, -0.06149998, -0.00512990],
    [0.99936943, -0.02808878, 0.01798797], [0.99984912, 0.00817105, 0.01472656],
    [0.99983314, -0.01005273, -0.01449911], [0.99987069, 0.00682624, -0.01392933],
])  # fmt: skip


@pytest.mark.parametrize(
    ("tolerance", "count", "error"),
    [(1e-4, 1, 1e-6), pytest.param(1e-7, 6, 2e-8, marks=pytest.mark.slow)],
)
def test_the_spin_up_of_a_twisted_blade(tolerance, count, error, monkeypatch):
    """The known tips are certain to 2e-8; both ends of the steady part are ends of steps."""
    seen, tip_rate = [], SpaceContinuum.tip_rate

    def watched(model, q, q_dot):
        seen.extend((model, *state) for state in zip(q, q_dot, strict=True))
        return tip_rate(model, q, q_dot)

    monkeypatch.setattr(SpaceContinuum, "tip_rate", watched)
    times, motion = (
        np.array([3.0, 6.0, 9.0, 12.0, 16.0, 20.0])[:count],
        SpinUp(omega=4.0, ramp_time=12.0),
    )
    blade = BLADE.with_twist(math.radians(30.0))
    found = spin_up_response(blade, motion, times, tolerance=tolerance, theory=SOLID)
    assert found.tip == pytest.approx(SPIN_UP[:count], abs=error)
    assert found.flap.tolist() == found.tip[:, 2].tolist()
    if count == 6:
        model, *states = zip(*(seen[-3], seen[-1]), strict=True)
        q, q_dot = map(np.array, states)
        kept = model[-1].kinetic_energy(q, q_dot) + model[-1].amended_potential(q, 4.0)
        assert np.ptp(kept) < 1e-9


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: steady_state(BEAM.with_twist(0.5), 1.0), "with_section_out_of_plane\\(bending"),
        (lambda: linear_modes(BEAM.with_precone(0.1), 1.0), "give its stiffness there by"),
        (
            lambda: linear_modes(
                BLADE.with_twist(0.5), 1.0, only="axial", theory=Theory(extension=False)
            ),
            "has 0 axial",
        ),
        (lambda: BLADE.with_offsets(mass=0.1), "mass_offset must be a pair"),
        (lambda: BLADE.with_twist(math.nan), "twist must be finite"),
        (lambda: BLADE.with_precone("5 degrees"), "precone must be"),
    ],
)
def test_bad_input(call, sentence):
    with pytest.raises((TypeError, ValueError), match=sentence):
        call()


def test_campbell_and_damping_ratios_of_a_twisted_blade():
    """Modes keep their shape over the speed; external drag damps all by d/(2 m ω_j) at rest."""
    blade = BLADE.with_twist(math.radians(30.0))
    diagram = campbell(blade, [0.5, 1.0], 2, orders=2)
    known = linear_modes(blade, 1.0, 2).frequencies
    assert diagram.frequencies[1] == pytest.approx(known, rel=1e-9)
    assert diagram.mac.min() > 0.99
    assert diagram.names == ("flap 1", "lag 1")
    theory = Theory(extension=False, trapeze=False)
    modes = linear_modes(blade, 0.0, 2, theory=theory).frequencies
    damped = blade.with_damping(Damping(external=0.02))
    ratios = damping_ratios(damped, 0.0, 2, theory=theory)
    assert ratios == pytest.approx(0.01 / modes, rel=1e-6)
