"""`rotbeam compare-modes`, called as a function."""

import csv
import io

import numpy as np
import pytest

from analytic import campbell
from rotbeam_exu.cli.compare_modes import compare_modes


def test_csv_holds_the_diagram(beam, capsys):
    compare_modes(omega_max=8.0, points=5, count=2, orders=3, format="csv")
    rows = list(csv.reader(io.StringIO(capsys.readouterr().out)))
    expected = campbell(beam, np.linspace(0.0, 8.0, 5), 2, 3)
    table = np.array(rows[1:6], dtype=float)
    assert table[:, 0] == pytest.approx(expected.omegas)
    assert table[:, 1:] == pytest.approx(expected.frequencies, rel=1e-9)
    assert rows[6] == []
    assert len(rows) == 8 + len(expected.crossings)


def test_table_shows_frequencies_and_crossings(capsys):
    compare_modes(omega_max=6.0, points=2, count=1, orders=1)
    printed = capsys.readouterr().out
    assert "3.730401" in printed
    assert "3.208183" in printed  # where mode 1 meets the line ω


def test_one_speed_is_no_diagram():
    with pytest.raises(ValueError, match="points must be at least 2"):
        compare_modes(points=1)
