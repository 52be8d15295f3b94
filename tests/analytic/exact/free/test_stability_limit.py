"""Which planar orbits leave their plane: the paper's beam as rectangles and as a tube."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from analytic import (
    AmplitudeNotReachedError,
    Blade,
    Damping,
    Rectangle,
    Section,
    SpinUp,
    Theory,
    Tube,
    linear_modes,
    periodic_orbits,
    spin_up_response,
    stability_limit,
)
from analytic.exact.continuum.planar_rotation import blade_continuum
from analytic.exact.continuum.rotation import rotating_blade
from analytic.exact.free.planar_orbits import growth_rates, planar_orbits
from analytic.exact.stability.growth import GrowthOutOfPlane, _steady_modes
from analytic.exact.stability.out_of_plane import FlapTorsion, with_points_for
from analytic.methods.continuation import Care
from analytic.theory import BERNOULLI_EULER
from tests.beams import UNIT, told

ROOT = Path(__file__).parents[4]
STEPS = (0.02, 0.035, 0.05, 0.08, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6)
# The first unstable amplitude of the list, by ω [rad/s] and height over width; "-" has none.
# Another code has 0.1 for 18.5 and none for 3 at 8 rad/s: with its eight functions ours has so too,
# and with 12, 16, 20, 24 and 32 it has not.
TABLE = [
    (2.0, 18.5, 0.035), (2.0, 6.0, 0.15), (2.0, 3.0, 0.3), (2.0, 2.0, 0.5), (2.0, 1.5, None),
    (4.0, 18.5, 0.08), (4.0, 6.0, 0.25), (4.0, 3.0, 0.5), (4.0, 2.0, None),
    (6.0, 6.0, 0.3), (6.0, 3.0, 0.55), (6.0, 2.0, None),
    (8.0, 18.5, 0.08), (8.0, 6.0, 0.3), (8.0, 3.0, None), (8.0, 2.0, None),
]  # fmt: skip
# From where on all orbits up to 0.6 leave the plane by 0.01 per radian; half the steps of the
# amplitude and half as many functions and steps of time again change none by 1e-3 of itself.
LIMITS = {
    (2.0, 18.5): 0.0400, (2.0, 6.0): 0.1577, (2.0, 3.0): 0.3825, (2.0, 2.0): 0.5458,
    (4.0, 18.5): 0.0592, (4.0, 6.0): 0.2100, (4.0, 3.0): 0.4668, (4.0, 2.0): math.inf,
    (6.0, 18.5): 0.0705, (6.0, 6.0): 0.2551, (6.0, 3.0): 0.5411, (6.0, 2.0): math.inf,
    (8.0, 18.5): 0.0756, (8.0, 6.0): 0.2811, (8.0, 3.0): math.inf, (8.0, 2.0): math.inf,
}  # fmt: skip


def rectangle(beam, ratio):
    """A rectangle of another material: a Blade does not tell its area."""
    return beam.with_hub_radius(0.0).with_shape(Rectangle(ratio=ratio))


@pytest.mark.filterwarnings("ignore:internal resonance")
@pytest.mark.parametrize(
    ("omega", "ratio", "first", "steps"),
    [
        *((*TABLE[k], STEPS[STEPS.index(TABLE[k][2]) - 1 :][:2]) for k in (0, 2, 9)),
        *(pytest.param(*row, STEPS, marks=pytest.mark.slow) for row in TABLE),
    ],
)
def test_where_rectangles_leave_the_plane(beam, omega, ratio, first, steps):
    found = periodic_orbits(rectangle(beam, ratio), omega, steps).out_of_plane()
    unstable = found.amplitude[~found.stable]
    assert (unstable.min() if unstable.size else None) == first


def test_the_pages_state_these_limits():
    page = (ROOT / "docs" / "theory" / "planar.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([2468]) \|(.*)\|$", page, re.MULTILINE)
    ratios = (2.0, 3.0, 6.0, 18.5)
    for omega, cells in rows:
        stated = [cell.split()[0] for cell in cells.split("|")[1:5]]
        known = [math.inf if cell == "none" else float(cell) for cell in stated]
        assert known == pytest.approx([LIMITS[float(omega), r] for r in ratios], rel=5e-3)
    assert len(rows) == 4
    findings = " ".join((ROOT / "docs/findings.md").read_text(encoding="utf-8").split())
    low, high = (f"{LIMITS[omega, 18.5]:.3f}" for omega in (2.0, 8.0))
    assert f"from {low} L at 2 rad/s and from {high} L at 8" in findings


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:internal resonance")
@pytest.mark.parametrize(("omega", "ratio"), LIMITS)
def test_the_limits_of_the_table(beam, omega, ratio):
    found = stability_limit(rectangle(beam, ratio), omega)
    # Printed to four digits; bisected to 1e-4 of itself.
    assert found.amplitude == pytest.approx(LIMITS[omega, ratio], rel=2e-3)
    assert found.converged


@pytest.fixture(scope="module")
def strip_at_6(beam):
    return stability_limit(beam.with_shape(Rectangle()), 6.0, largest=0.1)


@pytest.mark.slow
def test_with_damping_the_limit_and_the_ends_of_tongues_are_numbers(beam):
    """Three times the functions and steps grow on one side alone, to the four digits printed."""
    strip = beam.with_shape(Rectangle())
    found = stability_limit(strip, 2.0, damping=0.005, largest=0.1)
    assert found.amplitude == pytest.approx(0.04018, abs=1e-5)
    assert found.converged
    assert len(found.tongues) == 2  # 6 without damping
    orbits = planar_orbits(strip, 2.0, damping=0.005)
    ends = [(tongue.low, tongue.high) for tongue in found.tongues]
    for end, into in [(found.amplitude, 5e-4), *((low, 5e-4) for low, _ in ends),
                      *((high, -5e-4) for _, high in ends)]:  # fmt: skip
        grows = [orbits.growth(end * (1.0 + off), 3).unstable for off in (-into, into)]
        assert grows == [False, True]


@pytest.mark.slow  # cheaper sections below have a tongue and a limit that their edges tell
def test_above_the_limit_all_orbits_grow_and_below_it_only_tongues_do(beam, strip_at_6):
    """The referee's amplitudes: 0.0705 by another code; tongues and windows of stability below."""
    limit = strip_at_6
    assert limit.amplitude == pytest.approx(0.0705, abs=2e-4)
    assert limit.converged
    assert limit.growth == 0.01
    above = np.linspace(limit.amplitude * 1.0005, 0.09, 8)
    before = [0.0, *(one.high for one in limit.tongues[:-1])]
    between = [
        max(one.low * 0.997, 0.5 * (end + one.low))
        for one, end in zip(limit.tongues, before, strict=True)
    ]
    inside = [0.5 * (one.low + one.high) for one in limit.tongues]
    found = periodic_orbits(
        beam.with_shape(Rectangle()), 6.0, [*between, *inside, *above]
    ).out_of_plane()
    per_radian = found.growth_rate / found.frequency
    count = len(between)
    assert np.all(per_radian[2 * count :] >= 0.01)
    assert found.stable[:count].all()
    # The last two, a sum resonance and a divergence, are narrow, with a window between.
    assert not found.stable[count : 2 * count].any()
    (strongest,) = [one for one in limit.tongues if one.growth > 0.02]
    assert strongest.kind == "period doubling"
    assert 0.067 < strongest.low < strongest.high < 0.0695
    assert f"{count} tongues below from a = {limit.tongues[0].low:.4g} on" in str(limit)


@pytest.mark.slow  # test_limit_search has tongues on growths that are known
@pytest.mark.filterwarnings("ignore:internal resonance")
def test_a_tongue_in_the_range_is_no_limit(beam):
    """A round bar that does not twist, at w̄ = 4.43: unstable about a = 0.5, stable at 0.6."""
    blade = beam.with_section_out_of_plane(1.0, math.inf)
    found = stability_limit(blade, 4.43 * beam.frequency_scale)
    assert math.isinf(found.amplitude)
    (tongue,) = found.tongues
    assert 0.0 < tongue.growth < found.growth == 0.01
    edges = periodic_orbits(blade, found.omega, [tongue.low, tongue.high, 0.6]).out_of_plane()
    assert edges.stable.tolist() == [False, False, True]
    assert "stay in their plane, up to a = 0.6, but for one tongue from" in str(found)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:internal resonance")
@pytest.mark.parametrize("omega", [2.0, 4.0, 6.0, 8.0])
def test_all_spin_ups_of_the_paper_leave_the_plane_as_a_rectangle_and_not_as_a_tube(beam, omega):
    ends = []
    for ramp in (3.375, 3.25, 3.0, 2.75, 2.5, 2.0):
        times = np.linspace(ramp, ramp + 6.0, 800)
        found = spin_up_response(beam, SpinUp(omega=omega, ramp_time=ramp), times, tolerance=1e-3)
        ends.append(0.5 * np.ptp(found.q) / beam.length)
    assert min(ends) > 0.097
    limit = stability_limit(beam.with_shape(Rectangle()), omega)
    assert limit.amplitude < min(ends)
    assert not periodic_orbits(beam.with_shape(Rectangle()), omega, ends).stable.any()
    assert periodic_orbits(beam.with_shape(Tube()), omega, ends).stable.all()


LIMIT_OF_SOFT_FLAP = 0.39117
"""By another code, where it grows at all: as the root of the distance from there."""


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:internal resonance")
def test_a_rectangle_of_three_to_one_has_a_tongue_of_the_sum(beam):
    found = stability_limit(rectangle(beam, 3.0), 2.0, largest=0.36).tongues
    (tongue,) = [one for one in found if one.kind == "sum resonance"]
    assert (tongue.low, tongue.high) == pytest.approx((0.2955, 0.3532), rel=2e-4)


def test_on_either_side_of_the_limit_an_orbit_leaves_its_plane_or_stays(beam):
    blade = beam.with_section_out_of_plane(0.01, math.inf)
    found = periodic_orbits(
        blade, 2.0, [LIMIT_OF_SOFT_FLAP + 1e-3, LIMIT_OF_SOFT_FLAP - 1e-3]
    ).out_of_plane()
    assert found.stable.tolist() == [False, True]
    assert found.growth_rate[0] > 0.0
    assert found.kind == ("period doubling", "")
    assert found.modes[1] == ()
    assert found.converged.all()
    assert "leave their plane; the smallest, a = 0.3922" in str(found)
    # Growth over a period is the largest multiplier.
    growth = math.exp(found.growth_rate[0] * 2.0 * math.pi / found.frequency[0])
    assert np.abs(found.multipliers[0]).max() == pytest.approx(growth, rel=1e-9)
    same = growth_rates(blade, 2.0, found.amplitude)
    assert same == pytest.approx(found.growth_rate, rel=0.01)
    # Motion that stays decays by its ratio of damping: flap of a round bar is of known frequency.
    flap = math.hypot(linear_modes(beam, 2.0, 1).frequencies[0], 2.0)
    decay = growth_rates(beam.with_section_out_of_plane(1.0), 2.0, np.array([0.01]), damping=0.02)
    assert decay == pytest.approx(-0.02 * flap, rel=1e-5)


@pytest.mark.slow
def test_a_map_has_no_number_where_there_is_no_orbit(beam):
    rates = growth_rates(beam.with_shape(Rectangle()), 8.0, np.array([0.02, 0.97]))
    assert np.isnan(rates).tolist() == [False, True]


def test_limits_over_shape_are_infinite_where_nothing_grows(beam):
    found = stability_limit(rectangle(beam, 1.0), 6.0, largest=0.03)
    assert math.isinf(found.amplitude)
    assert "stay in their plane, up to a = 0.03" in str(found)


@pytest.mark.parametrize("omega", [0.0, 1e-3])
def test_a_tube_that_hardly_turns_stays_in_the_plane(beam, omega):
    """Its plane may nearly be turned: multipliers near a double 1, which nothing may split."""
    found = periodic_orbits(beam.with_shape(Tube()), omega, [0.1, 0.4]).out_of_plane()
    assert found.stable.all()


def test_a_stability_of_growth_that_overflows_is_finite(beam):
    """The rectangle at 0.4 of its length: multipliers beyond what a number holds."""
    found = periodic_orbits(beam.with_shape(Rectangle()), 2.0, 0.4).out_of_plane()
    assert isinstance(found, GrowthOutOfPlane)
    assert 50.0 < found.growth_rate[0] < 500.0
    assert not found.converged[0]


ROUND = Tube()


@pytest.mark.filterwarnings("ignore:omega = 100 rad/s is 28 times")
@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda: periodic_orbits(UNIT, 1.0, 0.1).out_of_plane(), "is unknown: give its section by"),
        (lambda: stability_limit(UNIT, 1.0), "is unknown: give its section by"),
        (
            lambda: linear_modes(UNIT, 1.0, only="flap"),
            "has 0 flap modes: .* known out of the plane",
        ),
        (
            lambda: periodic_orbits(UNIT.with_section_out_of_plane(0.5), 1.0, 0.1).out_of_plane(),
            "torsional stiffness decides .* math.inf",
        ),
        (
            lambda: stability_limit(UNIT.with_shape(ROUND).with_setting_angle(0.3), 1.0),
            r"set at 0.3 rad: take blade.with_setting_angle\(0.0\)",
        ),
        (
            lambda: stability_limit(UNIT.with_shape(ROUND), 1.0, damping=-0.1),
            "not be neg",
        ),
        (
            lambda: periodic_orbits(told(UNIT, 0.0, 0.5, 0.5), 1.0, 0.1).out_of_plane(),
            "twist without inertia: give .* a rotary_inertia above zero",
        ),
        (
            lambda: periodic_orbits(UNIT.with_shape(ROUND), 1.0, 1.5),
            "between 0 and 1",
        ),
        (lambda: stability_limit(UNIT.with_shape(ROUND), 1.0, largest=1.0), "below 1"),
        (
            lambda: linear_modes(
                UNIT.with_section_out_of_plane(1.0, math.inf), 1.0, only="torsion"
            ),
            "torsion has no modes where torsion_ratio is unknown or infinite",
        ),
        (
            lambda: linear_modes(told(UNIT, 0.0, 1.0, 0.5), 1.0, only="torsion"),
            "has 0 torsion modes: .* no motion without stiffness or inertia has",
        ),
        (
            lambda: periodic_orbits(
                UNIT.with_section_out_of_plane(1e-3, 1.0), 100.0, 0.02
            ).out_of_plane(),
            "in the flap frequencies at w_bar = 100; rotate slower",
        ),
        (
            lambda: linear_modes(UNIT, 1.0, only="pitch"),
            "only must be one of flap, lag, torsion, axial, got 'pitch'",
        ),
        (lambda: periodic_orbits(UNIT, 1.0, 0.1, "lead 1"), "mode must be a name, 'lag 1' say"),
        (lambda: periodic_orbits(UNIT, 1.0, 0.1, "flap 1"), "no mode 'flap 1': its lowest are lag"),
        (lambda: periodic_orbits(UNIT, 1.0, 0.1, "axial 1"), "take a mode of lag or flap"),
    ],
)
def test_what_is_refused(ask, sentence):
    with pytest.raises(ValueError, match=sentence):
        ask()


def test_orbits_that_do_not_exist_are_named(beam, monkeypatch):
    monkeypatch.setattr("analytic.exact.free.path.THOROUGH", Care(harmonics=30))
    with pytest.raises(AmplitudeNotReachedError, match="no orbit of lag 3"):
        periodic_orbits(beam.with_shape(Rectangle()), 4.0, 0.2, mode="lag 3").out_of_plane()


TAPERED = Blade(
    length=8.0,
    section=Section(
        mass_per_length=[0.2, -0.1], axial_stiffness=[5e6, -2e6], bending_stiffness=[566.0, -300.0]
    ),
)


@pytest.mark.parametrize("inertia", [None, 5e-5])
def test_what_grows_is_named_by_the_modes_of_the_straight_blade(beam, inertia):
    """Flap and torsion by L2 are those of `linear_modes`, in other coordinates, name by name."""
    blade = beam.with_shape(Rectangle())
    if inertia:
        blade = told(TAPERED, inertia, 0.0625, 0.08)
    planar = rotating_blade(blade, 4.0, blade_continuum(blade, BERNOULLI_EULER, 16, 8))
    space = FlapTorsion(blade, 27)
    rows, frequencies, names = _steady_modes(space, with_points_for(planar, space.functions))
    assert len(names) == len(rows) == frequencies.size == 54
    of = dict(zip(names, frequencies * blade.frequency_scale, strict=True))
    for plane in ("flap", "torsion"):
        known = linear_modes(blade, 4.0, 2, only=plane).frequencies
        # The Hill equation leaves out the inertia of sections that turn with the slope of flap.
        within = 1e-5 if inertia and plane == "flap" else 1e-8
        assert [of[f"{plane} 1"], of[f"{plane} 2"]] == pytest.approx(known, rel=within)


@pytest.mark.parametrize(
    ("blade", "theory", "covers"),
    [
        (UNIT.with_shape(ROUND), BERNOULLI_EULER, "all directions"),
        (UNIT.with_shape(ROUND).with_twist(0.1), BERNOULLI_EULER, "all directions"),
        (UNIT, BERNOULLI_EULER, "the plane alone: how this blade bends and twists"),
        (UNIT.with_shape(ROUND), Theory(shear=0.3), "the plane alone: how slices shear"),
        (told(UNIT, 0.0, 0.5, 0.5), BERNOULLI_EULER, "the plane alone: .* without inertia"),
    ],
)
def test_orbits_say_which_directions_their_stability_covers(blade, theory, covers):
    orbits = periodic_orbits(blade, 1.0, 0.05, theory=theory)
    assert re.match(covers, orbits.covers)
    assert orbits.stable.all()


def test_damping_of_the_blade_or_a_ratio_slows_what_leaves_the_plane(beam):
    orbits = periodic_orbits(beam.with_shape(Rectangle()), 4.0, 0.08)
    assert not orbits.stable[0]
    free, ratio, both = (
        orbits.out_of_plane(damping=damping, blade_damping=own).growth_rate[0]
        for damping, own in ((0.0, None), (0.005, None), (0.005, Damping(external=0.05)))
    )
    assert free > ratio > both > 0.0
    twisted = periodic_orbits(UNIT.with_shape(ROUND).with_twist(0.1), 1.0, 0.05)
    with pytest.raises(ValueError, match="these orbits are in space and have no plane to leave"):
        twisted.out_of_plane()
