"""The inertia of point masses against rotation, in every element that takes blades."""

import exudyn
import numpy as np
import pytest
from exudyn.itemInterface import NodePoint2DSlope1, ObjectGenericODE2

from analytic import SpinUp, linear_modes, spin_up_response
from rotbeam_exu import natural_frequencies, simulate
from rotbeam_exu.fem.elements import Ancf3, Chain, Exact
from rotbeam_exu.fem.elements.energy_body import add_point_inertias, spins
from rotbeam_exu.fem.solver import Sensors, exudyn_system


@pytest.fixture(scope="module")
def heavy(beam):
    """Tip mass 1 and inertia 0.1 in m0 L and m0 L³, at w̄ = 4."""
    m0, length = beam.mass_per_length, beam.length
    return beam.with_tip_mass(m0 * length, 0.1 * m0 * length**3)


@pytest.mark.parametrize(
    ("stiff", "close"),
    # Stiff in shear; the sections' own inertia, which the theory has not, is of the order of μ, and
    # Green-Lagrange's bending of the paper's element is stiffer by 3ε, 4e-5 here.
    [(Exact(nodes=3, shear_correction=1e3), 2e-5), (Ancf3(shear_correction=100.0), 8e-5)],
    ids=["exact", "ancf3"],
)
def test_elements_have_it_on_their_sections(heavy, stiff, close):
    omega = 4.0 * heavy.frequency_scale
    found = natural_frequencies(heavy, omega, element=stiff, elements=32, count=2)
    assert found == pytest.approx(linear_modes(heavy, omega, 2).frequencies, rel=close)


def test_a_free_slope_keeps_energy_and_angular_momentum():
    """Its length grows as well: ½M|ṗ|² + ½Jϑ̇², more than a blade stretches."""
    M, J, samples = 1.0, 2.0, 3
    with exudyn_system() as mbs:
        node = mbs.AddNode(
            NodePoint2DSlope1(
                referenceCoordinates=[0.0, 0.0, 1.0, 0.0], initialVelocities=[0.0, 0.0, 0.5, 1.0]
            )
        )
        mbs.AddObject(ObjectGenericODE2(nodeNumbers=[node], massMatrix=M * np.eye(4)))
        chain = Chain(nodes=(node,), turning=((0, J),))
        add_point_inertias(mbs, chain.nodes, chain.turning, lambda t: 0.0)
        sensors = Sensors(mbs, chain, clamp=())
        mbs.Assemble()
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.numberOfSteps = 400
        settings.timeIntegration.generalizedAlpha.spectralRadius = 1.0
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = 0.5
        mbs.SolveDynamic(settings)
        found = sensors.read()
    p, rate = found.coordinates[:, 0, 2:], found.velocities[:, 0, 2:]
    ((_, spin),) = spins(chain.turning, found.coordinates, found.velocities)
    assert found.time.size == samples
    energy = 0.5 * (M * np.sum(rate**2, axis=1) + J * spin**2)
    momentum = M * (p[:, 0] * rate[:, 1] - p[:, 1] * rate[:, 0]) + J * spin
    # The length has doubled and the spin halved; the step leaves 1e-6.
    assert spin[-1] < 0.6 * spin[0]
    assert energy == pytest.approx(np.full(samples, energy[0]), rel=1e-5)
    assert momentum == pytest.approx(np.full(samples, momentum[0]), rel=1e-5)


def test_a_spin_up_follows_the_exact_blade_in_either_frame(beam, fitted_order):
    m0, length = beam.mass_per_length, beam.length
    blade = beam.with_hub_radius(0.5).with_point_mass(0.1 * m0 * length, 0.5 * length)
    blade = blade.with_tip_mass(0.2 * m0 * length, 0.1 * m0 * length**3)
    spin_up = SpinUp(omega=3.0, ramp_time=4.0)
    steps = np.array([8e-3, 4e-3])
    inertial, rotating = (
        [
            simulate(blade, spin_up, elements=16, duration=5.0, step=step, frame=frame)
            for step in steps
        ]
        for frame in ("inertial", "rotating")
    )
    exact = spin_up_response(blade, spin_up, rotating[-1]["time"].to_numpy(), tolerance=1e-5)
    size = np.abs(exact.q).max()
    # Mesh and step leave 1.5e-5.
    assert np.abs(rotating[-1]["q"] - exact.q).max() < 5e-5 * size
    apart = [float(abs(a["q"] - b["q"]).max()) for a, b in zip(inertial, rotating, strict=True)]
    assert fitted_order(steps, apart) == pytest.approx(2.0, abs=0.1)
