"""`rotbeam backbone` and `rotbeam table`."""

import csv
import io

import pytest

from analytic import VARIANTS, Beam, paper_table, periodic_orbits, reduced_model
from analytic.methods.continuation import Care
from analytic.reduced.model_range import model_at
from tests.beams import BLADE_TOML

BLADE = BLADE_TOML.replace("[blade]", "[blade]\nhub_radius = 0.5") + "[motion]\nomega = 6\n"


def test_csv_keeps_every_digit_of_what_the_model_answers(call):
    backbone = ("backbone", "--omega", "6", "--variant", "FrM", "--amplitude", "0.05", "0.2")
    _, out, _ = call(*backbone, "--format", "csv")
    model = reduced_model(Beam.reference(), 6.0, "FrM")
    exact = map(model.exact_frequency, (0.05, 0.2))
    for row, a, exactly in zip(csv.DictReader(io.StringIO(out)), (0.05, 0.2), exact, strict=True):
        assert row["variant"] == "FrM"
        assert float(row["amplitude a/L"]) == a
        assert float(row["Eq. 63 [rad/s]"]) == model.frequency(a)
        assert float(row["Eq. 41 exactly [rad/s]"]) == exactly
        assert float(row["Eq. 63 / ω_n"]) == pytest.approx(model.frequency(a) / model.omega_n)
    out = call(*backbone)[1]
    assert "FrM at ω = 6 rad/s" in out
    assert f"{model.frequency(0.2):.4f}" in out


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
    every = ("backbone", "--all-variants", "--amplitude", "0.1", "--config", blade, "--format",
             "csv")  # fmt: skip
    code, out, error = call(*every)
    assert code == 0
    answered = [row["variant"] for row in csv.DictReader(io.StringIO(out))]
    assert "FrM" in answered
    assert error.count("warning:") == 1
    refused = ", ".join(name for name in VARIANTS if name not in answered)
    assert f"no answer: {refused}: CI is for the uniform beam" in error
    # Who asked for one by its name did not get what was asked for.
    code, out, error = call("backbone", "--variant", "CI", "--amplitude", "0.1", "--config", blade)
    assert (code, out) == (2, "")
    assert "has a hub: take FrM" in error


def test_without_a_variant_it_is_frm_and_the_exact_beam(call, tmp_path):
    """FrE, the paper's, is 6 to 29 % off."""
    code, out, _ = call("backbone", "--omega", "6", "--amplitude", "0.1", "--format", "csv")
    (row,) = csv.DictReader(io.StringIO(out))
    assert (code, row["variant"]) == (0, "FrM")
    (frequency,) = periodic_orbits(Beam.reference(), 6.0, [0.1]).frequency
    assert float(row["exact beam [rad/s]"]) == pytest.approx(frequency)
    blade = tmp_path / "blade.toml"
    blade.write_text(
        BLADE.replace("[blade]", "[blade]\nline = { twist = [0.0, 0.5] }").replace(
            "[blade.section]",
            "[blade.section]\nout_of_plane = { bending_ratio = 0.1, torsion_ratio = 0.1 }",
        )
    )
    code, out, error = call("backbone", "--amplitude", "0.1", "--config", blade)
    assert (code, error) == (0, "")
    assert "exact/ω_n" in out


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


def test_the_exact_backbone_of_a_higher_mode_comes_alone(call, monkeypatch):
    # What is not found is given up sooner.
    monkeypatch.setattr("analytic.exact.free.path.THOROUGH", Care(harmonics=30))
    arguments = ("backbone", "--omega", "6", "--mode", "2", "--amplitude", "0.02", "0.2")
    code, out, error = call(*arguments, "--format", "csv")
    near, far = csv.DictReader(io.StringIO(out))
    truth = periodic_orbits(Beam.reference(), 6.0, [0.02], mode="lag 2")
    assert float(near["exact beam [rad/s]"]) == pytest.approx(truth.frequency[0], rel=1e-9)
    assert far["exact beam [rad/s]"] == "nan"
    assert code == 1
    assert "no orbit of lag 2 at omega = 6 rad/s with a peak |q|/L of 0.2" in error


def test_tables_are_printed_with_their_notes(call, monkeypatch):
    monkeypatch.setenv("COLUMNS", "1000")
    code, out, _ = call("table", "all")
    assert code == 0
    tables = out.split("Table ")[1:]
    assert [table[0] for table in tables] == list("12345")
    for number, printed in enumerate(tables, 1):
        cells = {cell.strip() for cell in printed.split("│")}
        for row in paper_table(number).rows:
            assert {row.printed, row.derived} <= cells
            assert row.note in printed
    assert "erratum" in tables[2]


def test_the_backbone_of_a_damped_blade_is_that_without_damping(call, tmp_path):
    orbits = ("backbone", "--exact", "--amplitude", "0.1", "--format", "csv", "--config")
    answers = []
    for name, damping in (("free", ""), ("damped", "[blade.damping]\nratio = 0.01\n")):
        file = tmp_path / f"{name}.toml"
        file.write_text(BLADE + damping)
        answers.append(call(*orbits, file))
    assert answers[0][:2] == answers[1][:2]
    assert answers[0][0] == 0
    assert "without its damping" in answers[1][2]
