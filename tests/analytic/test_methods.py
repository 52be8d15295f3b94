"""The methods on systems that are no beam: what they know of one is the System protocol."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.special import ellipk

from analytic.methods.continuation import Path, linear_orbit
from analytic.methods.floquet import floquet_multipliers
from analytic.methods.harmonic_balance import solve
from analytic.methods.system import Tangent


@dataclass(frozen=True)
class Duffing:
    """ẍ + x + x³ = 0, and a passenger y with ÿ + 9.3 y + x² = 0, which is even in time."""

    size = functions = 2
    driven = False
    odd = np.array([True, False])
    equilibrium = np.zeros(2)

    def residual(self, q, q_dot, q_ddot):
        x, y = q.T
        return q_ddot + np.stack((x + x**3 + 2.0 * x * y, 9.3 * y + x**2), axis=-1)

    def tangent(self, q, q_dot, q_ddot):
        stiffness = np.zeros((len(q), 2, 2))
        x, y = q.T
        stiffness[:, 0, 0] = 1.0 + 3.0 * x**2 + 2.0 * y
        stiffness[:, 0, 1] = stiffness[:, 1, 0] = 2.0 * x
        stiffness[:, 1, 1] = 9.3
        mass = np.broadcast_to(np.eye(2), stiffness.shape)
        return Tangent(self.residual(q, q_dot, q_ddot), stiffness, 0.0 * stiffness, mass)

    def gauge(self, q):
        return q[:, 0]

    def gauge_rate(self, q, q_dot):
        return q_dot[:, 0]

    def gauge_gradient(self, q):
        return np.broadcast_to([1.0, 0.0], q.shape)

    def kinetic_energy(self, q, q_dot):
        return 0.5 * np.sum(q_dot**2, axis=-1)

    def potential(self, q):
        x, y = q.T
        return 0.5 * x**2 + 0.25 * x**4 + 4.65 * y**2 + x**2 * y

    def refined(self):
        return self

    def lifted(self, q, finer):
        return q


class Alone(Duffing):
    """The same without the coupling: Duffing's oscillator, whose period is an elliptic integral."""

    def residual(self, q, q_dot, q_ddot):
        x, y = q.T
        return q_ddot + np.stack((x + x**3, 9.3 * y), axis=-1)

    def tangent(self, q, q_dot, q_ddot):
        at = super().tangent(q, q_dot, q_ddot)
        stiffness = at.stiffness.copy()
        stiffness[:, 0, 0] -= 2.0 * q[:, 1]
        stiffness[:, 0, 1] = stiffness[:, 1, 0] = 0.0
        return at._replace(residual=self.residual(q, q_dot, q_ddot), stiffness=stiffness)

    def potential(self, q):
        return super().potential(q) - q[:, 0] ** 2 * q[:, 1]


def orbits(system, amplitudes):
    seed = solve(linear_orbit(system, np.array([1.0, 0.0]), 1.0, 0.05), 0.05)
    path = Path(seed=seed, double=solve(seed.scaled(0.1), 0.1), longest=1.0)
    return [path.at(amplitude) for amplitude in amplitudes]


@pytest.mark.parametrize("amplitude", [0.1, 1.0, 3.0])
def test_duffings_frequency_is_an_elliptic_integral(amplitude):
    (orbit,) = orbits(Alone(), [amplitude])
    square = amplitude**2
    exact = 0.5 * np.pi * np.sqrt(1.0 + square) / ellipk(0.5 * square / (1.0 + square))
    # The frequency is wrong by the order of the square of the residual.
    assert orbit.residual < 1e-4
    assert orbit.frequency == pytest.approx(exact, rel=1e-8)


def test_orbits_of_two_coordinates_conserve_energy_and_are_stable():
    for orbit in orbits(Duffing(), [0.2, 0.5, 1.0]):
        assert orbit.gauge(np.array([orbit.peak_phase]))[0] == pytest.approx(orbit.amplitude)
        assert orbit.invariant_drift < 2e-11
        # Even in time: y returns the same way.
        there, back = orbit.coordinates(np.array([0.4, -0.4]))[0]
        assert there == pytest.approx([-back[0], back[1]])
        assert floquet_multipliers(orbit).stable()
