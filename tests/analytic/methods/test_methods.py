"""The methods on systems that are no beam: what they know of one is what `methods.system` tells."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.special import ellipk

from analytic.methods.continuation import Path, linear_orbit
from analytic.methods.floquet import floquet_multipliers, flow
from analytic.methods.fourier import packed, unpacked
from analytic.methods.harmonic_balance import jacobian, projected, solve
from analytic.methods.newton import LARGE, Newton, by_products, factored
from analytic.methods.orbit import Orbit
from analytic.methods.system import Tangent


@dataclass(frozen=True)
class Duffing:
    """ẍ + x + x³ = 0, and a passenger y with ÿ + 9.3 y + x² = 0, which is even in time."""

    size = functions = 2
    driven = stiff = False
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

    def refined(self, *state):
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


def test_multipliers_by_half_a_period_are_those_of_a_whole_one():
    (orbit,) = orbits(Duffing(), [0.5])
    assert orbit.system.odd is not None
    whole = np.linalg.eigvals(flow(orbit, 24, 1.0)[0])
    for value in floquet_multipliers(orbit).values[2:]:
        assert np.abs(whole - value).min() < 1e-10


def test_factors_of_single_precision_lead_to_a_root_in_double():
    rng = np.random.default_rng(1)
    count = LARGE + 50
    matrix = np.diag(np.linspace(1.0, 1e3, count)) + 0.1 * rng.normal(size=(count, count))
    exact = rng.normal(size=count)
    side = matrix @ exact
    factors = factored(matrix.copy())
    assert factors[0].dtype == np.float32
    found = Newton(converged=1e-14, slow=0.4, steps=10, tangents=1).root(
        np.zeros(count), lambda z: matrix @ z - side, lambda z: (factors, matrix @ z - side)
    )
    assert found.z == pytest.approx(exact, abs=1e-11)


def test_a_scaled_orbit_is_right_to_leading_order_in_every_harmonic():
    """Mean and second harmonic go with the square: what is left is smaller by the square again."""
    seed = solve(linear_orbit(Duffing(), np.array([1.0, 0.0]), 1.0, 0.02), 0.02)
    double = solve(seed.scaled(0.04), 0.04)
    assert double.coefficients[0, 1] == pytest.approx(-0.5 * 0.04**2 / 9.3, rel=5e-3)
    for first in (0, seed.harmonics + 1):
        rows = slice(first, first + 3)
        scaled = seed.scaled(0.04).coefficients[rows]
        assert scaled == pytest.approx(double.coefficients[rows], rel=5e-3, abs=1e-12)


class Coupled(Duffing):
    """Stiffness, damping and mass that vary along the motion and couple all coordinates."""

    def residual(self, q, q_dot, q_ddot, phase=0.0, rate=0.0):
        x, y = q.T
        (x_dot, y_dot), (x_ddot, y_ddot) = q_dot.T, q_ddot.T
        first = (1.0 + y) * x_ddot + x * y_ddot + 0.3 * x * x_dot + 0.7 * y_dot + x - x * y**2
        second = x * x_ddot + y_ddot - 0.7 * x_dot + x_dot**2 + y + x**2 * y
        return np.stack((first + rate**2 * np.cos(phase), second), axis=-1)

    def tangent(self, q, q_dot, q_ddot, phase=0.0, rate=0.0):
        def derivative(place):
            state = [q, q_dot, q_ddot]
            columns = []
            for k in range(2):
                ahead, behind = (
                    [s + sign * 1e-5 * (i == place) * np.eye(2)[k] for i, s in enumerate(state)]
                    for sign in (1.0, -1.0)
                )
                columns.append((self.residual(*ahead) - self.residual(*behind)) / 2e-5)
            return np.stack(columns, axis=-1)

        residual = self.residual(q, q_dot, q_ddot, phase, rate)
        return Tangent(residual, derivative(0), derivative(1), derivative(2))


class Lopsided(Coupled):
    """As if nothing reversed time: full series, one unknown of which fixes the phase."""

    odd, pinned = None, 1


class Driven(Coupled):
    """Under a drive, whose phase it has."""

    odd, driven = None, True


@pytest.mark.parametrize("system", [Coupled(), Lopsided(), Driven()])
def test_the_jacobian_is_the_derivative_of_the_projected_residual(system):
    """By its Fourier coefficients and by differences: half and full series."""
    at = Orbit(system=system, frequency=1.3, coefficients=np.zeros((9, 2)))
    unknowns = 0.1 * np.random.default_rng(0).standard_normal(
        packed(at.coefficients, at.parts).size
    )
    assert unknowns.size == {Coupled: 9, Lopsided: 17, Driven: 18}[type(system)]

    def residual(z):
        coefficients = unpacked(z[:-1], at.parts, at.coefficients.shape)
        return projected(replace(at, coefficients=coefficients, frequency=z[-1]))

    z, h = np.append(unknowns, 1.3), 1e-5
    differences = [(residual(z + s) - residual(z - s)) / (2.0 * h) for s in h * np.eye(z.size)]
    here = replace(at, coefficients=unpacked(unknowns, at.parts, at.coefficients.shape))
    matrix = jacobian(here)[:-1]
    # Differences of cubic polynomials: their step's square.
    assert matrix == pytest.approx(np.transpose(differences), abs=1e-9)


@pytest.mark.parametrize("system", [Coupled(), Lopsided(), Driven()])
def test_a_coarse_jacobian_resolves_half_of_the_harmonics(system):
    """The tangent of a cubic system has twice the harmonics of the motion: up to six of twelve."""
    at = Orbit(system=system, frequency=1.3, coefficients=np.zeros((25, 2)))
    coefficients = np.zeros((25, 2))
    random = 0.1 * np.random.default_rng(0).standard_normal((7, 2))
    coefficients[:4], coefficients[13:16] = random[:4], random[4:]
    unknowns = packed(coefficients, at.parts)
    here = replace(at, coefficients=unpacked(unknowns, at.parts, (25, 2)))
    # The system's own tangent is by differences.
    assert jacobian(here, coarse=True) == pytest.approx(jacobian(here), abs=1e-8)
    more = replace(here, coefficients=here.coefficients + 1e-2 * np.eye(25, 2, -5))
    assert np.abs(jacobian(more, coarse=True) - jacobian(more)).max() > 1e-4


def test_old_factors_and_products_solve_as_new_factors_do():
    """The rank in which they differ is the number of products; one more checks the solution.

    Too far off there is none.
    """
    random = np.random.default_rng(0)
    old = np.eye(60) + 0.1 * random.standard_normal((60, 60))
    vector = random.standard_normal(60)
    few, all_of_it = (random.standard_normal((60, rank)) for rank in (5, 60))
    matrix, asked = old + few @ few.T, []

    def product(x):
        asked.append(x)
        return matrix @ x

    found = by_products(product, factored(old.copy()), vector)
    assert found == pytest.approx(np.linalg.solve(matrix, vector), rel=1e-9)
    assert len(asked) == 7
    far = old + 10.0 * all_of_it
    assert by_products(lambda x: far @ x, factored(old.copy()), vector) is None
