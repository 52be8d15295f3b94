"""`rotbeam backbone` and `rotbeam table`."""

import csv
import io

import pytest
from cyclopts import App

from analytic import VARIANTS, Beam, reduced_model
from rotbeam_exu.cli.backbone import backbone
from rotbeam_exu.cli.table import table


def rows(capsys):
    return list(csv.DictReader(io.StringIO(capsys.readouterr().out)))


def test_backbone_prints_what_the_model_answers(capsys):
    backbone(omega=6.0, variant="FrM", amplitude=[0.05, 0.2], form="csv")
    model = reduced_model(Beam.reference(), 6.0, "FrM")
    # Digit by digit: CSV keeps them all. (Together, since the quadrature's points depend on both.)
    exact = model.exact_frequency([0.05, 0.2])
    for row, a, exactly in zip(rows(capsys), (0.05, 0.2), exact, strict=True):
        assert row["variant"] == "FrM"
        assert float(row["amplitude a/L"]) == a
        assert float(row["Eq. 63 [rad/s]"]) == model.frequency(a)
        assert float(row["Eq. 41 exactly [rad/s]"]) == exactly
        assert float(row["ω_NL/ω_n"]) == pytest.approx(model.frequency(a) / model.omega_n)


def test_backbone_of_all_variants(capsys):
    backbone(omega=4.0, amplitude=[0.1, 0.2], all_variants=True, form="csv")
    assert [row["variant"] for row in rows(capsys)] == [v for v in VARIANTS for _ in range(2)]


def test_backbone_as_a_table_keeps_units_and_introduces_the_model(capsys):
    backbone(omega=6.0, amplitude=[0.1])
    out = capsys.readouterr().out
    assert "FrE at ω = 6 rad/s" in out
    assert "[rad/s]" in out
    assert "3.729671" in out


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5])
def test_table_marks_differences(capsys, number):
    table(number, form="csv")
    printed = rows(capsys)
    assert all(row["derived"] for row in printed)
    errata = sum("erratum" in row["note"] for row in printed)
    assert errata == (5 if number == 3 else 0)


def test_table_for_a_reader(capsys):
    table(5)
    assert "Table 5" in capsys.readouterr().out


def test_command_line_takes_several_amplitudes(capsys):
    app = App()
    app.command(backbone)
    app.command(table)
    app(
        "backbone --omega 6 --variant FrE --amplitude 0.05 0.1 0.2 --format csv",
        result_action="return_value",
    )
    assert [row["amplitude a/L"] for row in rows(capsys)] == ["0.05", "0.1", "0.2"]
    app("table 2 --format csv", result_action="return_value")
    assert len(rows(capsys)) == 8
