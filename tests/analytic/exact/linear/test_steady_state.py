"""Steady states of real blades under their weight and forces at the tip; branches under loads."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from analytic import Beam, PointLoad, RotbeamWarning, Theory, steady_state
from analytic.exact.continuum.discretization import space_continuum
from analytic.exact.continuum.rotation import rotating_blade
from analytic.exact.continuum.space import SpaceContinuum
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import unit_beam

BLADES = Path(__file__).parents[4] / "models" / "blades"
RIGID = Theory(extension=False, trapeze=False)
STRIP = Beam.reference().with_section_out_of_plane(0.5, 0.6).with_twist(0.5)


@pytest.fixture(scope="module", params=["nrel_5mw", "iea_15mw"])
def blade(request):
    return load_beam(BLADES / f"{request.param}.toml")


def along(blade):
    """Gauss points between any two stations, and their weights [m]."""
    stations = np.array(blade.section.x)
    place, share = np.polynomial.legendre.leggauss(6)
    half = 0.5 * np.diff(stations)[:, None]
    return (stations[:-1, None] + half * (1.0 + place)).ravel(), (half * share).ravel()


@pytest.mark.parametrize(
    ("omega", "gravity", "force"),
    [
        (0.0, 9.80665, (0.0, 0.0, 0.0)),
        (1.0, 9.80665, (0.0, 0.0, 0.0)),
        (0.0, 0.0, (0.0, 0.0, 1e4)),
        (0.0, 0.0, (0.0, 0.0, 2e5)),
        (0.5, 9.80665, (0.0, -2e5, 2e5)),
    ],
)
def test_the_root_carries_weight_tip_force_and_acceleration(blade, omega, gravity, force):
    """Root force and moment are integrals of loads times levers at the deformed places."""
    state = steady_state(blade, omega, gravity=gravity, force=force, tolerance=1e-7)
    x, dx = along(blade)
    at, root = state.section_loads(x), state.section_loads([0.0])
    M = np.array(blade.section.mass)
    m = M[:, 0, 0]
    offset = np.stack((np.zeros_like(m), -M[:, 0, 5] / m, M[:, 0, 4] / m), axis=1)
    apart = (
        np.eye(3) * (offset**2).sum(axis=1)[:, None, None] - offset[:, :, None] * offset[:, None]
    )
    inertia = M[:, 3:, 3:] - m[:, None, None] * apart  # about the center of mass
    m, offset, inertia = (
        make_interp_spline(blade.section.x, one, 1)(x) for one in (m, offset, inertia)
    )
    inertia = at.section @ inertia @ at.section.swapaxes(1, 2)
    center = state.axis(x) + np.einsum("pij,pj->pi", at.section, offset)
    cone = blade.line.precone
    axis = np.array([math.sin(cone), 0.0, math.cos(cone)])
    radius = center + blade.hub_radius * np.array([math.cos(cone), 0.0, -math.sin(cone)])
    spin = omega * axis
    pull = -(m * dx)[:, None] * (gravity * axis + np.cross(spin, np.cross(spin, radius)))
    total = pull.sum(axis=0) + force
    moment = np.cross(center, pull).sum(axis=0) + np.cross(state.tip, force)
    moment -= dx @ np.cross(spin, inertia @ spin)  # of sections that turn
    found = root.section[0] @ root.force[0], root.section[0] @ root.moment[0]
    assert found[0] == pytest.approx(total, abs=1e-7 * np.linalg.norm(total))
    assert found[1] == pytest.approx(moment, abs=1e-6 * np.linalg.norm(moment))
    assert state.error < 1e-7


def test_a_real_blade_takes_its_weight_at_once(blade, monkeypatch):
    """It bends by 0.1 of its length at most, which Newton's method does in a few changes."""
    tangent, count = SpaceContinuum.tangent, []
    monkeypatch.setattr(
        SpaceContinuum, "tangent", lambda *given: count.append(1) or tangent(*given)
    )
    state = steady_state(blade, 0.0, gravity=9.80665)
    assert len(count) < 16
    assert -0.1 * blade.length < state.tip[2] < -0.01 * blade.length


def test_the_lag_of_nrels_blade_under_a_hundredth_of_its_weight():
    """-8.908e-4 m by a chain of rigid bodies and springs, which has shear too."""
    state = steady_state(load_beam(BLADES / "nrel_5mw.toml"), 0.0, gravity=0.1)
    assert state.tip[1] == pytest.approx(-8.908e-4, rel=1e-3)


@pytest.mark.parametrize(
    ("ratios", "twist", "cone", "prebend", "force"),
    [
        ((0.03, 0.13), 0.69, 0.29, 0.0, (-8.0, 0.4, -0.1)),
        ((0.19, 0.23), -0.21, 0.31, 0.07, (-2.4, 0.4, -0.3)),
    ],
)
def test_large_loads_stay_on_the_branch(ratios, twist, cone, prebend, force):
    """The state is the one that small steps of the load lead to, though there are others."""
    blade = unit_beam(1e-4).with_section_out_of_plane(*ratios).with_twist(twist)
    blade = blade.with_precone(cone).with_prebend(prebend)
    last = rotating_blade(blade, 0.0, space_continuum(blade, RIGID, 6))
    for share in np.linspace(0.0, 1.0, 201)[1:]:
        load = PointLoad(force=share * np.array(force))
        last = replace(last, loads=(load,), near=last.equilibrium)
    assert replace(last, near=None).tip == pytest.approx(last.tip, abs=1e-9)


@pytest.mark.parametrize("load", [{"force": (0.0, 0.0, 1e12)}, {"gravity": 1e300}])
def test_a_load_beyond_all_bounds_is_refused(load):
    with pytest.raises(ValueError, match=r"60 steps.* of the load: load it less, and check its un"):
        steady_state(STRIP, 0.0, **load)


def test_newtons_for_kilonewtons_are_warned_of():
    with pytest.warns(RotbeamWarning, match="rotate slower, or load it less"):
        steady_state(STRIP, 2.0, force=(0.0, 0.0, 1e6))
    thousandth = steady_state(STRIP, 2.0, force=(0.0, 0.0, 1e3))
    assert thousandth.tip[2] > 0.9 * STRIP.length
