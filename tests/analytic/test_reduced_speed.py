"""Speed of the reduced models; measured only when benchmarks are enabled."""

import subprocess
import sys
import time

import numpy as np
import pytest

from analytic import Beam, reduced_model
from analytic.quadrature import gauss_points

pytestmark = pytest.mark.benchmarks


@pytest.mark.parametrize(("variant", "limit"), [("FrE", 5e-3), ("FrM", 50e-3)])
def test_one_model(benchmark, variant, limit):
    # From nothing: without the cached quadrature points.
    model = benchmark.pedantic(
        reduced_model,
        args=(Beam.reference(), 6.0, variant),
        setup=gauss_points.cache_clear,
        rounds=50,
    )
    assert model.w_n > 3.5
    if benchmark.enabled:
        assert benchmark.stats.stats.median < limit


def test_a_million_amplitudes_against_the_bare_formula(benchmark):
    model = reduced_model(Beam.reference(), 6.0)
    a = np.linspace(0.0, 0.2, 1_000_000)
    omega_n, lambda_omega = model.omega_n, model.lambda_omega
    result = benchmark(model.frequency, a)
    np.testing.assert_allclose(result, omega_n * (1 - lambda_omega * a**2), rtol=1e-14)
    if benchmark.enabled:
        bare = []
        for _ in range(10):
            start = time.perf_counter()
            omega_n * (1 - lambda_omega * a**2)
            bare.append(time.perf_counter() - start)
        assert benchmark.stats.stats.min < 5 * min(bare)


def test_import(benchmark):
    code = "import time; t = time.perf_counter(); import analytic; print(time.perf_counter() - t)"

    def seconds():
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
        return float(run.stdout)

    taken = benchmark.pedantic(seconds, rounds=1)
    if benchmark.enabled:
        assert min(taken, seconds(), seconds()) < 0.3
