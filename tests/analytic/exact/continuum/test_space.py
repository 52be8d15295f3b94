"""The blade in space: its equations against the plane, differences, conservation, symmetries."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from analytic.exact.continuum.basis import StrainFunctions
from analytic.exact.continuum.planar import Continuum
from analytic.exact.continuum.rotation import SteadyBlade
from analytic.exact.continuum.space import SpaceContinuum
from analytic.exact.continuum.state import Driven
from analytic.exact.continuum.unit import SpaceUnit
from analytic.exact.continuum.vectors import Frames
from analytic.parts import Damping, Line
from analytic.theory import Theory

DAMPING = Damping(bending=0.1, axial=0.05, external=0.2)
ALL = SpaceUnit(
    hub=0.3, flap=0.2, torsion=0.1, angle=0.3, bending=(1.0, -0.4),
    masses=((0.6, 0.2, 0.01), (1.0, 0.3, 0.02)), body_offsets=((0.0, 0.1), (0.05, 0.02)),
    line=Line(
        twist=(0.0, 0.7, -0.2), precone=0.1, prebend=0.1, sweep=(0.05, 0.1),
        mass_offset=(0.03, 0.02), tension_offset=(0.02, -0.01), kinks=((0.3, 0.2, -0.1),),
    ),
)  # fmt: skip
"""All that a blade may have, but damping."""
THEORIES = [
    Theory(shear=0.3, rotary_inertia=True),
    Theory(),
    Theory(extension=False),
    Theory(extension=False, trapeze=False),
]


def space(blade, theory=Theory(), slenderness=1e-2, bending=5, torsion=4, axial=3):  # noqa: B008
    return SpaceContinuum(StrainFunctions(blade, theory, slenderness, bending, torsion, axial))


def states(model, size, samples=2, seed=0):
    return size * np.random.default_rng(seed).normal(size=(3, samples, model.size))


@pytest.mark.parametrize("shear", [None, 0.3])
def test_in_the_plane_it_is_the_planar_beam_in_its_coordinates(shear):
    """Residual and tangent, of a blade on a hub with a tip mass, drag and viscosity."""
    blade = SpaceUnit(
        hub=0.4, masses=((1.0, 0.3, 0.02),), body_offsets=((0.0, 0.0),), damping=DAMPING,
        flap=0.3, torsion=0.2,
    )  # fmt: skip
    planar = Continuum(1e-2, 8, 6, blade=blade, shear=shear)
    model = space(blade, Theory(shear=shear, trapeze=False), 1e-2, 8, 4, 6)
    bending, torsion, axial, across = model.functions.counts
    start = bending + torsion
    own = np.concatenate(
        (np.arange(0, bending, 2), start + np.arange(axial), start + axial + np.arange(across // 2))
    )
    others = np.setdiff1d(np.arange(model.size), own)
    # Decaying coefficients, which the Gauss points of both resolve.
    x = 0.3 * np.random.default_rng(1).normal(size=(3, 4, planar.size))
    x *= (
        3.0
        ** -np.concatenate(
            [np.arange(8)] + [np.arange(6)] * (planar.size // 6 - 1 + (shear is None) * 0)
        )[: planar.size]
    )
    by = Driven(*np.random.default_rng(2).normal(size=(2, 4)))
    X = np.zeros((3, 4, model.size))
    X[:, :, own] = x
    one, other = planar.tangent(*x, by), model.tangent(*X, by)
    assert other.residual[:, own] == pytest.approx(one.residual, abs=1e-12)
    assert np.abs(other.residual[:, others]).max() < 1e-14
    for name in ("stiffness", "damping", "mass"):
        own_part = getattr(other, name)[:, own[:, None], own]
        assert own_part == pytest.approx(getattr(one, name), abs=1e-11)
    assert model.residual(*X, by)[:, own] == pytest.approx(one.residual, abs=1e-12)
    places = np.array([0.0, 0.4, 1.0])
    force, moment = model.section_loads(places, *X, by)
    planar_force, planar_moment = planar.section_loads(places, *x, by)
    scale = np.abs(planar_force).max()
    assert force == pytest.approx(planar_force, abs=1e-10 * scale)
    assert moment == pytest.approx(planar_moment, abs=1e-10 * scale)
    for one in (planar_force[..., 2], planar_moment[..., :2]):
        assert not one.any()


def test_loads_of_the_sections_are_those_of_their_strains():
    """All six of a rotating blade that has all there is but point masses, by the section's law."""
    model = space(
        replace(ALL, masses=(), body_offsets=()),
        Theory(shear=0.3, rotary_inertia=True, trapeze=False), bending=14, torsion=12, axial=12,
    )  # fmt: skip
    steady = SteadyBlade(model, 2.0)
    q, x = steady.equilibrium[None], np.array([0.0, 0.2, 0.5, 0.9])
    found = np.concatenate(steady.section_loads(x, q, 0.0 * q, 0.0 * q), axis=-1)[0]
    functions, at = model.functions, model.functions.at(x)
    strains = np.concatenate((at.gamma @ q[0], at.K @ q[0]))
    turned = functions.blade.section_frames(x)
    law = np.linalg.solve(functions.flexibility(x), strains.T[..., None])[..., 0]
    law = np.einsum("jip,pkj->pki", turned, law.reshape(-1, 2, 3)).reshape(-1, 6)
    # The law's are projected on functions, those by d'Alembert are not.
    np.testing.assert_allclose(found, law, atol=1e-6 * np.abs(law).max())


@pytest.mark.parametrize("theory", THEORIES)
def test_the_tangent_is_the_derivative_of_the_residual(theory):
    model = space(replace(ALL, damping=DAMPING), theory)
    x, rng = states(model, 0.1), np.random.default_rng(3)
    w, w_dot = rng.normal(size=(2, 2))
    push = rng.normal(size=(3, 3, 2, model.points.size)) * model.weights
    push[1] = push[1][..., :1]
    at, h = model.tangent(*x, Driven(w, w_dot, push)), 1e-6
    for k, name in enumerate(("stiffness", "damping", "mass")):
        step = np.zeros_like(x)
        found = np.empty_like(getattr(at, name))
        for j in range(model.size):
            step[k, :, j] = h
            found[:, :, j] = (
                model.residual(*(x + step), Driven(w, w_dot, push))
                - model.residual(*(x - step), Driven(w, w_dot, push))
            ) / (2.0 * h)
            step[k, :, j] = 0.0
        # Round-off of the differences is 1e-10; frames are resolved to 1e-9 on these points.
        assert found == pytest.approx(getattr(at, name), abs=5e-9)
    assert np.abs(at.mass - np.swapaxes(at.mass, 1, 2)).max() < 1e-15


@pytest.mark.parametrize("theory", THEORIES)
def test_about_the_steady_state_stiffness_is_symmetric_and_coriolis_skew(theory):
    steady = SteadyBlade(space(ALL, theory, slenderness=1e-4, bending=8), 2.0)
    at = steady.linearized
    (K,), (C,) = at.stiffness, at.damping
    assert np.abs(at.residual).max() < 1e-12
    assert np.abs(K - K.T).max() < 1e-8  # as well as the frames are resolved
    assert np.abs(C + C.T).max() < 1e-8


@pytest.mark.parametrize(("acts_on", "tip"), [("tip", 1 / 3), ("length", 1 / 8), ("mass", 1 / 8)])
def test_a_small_load_bends_the_blade_as_in_a_handbook(acts_on, tip):
    """FL³/3EI and qL⁴/8EI: across it in lag, and what of the radial one the precone turns down."""
    cone, flap, size = 0.3, 0.5, 1e-6
    blade = SpaceUnit(flap=flap, torsion=0.1, line=Line(precone=cone))
    model = space(blade, Theory(extension=False, trapeze=False), bending=8)
    still = np.zeros((2, model.size))
    at = model.tangent(
        still, still, still, Driven(0.0, push=model.push(size * np.array([1, 1j]), acts_on))
    )
    moved = model.tip(-np.linalg.solve(at.stiffness, at.residual[..., None])[..., 0]) / size
    assert moved[0, 1:] == pytest.approx([0.0, -math.sin(cone) * tip / flap], abs=1e-5)
    assert moved[1, 1:] == pytest.approx([tip, 0.0], abs=1e-5)


@pytest.mark.parametrize("theory", THEORIES)
def test_the_power_of_all_forces_is_the_rate_of_the_jacobi_integral(theory):
    """q̇ · residual of any motion at a constant speed; q + q̇τ + q̈τ²/2 by differences."""
    model, rate = space(ALL, theory), 1.7
    q, q_dot, q_ddot = states(model, 0.1)
    h, energy = 1e-4, []
    for at in (h, -h):
        here, there = q + at * q_dot + 0.5 * at**2 * q_ddot, q_dot + at * q_ddot
        energy.append(model.kinetic_energy(here, there) + model.amended_potential(here, rate))
    power = np.sum(q_dot * model.residual(q, q_dot, q_ddot, Driven(rate)), axis=1)
    assert (energy[0] - energy[1]) / (2.0 * h) == pytest.approx(power, rel=1e-6)


@pytest.mark.parametrize("component", [1, 2])
def test_the_gauge_is_how_far_the_tip_has_moved_along_its_component(component):
    """Zero in the steady state; its gradient and its rate by differences."""
    steady = SteadyBlade(space(ALL, slenderness=1e-4, bending=8), 2.0, component)
    model, still = steady.model, steady.equilibrium[None]
    assert steady.gauge(still) == pytest.approx(0.0, abs=1e-14)
    q, q_dot, _ = states(model, 0.1)
    moved, rest = (model.places(state, np.ones(1))[:, 0] for state in (q, still))
    assert steady.gauge(q) == pytest.approx((moved - rest)[:, component], abs=1e-12)
    h = 1e-6
    rate = (steady.gauge(q + h * q_dot) - steady.gauge(q - h * q_dot)) / (2.0 * h)
    assert steady.gauge_rate(q, q_dot) == pytest.approx(rate, abs=1e-8)
    assert np.sum(steady.gauge_gradient(q) * q_dot, axis=1) == pytest.approx(rate, abs=1e-8)


@pytest.mark.parametrize(
    ("change", "odd"),
    [
        ({"line": Line(twist=(0.0, 0.7)), "angle": 0.4}, "half turn"),
        ({"line": Line(precone=0.2, prebend=0.1, mass_offset=(0.0, 0.05))}, "mirror"),
        ({"line": Line(precone=0.2, kinks=((0.5, 0.3, 0.0),))}, "mirror"),
        ({"line": Line(precone=0.2, kinks=((0.5, 0.0, 0.3),))}, None),
        ({"line": Line(twist=(0.0, 0.7), precone=0.2)}, None),
        ({"line": Line(mass_offset=(0.05, 0.0))}, None),
    ],
)
def test_time_reversal_maps_motions_onto_motions_where_it_is_said_to(change, odd):
    blade = SpaceUnit(hub=0.3, flap=0.2, torsion=0.1, **change)
    model = space(blade, Theory(rotary_inertia=True))
    said, (q, q_dot, q_ddot) = model.functions.odd, states(model, 0.1)
    here = model.residual(q, q_dot, q_ddot, Driven(2.0))
    bending = model.functions.counts[0]
    if odd is None:
        assert said is None
        # Neither of the two maps of space.
        tried = [np.arange(model.size) < bending]
    else:
        tried = [said]
    for turned in tried:
        sign = np.where(turned, -1.0, 1.0)
        there = model.residual(sign * q, -sign * q_dot, sign * q_ddot, Driven(2.0))
        off = np.abs(there - sign * here).max()
        assert (off < 1e-12) == (odd is not None)


def test_the_unloaded_line_is_that_of_the_equations_kinks_included():
    """Elements of other codes begin on it; without the kink the tip is 0.15 away."""
    model, x = space(ALL, bending=12), np.array([0.2, 0.5, 1.0])
    place, sections = ALL.unloaded(x)
    (expected,) = model.places(np.zeros((1, model.size)), x)
    assert place == pytest.approx(expected, abs=1e-12)
    assert sections @ sections.swapaxes(1, 2) == pytest.approx(np.tile(np.eye(3), (3, 1, 1)))


@pytest.mark.parametrize("turns", [0.5, 1.0, 4.0])
def test_frames_of_a_helix(turns):
    """With constant curvatures the frame turns evenly about them, wound up by several turns too."""
    model = space(SpaceUnit(flap=0.5, torsion=0.1), bending=12)
    frames = Frames(model.blade.running(model.functions.grid, np.array([0.5, 1.0])))
    K = turns * np.array([0.5, -2.0, 3.0])
    found = frames.of(np.broadcast_to(K[:, None, None], (3, 1, model.points.size)))[:, :, 0]
    for x, R in zip([*model.points, 0.5, 1.0], np.moveaxis(found, -1, 0), strict=True):
        assert pytest.approx(Rotation.from_rotvec(x * K).as_matrix(), abs=1e-12) == R
