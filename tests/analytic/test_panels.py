"""Blades that are not smooth: masses inside the span, stations, steps of the section."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from analytic import (
    Blade,
    Section,
    Theory,
    linear_modes,
    periodic_orbits,
    reduced_model,
)
from tests.beams import UNIT


def shot(pieces, jumps):
    """First frequencies at rest of pieces (length, EI), with a mass and inertia at their ends.

    By transfer matrices of the exact solutions, cos and cosh, which share nothing with polynomials.
    """

    def determinant(w):
        state = np.eye(4)[:, 2:]  # v, v', moment and shear: the last two are free at the clamp
        for (length, EI), (mass, inertia) in zip(pieces, jumps, strict=True):
            b = (w**2 / EI) ** 0.25
            s, c, sh, ch = (
                f(b * length) for f in (math.sin, math.cos, math.sinh, math.cosh)
            )  # fmt: skip
            even, odd = 0.5 * (ch + c), 0.5 * (sh + s)
            curve, twist = 0.5 * (ch - c), 0.5 * (sh - s)
            piece = np.array(
                [
                    [even, odd / b, curve / (EI * b**2), twist / (EI * b**3)],
                    [b * twist, even, odd / (EI * b), curve / (EI * b**2)],
                    [EI * b**2 * curve, EI * b * twist, even, odd / b],
                    [EI * b**3 * odd, EI * b**2 * curve, b * twist, even],
                ]
            )
            jump = np.eye(4)
            jump[3, 0], jump[2, 1] = mass * w**2, -inertia * w**2
            state = jump @ piece @ state
        return np.linalg.det(state[2:])

    grid = np.arange(0.2, 70.0, 0.05)
    signs = np.sign([determinant(w) for w in grid])
    roots = np.flatnonzero(signs[1:] != signs[:-1])
    return [brentq(determinant, grid[i], grid[i + 1], xtol=1e-13) for i in roots]


@pytest.mark.parametrize(("mass", "inertia"), [(0.1, 0.0), (0.3, 0.02), (2.0, 0.0)])
def test_a_mass_inside_the_span_is_met_to_all_digits(mass, inertia):
    exact = shot([(0.37, 1.0), (0.63, 1.0)], [(mass, inertia), (0.0, 0.0)])
    blade = UNIT.with_point_mass(mass, 0.37, inertia)
    found = linear_modes(blade, 0.0, len(exact), theory=Theory(extension=False)).frequencies
    assert found == pytest.approx(exact, rel=1e-9)
    assert blade.omega_0 == pytest.approx(exact[0], rel=1e-12)
    assert reduced_model(blade, 0.0, "FrM").omega_n == pytest.approx(exact[0], rel=1e-10)


def test_a_step_of_the_section_is_the_limit_of_a_steep_slope():
    exact = shot([(0.5, 1.0), (0.5, 0.4)], [(0.0, 0.0)] * 2)
    errors = []
    for width in (2e-3, 1e-3):
        ends = ((0.0, 1.0), (0.5 - 0.5 * width, 1.0), (0.5 + 0.5 * width, 0.4), (1.0, 0.4))
        section = Section(axial_stiffness=1e9, mass_per_length=1.0, bending_stiffness=ends)
        stepped = Blade(length=1.0, section=section)
        found = linear_modes(stepped, 0.0, 3, theory=Theory(extension=False)).frequencies
        errors.append(np.abs(found / exact[:3] - 1.0).max())
    # The slope's compliance is off by the order of its width.
    assert errors[0] < 2e-3
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.05)


def test_softening_with_a_mass_inside_is_that_of_the_orbits():
    blade = UNIT.with_point_mass(0.3, 0.6).with_hub_radius(0.5)
    frm = reduced_model(blade, 3.0, "FrM")
    exact = periodic_orbits(blade, 3.0, [0.02], theory=Theory(extension=False))
    assert frm.lambda_omega == pytest.approx(exact.lambda_omega, abs=1e-6)
