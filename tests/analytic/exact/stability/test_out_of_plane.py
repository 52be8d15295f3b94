"""Motion out of the plane: the second-order Lagrangian, its limits, and resonances of a bar."""

import math
from dataclasses import asdict

import numpy as np
import pytest
from scipy import optimize

from analytic import (
    Beam,
    Blade,
    Damping,
    Rectangle,
    Section,
    SpeedRipple,
    Theory,
    forced_response,
    linear_modes,
    periodic_orbits,
)
from analytic.exact.continuum.discretization import space_continuum
from analytic.exact.continuum.planar_rotation import blade_continuum
from analytic.exact.continuum.rotation import SteadyBlade, rotating_blade
from analytic.exact.driven.forced import DrivenBlade
from analytic.exact.stability.growth import STEPS, grown
from analytic.exact.stability.out_of_plane import FlapTorsion, OutOfPlaneMotion, with_points_for
from analytic.methods.floquet import flow
from analytic.methods.system import Tangent
from analytic.parts import UNDAMPED
from analytic.quadrature import gauss_points
from analytic.section import OutOfPlane
from analytic.theory import BERNOULLI_EULER
from tests.beams import clamped_basis, told, unit_beam

RIGID = math.inf
BEAM = Beam.reference()
SLENDER = OutOfPlane(bending_ratio=0.01, torsion_ratio=RIGID)
ROUND = OutOfPlane(bending_ratio=1.0, torsion_ratio=RIGID)


STRIP = BEAM.with_shape(Rectangle()).section.out_of_plane
DAMPING = Damping(bending=5e-3)
SLENDER_LIMIT = Theory(extension=False)


def growth(section, w_bar, a, *, theory=SLENDER_LIMIT, functions=12, steps=STEPS):
    blade = BEAM.with_section_out_of_plane(**asdict(section))
    (orbit,) = periodic_orbits(
        blade, w_bar * blade.frequency_scale, a, theory=theory
    ).nondimensional
    return grown(blade, orbit, functions, steps)


class Across:
    """κ2 and κ1 of the blade in space about a planar orbit, as `methods.floquet` sees an orbit."""

    def __init__(self, orbit, system):
        self.orbit, self.system, self.frequency = orbit, system, orbit.frequency
        bending, torsion, axial, _ = system.model.functions.counts
        planar = orbit.system.model
        self.out = np.append(np.arange(1, bending, 2), np.arange(bending, bending + torsion))
        lag, along = np.arange(0, 2 * planar.bending, 2), np.arange(min(axial, planar.axial))
        self.inside = np.append(lag, bending + torsion + along)

    def tangent(self, phase):
        state = np.zeros((3, phase.size, self.system.size))
        state[:, :, self.inside] = np.array(self.orbit.coordinates(phase))[..., : self.inside.size]
        at = self.system.tangent(*state, *self.orbit.drive(phase))
        for part in at[1:]:
            mixed = np.delete(part, self.out, axis=2)[:, self.out]
            assert np.abs(mixed).max() < 1e-13 * np.abs(part).max(), "the plane is invariant"
        return Tangent(
            at.residual[:, self.out], *(x[:, self.out[:, None], self.out] for x in at[1:])
        )


@pytest.mark.parametrize(
    ("section", "a", "theory", "damping", "digits"),
    [
        # Of slices without any inertia L2 leaves nothing out.
        (SLENDER, 0.3917, Theory(extension=False, trapeze=False), UNDAMPED, 1e-8),
        pytest.param(
            SLENDER, 0.3917, Theory(trapeze=False), UNDAMPED, 1e-8, marks=pytest.mark.slow
        ),
        # Which changes the growth by 1e-3 and 1e-1 of itself.
        (SLENDER, 0.3917, Theory(trapeze=False), DAMPING, 1e-8),
        # L2 leaves out what ϑ̇β adds to φ̇, and the inertia of whole slices against flap: 4e-5.
        pytest.param(STRIP, 0.045, Theory(), UNDAMPED, 1e-4, marks=pytest.mark.slow),
        (STRIP, 0.045, Theory(), DAMPING, 1e-4),
        (STRIP, 0.045, Theory(trapeze=False, rotary_inertia=True), UNDAMPED, 1e-4),
    ],
)
def test_it_is_the_tangent_of_the_blade_in_space(section, a, theory, damping, digits):
    """Multipliers and growth by L2 in w and φ, and by the strains κ2 and κ1: two derivations."""
    inertia = 0.0 if section is SLENDER else None
    blade = told(BEAM, inertia, section.bending_ratio, section.torsion_ratio)
    (orbit,) = periodic_orbits(blade, 2.0, a, theory=theory).nondimensional
    blade = blade.with_damping(damping)
    known = grown(blade, orbit, 16, 48, theory)
    model = space_continuum(blade, theory, max(16, orbit.system.model.bending))
    across = Across(orbit, SteadyBlade(model, orbit.system.rate))
    # Nothing resists the free orbit.
    model.functions.damping[across.inside] = 0.0
    matrix, exponent = flow(across, 48)
    found = np.linalg.eigvals(matrix) * np.exp(exponent)
    assert known.unstable
    assert np.log(np.abs(found)).max() == pytest.approx(known.exponent, rel=digits)
    apart = np.abs(found[:, None] - known.multipliers).min(axis=0)
    assert (apart / np.maximum(1.0, np.abs(known.multipliers))).max() < 5.0 * digits


def test_about_a_damped_response_it_is_the_tangent_of_the_blade_in_space():
    """With the viscous moment of the response, a third of its elastic one; a = 0.26."""
    blade, load = BEAM.with_section_out_of_plane(**asdict(STRIP)), SpeedRipple(amplitude=0.2)
    blade = blade.with_damping(Damping(bending=0.1, out_of_plane=0.05, torsion=0.2))
    orbit = forced_response(blade, 2.0, load, [3.0, 3.1]).nondimensional[0]
    known = grown(blade, orbit, 16, 48, Theory())
    model = space_continuum(blade, Theory(), max(16, orbit.system.model.bending))
    across = Across(
        orbit,
        DrivenBlade(
            model=model, rate=orbit.system.speed(orbit.frequency), drive=orbit.system.drive
        ),
    )
    matrix, size = flow(across, 48)
    found = np.log(np.abs(np.linalg.eigvals(matrix)).max()) + size
    # As above: the inertia of the sections against flap.
    assert found == pytest.approx(known.exponent, rel=1e-4)


@pytest.mark.parametrize("section", [STRIP, ROUND])
def test_what_the_viscosity_adds_to_the_stiffness_is_half_the_rate_of_the_damping(section):
    """Strains s(q) have C = ∫η sᵀs and air, and ∫η sᵀṡ with its transpose is Ċ."""
    blade = unit_beam(1e-2).with_section_out_of_plane(**asdict(section))
    space = FlapTorsion(blade.with_damping(Damping(bending=0.1, external=0.3)), 6)
    planar, h = SteadyBlade(blade_continuum(space.blade, BERNOULLI_EULER, 8, 6), 2.0), 1e-5
    q, rate = 0.3 * np.random.default_rng(5).normal(size=(2, 1, planar.size))
    more = space.resistance(planar, q, rate)[1]
    after, before = (space.resistance(planar, q + step * rate, rate)[0] for step in (h, -h))
    assert more + np.swapaxes(more, 1, 2) == pytest.approx((after - before) / (2.0 * h), abs=1e-6)


def test_damping_by_mass_decays_as_the_undamped_motion_of_less_stiffness():
    """M q̈ + cM q̇ + K q = 0 is solved by exp(-ct/2) p, M p̈ + (K - c²M/4) p = 0: exactly."""
    blade, c = BEAM.with_section_out_of_plane(**asdict(SLENDER)), 0.3
    (orbit,) = periodic_orbits(blade, 2.0, 0.3917, theory=SLENDER_LIMIT).nondimensional
    damping = Damping(external=c * blade.frequency_scale * blade.mass_per_length)
    found = grown(blade.with_damping(damping), orbit, 12, 48).multipliers

    class Softer(OutOfPlaneMotion):
        def tangent(self, phase):
            at = super().tangent(phase)
            return at._replace(stiffness=at.stiffness - 0.25 * c**2 * at.mass)

    softer = Softer(orbit.on(with_points_for(orbit.system, 12)), FlapTorsion(blade, 12))
    values = np.linalg.eigvals(flow(softer, 48)[0]) * np.exp(-c * np.pi / orbit.frequency)
    apart = np.abs(values[:, None] - found).min(axis=0)
    assert apart == pytest.approx(0.0, abs=1e-9)


def test_small_orbits_leave_each_mode_its_damping_ratio():
    """About the straight blade M, C and K have the same modes: exp(2π(-ζ ± i√(1 - ζ²))ν/Ω)."""
    # Of little torsional stiffness, so that its first mode is among the lowest four.
    blade, ratio = BEAM.with_section_out_of_plane(0.1, 1e-4), 0.02
    multipliers = periodic_orbits(blade, 4.0, 1e-4).out_of_plane(damping=ratio).multipliers[0]
    frequency = linear_modes(blade, 4.0, 1, only="lag").frequencies[0]
    for plane in ("flap", "torsion"):
        own = linear_modes(blade, 4.0, 1, only=plane).frequencies[0]
        wanted = np.exp(2.0 * np.pi * own / frequency * (-ratio + 1j * math.sqrt(1.0 - ratio**2)))
        # The modes are right to 1e-5 or so, and the orbit changes them by its square.
        assert np.abs(multipliers - wanted).min() < 1e-4


@pytest.mark.parametrize(
    ("blade", "digits"),
    # What 18 functions and the round-off of K leave; at a mass inside e jumps, and w' with it.
    [
        (BEAM, 2e-8),
        (BEAM.with_hub_radius(4.0).with_tip_mass(0.5), 2e-8),
        (BEAM.with_taper(0.3, 0.3).with_point_mass(0.2, 5.0), 2e-6),
        (
            unit_beam(5e-4),
            2e-8,
        ),
    ],
    ids=["paper", "hub and mass", "taper and mass inside", "stocky"],
)
def test_about_the_steady_state_it_has_the_flap_modes(blade, digits):
    """Those of a blade that is turned by a right angle, by other equations: in ϑ and e, not w."""
    blade, omega = blade.with_section_out_of_plane(0.3, 0.2), 5.0 * blade.frequency_scale
    space = FlapTorsion(blade, 18)
    model = blade_continuum(blade, BERNOULLI_EULER, 24, 16)
    steady = rotating_blade(blade, omega, model)
    still = np.zeros((1, steady.size))
    (K,) = space.stiffness(steady, steady.equilibrium[None], still, still)
    n = space.functions
    squares = 1.0 / np.linalg.eigvals(np.linalg.solve(K[:n, :n], space.mass[:n, :n])).real
    found = np.sqrt(np.sort(squares)[:3]) * blade.frequency_scale
    assert found == pytest.approx(linear_modes(blade, omega, only="flap").frequencies, rel=digits)
    assert np.all(K[:n, n:] == 0.0), "the straight blade does not twist as it bends"


def test_torsional_frequencies_are_those_of_a_rod(beam):
    blade = beam.with_shape(Rectangle())
    section = blade.section.out_of_plane
    rod = math.sqrt(section.torsion_ratio / (beam.slenderness * (1.0 + section.bending_ratio)))
    rod *= beam.frequency_scale
    modes = linear_modes(blade, 0.0, only="torsion")
    assert modes.frequencies == pytest.approx(0.5 * np.pi * rod * np.array([1, 3, 5]), rel=1e-10)
    x = np.linspace(0.0, beam.length, 5)
    twist = modes.shapes(x)[3, :, 1].real
    assert twist == pytest.approx(-np.sin(1.5 * np.pi * x / beam.length), abs=1e-9)
    assert modes.shares == pytest.approx(np.eye(4)[[2] * 3], abs=1e-12)
    inertia = 4.0 * beam.slenderness * beam.mass_per_length * beam.length**2
    doubled = told(beam, inertia, section.bending_ratio, section.torsion_ratio)
    halved = linear_modes(doubled, 0.0, only="torsion").frequencies
    assert halved == pytest.approx(0.5 * modes.frequencies, rel=1e-10)


@pytest.mark.parametrize("r", [1e-9, 0.05, 1.0, 20.0])
def test_a_bundle_of_loose_fibres_twists_as_fast_as_it_turns(r):
    """With GJ → 0, Legendre's equation: ν² = w²[n(n + 1)/2 + (1 - r)/(1 + r)], n = 1, 3, 5.

    A sheet on edge, r → ∞, then has ν = 0: each of its fibres hangs outwards in a plane of its own.
    """
    section = Section(axial_stiffness=1e8, bending_stiffness=1.0, mass_per_length=1.0)
    blade = Blade(length=1.0, section=section).with_section_out_of_plane(r, 1e-12)
    found = linear_modes(blade, 10.0, only="torsion").frequencies / 10.0
    n = np.array([1.0, 3.0, 5.0])
    wanted = np.sqrt(0.5 * n * (n + 1.0) + (1.0 - r) / (1.0 + r))
    assert found == pytest.approx(wanted, rel=1e-5)  # GJ, and the stretch of 1e-6


def test_the_propeller_moment_is_that_of_the_moving_plane():
    """Ω = ϑ̇ + w: about a blade as it swings through its straight shape, along it as ϑ̇ does."""
    inertia = 1e-2 * BEAM.mass_per_length * BEAM.length**2
    blade = told(BEAM, inertia / 1.5, 0.5, 1e-3)
    model = blade_continuum(blade, Theory(extension=False), 12, 1)
    space, planar = FlapTorsion(blade, 8), SteadyBlade(model, 2.0)
    still, swinging = np.zeros((1, model.size)), np.zeros((1, model.size))
    swinging[0, 0] = 1.5  # ϑ̇ = 1.5 x, the first of Legendre's polynomials being ϑ' = 1
    n = space.functions
    at_rest, moving = (
        space.stiffness(planar, still, v, still)[0, n:, n:] for v in (still, swinging)
    )
    x, dx = gauss_points(24)
    phi = clamped_basis(n, x, 1).value
    iota = 1e-2 * (1.0 - 0.5) / (1.0 + 0.5)
    wanted = phi.T @ ((dx * iota * ((2.0 + 1.5 * x) ** 2 - 4.0))[:, None] * phi)
    # The tension of the swing adds what the trapeze effect makes of it: μ to 1e-2.
    assert moving - at_rest == pytest.approx(wanted, abs=2e-3 * np.abs(wanted).max())


def test_a_section_that_the_rotation_turns_over_is_refused():
    """On edge, r = 4, and more inertia about its axis than the tension holds."""
    inertia = 0.1 * BEAM.mass_per_length * BEAM.length**2
    blade = told(BEAM, inertia / 5.0, 4.0, 0.01)
    with pytest.raises(ValueError, match="state ends or becomes unstable at .* rotate slower"):
        linear_modes(blade, 6.0, only="torsion")
    assert linear_modes(blade, 0.1, 1, only="torsion").frequencies[0] > 0.0
    own = BEAM.with_section_out_of_plane(4.0, 0.01)
    assert linear_modes(own, 6.0, 1, only="torsion").frequencies[0] > 0.0


@pytest.mark.parametrize(
    ("curvature", "known", "digits"),
    # P L²/√(EI_out GJ) of a force P at the tip, ϑ' = P(1 - x), and the same of the whole weight W,
    # ϑ' = W(1 - x)²/2; both in the first of Legendre's polynomials.
    [
        ((0.5, -0.5 / math.sqrt(3.0)), 4.0126, 5e-5),
        ((1.0 / 6.0, -0.25 / math.sqrt(3.0), 1.0 / (12.0 * math.sqrt(5.0))), 12.85, 0.01),
    ],
    ids=["force at the tip", "own weight"],
)
def test_a_bar_bent_on_edge_buckles_where_timoshenko_says(curvature, known, digits):
    """In the limit of a bar that hardly bends in its plane."""
    small = 1e-8
    blade = BEAM.with_section_out_of_plane(small, small)
    model = blade_continuum(blade, Theory(extension=False), 8, 1)
    shape = np.zeros(model.size)
    shape[: len(curvature)] = curvature
    still, straight = np.zeros((1, model.size)), SteadyBlade(model, 0.0)

    def least(load):
        bent = load * small * shape[None]
        (K,) = FlapTorsion(blade, 8).stiffness(straight, bent, still, still)
        return np.linalg.eigvalsh(K / small)[0]

    assert optimize.brentq(least, 0.75 * known, 1.17 * known) == pytest.approx(known, abs=digits)


@pytest.mark.parametrize(
    ("section", "a", "edge", "into"),
    [
        # Flap is half of lag near w̄ = 1.68284, and one and a half of it near 4.42.
        (SLENDER, 0.2, 1.36191, 1.0),
        (SLENDER, 0.2, 2.04929, -1.0),
        (ROUND, 0.5, 4.40714, 1.0),
        (ROUND, 0.5, 4.43220, -1.0),
    ],
)
def test_edges_of_the_tongues(section, a, edge, into):
    """Of the inextensible beam, to 1e-4; another code found them."""
    inside, outside = (growth(section, edge + sign * into * 1e-4, a) for sign in (1.0, -1.0))
    assert inside.unstable
    assert inside.kind == "period doubling"
    assert inside.modes[0] == "flap 1"
    assert not outside.unstable
