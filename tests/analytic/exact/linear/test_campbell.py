"""Campbell diagram: tracking by shape, crossings with the engine orders."""

from pathlib import Path

import numpy as np
import pytest

from analytic import Rectangle, Theory, campbell, linear_modes
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import unit_beam

NREL = Path(__file__).parents[4] / "models" / "blades" / "nrel_5mw.toml"


@pytest.fixture(scope="module")
def diagram(beam):
    return campbell(beam, np.linspace(0.0, 12.0, 7), 3)


def test_frequencies_are_those_of_the_linear_modes(diagram, beam):
    for omega, row in zip(diagram.omegas, diagram.frequencies, strict=True):
        assert row == pytest.approx(linear_modes(beam, omega, 3).frequencies, rel=1e-10)
    assert diagram.mac.min() > 0.9


def told(diagram, tolerance):
    """Frequencies and crossings against modes of one speed each, whatever their places."""
    blade, count = diagram.blade, diagram.frequencies.shape[1] + 4
    for omega, row in zip(diagram.omegas, diagram.frequencies, strict=True):
        known = linear_modes(blade, omega, count).frequencies
        assert np.abs(np.log(row / known[:, None])).min(axis=0) == pytest.approx(0, abs=tolerance)
    assert diagram.crossings
    for one in diagram.crossings[::3]:
        known = linear_modes(blade, one.omega, count).frequencies
        assert np.abs(np.log(one.frequency / known)).min() < tolerance


def test_a_strip_has_modes_of_all_families_followed_far(beam):
    """From standstill, where flap 1 is below lag 1 by a factor of 18, flap modes rise over all."""
    diagram = campbell(beam.with_shape(Rectangle()), [0.0, 2.3, 9.0], 5, orders=3)
    told(diagram, 1e-9)
    assert diagram.error < 1e-9
    # A chain flaps at ω √(j (2 j - 1)).
    flaps = [name.startswith("flap") for name in diagram.names]
    chain = 9.0 * np.sqrt([1.0, 6.0, 15.0, 28.0])[: sum(flaps)]
    assert diagram.frequencies[-1, flaps] == pytest.approx(chain, rel=0.03)


def test_a_twisted_coned_blade_has_its_frequencies_where_modes_veer(beam):
    """Torsion 1 meets flap 3 at 6.5 rad/s to 1 %, and lag 1 meets flap 1 at 2 rad/s."""
    limp = beam.with_section_out_of_plane(0.3, 2e-3).with_twist(0.6).with_precone(0.1)
    diagram = campbell(limp, [0.0, 2.0, 5.7, 6.5, 8.0], 6, orders=4)
    told(diagram, 1e-9)
    # The same names as by the modes of one speed.
    last = linear_modes(limp, 8.0, 9)
    places = [np.argmin(np.abs(last.frequencies - one)) for one in diagram.frequencies[-1]]
    assert diagram.last_names == tuple(last.names[place] for place in places)
    assert diagram.last_names != diagram.names


@pytest.mark.slow  # a table of 49 stations at six speeds
def test_a_real_blade_has_the_frequencies_of_its_modes():
    told(campbell(load_beam(NREL), np.linspace(0.2, 1.6, 4), 6), 1e-6)


def test_crossings_lie_on_the_line_and_on_the_mode(diagram, beam):
    assert diagram.crossings
    for crossing in diagram.crossings:
        assert crossing.frequency == crossing.order * crossing.omega
        modes = linear_modes(beam, crossing.omega, 3)
        there = modes.frequencies[modes.names.index(crossing.mode)]
        assert there == pytest.approx(crossing.frequency, rel=1e-9)


def test_the_theory_is_that_of_the_modes():
    """Shear and rotary inertia lower the second frequency of a thick beam by 2 % and more."""
    thick, theory = unit_beam(5e-4), Theory(shear=0.3, rotary_inertia=True)
    diagram = campbell(thick, [0.0, 6.0], 2, theory=theory)
    for omega, row in zip(diagram.omegas, diagram.frequencies, strict=True):
        assert row == pytest.approx(
            linear_modes(thick, omega, 2, theory=theory).frequencies, rel=1e-10
        )
        assert row[1] < 0.98 * linear_modes(thick, omega, 2).frequencies[1]
    crossing = diagram.crossings[0]
    assert crossing.mode == "lag 1"
    there = linear_modes(thick, crossing.omega, 2, theory=theory).frequencies[0]
    assert there == pytest.approx(crossing.frequency, rel=1e-9)


def test_every_order_that_must_cross_does(diagram):
    found = {(c.mode, c.order) for c in diagram.crossings}
    for mode in range(3):
        for order in range(1, 7):
            # From above the line at rest to below it at the end, or not.
            crosses = diagram.frequencies[-1, mode] < order * diagram.omegas[-1]
            assert ((f"lag {mode + 1}", order) in found) == crosses


def test_a_mode_is_followed_through_another(beam):
    """The axial mode of a thick beam rises more slowly than bending mode 3, which overtakes it."""
    thick = unit_beam(5e-4)
    speeds = np.linspace(0.0, 14.0, 15)
    diagram = campbell(thick, speeds, 4)
    sorted_by_frequency = np.sort(diagram.frequencies, axis=1)
    assert diagram.mac.min() > 0.5
    # Each column is smooth where the sorted ones kink at the crossing.
    assert (
        np.abs(np.diff(diagram.frequencies, n=2, axis=0)).max()
        <= np.abs(np.diff(sorted_by_frequency, n=2, axis=0)).max()
    )


def test_a_crossing_is_a_frequency_where_two_modes_veer():
    """The axial mode and bending mode 3 change their shapes at 10.6 rad/s, on both sides of 7ω.

    One of them, followed by its shape, jumps over the line there.
    """
    thick = unit_beam(4.8e-4)
    met = [c.omega for c in campbell(thick, [9.0, 12.5], 4, orders=7).crossings if c.order == 7]
    assert sorted(met) == pytest.approx([10.519635, 10.687716], abs=1e-6)
    for omega in met:
        ratios = linear_modes(thick, omega, 4).frequencies / omega
        assert np.abs(ratios - 7.0).min() < 1e-9  # the tolerance


@pytest.mark.parametrize("omegas", [[1.0, 1.0], [2.0, 1.0], [-1.0, 1.0], [0.0, np.nan]])
def test_bad_speeds(beam, omegas):
    with pytest.raises(ValueError, match="omegas must"):
        campbell(beam, omegas)
