"""Tables of loads from CSV, alone and named in a file."""

import json

import numpy as np
import pytest

from analytic import Beam, LoadTable, SteadyRotation, spin_up_response
from rotbeam_exu import dataset_of, load, save
from rotbeam_exu.files.beam_file import load_run_file
from rotbeam_exu.files.load_file import load_table
from rotbeam_exu.runs.attributes import loads_of

BLADE = Beam.reference().with_section_out_of_plane(0.0625, 0.08)
ROWS = """time [ms],x [m],fz [kN/m],my [N m/m]
0,4.0,0.001,0
0,8.0,0.002,0.1
500,4.0,0.003,0
500,8.0,0.004,0.2
"""
TABLE = LoadTable(
    x=[4.0, 8.0], time=[0.0, 0.5],
    force=[[[0, 0, 1.0], [0, 0, 2.0]], [[0, 0, 3.0], [0, 0, 4.0]]],
    moment=[[[0, 0, 0.0], [0, 0.1, 0]], [[0, 0, 0.0], [0, 0.2, 0]]],
)  # fmt: skip


def written(folder, text, name="loads.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_csv_is_the_table_of_its_arrays(tmp_path):
    assert load_table(written(tmp_path, ROWS)) == TABLE
    over_span = "x [m],fx [N/m]\n0,1\n2,2\n8,3\n"
    found = load_table(written(tmp_path, over_span), following=True)
    assert (found.x, found.time, found.following) == ((0.0, 2.0, 8.0), None, True)
    assert np.array(found.force)[:, 0].tolist() == [1.0, 2.0, 3.0]


def test_a_file_names_it_and_a_run_records_it(tmp_path):
    written(tmp_path, ROWS)
    told = '[[loads]]\nkind = "LoadTable"\nfile = "loads.csv"\nfollowing = true\n'
    (mine,) = load_run_file(written(tmp_path, told, "run.toml")).loads
    assert mine == LoadTable(**{**vars(TABLE), "following": True})
    time = np.linspace(0.0, 1.0, 400)
    long = LoadTable(x=np.linspace(0.0, 8.0, 10), time=time, force=np.ones((400, 10, 3)))
    found = spin_up_response(
        BLADE, SteadyRotation(omega=3.0), [0.0, 0.01], loads=[long], tolerance=1e-2, start="steady"
    )
    data = load(save(dataset_of(found), tmp_path / "run.nc"))
    assert loads_of(data.attrs) == (long,)
    assert (data.attrs["start"], json.loads(data.attrs["loads"])[0]["kind"]) == (
        "steady", "LoadTable",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (ROWS.replace("500,8.0", "500,7.0"), "the rows of instant 2 do not have the stations"),
        (ROWS.replace("500,8.0", "600,8.0"), "the rows of instant 2 do not have the stations"),
        (ROWS.rstrip().rpartition("\n")[0], "3 rows, and 2 stations at the first instant"),
        (ROWS.replace("500,", "0,"), "x must ascend"),
        (ROWS.replace("0,8.0", "0,2.0"), "x must ascend"),
        (ROWS.replace("0,4", "900,4", 1).replace("0,8", "900,8", 1), "time must ascend"),
        (ROWS.replace("0.003", "nan"), "line 4 has 'nan' in column fz"),
        (ROWS.replace("0.003", "much"), "line 4 has 'much' in column fz"),
        (ROWS.replace("0.003", ""), "line 4 has '' in column fz"),
        (ROWS.replace("kN/m", "lbf/ft"), "give the unit of column 'fz .lbf/ft.'"),
        (ROWS.replace("fz", "lift"), "unknown column 'lift'; known are time, x, fx"),
        (ROWS.replace("my", "fz"), "two columns fz"),
        (ROWS.replace("0.003", "0,003"), "line 4 has 5 cells, the header 4"),
        ("time [s],fx [N/m]\n0,1\n1,2\n", "lacks the column x"),
        ("x [m]\n0\n1\n", "lacks the column x, or any of fx"),
        ("lat,lon\n1,2\n", r"give it a header, as x \[m\],fx \[N/m\]"),
    ],
)
def test_what_is_no_table_is_refused_by_a_sentence(tmp_path, text, sentence):
    with pytest.raises(ValueError, match=sentence):
        load_table(written(tmp_path, text))


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ('file = "../loads.csv"', "names the file '../loads.csv', which is not in its folder"),
        ('file = "/etc/hostname"', "which is not in its folder"),
        ('file = "none.csv"', "which is not in its folder"),
        ('file = "loads.csv"\nspan = 3', "unexpected keyword argument 'span'"),
        ('file = "loads.csv"\nfollowing = "no"', "following must be True or False"),
    ],
)
def test_a_file_outside_the_folder_and_unknown_keys_are_refused(tmp_path, line, sentence):
    inner = tmp_path / "inner"
    inner.mkdir()
    written(tmp_path, ROWS)
    written(inner, ROWS)
    told = written(inner, f'[[loads]]\nkind = "LoadTable"\n{line}\n', "run.toml")
    with pytest.raises(ValueError, match=sentence):
        load_run_file(told)
