"""`rotbeam campbell`, called as a function."""

import numpy as np
import pytest

from analytic import Tube, linear_modes
from rotbeam_exu import load
from rotbeam_exu.cli.campbell import campbell as command
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import BLADE_TOML, REED, REED_TOML

PLANES = ("lag", "flap", "torsion")


def test_table_shows_frequencies_and_crossings(capsys):
    command(omega_max=6.0, points=2, count=1, orders=1)
    printed = capsys.readouterr().out
    assert "3.730401" in printed
    assert "3.208183" in printed  # where lag 1 meets the line ω
    assert "lag 1" in printed


def test_a_beam_of_ones_own_goes_up_to_its_own_speeds(beam, tmp_path):
    (tmp_path / "beam.toml").write_text(REED_TOML)
    command(config=tmp_path / "beam.toml", points=2, count=1, orders=1, out=tmp_path)
    found = load(tmp_path / "campbell-given.nc")
    faster = REED.omega_0 / beam.omega_0
    assert found["omega"][1] == pytest.approx(12.0 * faster, rel=0.05)  # two digits
    assert found["frequency"][0, 0] == pytest.approx(faster * beam.omega_0, rel=1e-5)


def test_the_modes_of_a_known_section_and_their_figure(beam, capsys, tmp_path):
    options = {"omega_max": 12.0, "points": 2, "count": 3, "orders": 6}
    command(**options, section="tube", out=tmp_path, frequency_max=80.0)
    printed = capsys.readouterr().out
    modes = linear_modes(beam.with_shape(Tube()), 12.0, 4)
    written = sorted(path.name for path in tmp_path.iterdir())
    ends = ("-crossing_mode.csv", "-frequency-wide.csv", "-frequency.csv")
    ends += (".json", ".nc", ".pdf", ".png")
    assert written == [f"campbell-tube{end}" for end in ends]
    assert all(name in printed for name in written)
    found = load(tmp_path / "campbell-tube.nc")
    assert {"lag 1", "flap 1"} < set(found["mode"].to_numpy())
    known = dict(zip(modes.names, modes.frequencies, strict=True))
    for name in found["mode"].to_numpy():
        frequency = known[name]
        assert found["frequency"].sel(mode=name)[-1] == pytest.approx(frequency, rel=1e-9)
    with pytest.raises(FileExistsError, match="--force"):
        command(**options | {"points": 4}, section="tube", out=tmp_path)


def test_a_diagram_without_crossings_is_written_too(tmp_path):
    command(omega_max=1.0, points=2, count=1, orders=1, out=tmp_path)
    assert load(tmp_path / "campbell-given.nc").sizes["crossing"] == 0


@pytest.mark.parametrize(
    ("torsion", "families"),
    [("torsion_ratio = 1e-4\n", PLANES), ("torsion_ratio = inf\n", PLANES[:2]), ("", PLANES[:2])],
)
def test_families_are_those_that_the_section_in_a_file_tells(torsion, families, tmp_path, capsys):
    known = f"{BLADE_TOML}[blade.section.out_of_plane]\nbending_ratio = 0.5\n{torsion}"
    (tmp_path / "blade.toml").write_text(known)
    command(config=tmp_path / "blade.toml", points=2, omega_max=4.0, count=6)
    printed = " ".join(capsys.readouterr().out.split())
    assert [plane for plane in PLANES if f"{plane} 1" in printed] == list(families)


def test_a_blade_set_at_a_right_angle_flaps(tmp_path, capsys):
    """Names come from the largest share of the kinetic energy, with and without a section."""
    file = tmp_path / "blade.toml"
    known = "[blade.section.out_of_plane]\nbending_ratio = 0.5\ntorsion_ratio = 0.1\n"
    for angle, more, name in (
        (0.5 * np.pi, "", "flap 1"),
        (0.25 * np.pi, "", "lag 1"),
        (0.5 * np.pi, known, "lag 1"),
    ):
        angle_set = f"[blade]\nsetting_angle = {angle}"
        file.write_text(BLADE_TOML.replace("[blade]", angle_set) + more)
        command(config=file, points=2, omega_max=6.0, count=1, orders=2)
        printed = " ".join(capsys.readouterr().out.split())
        assert name in printed


def test_a_table_prints_torsion_to_the_digits_that_are_known(tmp_path, capsys):
    """0.1 % is what a clamp that holds the warping changes: four digits, not eight."""
    known = f"{BLADE_TOML}[blade.section.out_of_plane]\nbending_ratio = 1.0\ntorsion_ratio = 1e-4\n"
    (tmp_path / "blade.toml").write_text(known)
    command(config=tmp_path / "blade.toml", omega_max=4.0, points=2, count=4, orders=1)
    printed = capsys.readouterr().out
    blade = load_beam(tmp_path / "blade.toml")
    (torsion,) = linear_modes(blade, 4.0, 1, only="torsion").frequencies
    assert f" {torsion:#.4g} " in printed
    assert f"{torsion:#.5g}" not in printed
