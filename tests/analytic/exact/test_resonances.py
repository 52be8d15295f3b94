"""Where harmonics meet modes, on orbits of which the answer is known in closed form."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from analytic.exact.free import branches, internal_resonance
from analytic.exact.free.internal_resonance import (
    Resonance,
    frequency_at,
    frequency_ratios,
    nearest_resonance,
    outstanding,
    pinned,
    resonances_along,
    warn_of_resonances,
)
from analytic.input_checks import RotbeamWarning
from analytic.methods.newton import NoOrbitError

MODES = np.array([1.0, 5.5, 17.3, 33.6, 56.2, 80.1])
"""Of which ν_2/Ω is 5.5 + 4 a²: 6 at a² = 1/8; ν_3/Ω is 17.3 - 2 a²: 17 at a² = 0.15."""
FACTOR = np.array([4.0, -2.0, 0.1, 0.0])


def orbit_at(a, *, harmonics=7, pole=0.36, background=0.0, rate=1.0, setting=1.0):
    """An orbit of Ω = 2 - a² whose sixth harmonic goes through infinity at `pole`."""
    sines = 0.1 ** np.arange(harmonics) * a
    if harmonics > 5:
        sines[5] = a * (1e-3 / (pole - a) + background)
    model = SimpleNamespace(skews=lambda rate: abs(rate * setting) > 1e-9)
    return SimpleNamespace(
        amplitude=a, frequency=2.0 - a**2, harmonics=harmonics,
        gauge_harmonics=np.append(0.0, -1j * sines),
        sizes=np.abs(sines), system=SimpleNamespace(rate=rate, model=model),
    )  # fmt: skip


@pytest.fixture(autouse=True)
def multipliers(monkeypatch):
    """Multipliers as of such exponents: two for each mode after the orbit's own."""

    def found(orbit, modes):
        ratios = (MODES[1:5] + FACTOR * orbit.amplitude**2)[: modes - 1]
        turned = np.repeat(np.exp(2j * np.pi * ratios), 2)
        turned[1::2] = turned[1::2].conj()
        return SimpleNamespace(values=np.concatenate((np.ones(2), turned)))

    monkeypatch.setattr(internal_resonance, "floquet_multipliers", found)


def of(modes=MODES, place=0):
    """The path of a mode, whose unit of frequency is 3 rad/s."""
    beam = SimpleNamespace(frequency_scale=3.0)
    names = [f"lag {k}" for k in range(1, len(modes) + 1)]
    return SimpleNamespace(
        modes=modes, mode=names[place], place=place, names=names, blade=beam, at_resonance=""
    )


def along(amplitudes, **options):
    return [orbit_at(a, **options) for a in amplitudes]


def test_ratios_are_followed_through_whole_and_half_numbers():
    amplitudes = np.arange(0.05, 0.8, 0.05)
    modes, ratios = frequency_ratios(of(3.0 * MODES), along(amplitudes))
    assert modes == ["lag 2", "lag 3", "lag 4", "lag 5"]
    assert ratios == pytest.approx(MODES[1:5] + FACTOR * amplitudes[:, None] ** 2, abs=1e-12)
    # Of the second mode the first is among the others.
    assert frequency_ratios(of(MODES / 5.5, 1), along([0.05]))[0][:2] == ["lag 1", "lag 3"]


def test_resonances_are_where_ratios_are_whole_or_the_harmonic_has_its_pole():
    amplitudes = np.arange(0.05, 0.71, 0.025)
    found = resonances_along(of(), along(amplitudes))
    assert [(one.harmonic, one.mode) for one in found] == [
        (6, "lag 2"),
        (17, "lag 3"),
        (7, "lag 2"),
    ]
    assert [one.amplitude for one in found] == sorted(one.amplitude for one in found)
    by_number = {one.harmonic: one for one in found}
    # The sixth's own pole counts, of the others the ratio; straight between orbits 0.025 apart.
    assert by_number[6].amplitude == pytest.approx(0.36, abs=1e-9)
    assert by_number[17].amplitude == pytest.approx(np.sqrt(0.15), abs=1e-3)
    assert by_number[7].amplitude == pytest.approx(np.sqrt(0.375), abs=1e-3)
    for one in found:
        assert one.frequency == pytest.approx(3.0 * (2.0 - one.amplitude**2), abs=2e-3)
    # Without Coriolis forces an orbit has no even harmonics.
    still = resonances_along(of(), along(amplitudes, rate=0.0))
    assert [(one.harmonic, one.mode) for one in still] == [(17, "lag 3"), (7, "lag 2")]
    flapping = resonances_along(of(), along(amplitudes, setting=1e-17))
    assert [(one.harmonic, one.mode) for one in flapping] == [(17, "lag 3"), (7, "lag 2")]


def test_frequencies_between_orbits_are_on_straight_lines():
    orbits = along([0.2, 0.4])
    assert frequency_at(orbits, 0.3) == pytest.approx(2.0 - 0.5 * (0.04 + 0.16))
    assert frequency_at(orbits, 0.4) == pytest.approx(2.0 - 0.16)


@pytest.mark.parametrize("background", [2e-4, 2e-3, -2e-3])
def test_a_resonance_is_pinned_down_between_two_orbits(background):
    """The harmonic's own part shifts where two far orbits place the pole, not two near ones."""

    def at(a):
        asked.append(a)
        return orbit_at(a, background=background)

    asked = []
    orbits = [at(a) for a in (0.2, 0.3, 0.4, 0.5, 0.55)]
    near, place = pinned(at, orbits, Resonance(6, "lag 2", 0.35, 1.0))
    assert place == pytest.approx(0.36, abs=1e-6)
    assert [one.amplitude for one in near] == asked[5:]
    closest = sorted([0.3, 0.4, *asked[5:]], key=lambda a: abs(a - 0.36))
    below, above = (min(c for c in closest if c > 0.36), max(c for c in closest if c < 0.36))
    assert abs(above - below) < 5e-3
    assert all(0.3 < a < 0.4 for a in asked[5:])
    # What is beyond the orbits, or has no pole between them, stays where it is.
    assert pinned(at, orbits, Resonance(6, "lag 2", 0.1, 1.0)) == ([], 0.1)
    assert pinned(at, orbits, Resonance(6, "lag 2", 0.6, 1.0)) == ([], 0.6)
    assert pinned(at, orbits, Resonance(6, "lag 2", 0.45, 1.0)) == ([], 0.45)
    assert pinned(at, orbits, Resonance(9, "lag 2", 0.35, 1.0)) == ([], 0.35)

    def nowhere(a):
        raise NoOrbitError("none")

    assert pinned(nowhere, orbits, Resonance(6, "lag 2", 0.35, 1.0))[0] == []


def test_a_harmonic_stands_out_that_is_larger_than_the_one_before_and_near_a_mode():
    orbit = orbit_at(0.35)  # 5.5/1.8775 = 2.93 and 17.3/1.8775 = 9.2: near 3 and none
    assert outstanding(of(), orbit) == []  # the sixth is large, and 2.93 not near six
    assert outstanding(of(MODES * 2.0), orbit) == [6]  # 11/1.8775 = 5.86
    assert outstanding(of(MODES * 1.8), orbit) == []  # 5.27 is 12 % away
    third = orbit_at(0.1)
    third.sizes[2] = 0.02
    assert outstanding(of(MODES * 1.07), third) == [3]  # 5.9/1.99 = 2.96
    orbit.sizes[4] = 2.0 * orbit.sizes[5]
    assert outstanding(of(MODES * 2.0), orbit) == []  # less than the one before
    small = orbit_at(0.1, pole=9.0)  # 1e-4 of the first: drowned
    assert outstanding(of(MODES * 2.1), small) == []


def test_the_nearest_resonance_is_told_with_its_distance():
    """5.66 and 17.22: of 6 and 17 the higher is nearer, 1.3 %, but less felt."""
    said = nearest_resonance(of(), along([0.05, 0.1, 0.15, 0.2]))
    assert "harmonic 6 is 6.0 % from lag 2" in said
    said = nearest_resonance(of(), along([0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.33]))
    assert "harmonic 6 is 1.1 % from lag 2" in said


def test_a_warning_names_the_harmonic_and_its_distance_once():
    """At a = 0.3 ν_2/Ω is 5.86, 0.14 of a turn from 6; at 0.34 5.96, 0.04 of a turn."""
    orbits = along([0.3, 0.34, 0.35])
    modes = 2.0 * MODES
    with pytest.warns(RotbeamWarning) as told:
        warn_of_resonances(of(modes), orbits)
    (said,) = [str(one.message) for one in told]
    drive = f"{18 * orbits[1].frequency:.4f} rad/s"
    assert f"from a = 0.34 on, harmonic 6 of the orbit of lag 1 ({drive})" in said
    assert "is 0.6 % from lag 2" in said  # 0.0376 of 6
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_of_resonances(of(modes), along([0.1, 0.2]))  # 5.54 and 5.66: 0.3 of a turn
        warn_of_resonances(of(modes), [])


def test_the_nearest_resonance_is_that_of_the_last_orbit():
    """At a = 0.65 ratios are 7.19 and 16.455, from 6.31 and 16.895 before."""
    said = nearest_resonance(of(), along([0.05, 0.25, 0.45, 0.65]))
    assert "harmonic 7 is 2.6 % from lag 2" in said


def test_a_tongue_is_not_entered_where_another_felt_resonance_is_nearer(monkeypatch):
    """Two orbits give the direction, but not across another pole."""
    asked = []
    monkeypatch.setattr(branches, "_followed", lambda *sides: asked.append(sides[:2]) or "piece")
    main, own = along([0.3, 0.34, 0.38, 0.42]), Resonance(6, "lag 2", 0.36, 1.0)
    for other, below, beyond in (
        (Resonance(2, 3, 0.32, 1.0), None, "piece"),
        (Resonance(2, 3, 0.40, 1.0), "piece", None),
        (Resonance(5, 3, 0.32, 1.0), "piece", "piece"),  # of 1e-4, not felt
    ):
        found = [branches._tongue(main, [own, other], own, side) for side in (True, False)]
        assert found == [below, beyond]
    assert asked[-2:] == [(main[0], main[1]), (main[3], main[2])]
    # No harmonic that is felt, or no two orbits on its side, no tongue.
    assert branches._tongue(main, [own], Resonance(5, 3, 0.36, 1.0), True) is None
    assert branches._tongue(main, [own], Resonance(6, "lag 2", 0.32, 1.0), True) is None
