"""Root loads of the two shipped blades once a turn under their weight, at rated speed."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from analytic import (
    Damping,
    Gravity,
    LoadTable,
    SteadyRotation,
    Theory,
    linear_modes,
    spin_up_response,
    steady_state,
)
from rotbeam_exu.files.beam_file import load_beam

BLADES = Path(__file__).parents[3] / "models" / "blades"
G = 9.81
THEORY = Theory(shear=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "rpm", "rigid", "found"),
    [("nrel_5mw", 12.1, 3.57, 3.668), ("iea_15mw", 7.56, 17.98, 18.36)],
)
def test_the_weight_on_the_root_once_a_turn(name, rpm, rigid, found):
    """The first moment of the mass, more by what the first lag mode carries of it and amplifies."""
    blade, omega = load_beam(BLADES / f"{name}.toml"), rpm * math.pi / 30.0
    x, nodes = np.linspace(0.0, blade.length, 4001), np.array(blade.section.x)
    m = make_interp_spline(nodes, np.array(blade.section.mass)[:, 0, 0], 1)(x)
    moment = G * np.trapezoid(m * x, x)
    assert moment / 1e6 == pytest.approx(rigid, rel=6e-3)
    # The first mode is nearly as a weight in the direction of lag bends the blade.
    bend = np.interp(nodes, x, m)[:, None] * [0.0, 1.0, 0.0]
    shape = steady_state(blade, 0.0, loads=[LoadTable(x=nodes, force=bend)], theory=THEORY)
    lag = shape.axis(x)[:, 1] - steady_state(blade, 0.0, theory=THEORY).axis(x)[:, 1]
    share = np.trapezoid(m * lag, x) * np.trapezoid(m * x * lag, x)
    share /= np.trapezoid(m * lag**2, x) * np.trapezoid(m * x, x)
    modes = linear_modes(blade, omega, 4, theory=THEORY)
    times = 1.0 / (1.0 - (omega / modes.frequencies[modes.names.index("lag 1")]) ** 2)
    turn = np.linspace(0.0, 2.0 * math.pi / omega, 64, endpoint=False)
    response = spin_up_response(
        blade.with_damping(Damping(bending=0.01)),  # lag settles; it takes 1e-3 of the moment
        SteadyRotation(omega=omega), np.concatenate((turn, 3.0 * turn[1] * 64 + turn)),
        tolerance=1e-3, theory=THEORY, loads=[Gravity(G)], start="steady",
    )  # fmt: skip
    root = response.section_loads([0.0])
    about = np.einsum("tij,tj->ti", root.section[:, 0], root.moment[:, 0])[64:, 2]
    first = abs(np.fft.rfft(about)[1]) / 32.0
    assert first / 1e6 == pytest.approx(found, rel=1e-3)
    # Shape by the weight, and cone, twist and offsets, by which the levers are not the lengths.
    assert first / moment == pytest.approx(1.0 + share * (times - 1.0), abs=3e-3)
