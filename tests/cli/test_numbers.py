"""Numbers: what is none is refused, and what would never end."""

import math

import pytest

from rotbeam_exu.cli.output import print_columns


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (("run", "--elements"), "2.5"),
        (("sweep", "--jobs"), "1e1"),
        (("table",), "nan"),
        (("animate", "--rate"), "0.6"),
        (("campbell", "--points"), ""),
    ],
)
def test_what_is_no_whole_number_is_refused(call, tmp_path, monkeypatch, command, text):
    monkeypatch.chdir(tmp_path)
    code, out, error = call(*command, text)
    assert code == 2
    assert out == ""
    assert "it must be" in error
    assert len(error.strip().splitlines()) == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("campbell", "--count", "1000000000"), "at most 256 functions are taken"),
        (
            ("backbone", "--omega", "6", "--exact", "--functions", "1000000"),
            "at most 256 functions",
        ),
    ],
)
def test_what_would_never_end_is_refused_before_it_starts(call, arguments, sentence):
    code, _, error = call(*arguments)
    assert code == 2
    assert error.startswith("rotbeam: ")
    assert sentence in error


def test_a_zero_at_the_end_of_a_number_is_shown_where_its_neighbors_have_a_digit(capsys):
    print_columns({"ω_NL": [3.73033, 3.730329], "a": [0.1, 0.05], "±": [1e-9, math.nan]}, "table")
    rows = [line.split() for line in capsys.readouterr().out.splitlines() if line[0] == "│"]
    assert [row[1::2] for row in rows] == [
        ["3.730330", "0.10", "1e-09"], ["3.730329", "0.05", "-"],
    ]  # fmt: skip
