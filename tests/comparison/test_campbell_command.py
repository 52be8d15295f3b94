"""`rotbeam campbell`, called as a function."""

import csv
import io

import numpy as np
import pytest

from analytic import campbell
from rotbeam_exu.cli import app
from rotbeam_exu.cli.campbell import campbell as command


def test_csv_holds_the_diagram(beam, capsys):
    command(omega_max=8.0, points=5, count=2, orders=3, format="csv")
    rows = list(csv.reader(io.StringIO(capsys.readouterr().out)))
    expected = campbell(beam, np.linspace(0.0, 8.0, 5), 2, 3)
    table = np.array(rows[1:6], dtype=float)
    assert table[:, 0] == pytest.approx(expected.omegas)
    assert table[:, 1:] == pytest.approx(expected.frequencies, rel=1e-9)
    assert rows[6] == []
    assert len(rows) == 8 + len(expected.crossings)


def test_table_shows_frequencies_and_crossings(capsys):
    command(omega_max=6.0, points=2, count=1, orders=1)
    printed = capsys.readouterr().out
    assert "3.730401" in printed
    assert "3.208183" in printed  # where mode 1 meets the line ω


def test_one_speed_is_no_diagram():
    with pytest.raises(ValueError, match="points must be at least 2"):
        command(points=1)


def test_the_former_name_still_does():
    assert app["compare-modes"].default_command is app["campbell"].default_command


def test_a_beam_of_ones_own_goes_up_to_its_own_speeds(beam, tmp_path, capsys):
    (tmp_path / "beam.toml").write_text(
        "[beam]\nlength = 4.0\naxial_stiffness = 5.03e6\n"
        "bending_stiffness = 566.4\nmass_per_length = 0.202\n"
    )
    command(config=tmp_path / "beam.toml", points=2, count=1, orders=1, format="csv")
    rows = list(csv.reader(io.StringIO(capsys.readouterr().out)))
    # Half as long, four times as fast.
    assert float(rows[2][0]) == pytest.approx(48.0, rel=0.01)
    assert float(rows[1][1]) == pytest.approx(4.0 * beam.omega_0, rel=1e-3)
