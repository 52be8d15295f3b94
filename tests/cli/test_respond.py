"""`rotbeam respond`, as a user meets it."""

import re

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from analytic import Damping, ResponseNotReachedError, TipForce
from rotbeam_exu import dataset_of, load
from rotbeam_exu.cli import respond as job
from rotbeam_exu.runs.attributes import beam_of
from tests.beams import BLADE_TOML

RIPPLE = ("--omega", "6", "--ripple", "0.002", "--damping-ratio", "0.0008", "--from", "3.7")
QUICK = ("--to", "3.76", "--points", "2", "--functions", "8")


def test_the_table_has_ends_folds_and_peaks_and_the_files_the_curve(
    call, tmp_path, monkeypatch, folded
):
    asked = []

    def computed(*arguments, **options):
        asked.append((*arguments, options["functions"]))
        return folded

    monkeypatch.setattr(job.analytic, "forced_response", computed)
    code, out, error = call("respond", *RIPPLE, *QUICK, "--out", tmp_path)
    assert code == 0
    assert error == ""
    ((blade, omega, ripple, frequencies, functions),) = asked
    assert (blade, omega, ripple, functions) == (folded.blade, 6.0, folded.load, 8)
    assert frequencies.tolist() == [3.7, 3.76]
    rows = [re.split(r"\s*│\s*", line)[1:-1] for line in out.splitlines() if line.startswith("│")]
    assert [row[0] for row in rows] == ["start", "fold", "fold", "peak", "end"]
    assert [row[4] for row in rows] == ["yes", "yes | no", "no | yes", "yes", "yes"]
    wanted = [*((fold.frequency, fold.amplitude) for fold in folded.folds), folded.peaks[0]]
    for row, (nu, a) in zip(rows[1:4], wanted, strict=True):
        assert [float(row[1]), float(row[2])] == pytest.approx([nu, a], abs=1e-6)
    # On the backbone a ripple's lag is half a turn, its Euler force being a quarter behind it.
    assert float(rows[3][3]) == pytest.approx(np.pi, abs=1e-2)
    name = "response-omega-6-ripple-0.002-from-3.7-to-3.76"
    assert {path.name for path in tmp_path.iterdir()} == {
        f"{name}.{kind}" for kind in ("nc", "csv", "json", "png", "pdf")
    }
    data, table = load(tmp_path / f"{name}.nc"), pd.read_csv(tmp_path / f"{name}.csv")
    xr.testing.assert_equal(data, dataset_of(folded))
    assert set(table["phase [rad]"]) == set(folded.phase)
    assert (data["cosine"] - 1j * data["sine"]).to_numpy() == pytest.approx(folded.harmonics)
    assert beam_of(data.attrs) == folded.blade
    attrs = {"load": "SpeedRipple", "load_size": 0.002, "load_unit": "rad/s", "omega": 6.0}
    assert attrs.items() <= data.attrs.items()
    assert "numpy" in data.attrs["versions"]


def test_it_is_followed_through_lag_1_unless_told_otherwise(call, tmp_path):
    options = ("--tip-force", "0.5", "--damping-ratio", "0.02", "--points", "3", "--no-figure")
    for _ in range(2):  # the second replaces the first
        code, out, error = call("respond", "--omega", "6", *options, "-o", tmp_path)
    assert (code, error) == (0, "")
    (path,) = tmp_path.glob("*.nc")
    assert path.name == "response-omega-6-tip-force-0.5-from-3.36-to-4.1.nc"
    assert "peak" in out
    code, _, error = call("respond", "--gravity", "--damping-ratio", "0.1")
    assert (code, "give the rotation speeds between which to follow it" in error) == (2, True)


@pytest.mark.parametrize(
    ("load_option", "kind", "size"),
    [
        (("--distributed-force", "0.002"), "DistributedForce", 0.002),
        (("--gravity",), "Gravity", 9.81),
    ],
)
def test_each_load_is_taken(call, tmp_path, load_option, kind, size):
    """Figures of curves are tested above, and in tests/figures."""
    omega = () if kind == "Gravity" else ("--omega", "6")
    code, out, _ = call(
        "respond", *load_option, *omega, "--external-damping", "0.5", "--from", "4.5", "--to", "5",
        "--points", "2", "--functions", "6", "--theory", "extension=false", "--no-figure",
        "--out", tmp_path,
    )  # fmt: skip
    assert code == 0
    data = load(next(tmp_path.glob("*.nc")))
    assert (data.attrs["load"], data.attrs["load_size"]) == (kind, size)
    assert data.attrs["damping_external"] == 0.5
    assert ("ω [rad/s]" if kind == "Gravity" else "ν [rad/s]") in out
    assert ("backbone_frequency" in data) == (kind != "Gravity")


def test_the_damping_of_the_file_is_taken_or_replaced(reached, tmp_path):
    config = tmp_path / "blade.toml"
    config.write_text(f"{BLADE_TOML}\n[blade.damping]\nbending = 0.02\n")
    drive = ("--omega", "3", "--tip-force", "0.01", "--from", "2", "--to", "2.5", "--out", tmp_path)
    own, other = (
        reached(job.analytic, "forced_response", "respond", *drive, "--config", config, *options)
        for options in ((), ("--external-damping", "0.3"))
    )
    assert own[0][0].damping == Damping(bending=0.02)
    assert other[0][0].damping == Damping(external=0.3)


def answered(call, folder, section, rest, *options):
    """Data and text of a blade with more of its section, and more besides, in its file."""
    config = folder / "blade.toml"
    config.write_text(f"{BLADE_TOML}out_of_plane = {{ {section} }}\n{rest}")
    code, out, error = call(
        "respond", "--config", config, *options, "--points", "2", "--no-figure", "--out", folder
    )
    assert (code, error) == (0, "")
    return load(next(folder.glob("*.nc"))), " ".join(out.split())


def test_a_twisted_blade_has_lag_flap_and_twist_of_its_tip(call, tmp_path):
    data, _ = answered(
        call, tmp_path, "bending_ratio = 0.25, torsion_ratio = 0.3",
        "[blade.line]\ntwist = [0.0, 0.5]\n[blade.damping]\nbending = 0.1\nexternal = 0.1\n",
        "--gravity", "0.5", "--from", "2", "--to", "2.5", "--functions", "6",
        "--theory", "extension=false",
    )  # fmt: skip
    assert data["lag"].to_numpy() == pytest.approx(data["amplitude"].to_numpy(), rel=0.05)
    assert (data["lag"] > data["flap"]).all()
    assert (data["flap"] > data["twist"]).all()
    assert data["twist"].attrs["units"] == "rad"
    assert "plane" not in data["stable"].attrs["long_name"]


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ("", "3 of 14 planar orbits leave their plane; the smallest, a = 0.08758 at 2.74"),
        ("rotary_inertia = 0.0\n", "the plane alone: .* a twist without inertia"),
    ],
)
def test_a_known_section_tells_whether_the_response_leaves_the_plane(
    call, tmp_path, more, sentence
):
    data, said = answered(
        call, tmp_path, "bending_ratio = 0.01, torsion_ratio = 0.02",
        f"{more}[blade.damping]\nbending = 0.01\n",
        "--omega", "2", "--tip-force", "0.5", "--from", "2.4", "--to", "2.8", "--functions", "8",
    )  # fmt: skip
    assert re.search(sentence, said)
    assert ("growth_rate" in data) == (not more)
    if not more:
        assert (data["growth_rate"] > 0.0).to_numpy().tolist() == [False] * 11 + [True] * 3


def test_without_damping_a_zero_lets_through_what_meets_no_resonance(call, tmp_path):
    quiet = ("--omega", "6", "--tip-force", "0.1", "--points", "2", "--no-figure",
             "--out", tmp_path)  # fmt: skip
    assert "0 for none" in call("respond", *quiet, "--from", "1", "--to", "2")[2]
    none = (*quiet, "--damping-ratio", "0")
    assert call("respond", *none, "--from", "1", "--to", "2")[0] == 0


def test_what_was_found_of_a_curve_is_kept_and_marked(call, tmp_path, monkeypatch, folded):
    def broken(*_, **__):
        raise ResponseNotReachedError("the response was not found after 3.7 rad/s", folded)

    monkeypatch.setattr(job.analytic, "forced_response", broken)
    code, _, error = call("respond", *RIPPLE, *QUICK, "--out", tmp_path)
    assert code == 1
    kept = tmp_path / "response-omega-6-ripple-0.002-from-3.7-to-3.76-failed.nc"
    assert f"after 3.7 rad/s; the part that was computed is in {kept}, marked failed" in error
    assert load(kept).attrs["verdict"] == "failed: the response was not found after 3.7 rad/s"


def test_the_load_of_a_file_is_used_at_the_frequencies_of_the_curve(
    call, tmp_path, monkeypatch, folded
):
    calls = []

    def computed(*arguments, **_):
        calls.append(arguments)
        return folded

    monkeypatch.setattr(job.analytic, "forced_response", computed)
    (tmp_path / "run.toml").write_text(
        BLADE_TOML + '[motion]\nomega = 6\n[[loads]]\nkind = "TipForce"\n'
        "amplitude = 0.5\nfrequency = 3.0\n"
    )
    options = ("--config", tmp_path / "run.toml", *RIPPLE[4:], *QUICK, "--out", tmp_path)
    code, _, error = call("respond", *options)
    assert (code, "is that from --from to --to, not its own" in error) == (0, True), error
    (_, omega, force, frequencies), *_ = calls
    assert (omega, force) == (6.0, TipForce(amplitude=0.5))
    assert frequencies.tolist() == [3.7, 3.76]
