"""Blades from stations of 6x6 matrices: against the same blade by ratios, and rigid transports."""

import math

import numpy as np
import pytest
from scipy import optimize, special
from scipy.spatial.transform import Rotation

from analytic import (
    Blade,
    Damping,
    Section,
    Theory,
    damping_ratios,
    linear_modes,
    periodic_orbits,
    steady_state,
)
from analytic.description import describe, from_description
from analytic.exact.continuum.discretization import space_continuum
from analytic.exact.continuum.rotation import rotating_blade
from analytic.exact.continuum.state import Driven
from tests.beams import finite_elements, told, unit_beam

MU, R, G = 1e-4, 1.0 / 16.0, 0.08
X = np.linspace(0.0, 1.0, 4)
STIFFNESS = np.tile([1.0 / MU, 0.3 / MU, 0.3 / MU, G, R, 1.0], (4, 1))
MASS = np.tile([1.0, MU * (1.0 + R), MU * R, MU], (4, 1))
BEAM = unit_beam(MU)
CENTERS = {"center": (0.05, 0.02), "tension": (0.03, -0.01)}
SHEARED = Theory(shear=True, trapeze=False)


def stations(**offsets):
    """The blade with the same offsets at all stations."""
    everywhere = {name: [pair] * len(X) for name, pair in offsets.items()}
    return Blade.from_stations(X, STIFFNESS, MASS, twist=0.5 * X, **everywhere)


def turning(blade):
    return blade.with_precone(0.05).with_hub_radius(0.1).with_tip_mass(0.1, offset=(0.02, 0.0))


def frequencies(blade, theory, count=6):
    return linear_modes(turning(blade), 2.0, count, theory=theory).frequencies


@pytest.mark.parametrize(
    ("by_ratios", "by_stations"),
    [
        (Theory(extension=False, trapeze=False, rotary_inertia=True),
         Theory(extension=False, trapeze=False)),
        (Theory(rotary_inertia=True), Theory()),
        (Theory(shear=0.3, rotary_inertia=True, trapeze=False), SHEARED),
    ],
)  # fmt: skip
def test_a_blade_by_ratios_is_the_same_by_stations(by_ratios, by_stations):
    """All digits: the same flexibility and inertia, by formulas and by inverting matrices."""
    blade = BEAM.with_section_out_of_plane(R, G).with_twist(0.5)
    blade = blade.with_offsets(mass=CENTERS["center"], tension=CENTERS["tension"])
    found = frequencies(stations(**CENTERS), by_stations)
    assert found == pytest.approx(frequencies(blade, by_ratios), rel=1e-11)


def test_the_axis_of_the_table_does_not_matter():
    """Columns about their centers, and matrices about another axis that a rigid section moves."""
    a, b = 0.2, 0.1
    away = {name: (c2 - a, c3 - b) for name, (c2, c3) in CENTERS.items()}
    known = frequencies(stations(**CENTERS), SHEARED)
    there = stations(**away, shear=(-a, -b), axis=(a, b))
    assert frequencies(there, SHEARED) == pytest.approx(known, rel=1e-11)
    table = stations(**away, shear=(-a, -b)).section
    moved = Blade.from_stations(X, table.stiffness, table.mass, twist=0.5 * X, axis=[(a, b)] * 4)
    assert frequencies(moved, SHEARED) == pytest.approx(known, rel=1e-11)
    at_stations = table.matrices(X)  # at the tip too
    assert at_stations == pytest.approx(np.array((table.stiffness, table.mass)), rel=1e-13)


def test_the_line_of_a_coupled_blade_does_not_matter():
    """At rest, of all 36 entries; in rotation the axis of rotation would meet another line."""
    S = np.array(stations(**CENTERS).section.stiffness)
    S[:, 3, 4] = S[:, 4, 3] = 0.02
    S[:, 1, 5] = S[:, 5, 1] = 5.0
    M = stations(**CENTERS).section.mass
    found, damped = [], []
    for c2 in (0.0, -0.04):
        blade = Blade.from_stations(X, S, M, axis=[(c2, 0.0)] * 4).with_setting_angle(0.3)
        found.append(linear_modes(blade, 0.0, 5, theory=SHEARED).frequencies)
        viscous = blade.with_damping(Damping(bending=0.01, axial=0.002))
        damped.append(damping_ratios(viscous, 0.0, 5, theory=SHEARED))
    assert found[0] == pytest.approx(found[1], rel=1e-9)  # polynomials of two lines, refined
    assert damped[0] == pytest.approx(damped[1], rel=1e-9)


def test_damping_of_bending_is_about_the_center_of_tension():
    """Moments of η_b damp by η_b ω/2, wherever the line is; a ratio asked for is of bending."""
    for c2 in (0.0, 0.05):
        blade = Blade.from_stations(X, STIFFNESS, MASS, tension=[(c2, 0.0)] * 4)
        blade = blade.with_damping(Damping.from_ratio(blade, 1, 0.01))
        ratios, frequencies = damping_ratios(blade, 0.0, 4), linear_modes(blade, 0.0, 4).frequencies
        assert ratios == pytest.approx(0.5 * blade.damping.bending * frequencies, rel=1e-5)
        assert ratios[1] == pytest.approx(0.01, rel=0.02)  # lag, which axial inertia slows


def test_each_component_of_strain_has_its_own_damping():
    """Of modes at rest that one component alone bends, ζ = ηω/2."""
    blade = unit_beam(1e-3).with_section_out_of_plane(R, G)
    rates = {"lag": 1e-3, "flap": 3e-3, "torsion": 5e-5}
    damping = Damping(bending=1e-3, out_of_plane=3e-3, torsion=5e-5)
    modes, ratios = (
        verb(blade.with_damping(damping), 0.0, 6) for verb in (linear_modes, damping_ratios)
    )
    expected = [
        0.5 * rates[name.split()[0]] * w
        for name, w in zip(modes.names, modes.frequencies, strict=True)
    ]
    assert {name.split()[0] for name in modes.names} == set(rates)
    assert ratios == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("turned", [0.0, 0.5])
def test_equal_damping_of_all_strains_goes_with_the_stiffness_however_it_couples(turned):
    S = np.array(stations(**CENTERS).section.stiffness)
    S[:, 3, 4] = S[:, 4, 3] = 0.02
    S[:, 0, 3] = S[:, 3, 0] = 3.0
    blade = Blade.from_stations(X, S, stations(**CENTERS).section.mass)
    blade = blade.with_twist(turned)
    modes = linear_modes(blade, 0.0, 5, theory=SHEARED)
    eta = 1e-3
    ratios = damping_ratios(
        blade.with_damping(Damping(bending=eta, axial=eta, shear=eta)), 0.0, 5, theory=SHEARED
    )
    assert ratios == pytest.approx(0.5 * eta * modes.frequencies, rel=1e-9)


def test_damping_takes_energy_from_every_motion_of_a_coupled_section():
    blade = stations(**CENTERS).with_damping(Damping(bending=0.0, torsion=1e-3, shear=2e-3))
    model = space_continuum(blade, SHEARED, 6)
    assert np.linalg.eigvalsh(model.functions.damping).min() > -1e-15


def test_shear_centers_off_the_line_twist_a_blade_under_a_dead_force():
    """GJ κ1 = -F c2: a force on the line bends straight and twists by its lever to the centers."""
    blade = Blade.from_stations(X, STIFFNESS, MASS, shear=[(0.02, 0.0)] * 4)
    state = steady_state(blade, 0.0, force=(0.0, 0.0, 1e-6), theory=SHEARED)
    steady = state.steady
    twist = steady.model.weights @ (steady.model.strains.K[0] @ steady.equilibrium)
    assert twist == pytest.approx(-0.02 * 1e-6 / G, rel=1e-6)  # and the square of the load


def test_stiffness_that_varies_against_another_between_stations():
    """Uniform but for GJ, half at the tip: Bessel's equation, J0'(..) of a bar in torsion.

    κ' of (GJ φ')' + ω² j φ = 0 with GJ = g (1 - x/2) and s = √(1 - x/2):
    φ = J0(z s) Y0(z) - Y0(z s) J0(z), z = 4 ω √(j/g), and φ'(1) = 0.
    """
    stiffness = STIFFNESS.copy()
    stiffness[:, 3] *= 1.0 - 0.5 * X

    def slope(z):
        s = math.sqrt(0.5)
        return special.j1(z * s) * special.y0(z) - special.y1(z * s) * special.j0(z)

    z = optimize.brentq(slope, 4.0, 8.0)
    known = 0.25 * z * math.sqrt(G / (MU * (1.0 + R)))
    modes = linear_modes(Blade.from_stations(X, stiffness, MASS), 0.0, 9, theory=SHEARED)
    torsion = int(np.argmax(modes.shares[:, 2]))
    assert modes.frequencies[torsion] == pytest.approx(known, rel=1e-9)


def test_stiffness_is_the_identity_but_where_the_section_couples():
    """And its elastic energy is that of the strains: symmetric, positive."""
    S = np.array(stations(**CENTERS).section.stiffness)
    S[:, 3, 5] = S[:, 5, 3] = 0.1
    for blade, identity in ((stations(), True), (Blade.from_stations(X, S, MASS), False)):
        model = space_continuum(blade, SHEARED, 6)
        K, own = model.functions.stiffness, model.strains
        assert (np.abs(K - np.eye(model.size)).max() < 1e-12) == identity
        assert np.linalg.eigvalsh(K)[0] > 0.0
        E = np.concatenate((own.gamma, own.K))
        turned = model.functions.flexibility(model.points)
        energy = np.einsum("ipk,p,pij,jpl->kl", E, model.weights, np.linalg.inv(turned), E)
        assert energy == pytest.approx(K, abs=1e-9)


def test_time_reversal_of_blades_from_stations():
    """A half turn, the mirror, or neither, as the matrices couple."""
    S = np.array(Blade.from_stations(X, STIFFNESS, MASS).section.stiffness)
    for entries, twist, reversible in (
        ((4, 5), 0.5, True), ((0, 3), 0.5, True), ((3, 4), 0.5, False), ((3, 5), 0.5, False),
        ((3, 4), 0.0, False), ((3, 5), 0.0, True),
    ):  # fmt: skip
        coupled = S.copy()
        size = 0.1 * np.sqrt(S[0, entries[0], entries[0]] * S[0, entries[1], entries[1]])
        coupled[:, entries[0], entries[1]] = coupled[:, entries[1], entries[0]] = size
        model = space_continuum(Blade.from_stations(X, coupled, MASS, twist=twist * X), SHEARED, 5)
        said = model.functions.odd
        assert (said is not None) == reversible, entries
        if said is not None:
            q, q_dot, q_ddot = 0.1 * np.random.default_rng(0).normal(size=(3, 2, model.size))
            here = model.residual(q, q_dot, q_ddot, Driven(2.0))
            sign = np.where(said, -1.0, 1.0)
            there = model.residual(sign * q, -sign * q_dot, sign * q_ddot, Driven(2.0))
            assert there == pytest.approx(sign * here, abs=1e-12)


def test_files_hold_it():
    blade = turning(stations(**CENTERS))
    assert from_description(describe(blade), Blade) == blade


def changed(array, entry, value):
    array = np.array(array)
    array[entry] = value
    return array


S66, M66 = stations().section.stiffness, stations().section.mass


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: Blade.from_stations(X, changed(S66, (1, 3, 4), 0.1), M66),
         r"x = 0.333333 m is not symmetric: entries \(4, 5\) and \(5, 4\) are 0.1 and 0"),
        (lambda: Blade.from_stations(X, changed(STIFFNESS, (2, 3), 0.0), MASS), "has GJ = 0"),
        (lambda: Blade.from_stations(X, changed(changed(S66, (1, 3, 4), 0.1), (1, 4, 3), 0.1), M66),
         "x = 0.333333 m is not positive definite.* -0.41"),
        (lambda: Blade.from_stations(X, S66, changed(M66, (0, 0, 0), 2.0)), "not that of a rigid"),
        (lambda: Blade.from_stations(X, S66, changed(M66, (0, 3, 3), -1.0)),
         "inertia of -1 kg m about"),
        (lambda: Blade.from_stations(X, S66, changed(MASS, (3, 0), 0.0)), "is 0 kg/m"),
        (lambda: Blade.from_stations(X, STIFFNESS[:, :5], MASS), "the columns EA, GA2, .*4, 5"),
        (lambda: Blade.from_stations(X[:3], S66, M66), "at each of the 3 stations"),
        (lambda: Blade.from_stations(X + 0.1, S66, M66), "from 0 to the length"),
        (lambda: stations().with_offsets(mass=(0.1, 0.0)), "define where the centers are"),
        (lambda: stations().with_section_out_of_plane(1.0, 1.0), "define the section out of"),
        (lambda: stations().with_kink(1.0, sweep=0.1), "not between clamp and tip, at 1 m"),
        (lambda: stations().with_kink(0.5, sweep="0.1"), "angle of a kink must be a number"),
        (lambda: stations().with_taper(0.1), "scale their values"),
        (lambda: linear_modes(stations(), 1.0, theory=Theory(shear=0.3)), "shear=True"),
        (lambda: linear_modes(BEAM, 1.0, theory=Theory(shear=True)), "others need the ratio"),
        (lambda: steady_state(stations(), 0.0, force=1.0), "must be three numbers"),
    ],
)  # fmt: skip
def test_bad_input(call, sentence):
    with pytest.raises((TypeError, ValueError), match=sentence):
        call()


def test_the_swept_tip_of_epps_and_chandra():
    """Steel strip on a hub with a swept tip, in inches and pounds; rows of another code.

    Its frequencies of bending are upper bounds, by 2e-4: at rest those of the straight strip, of
    which 26.08789 and 51.11330 Hz are the highest, are above Timoshenko's beam in its plane and
    above finite elements, which both meet this one. Lag and the tip's place are exact.
    """
    area, flap, lag, strain, density = 0.063, 0.063**3 / 12.0, 0.063 / 12.0, 1.06e7, 2.51e-4
    shear = np.array([area / 1.2, area / 14.625127919304001, (flap + lag) / 65.85255016982444])
    shear *= strain / (2.0 * (1.0 + 0.325))
    stiffness = [strain * area, *shear, strain * flap, strain * lag]
    mass = [density * area, density * (flap + lag), density * flap, density * lag]
    straight = Blade.from_stations([0.0, 37.5], [stiffness] * 2, [mass] * 2).with_hub_radius(2.5)
    strip = Section(
        axial_stiffness=strain * area, bending_stiffness=strain * flap,
        mass_per_length=density * area, rotary_inertia=density * flap,
    )  # fmt: skip
    ratio = Theory(shear=shear[1] / (strain * area))
    planar = linear_modes(Blade(length=37.5, section=strip), 0.0, 4, theory=ratio).frequencies
    at_rest = linear_modes(straight, 0.0, 5, theory=SHEARED, tolerance=1e-9).frequencies
    assert at_rest[[0, 1, 3, 4]] == pytest.approx(planar, rel=1e-9)
    by_elements = []
    for n in (200, 400):
        nodes = np.linspace(0.0, 37.5, n + 1)[:, None] * [1.0, 0.0, 0.0]
        same = (
            np.tile(one, (n, 1, 1))
            for one in (np.eye(3), *straight.section.matrices(np.zeros(1))[:, 0])
        )
        by_elements.append(finite_elements(nodes, *same, 5))
    # Their errors fall by fours, to 2e-8 in the fifth.
    assert (4.0 * by_elements[1] - by_elements[0]) / 3.0 == pytest.approx(at_rest, rel=4e-8)
    omega = 750.0 * math.pi / 30.0
    swept = straight.with_kink(31.5, sweep=-0.25 * math.pi)
    for blade, known, tip in (
        (straight, [13.54979, 24.53872, 34.00088, 59.47985, 91.78109], [0.0028245, 0.0]),
        (swept, [13.56458, 24.90040, 26.07973, 42.99433, 76.42157], [0.0573986, 0.1848354]),
    ):
        modes = linear_modes(blade, omega, 5, theory=SHEARED, tolerance=1e-9)
        found = modes.frequencies / (2.0 * math.pi)
        assert found == pytest.approx(known, rel=3e-5)
        assert found[1] == pytest.approx(known[1], abs=6e-6)
        assert np.all(found < np.array(known) + 6e-6)
        moved = (steady_state(blade, w, theory=SHEARED).tip[:2] for w in (omega, 0.0))
        assert np.subtract(*moved) == pytest.approx(tip, abs=6e-8)


def test_a_line_of_twenty_kinks_is_nearly_that_of_a_smooth_sweep():
    """A panel lies between two of them, so that the first size is beyond the usual most."""
    kinked = straight = told(BEAM, 2.0 * MU, R, G)
    for place in (np.arange(1, 21) / 21).tolist():
        kinked = kinked.with_kink(place, sweep=0.005)
    swept = straight.with_sweep(0.005 * 21)
    frequencies = linear_modes(kinked, 1.0, 3).frequencies
    assert frequencies == pytest.approx(linear_modes(swept, 1.0, 3).frequencies, rel=1e-5)


def test_kinks_turn_what_lies_beyond_them_about_axes_of_their_own_section():
    """Three straight parts, the sections of which are set and twisted; rotations by scipy."""
    blade = BEAM.with_section_out_of_plane(1.0, 1.0).with_setting_angle(0.4).with_twist(0.5)
    blade = blade.with_kink(0.3, prebend=0.6, sweep=-0.2).with_kink(0.6, sweep=0.8)
    state = steady_state(blade, 0.0, theory=Theory(extension=False, trapeze=False))
    turn, known = np.eye(3), np.array([0.3, 0.0, 0.0])
    for at, length, angles in ((0.3, 0.3, [0.0, 0.6, -0.2]), (0.6, 0.4, [0.0, 0.0, 0.8])):
        section = Rotation.from_rotvec([0.4 + 0.5 * at, 0.0, 0.0])
        turn = turn @ Rotation.from_rotvec(section.apply(angles)).as_matrix()
        known = known + length * turn[:, 0]
    assert state.tip == pytest.approx(known, abs=1e-12)


def test_kinks_at_one_place_follow_each_other():
    """As kinks that are close together."""
    straight = BEAM.with_section_out_of_plane(R, G)
    at_once, close = (
        steady_state(straight.with_kink(0.5, 0.2).with_kink(there, 0.1, 0.1), 1.0).tip
        for there in (0.5, 0.5 + 1e-9)
    )
    assert at_once == pytest.approx(close, abs=1e-8)


# x, twist [degrees], m, EI2, EI3, GJ, EA, j2, j3: stations of a blade of 61.5 m, among many more.
LARGE = np.array([
    [0.0, 13.308, 678.9, 1.811e10, 1.811e10, 5.564e9, 9.729e9, 972.9, 973.0],
    [5.2, 13.308, 450.3, 7.230e9, 1.022e10, 2.324e9, 5.491e9, 456.8, 641.5],
    [15.2, 11.072, 349.5, 2.389e9, 4.948e9, 3.114e8, 3.012e9, 148.6, 453.8],
    [24.2, 8.534, 313.8, 1.362e9, 3.751e9, 1.744e8, 1.944e9, 80.2, 308.6],
    [36.2, 4.971, 220.6, 3.145e8, 1.829e9, 4.592e7, 7.608e8, 17.3, 134.8],
    [48.2, 2.116, 129.6, 7.631e7, 7.096e8, 1.453e7, 3.289e8, 4.4, 61.4],
    [57.2, 0.319, 66.3, 2.384e7, 2.617e8, 4.940e6, 9.224e7, 1.3, 17.1],
    [61.5, 0.0, 10.3, 1.700e5, 5.010e6, 1.900e5, 3.530e6, 0.02, 0.68],
])  # fmt: skip


def large():
    x, twist, m, flap, lag, torsion, axial, j2, j3 = LARGE.T
    stiffness = np.stack([axial, axial, axial, torsion, flap, lag], axis=1)
    mass = np.stack([m, j2 + j3, j2, j3], axis=1)
    return Blade.from_stations(x, stiffness, mass, twist=np.radians(twist)).with_hub_radius(1.5)


def test_frequencies_of_a_table_with_kinks_settle():
    """Torsion too, whose functions are those of the inertia at the stations: to 1e-7."""
    modes = linear_modes(large(), 1.267, 6)
    assert modes.error < 1e-7
    finer = rotating_blade(large(), 1.267, modes.model.refined()).vibration[0][:6]
    assert modes.frequencies == pytest.approx(large().frequency_scale * finer, rel=2e-8)


@pytest.mark.slow
def test_orbits_of_a_table_with_kinks_are_reached():
    """Kinks leave a residual of 2e-4 and no change of the frequency."""
    orbits = periodic_orbits(large(), 1.267, [0.01], mode="flap 1")
    assert orbits.frequency_error[0] < 1e-8
    softening = (1.0 - orbits.frequency[0] / orbits.omega_n) / 0.01**2
    assert softening == pytest.approx(orbits.lambda_omega, rel=1e-2)  # 7e-8 of the frequency
