"""Results on disk: netCDF equal after a round trip, tables for reading; whole or not at all."""

import json

import hypothesis.extra.numpy as npst
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from analytic import SpinUp, campbell, spin_up_response
from rotbeam_exu import dataset_of, load, save, simulate
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.fem.simulation import run_case
from rotbeam_exu.files.results import differing_inputs, save_tables, whole_file


@pytest.fixture(scope="module")
def run(beam, spin_up):
    return simulate(beam, spin_up, elements=2, duration=4.0, step=5e-3)


def test_a_loaded_run_can_be_done_again_to_the_bit(run, tmp_path):
    attrs = load(save(run, tmp_path / "run.nc")).attrs
    xr.testing.assert_equal(run_case(RunCase.described(attrs)), run)
    assert json.loads(attrs["versions"])["exudyn"]
    assert json.loads(attrs["settings"])["spectral_radius"] == 0.9


@pytest.mark.parametrize("name", ["time", "q"])
def test_a_changed_bit_of_a_number_is_refused(run, tmp_path, name):
    path = save(run, tmp_path / "run.nc")
    raw = bytearray(path.read_bytes())
    raw[raw.index(run[name].to_numpy()[10:20].tobytes()) + 3] ^= 1
    path.write_bytes(raw)
    with pytest.raises(ValueError, match="write it again"):
        load(path)


def test_every_variable_has_unit_and_name(run):
    for variable in run.variables.values():
        assert {"units", "long_name"} <= set(variable.attrs)


def test_csv_is_a_plain_table_and_a_json_file_says_what_was_run(run, tmp_path):
    path = save(run, tmp_path / "run.csv")
    assert path.read_text(encoding="utf-8").startswith("time [s],q [m],q_dot [m/s],")
    table = pd.read_csv(path)
    # Every digit.
    for name in ("time", "q"):
        title = f"{name} [{run[name].attrs['units']}]"
        assert np.array_equal(table[title], run[name])
    about = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    assert list(about["tables"]["run.csv"]) == list(table)
    assert about["tables"]["run.csv"]["q [m]"] == run["q"].attrs["long_name"]
    known = about["attributes"]
    assert (known["blade_length"], known["element"], known["step"]) == (8.0, "cable", 0.005)
    assert known["versions"] == json.loads(run.attrs["versions"])
    assert known.keys() == run.attrs.keys()
    assert len(list(tmp_path.iterdir())) == 2


def test_a_spin_up_along_the_blade_is_a_table_for_each_set_of_dims(beam, tmp_path):
    """Not every number at every station, direction and axis of the section: 18 MB of repetition."""
    motion, points = SpinUp(omega=4.0, ramp_time=1.0), [0.0, 4.0, 8.0]
    data = dataset_of(spin_up_response(beam, motion, [0.0, 0.5, 1.0], points=points))
    assert save(data, tmp_path / "spin.csv") == tmp_path / "spin-q.csv"
    tables = {path.stem: pd.read_csv(path) for path in tmp_path.glob("*.csv")}
    rows = {name.removeprefix("spin-"): len(table) for name, table in tables.items()}
    assert rows == {"q": 3, "place": 27, "section": 81, "force": 27, "strain": 9}
    last = tables["spin-place"].query("`time [s]` == 1 and `station [m]` == 8")
    assert last["place [m]"].tolist() == data.place.values[-1, -1].tolist()


TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=8)
NUMBERS = st.one_of(st.floats(), st.integers(-(2**63), 2**63 - 1))
NAMES = st.text("abcxyz_019", min_size=1, max_size=5)
ATTRIBUTES = st.dictionaries(
    NAMES.map("my_{}".format),
    st.one_of(
        TEXT, NUMBERS, st.lists(st.floats(), min_size=2, max_size=4),
        st.lists(TEXT, min_size=2, max_size=4),
    ),
    max_size=4,
)  # fmt: skip
VALUES = st.sampled_from(["f8", "f4", "i8", "u2", "?", "U", "O"])


@st.composite
def datasets(draw):
    """Datasets over up to three dimensions, some of them with coordinates, with any values."""
    sizes = draw(st.dictionaries(st.sampled_from(["x", "y", "time"]), st.integers(1, 3)))
    variables = {}
    for name in draw(st.lists(NAMES.map("v_{}".format), max_size=4, unique=True)) + list(sizes):
        dims = [name] if name in sizes else draw(st.permutations(list(sizes)))
        if name not in sizes:
            dims = dims[: draw(st.integers(0, len(dims)))]
        elif draw(st.booleans()):
            continue
        dtype, shape = draw(VALUES), tuple(sizes[dim] for dim in dims)
        count = int(np.prod(shape))
        if dtype in "UO":
            cells = draw(st.lists(TEXT, min_size=count, max_size=count))
            values = np.array(cells, dtype=str if dtype == "U" else object).reshape(shape)
        else:
            values = draw(npst.arrays(dtype, shape))
        variables[name] = (dims, values, draw(ATTRIBUTES))
    return xr.Dataset(variables, attrs=draw(ATTRIBUTES)).set_coords(
        [name for name in variables if name.startswith("v_") and draw(st.booleans())]
    )


# 8 by default, 200 by `make test-all`.
@settings(
    max_examples=settings().max_examples ** 2 // 50, suppress_health_check=[HealthCheck.too_slow]
)
@given(data=datasets())
def test_any_dataset_loads_equal(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("any") / "any.nc"
    kept = load(save(data, path))
    xr.testing.assert_identical(kept, data)
    for name, variable in data.variables.items():
        kind = "U" if variable.dtype.kind in "UO" else variable.dtype.kind
        assert kept[name].dtype.kind == kind
    # And again: what one file's encoding said does not change the next.
    xr.testing.assert_identical(load(save(kept, path)), data)


@pytest.mark.parametrize("law", [None, {"k": 1.0}, True, [1.0, "a"], 2**64, "a\0b"])
def test_an_attribute_that_netcdf_lacks_is_refused(tmp_path, law):
    with pytest.raises(ValueError, match="cannot write 'x.nc': "):
        save(xr.Dataset(attrs={"law": law}), tmp_path / "x.nc")
    assert not list(tmp_path.iterdir())


def test_attributes_of_any_kind_stand_in_the_json_file_as_a_reader_needs_them(tmp_path):
    attrs = {
        "a": None, "b": '{"k": [1.0, [true, NaN]]}', "two\nlines": "x\ny", "d": 1j, "e": np.eye(2),
        "f": "{no json}", "g": np.inf,
    }  # fmt: skip
    path = save(xr.Dataset({"v": ("x", [1.0])}, attrs=attrs), tmp_path / "x.csv")

    def refused(constant):
        pytest.fail(f"{constant} is no JSON")

    text = path.with_suffix(".json").read_text(encoding="utf-8")
    assert json.loads(text, parse_constant=refused)["attributes"] == {
        "a": None, "b": {"k": [1.0, [True, "nan"]]}, "two\nlines": "x\ny", "d": "1j",
        "e": [[1.0, 0.0], [0.0, 1.0]], "f": "{no json}", "g": "inf",
    }  # fmt: skip
    assert '    "e": [[1.0, 0.0], [0.0, 1.0]],' in text.splitlines()
    assert pd.read_csv(path).to_numpy().tolist() == [[0.0, 1.0]]


def test_a_table_has_a_row_for_each_point_of_the_grid(tmp_path):
    numbers = np.random.default_rng(1).normal(size=(3, 2))
    numbers[1, 0] = np.nan
    data = xr.Dataset(
        {
            "q": (("y", "x"), numbers),
            "kind": ("y", ["a#b", 'c,"d"', "e\nf"]),
            "passed": ("x", [True, False]),
            "count": 2**53 + 1,
            "day": ("x", np.array(["2026-01-01", "2026-01-02"], dtype="M8[ns]")),
        },
        coords={"x": [1e-300, 0.1], "place": ("y", np.array([7, 8, 9]))},
    )
    for dims in (["y", "x"], ["x", "y"]):
        given = data.transpose(*dims)
        save(given, tmp_path / "x.csv")
        for names in (["q"], ["kind"], ["passed", "day"]):
            table = pd.read_csv(
                tmp_path / f"x-{names[0]}.csv", parse_dates=["day"] if "day" in names else False
            )
            part = given[names]
            # By the other library's own way.
            wanted = part.to_dataframe(dim_order=list(part.sizes)).reset_index()
            pd.testing.assert_frame_equal(
                table, wanted, check_like=True, check_exact=True, check_dtype=False
            )
        assert table["passed"].dtype == bool
        assert pd.read_csv(tmp_path / "x-count.csv").to_dict("list") == {"count": [2**53 + 1]}


def test_seconds_are_no_time_deltas_and_fill_values_of_another_file_not_taken_over(tmp_path):
    data = xr.Dataset({"v": ("x", [1.0, np.nan, -0.5], {"units": "seconds"})})
    data["v"].encoding = {"_FillValue": -1.0, "dtype": "int16", "scale_factor": 0.5}
    xr.testing.assert_identical(load(save(data, tmp_path / "x.nc")), data)


@pytest.fixture
def small():
    return xr.Dataset(
        {"q": ("time", np.sin(np.arange(20.0)), {"units": "m", "long_name": "tip"})},
        coords={"time": ("time", 0.1 * np.arange(20), {"units": "s"})},
        attrs={"amplitude": 0.25, "element": "cable", "elements": 16},
    )


def test_a_truncated_file_is_refused(small, tmp_path):
    path = save(small, tmp_path / "small.nc")
    whole = path.read_bytes()
    for size in (0, 1, 100, len(whole) // 2, len(whole) - 100):
        path.write_bytes(whole[:size])
        with pytest.raises(ValueError, match="small"):
            load(path)


def test_a_table_is_not_loaded_and_both_remedies_work(small, tmp_path):
    path = save(small, tmp_path / "small.csv")
    with pytest.raises(
        ValueError, match=r"small\.csv is a table for reading: load the netCDF"
    ) as e:
        load(path)
    assert "pandas.read_csv(path)" in str(e.value)
    assert pd.read_csv(path).shape == (20, 2)
    xr.testing.assert_identical(load(save(small, path.with_suffix(".nc"))), small)


def test_several_dimensions_are_several_tables(tmp_path):
    data = xr.Dataset(
        {"a": (("x", "y"), np.eye(2)), "b": ("y", [1.5, np.nan], {"units": "m"})},
        coords={"x": ["one", "two#"], "y": [1, 2]},
        attrs={"element": "cable"},
    )
    paths = save_tables(data, tmp_path / "t.csv")
    assert [path.name for path in paths] == ["t-a.csv", "t-b.csv", "t.json"]
    assert pd.read_csv(paths[1]).columns.tolist() == ["y", "b [m]"]
    table = pd.read_csv(paths[0])
    assert table.columns.tolist() == ["x", "y", "a"]
    assert table["x"].tolist() == ["one", "one", "two#", "two#"]


def test_frequencies_over_speed_and_mode_have_a_column_per_mode_too(beam, tmp_path):
    found = campbell(beam, [0.0, 6.0], count=2, orders=1)
    save(dataset_of(found), tmp_path / "c.csv")
    wide = pd.read_csv(tmp_path / "c-frequency-wide.csv")
    assert list(wide) == ["omega [rad/s]", "lag 1 [rad/s]", "lag 2 [rad/s]"]
    assert np.array_equal(wide.to_numpy()[:, 1:], found.frequencies)
    long = pd.read_csv(tmp_path / "c-frequency.csv")
    assert list(long) == ["omega [rad/s]", "mode", "frequency [rad/s]"]


@pytest.mark.parametrize("name", ["t-a.csv", "t-b.csv", "t.json"])
def test_of_several_tables_all_or_none_are_written(tmp_path, name):
    def table(value):
        return xr.Dataset({"a": ("x", [value]), "b": ("y", [value])})

    save(table(1.0), tmp_path / "t.csv")
    before = {path: path.read_bytes() for path in tmp_path.iterdir() if path.name != name}
    (tmp_path / name).unlink()
    (tmp_path / name).mkdir()  # where no file can be written
    with pytest.raises(IsADirectoryError, match=name):
        save(table(2.0), tmp_path / "t.csv")
    assert {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()} == before


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


@pytest.mark.parametrize("ending", [".nc", ".csv"])
def test_inputs_that_differ_from_a_file_are_named(run, tmp_path, ending):
    path = save(run, tmp_path / f"run{ending}").with_suffix(ending.replace("csv", "json"))
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
    assert differing_inputs({**inputs, "blade_length": 9.0}, path) == {"blade_length": (9.0, 8.0)}


@pytest.mark.parametrize("ending", [".nc", ".csv"])
def test_another_grid_differs(tmp_path, ending):
    grid = xr.Dataset(
        {"a": (("omega", "time"), np.zeros((2, 3)))},
        coords={"omega": [4.0, np.nan], "time": [0.0, 1.0, 2.0]},
    )
    path = save(grid, tmp_path / f"sweep{ending}").with_suffix(ending.replace("csv", "json"))
    assert differing_inputs(grid.isel(time=[0]), path) == {}
    assert list(differing_inputs(grid.isel(omega=[0]), path)) == ["omega"]
    assert differing_inputs({"omega": [4.0, 6.0, 8.0]}, path)["omega"][0] == [4.0, 6.0, 8.0]
    assert differing_inputs({"omega": np.array([4.0, np.nan])}, path) == {}


def test_a_file_that_cannot_be_read_differs(run, tmp_path):
    (tmp_path / "run.nc").write_text("mine")
    assert "not a netCDF file" in differing_inputs(run, tmp_path / "run.nc")["file"][1]
    for text in ("mine", "[]", "{}"):
        (tmp_path / "run.json").write_text(text)
        assert list(differing_inputs(run, tmp_path / "run.json")) == ["file"]
    (tmp_path / "folder.nc").mkdir()
    assert list(differing_inputs(run, tmp_path / "folder.nc")) == ["file"]
