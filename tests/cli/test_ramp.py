"""`rotbeam ramp`, as a user meets it, and its picture."""

import re

import numpy as np
import pytest

from rotbeam_exu import comparison, load
from tests.files.test_beam_file import STATIONS

QUICK = ("--omega", "2", "--longest", "4.6", "--points", "2", "--finite-element-points", "1")


def test_tables_and_files(call, reached, tmp_path):
    asked = ("ramp", *QUICK, "--elements", "4", "--out", tmp_path)
    code, out, error = call(*asked)
    assert code == 0
    assert "4 of 4 done" in error  # a quiet ramp, too
    rows = [re.split(r"\s*│\s*", line)[1:-1] for line in out.splitlines() if line.startswith("│")]
    # Another code's quiet ramp, and what it leaves.
    quiet, left, form = map(float, rows[0])
    assert quiet == pytest.approx(4.2966, abs=2e-3)
    assert left == pytest.approx(0.0069, abs=5e-5)
    assert form == pytest.approx(left, rel=0.05)
    for row in rows[1:]:
        numbers = [float(cell) for cell in row[1:] if cell != "-"]
        # Closed form, with the backbone, exact and by 4 elements.
        assert numbers == pytest.approx([numbers[2]] * len(numbers), rel=0.15)
    name = "ramp-omega-2-longest-4.6"
    kinds = {f"{name}{end}" for end in (".nc", ".json", ".png", ".pdf")}
    kinds |= {f"{name}-{what}.csv" for what in ("linear", "exact", "finite_element", "quiet")}
    assert {path.name for path in tmp_path.iterdir()} == kinds
    # One path a line, whole.
    told = [line for line in out.splitlines() if line.startswith("written ")]
    assert sorted(told) == sorted(f"written {path}" for path in tmp_path.iterdir())
    data = load(tmp_path / f"{name}.nc")
    assert data["exact"].size == 2
    assert data["quiet_ramp_time"].to_numpy() == pytest.approx([quiet], abs=1e-4)
    assert np.all(data["corrected"] <= data["linear"])

    # Its grids are no inputs: the same may be asked again, and is computed; others may not.
    assert reached(comparison, "residual", *asked)
    points = asked.index("--points") + 1
    code, _, error = call(*asked[:points], "3", *asked[points + 1 :])
    assert code == 2
    assert "points 2 instead of 3" in error


@pytest.mark.slow
def test_a_table_of_stations(call, tmp_path):
    """Closed form of the lowest modes, exact transient and elements, which are four."""
    path = tmp_path / "blade.toml"
    path.write_text(STATIONS)
    command = ("ramp", "--config", path, "--omega", "0.5", "--longest", "6.5", "--mode", "flap 1")
    few = ("--points", "1", "--finite-element-points", "1", "--elements", "4", "--out", tmp_path)
    code, out, _ = call(*command, *few)
    assert code == 0
    assert "no quiet ramp time of flap 1 up to 6.5 s" in out
    assert "of all modes out of the plane of rotation" in out
    rows = [re.split(r"\s*│\s*", line)[1:-1] for line in out.splitlines() if line.startswith("│")]
    _, _, together, exact, elements = map(float, rows[-1])
    assert together == pytest.approx(exact, rel=0.1)
    assert elements == pytest.approx(exact, rel=0.1)
    data = load(tmp_path / "ramp-omega-0.5-longest-6.5-flap-1.nc")
    assert data.attrs["mode"] == "flap 1"
    assert np.isnan(data["corrected"]).all()
