"""`rotbeam blade`: what a file's blade weighs, how stiff it is, and its first frequencies."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import Theory, linear_modes
from rotbeam_exu.files.beam_file import load_beam, load_run_file
from tests.beams import BLADE_TOML

TABLE = """
[blade.stations]
x = [0.0, 2.0]
stiffness = [[8e6, 3e6, 3e6, 600.0, 500.0, 8e3], [4e6, 1e6, 1e6, 200.0, 100.0, 2e3]]
mass = [[9.0, 0.04, 0.01, 0.03], [3.0, 0.02, 0.005, 0.015]]
tension = [[0.0, 0.0], [0.01, 0.01]]
center = [[0.0, 0.0], [0.02, 0.0]]
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "blade.toml"
    path.write_text(TABLE)
    return path


def rows(out):
    """The cells of each row of the tables, by the first."""
    lines = [line.strip("│").split("│") for line in out.splitlines() if line.startswith("│")]
    return {first.strip(): [cell.strip() for cell in rest] for first, *rest in lines}


def test_it_prints_the_table_and_what_its_interpolation_is_worth(call, file):
    code, out, error = call("blade", "--config", file, "--theory", "shear=true")
    assert code == 0, error
    told = dict(line.split(maxsplit=1) for line in out.splitlines() if line[:4] in ("mass", "stat"))
    assert told == {"mass": "12 kg", "stations": "2"}
    assert "first moment          10 kg m" in out  # ∫(9 - 3x) x dx from 0 to 2
    assert "center of mass        0.83333 m" in out
    cells = rows(out)
    assert list(map(float, cells["EI2 [N m^2]"])) == [500.0, 100.0, 100.0, 500.0]
    assert list(map(float, cells["m [kg/m]"])) == [9.0, 3.0, 3.0, 9.0]
    blade, theory = load_beam(file), Theory(shear=True)
    other = replace(blade, section=replace(blade.section, interpolation="matrix"))
    modes, others = (linear_modes(one, 0.0, 6, theory=theory) for one in (blade, other))
    known, changed = modes.frequencies, others.frequencies
    assert modes.names == others.names
    for k, (name, frequency) in enumerate(zip(modes.names, known, strict=True)):
        hertz, radians, change = map(float, cells[name])
        assert hertz == pytest.approx(frequency / (2.0 * np.pi), abs=1e-6)
        assert radians == pytest.approx(frequency, abs=1e-6)
        assert change == pytest.approx(100.0 * (changed[k] / frequency - 1.0), abs=0.01)
    assert max(abs(changed / known - 1.0)) > 1e-3


def test_at_the_speed_of_the_file(call, file):
    file.write_text(f"{TABLE}[motion]\nomega = 5.0\n")
    _, out, _ = call("blade", "--config", file)
    modes = linear_modes(load_beam(file), 5.0, 6)
    frequency = dict(zip(modes.names, modes.frequencies, strict=True))["flap 1"]
    assert "at 5 rad/s [Hz]" in " ".join(out.replace("┃", " ").split())
    assert float(rows(out)["flap 1"][2]) == pytest.approx(frequency / (2.0 * np.pi), abs=1e-6)


def test_of_a_blade_by_matrices_it_prints_the_change_to_components(call, file):
    file.write_text(f'{TABLE}interpolation = "matrix"\n')
    assert load_beam(file).section.interpolation == "matrix"
    assert '"components": the change' in call("blade", "--config", file)[1]


def test_a_blade_of_profiles_has_no_other_interpolation(call, tmp_path):
    path = tmp_path / "blade.toml"
    path.write_text(BLADE_TOML)
    _, out, _ = call("blade", "--config", path)
    assert "mass                  1.6 kg" in out
    assert float(rows(out)["EI [N m^2]"][0]) == 566.0
    assert "[%]" not in out


def test_what_the_other_interpolation_makes_of_large_jumps(call, tmp_path):
    """Matrices linear about the line, of centers that jump by 3 % of the length."""
    x = np.linspace(0.0, 1.0, 9)
    tables = {
        "x": x,
        "stiffness": np.outer(1.0 - 0.5 * x, [4e3, 4e3, 4e3, 0.08, 0.0625, 1.0]),
        "mass": np.tile([1.0, 3e-3, 2e-3, 1e-3], (9, 1)),
        "tension": 0.03 * np.random.default_rng(1).standard_normal((9, 2)),
    }
    lines = "".join(f"{name} = {values.tolist()}\n" for name, values in tables.items())
    (tmp_path / "blade.toml").write_text(f"[blade.stations]\n{lines}")
    code, out, _ = call("blade", "--config", tmp_path / "blade.toml")
    assert code == 0
    assert float(rows(out)["flap 1"][2]) > 50.0


def test_it_writes_a_blade_and_reads_it_again(call, file, tmp_path):
    """As TOML, with the speed of the file, and as BeamDyn's two files; neither is replaced."""
    file.write_text("[motion]\nomega = 2.0\n" + TABLE)
    for name in ("b.toml", "b_BeamDyn.dat"):
        code, out, error = call("blade", "--config", file, "-o", tmp_path / name)
        assert (code, error) == (0, "")
        assert f"written {tmp_path / name}" in " ".join(out.split())
        found, known = (load_beam(one) for one in (tmp_path / name, file))
        assert np.array(found.section.stiffness) == pytest.approx(np.array(known.section.stiffness))
        assert np.array(found.section.mass) == pytest.approx(np.array(known.section.mass))
        code, _, error = call("blade", "--config", file, "-o", tmp_path / name)
        assert code != 0
        assert "is there: choose another name with --out, or --force" in " ".join(error.split())
        assert call("blade", "--config", file, "-o", tmp_path / name, "--force")[0] == 0
    assert load_run_file(tmp_path / "b.toml").motion == {"omega": 2.0}
    (tmp_path / "b_BeamDyn.dat").unlink()  # but its blade file is there
    assert "b_BeamDyn_Blade.dat is there" in "".join(
        call("blade", "--config", file, "-o", tmp_path / "b_BeamDyn.dat")[2].split("\n")
    )
    code, _, error = call("blade", "--config", file, "-o", tmp_path / "b.csv")
    assert code != 0
    assert "the ending must be .toml or .dat" in " ".join(error.split())


def test_a_file_of_beamdyn_is_a_config(call, file, tmp_path):
    call("blade", "--config", file, "-o", tmp_path / "b_BeamDyn.dat")
    code, out, error = call("blade", "--config", tmp_path / "b_BeamDyn.dat")
    assert (code, error) == (0, "")
    assert "first moment          10 kg m" in out
