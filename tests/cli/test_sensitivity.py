"""`rotbeam sensitivity`: changes in percent, and all derivatives in files."""

import numpy as np
import pytest

from analytic import linear_modes
from analytic.sensitivity import sensitivity
from rotbeam_exu import load
from rotbeam_exu.files.beam_file import load_beam
from rotbeam_exu.files.blade_toml import blade_toml
from tests.beams import irregular


def cells(out, name):
    (line,) = (line for line in out.splitlines() if line.startswith(f"│ {name} "))
    return [cell.strip() for cell in line.strip("│").split("│")][1:]


def test_it_prints_percents_and_writes_all(call, tmp_path):
    (tmp_path / "blade.toml").write_text(blade_toml(irregular(3, 0.01, 4)))
    options = ("--config", tmp_path / "blade.toml", "--omega", "2", "--count", "2", "--rows", "3")
    code, out, error = call("sensitivity", *options, "-o", tmp_path)
    assert code == 0, error
    found = sensitivity(linear_modes(load_beam(tmp_path / "blade.toml"), 2.0, 2))
    change, *percents = cells(out, "EI2")
    assert change == "+1 %"
    expected = found.relative[:, found.names.index("EI2")]
    assert list(map(float, percents)) == pytest.approx(expected, rel=1e-2)
    change, *percents = cells(out, "precone")
    assert change == "+1 deg"
    slope = found.derivatives[:, found.names.index("precone")] / found.values
    assert list(map(float, percents)) == pytest.approx(100.0 * np.radians(slope), rel=1e-2)
    several = sum("[" in name for name in found.names)
    assert f"{several - 3} more numbers of stations change less" in out
    (kept,) = map(load, tmp_path.glob("*.nc"))
    np.testing.assert_allclose(kept["derivative"], found.derivatives, rtol=1e-9)
    assert list(kept["parameter"].values) == list(found.names)


def test_the_papers_beam_at_rest(call):
    """ω ∝ √(EI/m), but for its axial inertia."""
    code, out, _ = call("sensitivity", "--count", "1")
    assert code == 0
    assert cells(out, "EI3") == ["+1 %", "+0.5"]
    assert cells(out, "m") == ["+1 %", "-0.5"]
    code, _, error = call("sensitivity", "--rows", "-1")
    assert (code, "rows must be" in error) == (2, True)


def test_a_steady_state_under_its_loads(call, tmp_path):
    """A stiff blade's weight: all of it is in the moment at the root."""
    (tmp_path / "blade.toml").write_text(
        "[blade]\nlength = 2.0\n[blade.section]\naxial_stiffness = 1e9\n"
        "bending_stiffness = 1e6\nmass_per_length = 3.0\n[blade.section.out_of_plane]\n"
        'bending_ratio = 1.0\ntorsion_ratio = 1.0\n[[loads]]\nkind = "Gravity"\ngravity = 10.0\n'
        "tilt = 1.5707963267948966\n"
    )
    options = ("--config", tmp_path / "blade.toml", "--steady")
    code, out, error = call("sensitivity", *options, "--scatter", "m=0.1", "-o", tmp_path)
    assert code == 0, error
    moments = 3.0 * 10.0 * 2.0**2 / 2.0
    (row,) = (line for line in out.splitlines() if line.startswith("│ m ") and "+0.6" in line)
    assert [cell.strip() for cell in row.strip("│").split("│")][2:] == ["+0", "+0.6", "+0"]
    value, spread, *_ = cells(out.partition("Standard")[2], "root moment y [N m]")
    assert (float(value), float(spread)) == pytest.approx((moments, 0.1 * moments), rel=1e-3)
    (kept,) = map(load, tmp_path.glob("sensitivity-steady-*.nc"))
    at = {"output": list(kept["output"].values).index("root moment y")}
    assert float(kept["output_value"][at]) == pytest.approx(moments, rel=1e-3)
    code, _, error = call("sensitivity", *options[:2])
    assert (code, "does not use [[loads]] without --steady or --spin-up" in error) == (0, True)


def test_a_scatter_is_printed_with_its_shares(call, tmp_path):
    """ω ∝ √(EI/m), but for its axial inertia."""
    code, out, error = call("sensitivity", "--count", "1", "--scatter", "EI3=0.06", "m=0.08")
    assert code == 0, error
    (_, _, spread, *shares) = cells(out, "lag 1")
    assert float(spread) == pytest.approx(5.0, rel=2e-2)
    assert list(map(float, shares)) == pytest.approx([36.0, 64.0], abs=0.2)
    for pairs, sentence in (
        (["EI3"], "--scatter takes name=deviation, as EI3=0.05, got 'EI3'"),
        (["EI3=0.1", "EI3=0.2"], "--scatter has EI3 twice"),
        (["GA2=0.1"], "scatter has no parameter 'GA2'; there are EA, EI3, m"),
        (["EI3=nan"], "the scatter of EI3 must be finite"),
    ):
        code, _, error = call("sensitivity", "--count", "1", "--scatter", *pairs)
        assert (code, sentence in error) == (2, True), error
    code, _, error = call("sensitivity", "--count", "1", "--scatter", "m=0.1", "--length", "2")
    assert (code, "leave length out" in error) == (2, True)


def test_the_file_has_the_uncertainty(call, tmp_path):
    blade = blade_toml(irregular(3, 0.01, 4))
    (tmp_path / "blade.toml").write_text(f"{blade}\n[uncertainty]\nEI3 = 0.06\nlength = 0.5\n")
    config = ("--config", tmp_path / "blade.toml", "--count", "1")
    code, of_file, error = call("sensitivity", *config)
    assert (code, error) == (0, "")
    told = of_file.partition("Standard")[2]
    _, given, _ = call("sensitivity", *config, "--scatter", "EI3=0.06", "--length", "0.5")
    assert told
    assert given.partition("Standard")[2] == told
    code, out, error = call("campbell", *config, "--points", "2", "--omega-max", "1")
    assert (code, error) == (0, "")
    row = next(line for line in told.splitlines() if " 1 " in line)
    mode, *values = row.strip("│").split("│")
    percent = out.partition("Standard deviations [%]")[2].splitlines()[4].strip("│").split("│")
    assert mode.strip() in out
    assert float(percent[1]) == pytest.approx(float(values[2]), rel=1e-2)
    code, _, error = call("blade", "--config", tmp_path / "blade.toml")
    assert (code, "does not use EI3, length of [uncertainty]" in error) == (0, True)


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("EI3 = -0.1", "EI3 of [uncertainty] must not be negative"),
        ("EI3 = true", "EI3 of [uncertainty] must be a"),
        ('EI3 = "5 %"', "EI3 of [uncertainty] must be a"),
        ("EI3 = nan", "EI3 of [uncertainty] must be finite"),
        ("EI9 = 0.1", "scatter has no parameter 'EI9'"),
        ("EI3 = 0.1\nlength = 2.0", "a correlation length is for numbers of stations"),
    ],
)
def test_an_uncertainty_that_is_none(call, tmp_path, line, sentence):
    (tmp_path / "run.toml").write_text(f"[uncertainty]\n{line}\n")
    code, _, error = call("sensitivity", "--config", tmp_path / "run.toml")
    assert code == 2
    assert sentence in error


def test_orbits_of_the_papers_beam(call):
    """At rest ω ∝ √(EI/m) at each amplitude, and the softening depends on neither."""
    code, out, error = call("sensitivity", "--omega", "0", "--amplitude", "0.1", "0.3")
    assert (code, error) == (0, "")
    frequency, softening = out.partition("Change of the frequency")[2].split("Change of the soft")
    ahead = [float(cell) for cell in cells(frequency, "EI3")[1:]]
    assert ahead == pytest.approx([0.01455] * 2, rel=1e-2)
    assert np.abs([float(cell) for cell in cells(softening, "m")[1:]]).max() < 1e-5
    code, _, error = call("sensitivity", "--steady", "--amplitude", "0.1")
    assert (code, "keep one" in error) == (2, True)


def test_a_spin_up(call, tmp_path):
    """What 1 % of EI does to its largest lag, and all numbers over time in the file."""
    options = ("--omega", "6", "--ramp-time", "3", "--duration", "6", "--tolerance", "1e-4")
    code, out, error = call(
        "sensitivity", "--spin-up", *options, "--scatter", "EI3=0.05", "-o", tmp_path
    )
    assert (code, error) == (0, "")
    assert float(cells(out.partition("Change")[0], "largest tip y [m]")[0]) == pytest.approx(
        -5.1557, rel=1e-4
    )
    changes = cells(out.split("Change of the")[1], "EI3")
    assert float(changes[2]) == pytest.approx(0.0378, abs=1e-4)
    off, percent, share = cells(out.partition("Standard")[2], "largest tip y [m]")[1:]
    assert float(off) == pytest.approx(5.0 * 0.0378, rel=3e-3)
    assert (float(percent), float(share)) == (pytest.approx(3.67, abs=0.01), 100.0)
    (kept,) = map(load, tmp_path.glob("sensitivity-spin-up-omega-6.nc"))
    assert "tip y at 5.9999 s" not in kept["output"].values
    assert "tip y at 6 s" in kept["output"].values


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--ramp-time", "3"], "--ramp-time and --duration are of a spin-up: give --spin-up"),
        (["--spin-up", "--steady"], "--steady and --spin-up are of different answers: keep one"),
        (["--spin-up", "--scatter", "omega[0]=1"], "scatter has no parameter 'omega[0]'; there"),
        (["--spin-up", "--duration", "-1"], "duration must be positive"),
    ],
)
def test_options_that_are_of_another_answer(call, options, sentence):
    code, _, error = call("sensitivity", *options, "--tolerance", "1e-3")
    assert (code, sentence in error) == (2, True), error
