"""Results on disk: equal after a round trip, whole or not at all, and they say how to redo them."""

import json

import numpy as np
import pytest
import xarray as xr

from analytic import Beam, SpinUp
from rotbeam_exu import load, save, simulate
from rotbeam_exu.storage import differing_inputs, whole_file, writable_folder


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
    assert json.loads(attrs["settings"])["relative_tolerance"] == 1e-8


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


def test_inputs_that_differ_from_a_file_are_named(run, tmp_path):
    path = save(run, tmp_path / "run.nc")
    # Another day, another machine, another version: the same run.
    again = run.assign_attrs(wall_time=9.0, versions="{}", verdict="failed")
    assert differing_inputs(again, path) == {}
    assert differing_inputs(run, tmp_path / "none.nc") == {}
    other = run.assign_attrs(step=1e-3, frame="rotating")
    assert differing_inputs(other, path) == {
        "frame": ("rotating", "inertial"),
        "step": (1e-3, 5e-3),
    }
    # Before it is computed, its inputs will do.
    inputs = {**run.attrs, "elements": np.int64(2)}
    assert differing_inputs(inputs, path) == {}
    assert differing_inputs({**inputs, "beam_length": 9.0}, path) == {"beam_length": (9.0, 8.0)}


def test_another_grid_differs_and_so_does_what_would_be_lost(tmp_path):
    grid = xr.Dataset(
        {"a": (("omega", "time"), np.zeros((2, 3)))},
        coords={"omega": [4.0, np.nan], "time": [0.0, 1.0, 2.0]},
    )
    path = save(grid, tmp_path / "sweep.nc")
    assert differing_inputs(grid.isel(time=[0]), path) == {}
    assert list(differing_inputs(grid.isel(omega=[0]), path)) == ["omega"]
    assert differing_inputs({"omega": [4.0, 6.0, 8.0]}, path)["omega"][0] == [4.0, 6.0, 8.0]
    assert differing_inputs({"omega": np.array([4.0, np.nan])}, path) == {}
    assert differing_inputs(grid.drop_vars("a"), path)["variables"] == (
        ["omega", "time"],
        ["a", "omega", "time"],
    )


def test_a_file_that_cannot_be_read_differs(run, tmp_path):
    (tmp_path / "run.nc").write_text("mine")
    assert "not a netCDF file" in differing_inputs(run, tmp_path / "run.nc")["file"][1]
    (tmp_path / "folder.nc").mkdir()
    assert list(differing_inputs(run, tmp_path / "folder.nc")) == ["file"]
