"""Results on disk: equal after a round trip, whole or not at all, and they say how to redo them."""

import json

import numpy as np
import pytest
import xarray as xr

from analytic import Beam, SpinUp
from rotbeam_exu import load, save, simulate
from rotbeam_exu.storage import whole_file, writable_folder


@pytest.fixture(scope="module")
def run(beam, spin_up):
    return simulate(beam, spin_up, elements=2, duration=4.0, step=5e-3)


def test_a_saved_run_loads_equal(run, tmp_path):
    xr.testing.assert_identical(load(save(run, tmp_path / "run.nc")), run)


def test_a_loaded_run_can_be_done_again_to_the_bit(run, tmp_path):
    attrs = load(save(run, tmp_path / "run.nc")).attrs
    beam = Beam(
        **{k.removeprefix("beam_"): float(v) for k, v in attrs.items() if k.startswith("beam_")}
    )
    again = simulate(
        beam,
        SpinUp(omega=float(attrs["omega"]), ramp_time=float(attrs["ramp_time"])),
        element=attrs["element"],
        elements=int(attrs["elements"]),
        duration=float(attrs["duration"]),
        step=float(attrs["step"]),
        frame=attrs["frame"],
    )
    xr.testing.assert_equal(again, run)
    assert json.loads(attrs["versions"])["exudyn"]
    assert json.loads(attrs["settings"])["spectral_radius"] == 0.9


def test_every_variable_has_unit_and_name(run):
    for variable in run.variables.values():
        assert {"units", "long_name"} <= set(variable.attrs)


def test_csv_holds_every_sample_with_units(run, tmp_path):
    path = save(run, tmp_path / "run.csv")
    header = path.read_text().splitlines()[0]
    assert header.startswith("time [s],q [m],q_dot [m/s],")
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    assert np.array_equal(table[:, 1], run["q"])


def test_a_failed_write_leaves_the_old_file(tmp_path):
    target = tmp_path / "run.nc"
    target.write_text("old")
    with pytest.raises(RuntimeError), whole_file(target) as partial:
        partial.write_text("half")
        raise RuntimeError
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_unknown_endings_and_files_that_are_no_results(run, tmp_path):
    with pytest.raises(ValueError, match=r"ending must be \.nc or \.csv"):
        save(run, tmp_path / "run.txt")
    with pytest.raises(FileNotFoundError, match="there is no file"):
        load(tmp_path / "none.nc")
    (tmp_path / "bad.nc").write_text("no netCDF")
    with pytest.raises(ValueError, match=r"bad\.nc is not a netCDF file"):
        load(tmp_path / "bad.nc")


def test_a_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="cannot write to the folder .* choose another"):
        writable_folder(tmp_path / "file" / "results")
