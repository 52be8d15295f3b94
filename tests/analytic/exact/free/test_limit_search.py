"""The search for the limit of stability, on growths that are known as functions of amplitude."""

import math

import numpy as np
import pytest

from analytic import Beam, Rectangle, Theory
from analytic.exact.free.planar_orbits import planar_orbits
from analytic.exact.free.stability_limit import _limit
from analytic.exact.stability.growth import GROWTH, Growth
from analytic.methods.newton import NoOrbitError


class Orbits:
    """Orbits of which `per_radian(a, finer)` tells the growth; none is larger than `end`."""

    blade, omega, mode, damping, damped = None, 2.0, "lag 1", 0.0, False
    theory = Theory()

    def __init__(self, per_radian, end=1.0):
        self.per_radian, self.end, self.asked = per_radian, end, []

    def growth(self, amplitude, finer=1):
        if amplitude > self.end:
            raise NoOrbitError("none")
        self.asked.append((amplitude, finer))
        exponent = 2.0 * np.pi * self.per_radian(amplitude, finer)
        return Growth(exponent, np.ones(8, complex), self.kind(amplitude), (f"at {amplitude:.3f}",))

    def kind(self, amplitude):
        return "divergence"


def ramp(a, finer, start=0.2, slope=0.1):
    """0.01 from `start` + 0.1 on; the first resolution is off by 0.3 %."""
    return max(0.0, slope * (a * (1.003 if finer == 1 else 1.0) - start))


def test_the_limit_is_where_growth_stays():
    orbits = Orbits(ramp)
    found = _limit(orbits, 0.01, 0.6)
    assert found.amplitude == pytest.approx(0.3, rel=1e-4)
    assert found.amplitude >= 0.3
    assert (found.searched, found.growth, found.converged) == (0.6, 0.01, True)
    assert (found.kind, found.modes) == ("divergence", (f"at {found.amplitude:.3f}",))
    # What grows below the limit, however slowly, is a tongue: from 0.2 on, to the limit.
    (tongue,) = found.tongues
    assert (tongue.low, tongue.high) == (pytest.approx(0.2, rel=0.02), pytest.approx(0.3, rel=3e-3))
    assert tongue.growth == pytest.approx(0.01, rel=0.02)
    assert (tongue.kind, tongue.modes) == ("divergence", (f"at {tongue.high:.3f}",))
    amplitudes = np.array(sorted({a for a, _ in orbits.asked}))
    # Steps of 2 %, of 5 % where it grows ten times as fast.
    assert np.diff(np.log(amplitudes)).max() <= math.log(1.0201)
    steep = Orbits(lambda a, finer: ramp(a, finer, slope=3.0))
    _limit(steep, 0.01, 0.6)
    strong = np.array(sorted(a for a, finer in steep.asked if finer == 1 and a > 0.3))
    assert np.median(np.diff(np.log(strong))) == pytest.approx(math.log(1.05))


def test_more_growth_has_a_higher_limit_and_what_stays_has_none():
    assert _limit(Orbits(ramp), 0.02, 0.6).amplitude == pytest.approx(0.4, rel=1e-4)
    none = _limit(Orbits(lambda a, finer: 0.0), 0.01, 0.6)
    assert (math.isinf(none.amplitude), none.kind, none.tongues) == (True, "", ())
    assert none.converged
    # Where the largest orbit does not grow so fast all that does is a tongue.
    bump = _limit(Orbits(lambda a, finer: 0.02 if 0.3 < a < 0.5 else 0.0), 0.01, 0.6)
    assert math.isinf(bump.amplitude)
    (tongue,) = bump.tongues
    assert (tongue.low, tongue.high) == pytest.approx((0.3, 0.5), rel=0.02)


def test_what_all_orbits_do_begins_at_the_smallest():
    """Growth at every amplitude down to a thousandth: the limit is the smallest looked at."""
    found = _limit(Orbits(lambda a, finer: 0.05), 0.01, 0.1)
    # Steps of 5 % end above it; finer ones begin at 0.85 of where those ended.
    assert 0.85e-3 < found.amplitude < 0.85 * 1.051e-3
    from_small = _limit(Orbits(lambda a, finer: 0.05 if a > 0.004 else 0.0), 0.01, 0.1)
    assert from_small.amplitude == pytest.approx(0.004, rel=1e-3)


def test_the_search_ends_where_orbits_do():
    found = _limit(Orbits(ramp, end=0.4), 0.01, 0.6)
    assert 0.4 / 1.02 < found.searched <= 0.4
    assert found.amplitude == pytest.approx(0.3, rel=1e-4)
    with pytest.raises(NoOrbitError):
        _limit(Orbits(ramp, end=0.001), 0.01, 0.6)


def test_a_limit_that_only_the_finer_resolution_sees_is_found():
    """At the largest orbit, 0.6, the first resolution has 0.0097 per radian, twice that 0.0103."""
    found = _limit(
        Orbits(lambda a, finer: 0.1 * (a * min(1.0, 0.98 + 0.01 * finer) - 0.497)), 0.01, 0.6
    )
    assert found.amplitude == pytest.approx(0.597, rel=1.1e-4)


def test_ends_of_damped_tongues_are_bisected():
    def tongues(a, finer):
        return max(0.01 * (0.02 - abs(a - 0.2)), 0.01 * (0.005 - abs(a - 0.3)), a - 0.4, 0.0)

    orbits = Orbits(tongues)
    orbits.damped = True
    found = _limit(orbits, GROWTH / (2.0 * np.pi), 0.6)
    # GROWTH begins 1.6e-4 inside of a tongue that rises by 0.01.
    ends = [(tongue.low, tongue.high) for tongue in found.tongues]
    inside = GROWTH / (2.0 * np.pi) / 0.01
    wanted = [(0.18 + inside, 0.22 - inside), (0.295 + inside, 0.305 - inside)]
    assert np.array(ends) == pytest.approx(np.array(wanted), rel=1e-4)
    assert found.amplitude == pytest.approx(0.4, rel=1e-4)


def test_tongues_are_apart_and_the_strongest_names_each():
    def growth(a, finer):
        for low, high in ((0.03, 0.04), (0.1, 0.15)):
            if low < a < high:
                return 0.001 * (1.0 - abs(2.0 * (a - low) / (high - low) - 1.0)) + 1e-5
        return ramp(a, finer)

    found = _limit(Orbits(growth), 0.01, 0.6).tongues
    assert [one.low for one in found] == pytest.approx([0.03, 0.1, 0.2], rel=0.021)
    assert [one.high for one in found] == pytest.approx([0.04, 0.15, 0.3], rel=0.021)
    for one, middle in zip(found, (0.035, 0.125, None), strict=False):
        if middle:
            assert one.growth == pytest.approx(0.001, rel=0.2)
            assert float(one.modes[0].split()[1]) == pytest.approx(middle, rel=0.03)


def test_neighbors_that_grow_in_two_ways_are_two_tongues():
    orbits = Orbits(lambda a, finer: 0.005 if 0.1 < a < 0.15 else ramp(a, finer))
    orbits.kind = lambda a: "sum resonance" if a < 0.12 else "divergence"
    found = _limit(orbits, 0.01, 0.6).tongues
    assert [one.kind for one in found] == ["sum resonance", "divergence", "divergence"]
    assert [one.high for one in found] == pytest.approx([0.12, 0.15, 0.3], rel=0.021)


@pytest.mark.parametrize(
    ("off", "converged"), [(0.0, True), (0.009, True), (0.03, False), (-0.03, False)]
)
def test_a_finer_resolution_must_tell_the_limit_within_a_per_cent(off, converged):
    def growth(a, finer):
        return ramp(a * (1.0 - off if finer == 3 else 1.0), 2)

    assert _limit(Orbits(growth), 0.01, 0.6).converged == converged


def test_growth_counts_above_round_off():
    still, grows = (Growth(exponent, np.ones(8)) for exponent in (GROWTH, 2.0 * GROWTH))
    assert (still.unstable, still.per_radian, still.rate(3.0)) == (False, 0.0, 0.0)
    assert grows.unstable
    assert grows.rate(3.0) == pytest.approx(2.0 * GROWTH * 3.0 / (2.0 * np.pi))
    # Damped, all that grows counts, and nothing else.
    just = Growth((1.0 + 1e-9) * GROWTH, np.ones(8)).per_radian
    strip = Beam.reference().with_shape(Rectangle())
    assert planar_orbits(strip, 2.0).least == 0.01
    assert planar_orbits(strip, 2.0, damping=0.005).least == pytest.approx(just, rel=1e-8)
