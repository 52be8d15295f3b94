"""Numbers that stand on the pages in words, where no block computes them."""

from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from exudyn.itemInterface import NodePoint2DSlope1, ObjectANCFCable2D

from analytic import (
    Damping,
    SpinUp,
    damping_ratios,
    design_ramp,
    exact_residual,
    linear_modes,
    spin_up_response,
)
from rotbeam_exu import natural_frequencies, simulate, steady_oscillation
from rotbeam_exu.cli.respond import Dampings
from rotbeam_exu.fem.elements import Cable, Chain
from rotbeam_exu.files.beam_file import load_beam

DOCS = Path(__file__).parents[2] / "docs"


@dataclass(frozen=True, kw_only=True)
class OtherQuadrature(Cable):
    """The cable with another of Exudyn's integration schemes."""

    quadrature: int = 0

    name: ClassVar[str] = "other quadrature"

    def lay(self, mbs, beam, elements):
        length = beam.length / elements
        nodes = tuple(
            mbs.AddNode(NodePoint2DSlope1(referenceCoordinates=[i * length, 0.0, 1.0, 0.0]))
            for i in range(elements + 1)
        )
        bodies = tuple(
            mbs.AddObject(
                ObjectANCFCable2D(
                    nodeNumbers=list(pair),
                    length=length,
                    massPerLength=beam.mass_per_length,
                    bendingStiffness=beam.bending_stiffness,
                    axialStiffness=beam.axial_stiffness,
                    useReducedOrderIntegration=self.quadrature,
                )
            )
            for pair in pairwise(nodes)
        )
        return Chain(nodes=nodes, bodies=bodies)


def says(page, words):
    return words in " ".join((DOCS / page).read_text(encoding="utf-8").split())


def elements_by_quadrature():
    return (
        (0, OtherQuadrature(quadrature=0)),
        (1, OtherQuadrature(quadrature=1)),
        (2, Cable()),
    )


def test_reduced_integration_costs_accuracy_in_linear_frequencies(beam):
    assert says("gotchas.md", "it is two to three times farther")
    exact = linear_modes(beam, 6.0).frequencies[0]
    off = {
        q: natural_frequencies(beam, 6.0, element=element, elements=8, count=1)[0] / exact - 1.0
        for q, element in elements_by_quadrature()
    }
    for q in (0, 1):
        assert 2.0 < off[2] / off[q] < 3.0


@pytest.mark.slow
def test_reduced_integration_helps_large_oscillations(beam):
    assert says("gotchas.md", "`useReducedOrderIntegration=2`, which is used here, is ten times")
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    runs = {
        q: simulate(beam, spin_up, element=element, elements=8, step=2e-3, duration=8.0)["q"]
        for q, element in elements_by_quadrature()
    }
    exact = spin_up_response(beam, spin_up, runs[2]["time"].to_numpy(), tolerance=1e-5).q
    off = {q: np.abs(run.to_numpy() - exact).max() for q, run in runs.items()}
    for q in (0, 1):
        assert off[q] / off[2] > 10.0


@pytest.mark.slow
@pytest.mark.parametrize(("omega", "ratio"), [(2.0, 3.5), (8.0, 19.0)])
def test_the_rotating_frame_has_the_smaller_step_error(beam, omega, ratio):
    assert says("theory/finite_element.md", "3.5 times at 2 rad/s to 19 times at 8 rad/s")
    by_step = {}
    for frame in ("inertial", "rotating"):
        runs = [
            simulate(beam, SpinUp(omega=omega, ramp_time=3.0), elements=8, step=step, frame=frame)
            for step in (2e-3, 1e-3)
        ]
        coarse, fine = (steady_oscillation(run).frequency for run in runs)
        by_step[frame] = coarse - fine
    assert by_step["inertial"] / by_step["rotating"] == pytest.approx(ratio, rel=0.1)


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ("scope.md", "relative to the turning frame"),
        ("theory/forced_response.md", "velocity is that in the turning frame"),
        ("howto/forced_response.md", "velocity in the turning frame"),
        ("howto/own_beam.md", "velocity relative to the turning frame"),
    ],
)
def test_external_damping_is_said_to_be_no_drag(page, words):
    text = " ".join((DOCS / page).read_text(encoding="utf-8").split())
    assert words in text
    assert "oint masses" in text
    assert "the air takes" not in text


@pytest.mark.parametrize("told", [Damping, Dampings, load_beam], ids=lambda told: told.__name__)
def test_so_do_docstring_command_and_file(told):
    text = " ".join(told.__doc__.split())
    assert "turning frame" in text
    assert "point masses" in text


def test_point_masses_have_no_external_damping(beam):
    """ζ = d ∫φ²dx/(2 ω_n M₁): a tip mass is in M₁ only."""
    blade = beam.with_tip_mass(0.3 * beam.mass).with_damping(Damping(external=1e-3))
    modes = linear_modes(blade, 0.0, 1)
    x, weights = np.polynomial.legendre.leggauss(40)
    shape = modes.shapes(0.5 * (x + 1.0) * beam.length)[:, 0]  # one at the tip
    area = 0.5 * beam.length * weights @ shape**2
    inertia = beam.mass_per_length * area + 0.3 * beam.mass
    # Coefficients and modes are resolved to 1e-9.
    assert damping_ratios(blade, 0.0, 1)[0] == pytest.approx(
        1e-3 * area / (2.0 * modes.frequencies[0] * inertia), rel=1e-7
    )


def test_a_designed_ramp_swings_on_the_way_and_knows_one_blade(beam):
    """To 6 rad/s in 2 s; two digits are given."""
    readme = " ".join((DOCS.parent / "README.md").read_text(encoding="utf-8").split())
    assert "by 0.71 L there, and one whose frequency is 1 % off is left with 2.1e-2 L" in readme
    assert says("theory/spin_up.md", "the tip is at $-0.71\\,L$")
    assert says("theory/spin_up.md", "$2.1\\cdot10^{-2}L$ is left there, and 2.4e-2 if the ramp")
    ramp = design_ramp(beam, 6.0, 2.0)
    on_the_way = spin_up_response(beam, ramp, np.linspace(0.0, 2.0, 201)).q / beam.length
    assert on_the_way.min() == pytest.approx(-0.71, abs=0.005)
    stiffer = replace(beam, youngs_modulus=1.01**2 * beam.youngs_modulus)
    longer = replace(ramp, ramp_time=1.01 * ramp.ramp_time)
    assert exact_residual(stiffer, ramp, tolerance=1e-4) == pytest.approx(2.1e-2, abs=5e-4)
    assert exact_residual(beam, longer, tolerance=1e-4) == pytest.approx(2.4e-2, abs=5e-4)


def test_no_page_says_what_a_referee_refuted():
    root = DOCS.parent
    pages = [root / "README.md", *DOCS.rglob("*.md")]
    text = {page: " ".join(page.read_text(encoding="utf-8").split()) for page in pages}
    for words in (
        "worse by refining",
        "methods that share no formula",
        "which shares nothing with this one",
        "costs no more than a formula",
        "In its plane of bending everything",
        "leave almost nothing in any",
    ):
        assert [page.name for page in pages if words in text[page]] == []
