"""`rotbeam animate`: of any beam, a film of the paper's length."""

import numpy as np
import pytest

from analytic import Beam, SpinUp, spin_up_response
from rotbeam_exu import figures, load, save
from rotbeam_exu.runs.attributes import beam_of, motion_of
from tests.beams import REED_TOML


def film(call, monkeypatch, tmp_path, *options):
    shown = {}

    def drawn(data, path, *, beside, rate, progress):
        shown.update(data=data, beside=beside, rate=rate)
        path.write_bytes(b"GIF")

    monkeypatch.setattr(figures.animation, "save_animation", drawn)
    code, out, error = call("animate", "--out", tmp_path / "film.gif", "--force", *options)
    return code, out + error, shown


def test_a_reed_is_shown_as_long_as_the_papers_beam(call, monkeypatch, tmp_path):
    (tmp_path / "reed.toml").write_text(REED_TOML)
    code, out, shown = film(call, monkeypatch, tmp_path, "--config", tmp_path / "reed.toml")
    assert code == 0
    assert "360 times slower" in out
    data = shown["data"]
    # As many pictures as of the paper's beam over 15 s, 20 a second, to two digits of each.
    assert abs(data.time.size / 301 - 1.0) < 0.05
    assert shown["rate"] == 20
    assert data.attrs["omega"] == 2200.0
    # The same motion, but for the two digits of the speed, 1.5 %, and of the ramp.
    paper = spin_up_response(
        Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0), np.linspace(0.0, 12.0, 241),
        tolerance=1e-4,
    )  # fmt: skip
    largest = abs(data.q).max().item() / data.attrs["blade_length"]
    assert largest == pytest.approx(np.abs(paper.q).max() / 8.0, rel=0.05)


def test_the_papers_beam_is_shown_in_real_time(call, monkeypatch, tmp_path):
    code, out, shown = film(call, monkeypatch, tmp_path, "--rate", "10", "--duration", "4")
    assert code == 0
    assert "slower" not in out
    assert beam_of(shown["data"].attrs) == Beam.reference()
    assert np.diff(shown["data"].time).max() < 0.1 + 1e-9


def test_a_single_picture_is_refused_and_the_remedy_works(call, monkeypatch, tmp_path):
    code, out, _ = film(call, monkeypatch, tmp_path, "--rate", "1", "--duration", "0.4")
    assert code == 2
    assert "take a rate 5 times as large" in out
    assert film(call, monkeypatch, tmp_path, "--rate", "5", "--duration", "0.4")[0] == 0


def test_the_linear_model_is_shown_beside_it_when_asked(call, monkeypatch, tmp_path):
    motion = ("--omega", "4", "--ramp-time", "3", "--duration", "3", "--rate", "5")
    code, _, shown = film(call, monkeypatch, tmp_path, *motion, "--beside", "linear")
    assert code == 0
    data, beside = shown["data"], shown["beside"]
    assert motion_of(beside.attrs) == motion_of(data.attrs)
    assert beside.place.shape == data.place.shape
    assert not beside.attrs["foreshortening"]
    assert film(call, monkeypatch, tmp_path, *motion)[2]["beside"] is None


def test_a_run_with_stations_is_shown_and_written_for_paraview(call, tmp_path):
    run = ("run", "--omega", "1", "--ramp-time", "1", "--duration", "14", "--step", "0.01")
    mesh = ("--elements", "2", "--stations", "5", "--no-figure", "--no-exact")
    code, out, error = call(*run, *mesh, "--out", tmp_path)
    assert (code, error) == (0, "")
    (kept,) = tmp_path.glob("*.nc")
    assert "place" in load(kept)
    assert [path.name for path in tmp_path.glob("*.csv")] == [f"{kept.stem}.csv"]  # one table
    film = ("animate", "--run", kept, "--rate", "1", "--out", tmp_path / "run.pvd")
    code, out, _ = call(*film)
    assert code == 0
    assert "to 14 s" in out
    assert len(list((tmp_path / "run").glob("*.vtu"))) == 15
    code, _, error = call(*film, "--force", "--omega", "2")
    assert code == 2
    assert "leave out --omega" in error
    # A run without stations has nothing to show.
    bare = save(load(kept).drop_dims("station"), tmp_path / "bare.nc")
    code, _, error = call("animate", "--run", bare, "--out", tmp_path / "run.gif")
    assert code == 2
    assert "simulate for stations" in error


def test_a_body_for_paraview_has_the_height_and_width_given(call, tmp_path):
    out = tmp_path / "film.pvd"
    motion = ("--omega", "4", "--duration", "1", "--rate", "2")
    assert call("animate", *motion, "--height", "0.04", "--width", "0.02", "-o", out)[0] == 0
    text = (tmp_path / "film" / "film-0002.vtu").read_text()
    assert f'NumberOfPoints="{4 * 41}" NumberOfCells="40"' in text
    assert 'Name="stress"' in text


def test_a_mode_is_shown_alone_and_slowly(call, monkeypatch, tmp_path):
    (tmp_path / "strip.toml").write_text(f"{REED_TOML}[beam.shape]\nkind = 'Rectangle'\n")
    options = ("--config", tmp_path / "strip.toml", "--omega", "100", "--mode")
    code, out, shown = film(call, monkeypatch, tmp_path, *options, "flap 1")
    assert code == 0, out
    assert "flap 1 at 100 rad/s" in out
    data = shown["data"]
    assert data.sizes["time"] == 80  # two periods, two seconds each
    assert abs(data["place"][0, -1, 2]) == pytest.approx(0.1 * 0.05, rel=1e-6)
    for more, sentence in (
        (("flap 1", "--beside", "linear"), "--mode shows a mode alone: leave out --beside"),
        (("flop 1",), "mode must be one of lag 1"),
    ):
        code, out, _ = film(call, monkeypatch, tmp_path, *options, *more)
        assert (code, sentence in out) == (2, True), out
    # A file that cannot be written is refused before the modes are computed.
    monkeypatch.delattr("rotbeam_exu.cli.animate.linear_modes")
    code, _, out = call("animate", *options, "flap 1", "--out", tmp_path / "film.pvd")
    assert (code, "the ending must be .gif or .mp4" in out) == (2, True), out
