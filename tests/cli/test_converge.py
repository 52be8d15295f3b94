"""`rotbeam converge`: orders, errors and what to take, beside the exact beam."""

import importlib
import signal
import warnings

import numpy as np
import pytest

from analytic import Beam, SpinUp, linear_modes, spin_up_response
from rotbeam_exu import load, natural_frequencies, simulate
from rotbeam_exu.cli.sweep import _print_errors
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.sweeps import grid

TAPERED = """
[blade]
length = 8.0
[blade.section]
axial_stiffness = 5.03e6
bending_stiffness = [566.0, -283.0]
mass_per_length = [0.2, -0.1]
"""


def converged(call, folder, *arguments):
    run = ("--jobs", "1", "-o", folder, "--cache", folder / "c")
    code, out, error = call("converge", *run, *arguments)
    assert code == 0, error
    (path,) = folder.glob("converge-*.nc")
    return load(path), out, error


def test_orders_errors_and_a_mesh_that_keeps_the_tolerance(call, tmp_path):
    mesh = ("--elements", "8", "--step", "4e-3", "--duration", "6.4", "--tolerance", "3e-3")
    data, out, error = converged(call, tmp_path, *mesh)
    assert data["order"] == pytest.approx(4.0, abs=0.4)  # of q(t), on 4, 8 and 16 cables
    assert data["order_in_step"] == pytest.approx(2.0, abs=0.05)
    np.testing.assert_allclose(data["frequency_order"], 4.0, atol=0.25)
    # The fit has no exact answer, and its errors are those from it, which is known to 3e-4.
    np.testing.assert_allclose(data["error"], data["exact_error"], rtol=0.0, atol=3e-4)
    assert np.abs(data["exact_distance"]).max() < 1e-6
    # Its 4e-4 are luck: the parts of mesh and step, 2.9e-3 and 2.6e-3, cancel.
    assert data["error"][3] < 1e-3
    assert "8 elements with a step of 0.004 s have errors of 8.7e-04" in error
    beam, motion = Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0)
    n, h = int(data["recommended_elements"]), float(data["recommended_step"])
    assert f"{n} elements, step {h:.3g} s" in out
    exact = None
    # The two parts of the error, apart, for together they cancel: each has half the tolerance.
    for elements, step in ((n, h / 2.0), (2 * n, h)):
        run = simulate(beam, motion, elements=elements, step=step, duration=6.4)[["q"]]
        run = run.sel(time=np.arange(0.0, 6.4, 40.0 * h), method="nearest")
        if exact is None:
            exact = spin_up_response(beam, motion, run["time"].to_numpy(), tolerance=1e-5).q
        off = np.abs(run["q"] - exact).max() / np.abs(exact).max()
        # Of the other part a quarter and a sixteenth are left.
        assert 0.6e-3 < off < 1.65e-3
    found = natural_frequencies(beam, 6.0, elements=n)
    assert np.abs(found / linear_modes(beam, 6.0).frequencies - 1.0).max() < 3e-3
    assert "limit of this element" not in error
    # An element is told of another limit for what its runs do not leave open.
    data["exact_distance"][:] = 8e-3
    for bar, told in ((1e-2, False), (1e-3, True)):
        data["frequency_uncertainty"][:] = bar
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            _print_errors(data, data)
        assert any("at least 7.0e-03" in str(one.message) for one in caught) is told


def test_a_tapered_blade_on_the_default_mesh_is_told(call, tmp_path):
    """Cables of constant sections: of second order, 2e-3 off on 16 in the frequencies."""
    (tmp_path / "beam.toml").write_text(TAPERED)
    config = ("--step", "16e-3", "--duration", "6.4", "--config", tmp_path / "beam.toml")
    data, _, error = converged(call, tmp_path, *config, "--count", "1", "--no-exact")
    assert data.attrs["elements"] == 16
    np.testing.assert_allclose(data["frequency_order"], 2.0, atol=0.2)
    assert data["order"] == pytest.approx(2.0, abs=0.2)
    assert "16 elements with a step of 0.016 s have errors of" in error
    exact = linear_modes(load_beam(tmp_path / "beam.toml"), data.attrs["omega"], 1).frequencies
    off = data["frequency"][:, 0] / exact - 1.0
    np.testing.assert_allclose(data["frequency_error"][:, 0], off, rtol=0.1)
    assert abs(off[1]) > 1e-4
    assert np.isnan(data["exact_error"]).all()
    assert int(data["recommended_elements"]) > 32


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_a_call_that_was_stopped_goes_on_from_the_cache(call, tmp_path, monkeypatch):
    """Frequencies of a fine mesh are minutes of work too, and were not kept."""
    computed, ends = [], []

    def watched(name, function):
        def one(*case, **options):
            if len(computed) in ends:
                signal.raise_signal(signal.SIGINT)
            result = function(*case, **options)
            computed.append(name)
            return result

        return one

    room = importlib.import_module("rotbeam_exu.comparison.refinement")
    monkeypatch.setattr(room, "natural_frequencies", watched("mesh", room.natural_frequencies))
    monkeypatch.setattr(grid, "solve", watched("spin-up", grid.solve))
    settings = ("--elements", "4", "--step", "8e-3", "--duration", "6.4", "--no-exact")
    asked = ("converge", *settings, "--jobs", "1", "-o", tmp_path, "--cache", tmp_path / "c")
    kept = f"finished frequencies and spin-ups are kept in the cache {tmp_path / 'c'}"
    for pieces in (2, 7):
        ends[:] = [pieces]
        code, _, error = call(*asked)
        assert (code, len(computed)) == (130, pieces)
        assert error.splitlines()[-1] == f"rotbeam: interrupted; {kept}"
        assert f"frequencies and spin-ups: {pieces} of 9 done" in error
    ends.clear()
    assert call(*asked)[0] == 0
    assert computed == ["mesh"] * 4 + ["spin-up"] * 5
    (path,) = tmp_path.glob("converge-*.nc")
    fresh = room.refinement(RunCase.described(load(path).attrs), exact=False, jobs=1)
    for name, values in fresh.data_vars.items():
        np.testing.assert_array_equal(load(path)[name], values)
