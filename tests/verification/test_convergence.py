"""Limits, orders and errors from a few runs, on series whose limit is known."""

import math

import numpy as np
import pytest

from rotbeam_exu.verification.convergence import convergence, observed_order

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
