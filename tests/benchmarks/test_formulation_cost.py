"""What the formulations cost against Exudyn's cable, in the same run."""

from statistics import median

import pytest

from rotbeam_exu import simulate

pytestmark = pytest.mark.benchmarks


def test_the_papers_element_costs_less_than_eight_cables(beam, spin_up):
    simulate(beam, spin_up, element="ancf3", elements=2, duration=4.0)  # imports and caches
    ratios = []
    for _ in range(3):
        cable, own = (
            simulate(beam, spin_up, element=element, duration=5.0).attrs["wall_time"]
            for element in ("cable", "ancf3")
        )
        ratios.append(own / cable)
    # The median of pairs, because the machine's speed drifts.
    assert median(ratios) < 8.0, ratios
