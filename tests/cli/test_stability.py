"""`rotbeam stability`, as a user meets it."""

import numpy as np
import pandas as pd
import pytest

import analytic
from analytic import Rectangle, periodic_orbits
from analytic.exact.free.stability_limit import StabilityLimit, Tongue
from rotbeam_exu import load
from rotbeam_exu.runs.attributes import beam_of
from tests.beams import BLADE_TOML

STIFF = """
[blade.section.out_of_plane]
bending_ratio = 0.01
torsion_ratio = inf
"""


def test_a_sentence_a_table_and_a_figure(call, tmp_path, beam, monkeypatch):
    # As test_stability_limit finds it, in seconds.
    sum_resonance = {"kind": "sum resonance", "modes": ("flap 1", "torsion 1")}
    tongue = Tongue(low=0.2955, high=0.3532, growth=0.06, **sum_resonance)
    monkeypatch.setattr(
        analytic,
        "stability_limit",
        lambda blade, omega, mode, *, largest, **how: StabilityLimit(
            blade=blade, omega=omega, mode=mode, **how, growth=0.01,
            amplitude=np.inf, searched=largest, kind="", modes=(), tongues=(tongue,),
            converged=True,
        ),
    )  # fmt: skip
    arguments = ("stability", "--omega", "2", "--section", "rectangle", "--ratio", "3")
    arguments += ("--amplitude", "0.36", "0.3", "--out", tmp_path)
    code, out, error = call(*arguments)
    assert (code, error) == (0, "")
    assert out.startswith(
        "At 2 rad/s the planar orbits of this section stay in their plane, up to a = 0.36, but for"
    )
    (tongue,) = [line for line in out.partition("Tongues")[2].splitlines() if " 0.2955 " in line]
    assert "sum" in tongue
    assert " 0.3532 " in tongue
    blade = beam.with_hub_radius(0.0).with_shape(Rectangle(ratio=3.0))
    exact = periodic_orbits(blade, 2.0, [0.3, 0.36]).out_of_plane()
    row = next(line for line in out.splitlines() if line.startswith("│   0.3"))
    assert f"{exact.growth_rate[0]:.4g}" in row
    assert "sum resonance" in row
    told = [line for line in out.splitlines() if line.startswith("written ")]
    assert sorted(told) == sorted(f"written {path}" for path in tmp_path.iterdir())
    name = "stability-rectangle-3-omega-2-lag-1"
    kinds = ("nc", "csv", "json", "png", "pdf")
    assert {path.name for path in tmp_path.iterdir()} == {f"{name}.{kind}" for kind in kinds}
    data = load(tmp_path / f"{name}.nc")
    assert data["growth_rate"].to_numpy() == pytest.approx(exact.growth_rate)
    pairs = data["multipliers"].sel(part="real") + 1j * data["multipliers"].sel(part="imaginary")
    assert pairs.to_numpy() == pytest.approx(exact.multipliers)
    assert beam_of(data.attrs) == blade
    # The limit is 0.3825, beyond what was asked for.
    assert np.isinf(data["limit"])
    assert data["limit_growth"] == 0.01
    assert data["tongue_low"].item() == pytest.approx(0.29, abs=0.01)
    table = pd.read_csv(tmp_path / f"{name}.csv", keep_default_na=False)
    assert {"sum resonance", ""} == set(table["kind"])


def test_damping_makes_the_growth_slower(call, tmp_path, beam, monkeypatch):
    """By the ratio, and by the damping of the file's blade; the limit is tested without a door."""

    def told(blade, omega, mode, *, largest, **how):
        del largest
        return StabilityLimit(
            blade=blade, omega=omega, mode=mode, **how, growth=1e-6,
            amplitude=0.0402, searched=0.1, kind="divergence", modes=("flap 1",), tongues=(),
            converged=True,
        )  # fmt: skip

    monkeypatch.setattr(analytic, "stability_limit", told)
    command = ("stability", "--omega", "2", "--section", "rectangle", "--amplitude", "0.045")
    code, out, _ = call(*command, "--damping-ratio", "0.005", "--out", tmp_path)
    assert code == 0
    sentence = "by 0.005 of the critical, are unstable out of the plane for a between 0.0402"
    assert sentence in " ".join(out.split())
    data = load(tmp_path / "stability-rectangle-omega-2-lag-1.nc")
    free = periodic_orbits(beam.with_shape(Rectangle()), 2.0, [0.045]).out_of_plane().growth_rate[0]
    assert 0.0 < data["growth_rate"].item() < free
    # Without damping it is another result.
    code, _, error = call(*command, "--out", tmp_path)
    assert code == 2
    assert "damping_ratio 0.005" in error
    assert call(*command, "--damping-ratio", "-1", "--out", tmp_path)[0] == 2


def test_a_section_out_of_a_file(call, reached, tmp_path):
    file = tmp_path / "blade.toml"
    file.write_text(BLADE_TOML + STIFF)
    command = ("stability", "--omega", "2", "--amplitude", "0.02", "--config", file)
    code, out, _ = call(*command, "--out", tmp_path)
    assert code == 0
    assert "stay in their plane, up to a = 0.02." in out
    growth = load(tmp_path / "stability-given-omega-2-lag-1.nc")["growth_rate"].to_numpy()
    assert np.array_equal(growth, [0.0])

    # What it found is no input: the same may be asked again, and is computed.
    assert reached(analytic, "stability_limit", *command, "--out", tmp_path)
