"""`rotbeam backbone` and `rotbeam table`."""

import csv
import io

import pytest
from cyclopts import App

from analytic import VARIANTS, Beam, paper_table, periodic_orbits, reduced_model
from analytic.reduced.model import model_at
from rotbeam_exu.cli.backbone import backbone
from rotbeam_exu.cli.table import table

BLADE = """
[blade]
length = 8.0
hub_radius = 0.5

[blade.section]
axial_stiffness = 5.0e6
bending_stiffness = 566.0
mass_per_length = 0.2

[motion]
omega = 6
"""


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
        assert float(row["Eq. 63 / ω_n"]) == pytest.approx(model.frequency(a) / model.omega_n)


def test_backbone_of_all_variants(capsys):
    backbone(omega=4.0, amplitude=[0.1, 0.2], all_variants=True, form="csv")
    assert [row["variant"] for row in rows(capsys)] == [v for v in VARIANTS for _ in range(2)]


def test_one_table_holds_the_coefficients_of_all_models_and_of_the_exact_beam(call, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, error = call(
        "backbone", "--omega", "6", "--all-variants", "--exact", "--amplitude", 0.1
    )
    assert (code, error) == (0, "")
    coefficients = [line for line in out.split("amplitude")[0].splitlines() if line[:1] == "│"]
    by_name = {
        cells[0]: cells[1:] for line in coefficients for cells in [line.strip("│ ").split("│")]
    }
    rows = {name.strip(): [cell.strip() for cell in cells] for name, cells in by_name.items()}
    assert list(rows) == [*VARIANTS, "exact"]
    for name in VARIANTS:
        model = reduced_model(Beam.reference(), 6.0, name)
        values = (model.omega_n, model.g1, model.g2, model.lambda_omega, model.lambda_x)
        # Six digits behind the point, or six in all.
        assert [float(cell) for cell in rows[name][:5]] == pytest.approx(values, rel=1e-5, abs=5e-7)
    truth = periodic_orbits(Beam.reference(), 6.0, [0.1])
    assert float(rows["exact"][3]) == pytest.approx(truth.lambda_omega, abs=5e-7)


def test_what_one_model_refuses_does_not_take_the_others_away(call, tmp_path):
    blade = tmp_path / "blade.toml"
    blade.write_text(BLADE)
    every = (
        "backbone",
        "--all-variants",
        "--amplitude",
        "0.1",
        "--config",
        blade,
        "--format",
        "csv",
    )
    code, out, error = call(*every)
    assert code == 0
    assert [row["variant"] for row in csv.DictReader(io.StringIO(out))] == ["FrC", "FrM", "FrM5"]
    assert error.count("warning:") == 1
    assert "no answer: CI, CE, FrI, FrE, P3, P4, P5: CI is for the uniform beam" in error
    # Who asked for one by its name did not get what was asked for.
    code, out, error = call("backbone", "--variant", "ci", "--amplitude", "0.1", "--config", blade)
    assert (code, out) == (2, "")
    assert "has a hub: take FrM" in error


def test_an_amplitude_without_an_orbit_is_a_dash_and_a_sentence(call):
    arguments = ("--omega", "30", "--variant", "CI", "--amplitude", "0.1", "0.9", "--format", "csv")
    code, out, error = call("backbone", *arguments)
    near, far = csv.DictReader(io.StringIO(out))
    model = model_at(Beam.reference(), 30.0, VARIANTS["CI"])
    assert float(near["Eq. 63 [rad/s]"]) == model.frequency(0.1)
    assert far["Eq. 63 [rad/s]"] == far["Eq. 41 exactly [rad/s]"] == "nan"
    assert code == 2
    assert "Eq. 63 has no frequency at amplitude 0.9" in error
    assert "Eq. 41 has no periodic orbit at amplitude 0.9" in error
    assert call("backbone", *arguments[:-2])[1].splitlines()[-4].count(" - ") == 3


def test_the_exact_backbone_of_a_higher_mode_comes_alone(call):
    arguments = ("backbone", "--omega", "6", "--mode", "2", "--amplitude", "0.02", "0.2")
    code, out, error = call(*arguments, "--format", "csv")
    near, far = csv.DictReader(io.StringIO(out))
    truth = periodic_orbits(Beam.reference(), 6.0, [0.02], mode=2)
    assert float(near["exact beam [rad/s]"]) == pytest.approx(truth.frequency[0], rel=1e-9)
    assert far["exact beam [rad/s]"] == "nan"
    assert code == 1
    assert "no orbit of mode 2 at omega = 6 rad/s with a peak |q|/L of 0.2" in error
    code, _, error = call(*arguments, "--variant", "FrE")
    assert code == 2
    assert "the reduced models are of mode 1" in error


def test_all_tables_are_one_csv(call):
    code, out, _ = call("table", "all", "--format", "csv")
    assert code == 0
    printed = list(csv.DictReader(io.StringIO(out)))
    assert list(dict.fromkeys(row["table"] for row in printed)) == list("12345")
    assert [row["derived"] for row in printed if row["table"] == "5"] == [
        row.derived for row in paper_table(5).rows
    ]
    assert [line[:7] for line in call("table", "ALL")[1].splitlines() if line[:5] == "Table"] == [
        f"Table {number}" for number in range(1, 6)
    ]


@pytest.mark.parametrize("number", ["0", "6", "every"])
def test_a_table_that_is_none_is_refused(call, number):
    code, out, error = call("table", number)
    assert (code, out) == (2, "")
    assert len(error.splitlines()) == 1


def test_backbone_as_a_table_keeps_units_and_introduces_the_model(capsys):
    backbone(omega=6.0, amplitude=[0.1])
    out = capsys.readouterr().out
    assert "FrE at ω = 6 rad/s" in out
    assert "[rad/s]" in out
    assert "3.729671" in out


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5])
def test_table_marks_differences(capsys, number):
    table(str(number), form="csv")
    printed = rows(capsys)
    assert all(row["derived"] for row in printed)
    errata = sum("erratum" in row["note"] for row in printed)
    assert errata == (5 if number == 3 else 0)


def test_table_for_a_reader(capsys):
    table("5")
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
