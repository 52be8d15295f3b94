"""Tables in a narrow terminal: titles and texts are folded, and every number is whole."""

import math

import pytest

from rotbeam_exu.cli.output import print_columns

COMMANDS = [
    ("backbone", "--omega", "6", "--all-variants", "--amplitude", "0.05", "0.2"),
    ("campbell", "--points", "3", "--count", "3", "--orders", "2", "--omega-max", "6"),
    ("table", "2"),
]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: "-".join(command[:2]))
def test_no_number_is_cut_or_broken(call, monkeypatch, command):
    monkeypatch.setenv("COLUMNS", "1000")
    wide = call(*command)[1]
    monkeypatch.setenv("COLUMNS", "80")
    code, narrow, _ = call(*command)
    assert code == 0

    def words(text):
        for line in "┃│┏┓┗┛┡┩━┳╇└┘─┴":
            text = text.replace(line, " ")
        return set(text.split())

    assert words(wide) == words(narrow)
    assert max(map(len, narrow.splitlines())) <= 80
    monkeypatch.setenv("COLUMNS", "40")
    assert words(call(*command)[1]) == words(wide)


def test_a_zero_at_the_end_of_a_number_is_shown_where_its_neighbors_have_a_digit(capsys):
    print_columns({"ω_NL": [3.73033, 3.730329], "a": [0.1, 0.05], "±": [1e-9, math.nan]}, "table")
    rows = [line.split() for line in capsys.readouterr().out.splitlines() if line[0] == "│"]
    assert [row[1::2] for row in rows] == [
        ["3.730330", "0.10", "1e-09"], ["3.730329", "0.05", "-"],
    ]  # fmt: skip
