"""Limits, orders and errors by one fit to all runs, on series whose limit is known."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotbeam_exu.verification.convergence import Order, converged

LIMIT = 2.5


def series(elements, steps=None, *, order=2.0, size=1.0, higher=0.0, in_step=3e-3):
    """f = f₀ + C (xᵖ + c xᵖ⁺¹) + D h², x = 1/n."""
    x = 1.0 / np.asarray(elements, dtype=float)
    h = np.zeros(x.size) if steps is None else np.asarray(steps, dtype=float)
    return LIMIT + size * x**order * (1.0 + higher * x) + in_step * h**2


@pytest.mark.parametrize("order", [1.0, 2.0, 3.7, 4.0, 8.0])
@pytest.mark.parametrize("elements", [(4, 8, 16), (10, 15, 20), (16, 8, 9, 4)])
def test_a_pure_power_is_found(order, elements):
    """To a tenth of the finest run's error: two in a hundred of it are left to chance."""
    values = series(elements, order=order)
    found = converged(elements, None, values, declared=(order, None))
    finest = max(elements) ** -order
    assert found.limit == pytest.approx(LIMIT, abs=0.1 * finest)
    if order > 1.0 or len(elements) > 3:
        assert found.orders["mesh"].value == pytest.approx(order, rel=0.02)
    else:  # three meshes cannot tell it from a half and from one and a half
        assert found.orders["mesh"].why == "the runs do not determine it"
    assert abs(found.limit - LIMIT) <= found.bar
    exact = 1.0 / np.sort(elements) ** order
    assert found.errors == pytest.approx(exact, abs=0.1 * finest)
    assert found.errors == pytest.approx(found.in_mesh, rel=1e-3, abs=0.1 * finest)


@pytest.mark.parametrize("order", [1.3, 1.7, 2.3, 3.4, 4.5])
def test_an_order_that_nobody_declared_is_found_between_those_of_the_grid(order):
    """Of four meshes, to a hundredth; the limit to a tenth of the finest run's error, as above."""
    found = converged((8, 16, 32, 64), None, series((8, 16, 32, 64), order=order))
    assert found.orders["mesh"].value == pytest.approx(order, rel=0.01)
    assert found.limit == pytest.approx(LIMIT, abs=0.1 / 64**order)


TOGETHER = (8, 16, 32, 16, 16), (2.0, 2.0, 2.0, 1.0, 4.0)
"""Meshes at one of the steps that were tried on one of them."""
APART = (8, 16, 32, 64, 64, 64), (2.0, 2.0, 2.0, 1.0, 0.5, 0.25)
"""Steps on a mesh of their own, all smaller."""
DIAGONAL = (8, 16, 32), (4.0, 2.0, 1.0)
"""As the step of an explicit code goes with its mesh."""
GRID = (8, 8, 8, 16, 16, 16, 32, 32, 32), (4.0, 2.0, 1.0) * 3


@pytest.mark.parametrize("runs", [TOGETHER, APART, DIAGONAL, GRID])
def test_all_runs_count_however_they_are_laid(runs):
    values = series(*runs, size=0.5)
    found = converged(*runs, values, declared=(2.0, 2.0))
    finest = 0.5 / max(runs[0]) ** 2 + 3e-3 * min(runs[1]) ** 2
    assert abs(found.limit - LIMIT) < 0.1 * finest
    assert abs(found.limit - LIMIT) <= found.bar < 3.0 * finest
    # Along a diagonal mesh and step are one.
    names = {"mesh"} if runs is DIAGONAL else {"mesh", "step"}
    assert {name: round(one.value) for name, one in found.orders.items()} == dict.fromkeys(names, 2)


def test_errors_of_mesh_and_step_are_told_apart():
    found = converged(*GRID, series(*GRID, size=0.5), declared=(2.0, 2.0))
    assert found.in_mesh == pytest.approx(0.5 / found.elements**2, rel=0.05)
    assert found.in_step == pytest.approx(3e-3 * found.steps**2, rel=0.05)
    assert (found.elements[-1], found.steps[-1]) == (32, 1.0)


def test_a_step_control_is_fitted_by_its_tolerance():
    """An oscillator whose frequency has the error of a mesh, and whose steps Dormand's rule has."""
    time = np.linspace(0.0, 10.0, 101)

    def run(elements, tolerance):
        square = (2.0 * (1.0 + elements**-2.0)) ** 2
        found = solve_ivp(
            lambda _, y: [y[1], -square * y[0]], (0.0, 10.0), [1.0, 0.0], t_eval=time,
            rtol=tolerance, atol=tolerance,
        )  # fmt: skip
        return found.y[0] - np.cos(2.0 * time)

    runs = [(16, 1e-5), (32, 1e-5), (64, 1e-5), (32, 1e-4), (32, 1e-6)]
    values = [run(*one) for one in runs]
    found = converged(*zip(*runs, strict=True), values, refined="tolerance")
    # Three tolerances leave 2 % of the finest run's error, their order being 1.16 and no whole one.
    assert found.limit < min(found.bar, 3e-2 * np.abs(values[2]).max())
    assert found.orders["mesh"].value == pytest.approx(2.0, abs=0.1)
    assert found.orders["step"].value == pytest.approx(1.0, abs=0.25)  # per unit of a step: 4/5
    two = converged(*zip(*runs[:4], strict=True), values[:4], refined="tolerance")
    assert two.orders["step"].why == "2 tolerances, three are needed"


def test_functions_are_fitted_alike():
    """cos t + C(t)/n² + D(t) h² tends to cos t; numbers are functions of one sample."""
    time = np.linspace(0.0, 1.0, 5)
    n, h = (np.array(one)[:, None] for one in TOGETHER)
    values = np.cos(time) + 0.5 / n**2 * (1.0 + time) + 3e-3 * h**2 * (2.0 - time)
    found = converged(*TOGETHER, values, declared=(2.0, 2.0))
    assert found.limit == pytest.approx(1.0, abs=1e-3)
    off = np.abs(values - np.cos(time)).max(axis=1)[[0, 4, 1, 3, 2]]
    assert found.errors == pytest.approx(off, abs=2e-4)
    assert 0.0 < found.bar < 2e-2
    alone = converged(*TOGETHER, values[:, :1], declared=(2.0, 2.0))
    assert alone.limit == converged(*TOGETHER, values[:, 0], declared=(2.0, 2.0)).limit


@pytest.mark.parametrize("declared", [None, 2.0])
@pytest.mark.parametrize("higher", [-8.0, -2.0, 2.0, 12.0])
def test_the_bar_holds_where_the_first_mesh_is_too_coarse(higher, declared):
    """A next term as large as the first on the coarsest mesh; bars shrink with the meshes."""
    bars = []
    for coarsest in (4, 8, 16, 32):
        elements = (coarsest, 2 * coarsest, 4 * coarsest)
        values = series(elements, higher=higher)
        found = converged(elements, None, values, declared=(declared, None))
        assert abs(found.limit - LIMIT) <= found.bar
        assert np.all(np.abs(found.errors - (found.values - LIMIT)) <= (found.bar + found.noise))
        bars.append(found.bar)
    assert np.all(np.diff(bars[1:]) < 0.0)


def test_one_mesh_has_no_limit():
    found = converged([8, 8], [1.0, 2.0], [1.0, 2.0])
    assert math.isnan(found.limit)
    assert (found.bar, found.orders["mesh"].why) == (math.inf, "one mesh, three are needed")


@pytest.mark.parametrize("seed", range(10))
def test_noise_is_never_taken_for_an_order(seed):
    """From far above the floor to far below it; there the bar is some of the floor."""
    noise, rng = 1e-6, np.random.default_rng(seed)
    for coarsest in 4 * 2 ** np.arange(12):
        elements = coarsest * np.array([1, 2, 4])
        values = series(elements, order=4.0) + noise * rng.uniform(-1.0, 1.0, 3)
        found = converged(elements, None, values, noise=noise, declared=(4.0, None))
        assert abs(found.limit - LIMIT) <= found.bar
    assert found.orders["mesh"].why == "the changes are below the floor"
    assert found.bar < 20.0 * noise


@pytest.mark.parametrize("size", [1e7, 1e8])
def test_degrees_that_are_raised_converge_exponentially(size):
    """Errors C exp(-2.5 n) as of a spectral element, beside three steps on one degree.

    The limit is known to a fifth of the finest run's error, which is the step's.
    """
    degrees, steps = (8, 10, 12, 14, 10, 10), (2.0, 2.0, 2.0, 2.0, 1.0, 0.5)
    h = np.array(steps)
    values = LIMIT + size * np.exp(-2.5 * np.array(degrees)) + 3e-3 * h**2
    found = converged(degrees, steps, values, declared=(None, 2.0))
    assert str(found.orders["mesh"]) == "exponential"
    assert found.orders["step"].value == pytest.approx(2.0, rel=0.02)
    assert abs(found.limit - LIMIT) <= found.bar < 0.2 * 3e-3 * h[3] ** 2


def test_growths_are_counted_along_meshes_and_steps():
    meshes = (8, 16, 32, 64)
    assert converged(meshes, None, (1.0, 2.0, 4.0, 9.0)).growths == 2
    assert converged(meshes, None, (1.0, 2.0, 4.0, 5.0)).growths == 1
    assert converged(meshes, None, series(meshes)).growths == 0
    steps = (8, 16, 16, 16, 16), (8.0, 8.0, 4.0, 2.0, 1.0)
    assert converged(*steps, (0.9, 1.0, 1.1, 1.3, 1.8)).growths == 2
    # What the floor hides does not grow.
    assert converged(meshes, None, (1.0, 1.01, 1.03, 1.08), noise=0.1).growths == 0
    # Of each change by the floors of both its runs: 2 is above 1.5, and 5 below 5.5.
    assert converged(meshes, None, (1.0, 2.0, 4.0, 9.0), noise=(0.0, 0.0, 1.5, 4.0)).growths == 1


def test_an_order_is_low_below_seven_tenths_of_the_declared_one():
    assert [Order(value=v, declared=4.0).low for v in (2.79, 2.81)] == [True, False]
    assert not Order(value=0.1, declared=None).low
    assert str(Order(value=math.nan, declared=2.0, why="2 runs")) == "not measured: 2 runs"


@pytest.mark.parametrize(
    ("elements", "steps", "values", "sentence"),
    [
        ((), None, (), "each run has a mesh"),
        ((8, 16), None, (1.0,), "each run has a mesh"),
        ((8, 8), None, (1.0, 2.0), "no two runs the same"),
        ((8, -16), None, (1.0, 2.0), "must be positive"),
        ((8, 16), None, (1.0, math.nan), "values must be finite"),
    ],
)
def test_bad_input(elements, steps, values, sentence):
    with pytest.raises(ValueError, match=sentence):
        converged(elements, steps, values)
