"""Samples of an answer on workers, which stay in a cache."""

import numpy as np
import pytest

from analytic import Beam, RotbeamWarning, SpinUp, linear_modes, spin_up_response
from analytic.sensitivity import sampled
from rotbeam_exu.sweeps import cases
from rotbeam_exu.sweeps.cases import kept_workers

SCATTER = {"EI3": 0.05, "hub_radius": 0.1}


def test_workers_give_the_same_samples_and_keep_them(tmp_path, monkeypatch):
    answer = linear_modes(Beam.reference(), 2.0, 2)
    alone, counted = sampled(answer, SCATTER, count=6), []

    def once(of):
        how = {"cache": tmp_path, "progress": lambda *done: counted.append(done)}
        with kept_workers(of, 2, 6, **how) as pool:
            return sampled(answer, SCATTER, count=6, executor=pool)

    np.testing.assert_array_equal(once({"EI3": 1.0}), alone)
    assert counted == [(k, 6) for k in range(1, 7)]
    files = sorted(tmp_path.glob("*.nc"))
    assert len(files) == 6
    files[0].unlink()  # as if it had been stopped
    np.testing.assert_array_equal(once({"EI3": 1.0}), alone)
    assert sorted(tmp_path.glob("*.nc")) == files
    monkeypatch.setattr(cases._Processes, "submit", lambda *_, **__: pytest.fail("solved again"))
    np.testing.assert_array_equal(once({"EI3": 1.0}), alone)
    with pytest.raises(pytest.fail.Exception, match="solved again"):
        once({"EI3": 2.0})


def test_a_sample_without_an_answer_stays_on_record(tmp_path):
    """A ramp cannot take less than no time."""
    answer = spin_up_response(
        Beam.reference(), SpinUp(omega=2.0, ramp_time=1.0), [2.0], tolerance=1e-3
    )
    several = []
    for _ in range(2):
        with (
            kept_workers({}, 1, 6, cache=tmp_path) as pool,
            pytest.warns(RotbeamWarning, match="samples are without .* ramp_time must be"),
        ):
            several.append(sampled(answer, {"ramp_time": 1.0}, count=6, executor=pool))
    assert 0 < np.isnan(several[0][:, 0]).sum() < 6
    np.testing.assert_array_equal(*several)
