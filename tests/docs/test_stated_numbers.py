"""Numbers that stand on the pages in words, where no block computes them."""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from exudyn.itemInterface import NodePoint2DSlope1, ObjectANCFCable2D

from analytic import SpinUp, linear_modes, spin_up_response
from rotbeam_exu import natural_frequencies, simulate, steady_oscillation
from rotbeam_exu.fem.elements import Cable, Chain

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
