"""Damping of the section by the ratios of its modes."""

import numpy as np
import pytest

from analytic import Theory, damping_ratios, linear_modes
from analytic.exact.linear.damping import modal_damping
from analytic.warning import RotbeamWarning
from tests.beams import irregular, unit_beam

ASKED = {"flap 1": 0.01, "lag 1": 0.02, "torsion 1": 0.02}


def test_of_modes_that_one_component_bends():
    """η = 2ζ/ω to the first order, and ζ = -Re λ/|λ| has no other."""
    blade = unit_beam(1e-3).with_section_out_of_plane(0.0625, 0.08)
    modes, damping = linear_modes(blade, 0.0, 12), modal_damping(blade, ASKED)
    at = dict(zip(modes.names, modes.frequencies, strict=True))
    etas = {"flap 1": damping.out_of_plane, "lag 1": damping.bending, "torsion 1": damping.torsion}
    for name, eta in etas.items():
        assert eta == pytest.approx(2.0 * ASKED[name] / at[name], rel=1e-6)


@pytest.mark.parametrize("omega", [0.0, 1.0])
def test_of_tables(omega):
    """Named modes of an irregular blade decay as asked, at the speed asked for."""
    blade = irregular(3, 0.03, 9)
    damped = blade.with_damping(modal_damping(blade, ASKED, omega))
    names = linear_modes(blade, omega, 12).names
    count = 1 + max(map(names.index, ASKED))
    found = dict(zip(names, damping_ratios(damped, omega, count), strict=False))
    assert [found[name] for name in ASKED] == pytest.approx(list(ASKED.values()), rel=1e-3)


def test_more_modes_than_families_are_fitted():
    """ζ = ηω/2 of bending alone: two equal ratios have the least squares of ω_1/ω_2."""
    blade = unit_beam(1e-6)
    theory = Theory(extension=False)
    with pytest.warns(RotbeamWarning, match=r"the nearest gives lag 1 0\.00\d+, lag 2 0\.011"):
        damping = modal_damping(blade, {"lag 1": 0.01, "lag 2": 0.01}, theory=theory)
    per_eta = 0.5 * linear_modes(blade, 0.0, 2, theory=theory).frequencies / 0.01
    assert damping.bending == pytest.approx(np.sum(per_eta) / (per_eta @ per_eta), rel=1e-4)


@pytest.mark.parametrize(
    ("ratios", "sentence"),
    [
        ({}, "ratios must name modes"),
        ([0.01], r"ratios must name modes.*got \[0.01\]"),
        ({"flap 90": 0.01}, "ratios name flap 90; the 12 lowest modes of the blade are flap 1"),
        ({"bend 1": 0.01}, "families are flap, lag, torsion, axial"),
        ({"lag 1": -0.01}, "the ratio of lag 1 must be positive"),
        ({"lag 1": float("nan")}, "the ratio of lag 1 must be finite"),
    ],
)
def test_what_is_no_ratio_is_refused(ratios, sentence):
    with pytest.raises(ValueError, match=sentence):
        modal_damping(unit_beam(1e-3).with_section_out_of_plane(0.0625, 0.08), ratios)
