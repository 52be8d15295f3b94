"""A run of a section that does not stay in the plane says so."""

import math

import numpy as np
import xarray as xr

from analytic import SpinUp
from rotbeam_exu import load, save, simulate
from rotbeam_exu.comparison import figure_14
from rotbeam_exu.runs.attributes import beam_of


def run(blade, ramp_time):
    # As coarse as measures the amplitude: the limit is the exact beam's.
    spin_up = SpinUp(omega=2.0, ramp_time=ramp_time)
    return simulate(blade, spin_up, elements=4, duration=ramp_time + 3.0, step=5e-3)


def test_a_run_beyond_the_limit_says_so_and_the_file_keeps_it(beam, tmp_path):
    blade = beam.with_section_out_of_plane(0.01, math.inf)
    beyond = run(blade, 1.8)
    sentence = beyond.attrs["out_of_plane"]
    assert "does not stay in the plane: at 2 rad/s" in sentence
    late = beyond["q"].where(beyond["time"] >= 1.8)
    a = 0.5 * float(late.max() - late.min()) / beam.length
    assert sentence.endswith(f"this one has a = {a:.3g}")
    again = load(save(beyond, tmp_path / "run.nc"))
    assert again.attrs["out_of_plane"] == sentence
    assert beam_of(again.attrs) == blade
    assert "out_of_plane" not in run(blade, 3.375).attrs
    unknown = run(beam.blade, 1.8)
    assert "out_of_plane" not in unknown.attrs
    assert np.array_equal(unknown["q"], beyond["q"]), "in the plane nothing knows of the section"


def test_figure_14_of_a_section_beyond_its_limit_says_so(beam, monkeypatch):
    monkeypatch.setattr(
        "rotbeam_exu.comparison.backbones.finite_element_points",
        lambda *_, **__: xr.Dataset({"ratio": ("omega", [1.0])}, {"omega": [2.0]}, {"meshes": ""}),
    )
    blade, options = beam.with_section_out_of_plane(0.01, math.inf), {"omegas": [2.0]}
    beyond = figure_14(blade, amplitudes=[0.1, 0.45], **options)
    assert "the planar orbit of a = 0.4 leaves it by" in beyond.attrs["out_of_plane"]
    assert "out_of_plane" not in figure_14(blade, amplitudes=[0.1, 0.3], **options).attrs
