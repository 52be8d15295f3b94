"""Limits, orders and errors from a few runs, on series whose limit is known."""

import math

import numpy as np
import pytest

from rotbeam_exu.verification.convergence import (
    convergence,
    convergence_of_functions,
    observed_order,
)

LIMIT = 2.5


def series(sizes, *, order=2.0, size=1.0, higher=0.0):
    """f = f₀ + C (hᵖ + c hᵖ⁺¹)."""
    h = np.asarray(sizes, dtype=float)
    return LIMIT + size * h**order * (1.0 + higher * h)


@pytest.mark.parametrize("order", [1.0, 2.0, 3.7, 4.0, 8.0])
@pytest.mark.parametrize("sizes", [(0.4, 0.2, 0.1), (0.3, 0.2, 0.15), (0.1, 0.2, 0.17, 0.4)])
def test_a_pure_power_is_found_to_round_off(order, sizes):
    found = convergence(sizes, series(sizes, order=order))
    assert found.order == pytest.approx(order, abs=1e-6)
    assert found.limit == pytest.approx(LIMIT, abs=1e-9)
    assert found.why == ""
    exact = np.sort(np.asarray(sizes))[::-1] ** order
    assert found.errors == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("declared", [None, 2.0])
@pytest.mark.parametrize("higher", [-2.0, -0.5, 0.5, 3.0])
def test_the_bar_holds_where_the_first_mesh_is_too_coarse(higher, declared):
    """A next term as large as the first on the coarsest mesh."""
    for finest in (0.1, 0.05, 0.025):
        sizes = (4 * finest, 2 * finest, finest)
        found = convergence(sizes, series(sizes, higher=higher), declared=declared)
        assert abs(found.limit - LIMIT) <= found.bar
        assert np.all(np.abs(found.errors - (found.values - LIMIT)) <= found.error_bars)


def test_the_bar_holds_where_the_declared_order_is_met_by_chance():
    """h² + 0.3 h³ - (28 · 0.3/180) h⁴ shows an order of two on 4, 2 and 1, though it has more."""
    h = np.array([4.0, 2.0, 1.0])
    found = convergence(h, h**2 + 0.3 * h**3 - 28 * 0.3 / 180 * h**4, declared=2.0)
    assert found.order == pytest.approx(2.0)
    assert 0.2 < abs(found.limit) <= found.bar


def test_bars_hold_and_shrink_as_meshes_are_refined():
    bars = []
    for finest in 0.1 * 0.5 ** np.arange(6):
        sizes = finest * np.array([4.0, 2.0, 1.0])
        found = convergence(sizes, series(sizes, higher=2.0), declared=2.0)
        assert abs(found.limit - LIMIT) <= found.bar
        bars.append(found.bar)
    assert np.all(np.diff(bars) < 0.0)


@pytest.mark.parametrize("seed", range(20))
def test_noise_is_never_taken_for_an_order_or_a_limit(seed):
    """From far above the floor to far below it the limit stays within its bar."""
    noise, rng = 1e-6, np.random.default_rng(seed)
    for finest in 0.2 * 0.5 ** np.arange(14):
        sizes = finest * np.array([4.0, 2.0, 1.0])
        values = series(sizes, order=4.0) + noise * rng.uniform(-1.0, 1.0, 3)
        found = convergence(sizes, values, noise=noise, declared=4.0)
        assert abs(found.limit - LIMIT) <= found.bar
        assert found.settles
    assert math.isnan(found.order)
    assert found.why == "the changes are below the floor"
    assert found.bar <= 4.0 * noise


def test_the_order_is_taken_where_it_stands_out_of_the_noise():
    sizes = 0.4 * 0.5 ** np.arange(6)
    found = convergence(sizes, series(sizes, order=4.0), noise=1e-5)
    assert found.order == pytest.approx(4.0, abs=1e-6)
    assert found.limit == found.values[-1]


def test_two_runs_need_a_declared_order():
    sizes = (0.2, 0.1)
    found = convergence(sizes, series(sizes), declared=2.0)
    assert found.limit == pytest.approx(LIMIT)
    assert math.isnan(found.order)
    assert found.why == "2 runs, three are needed"
    # The first order, when in truth it is the second, is off by less than its bar.
    assumed = convergence(sizes, series(sizes))
    assert 0.0 < abs(assumed.limit - LIMIT) <= assumed.bar


def test_one_run_has_no_limit():
    found = convergence([0.1], [1.0])
    assert math.isnan(found.limit)
    assert found.why == "1 run, three are needed"


def test_what_oscillates_has_a_limit_but_no_order():
    found = convergence((0.4, 0.2, 0.1), (3.0, 2.0, 2.5))
    assert found.why == "the values are not monotone"
    assert found.settles
    assert abs(found.limit - 2.4) <= found.bar


def test_what_grows_does_not_settle():
    found = convergence((0.4, 0.2, 0.1), (1.0, 2.0, 4.0))
    assert not found.settles
    assert found.why == "the changes do not shrink"


def test_orders_of_functions_are_those_of_the_norms_of_their_changes():
    assert observed_order((4, 2, 1), (1.6e-3, 4e-4), (0.0, 0.0))[0] == pytest.approx(2.0)
    assert observed_order((4, 2, 1), (1.6e-3, 4e-4), (0.0, 1e-3))[1] == (
        "the changes are below the floor"
    )


NOISE = (3e-3, 2e-3, 1e-3)
"""Of each run another, the finest's last."""


def test_a_measured_order_keeps_a_quarter_of_its_correction():
    """Roache's factor of 1.25 on C h² = 0.01; a coarser fourth mesh says nothing more."""
    for sizes in ((0.4, 0.2, 0.1), (0.8, 0.4, 0.2, 0.1)):
        found = convergence(sizes, series(sizes), declared=2.0)
        assert found.bar == pytest.approx(0.25 * 0.01)
    off = convergence((0.8, 0.4, 0.2, 0.1), [7.0, *series((0.4, 0.2, 0.1))])
    assert (off.order, off.limit) == pytest.approx((2.0, LIMIT))
    # Declared as one, the correction would be 0.03: the bar is twice the difference.
    assert convergence(sizes, series(sizes), declared=1.0).bar == pytest.approx(2.0 * 0.02)


def test_the_noise_of_each_run_has_its_place_in_the_bar():
    """With halved sizes the correction is b²/(a - b) for changes a and b; noise at its worst."""
    a, b = 0.12, 0.03
    found = convergence((0.4, 0.2, 0.1), series((0.4, 0.2, 0.1)), noise=NOISE)
    largest = (b + 0.003) ** 2 / (a - 0.005 - (b + 0.003))
    assert found.bar == pytest.approx(2.0 * 0.01 + largest - 0.01 + 0.001)
    assert found.error_bars == pytest.approx(found.bar + np.array(NOISE))
    # Runs may come in any order, their noise with them.
    again = convergence((0.1, 0.4, 0.2), series((0.1, 0.4, 0.2)), noise=(1e-3, 3e-3, 2e-3))
    assert again.bar == pytest.approx(found.bar)
    # That of a fourth and coarsest has no part in it.
    four = (0.8, 0.4, 0.2, 0.1)
    longer = convergence(four, series(four), noise=(0.5, *NOISE))
    assert (longer.limit, longer.bar) == pytest.approx((found.limit, found.bar))


def test_a_declared_order_keeps_twice_its_correction():
    found = convergence((0.2, 0.1), series((0.2, 0.1)), noise=NOISE[1:], declared=2.0)
    assert found.bar == pytest.approx(2.0 * 0.01 + 0.003 / 3.0 + 0.001)
    assumed = convergence((0.3, 0.1), series((0.3, 0.1)), noise=NOISE[1:])
    # Of the first order a third of the size leaves half of the change.
    assert assumed.limit == pytest.approx(LIMIT + 0.01 - 0.08 / 2.0)
    assert assumed.bar == pytest.approx(2.0 * 0.04 + 0.003 / 2.0 + 0.001)


def test_what_cannot_be_extrapolated_keeps_three_changes():
    for values, settles in (((3.0, 2.0, 2.5), True), ((2.0, 2.2, 2.7), False)):
        found = convergence((0.9, 0.3, 0.1), values, noise=NOISE)
        assert found.limit == values[-1]
        # Of the first order a third of the size leaves half of the change, of 0.5 here.
        assert found.bar == pytest.approx(3.0 * 0.25 + 0.001)
        assert found.settles == settles


def test_below_the_floor_the_finest_run_is_the_limit_within_twice_the_noise():
    for coarse, wider in ((0.2, 1.0), (0.15, 2.0), (0.4, 1.0)):
        found = convergence((coarse, 0.1), (2.502, 2.5), noise=NOISE[1:])
        assert (found.limit, found.bar) == pytest.approx((2.5, 2.0 * 0.003 * wider))


@pytest.mark.parametrize(
    ("sizes", "changes", "noise", "order"),
    [
        ((4, 2, 1), (1.3, 1.0), (0.1, 0.1), math.log2(1.3)),
        ((4, 2, 1), (1.3, 1.0), (0.21, 0.1), "the changes shrink by no more than the noise"),
        ((4, 2, 1), (1.3, 1.0), (0.1, 0.21), "the changes shrink by no more than the noise"),
        ((4, 2, 1), (1.3, 1.0), (0.1, 1.0), "the changes are below the floor"),
        # With any order above zero changes shrink by more than ln 2 over ln 4/3, 2.41.
        ((4, 2, 1.5), (1.0, 0.42), (0.0, 0.0), "the changes do not shrink"),
        ((4, 2, 1.5), (12.0, 1.75), (0.0, 0.0), 2.0),
        ((8, 4, 2, 1), (4.8, 1.2, 0.4), (0.0, 0.0, 0.5), 2.0),
        ((8, 4, 2, 1), (9.0, 1.2, 0.3), (0.0, 0.0, 0.0), 2.0),
        ((8, 4, 2, 1), (9.0, 1.2, -0.3), (0.0, 0.0, 0.0), "the values are not monotone"),
        ((2, 1), (0.3,), (0.0,), "2 runs, three are needed"),
    ],
)
def test_an_order_is_of_the_three_finest_runs_that_show_one(sizes, changes, noise, order):
    found, why = observed_order(sizes, changes, noise)
    if isinstance(order, str):
        assert (math.isnan(found), why) == (True, order)
    else:
        assert (found, why) == (pytest.approx(order, abs=1e-9), "")


def test_functions_tend_to_a_function():
    x = np.linspace(0.0, 1.0, 5)
    for sizes in ((0.1, 0.4, 0.2), (0.2, 0.1, 0.8, 0.4)):
        functions = np.cos(x) + np.array(sizes)[:, None] ** 2 * (1.0 + x)
        runs, limit = convergence_of_functions(sizes, functions, noise=1e-6, declared=2.0)
        assert limit == pytest.approx(np.cos(x), abs=1e-12)
        assert runs.order == pytest.approx(2.0)
        # By the largest change, at x = 1, where C is 2.
        assert np.abs(runs.errors) == pytest.approx(2.0 * np.sort(sizes)[::-1] ** 2)
        assert runs.bar == pytest.approx(0.25 * 0.02, rel=1e-3)
    for alone in ([0.1], [0.2, 0.1]):
        assert np.array_equal(
            convergence_of_functions(alone, np.ones((len(alone), 3)))[1], [1.0] * 3
        )


@pytest.mark.parametrize(
    ("sizes", "values", "sentence"),
    [
        ((), (), "each run has a size"),
        ((0.1, 0.2), (1.0,), "each run has a size"),
        ((0.1, 0.1), (1.0, 2.0), "sizes must be positive and distinct"),
        ((0.1, -0.1), (1.0, 2.0), "sizes must be positive and distinct"),
        ((0.1, 0.2), (1.0, np.nan), "values"),
    ],
)
def test_bad_input(sizes, values, sentence):
    with pytest.raises(ValueError, match=sentence):
        convergence(sizes, values)
