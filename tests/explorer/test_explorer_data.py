"""What the page is made of and the command that writes it, without a browser."""

import json

import numpy as np
import pytest

from analytic import AmplitudeNotReachedError, periodic_orbits
from rotbeam_exu import explorer
from rotbeam_exu.cli import main
from rotbeam_exu.explorer import data as room
from rotbeam_exu.explorer import explorer_data, explorer_page
from tests.beams import REED_TOML


def test_uneven_sliders_and_ramps_that_outlast_the_page_are_refused():
    for options, sentence in (
        ({"omegas": [0.0, 1.0, 3.0]}, "omegas must ascend in equal steps"),
        ({"amplitudes": [0.2, 0.1]}, "amplitudes must ascend in equal steps"),
        *(({"exact_ramp_times": wrong}, "exact_ramp_times must ascend and end before")
          for wrong in ([3.0, 2.0], [3.0, 15.0], [])),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=sentence):
            explorer_data(**options)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_harmonics_left_out_are_small(beam, data):
    for omega in (0.0, 6.0, 12.0):
        kept = data["harmonics"].sel(omega=omega, a=0.6).to_numpy()
        all_of_them = periodic_orbits(beam, omega, [0.6]).harmonics[0]
        assert np.abs(kept[: all_of_them.size] - all_of_them[: kept.size]).max() < 1e-7
        assert np.abs(all_of_them[kept.size :]).sum() < 1e-6


def test_orbits_that_are_not_found_leave_a_gap(beam, monkeypatch):
    def not_the_last(beam, omega, amplitudes):
        raise AmplitudeNotReachedError("drifts", periodic_orbits(beam, omega, amplitudes[:-1]))

    monkeypatch.setattr(room, "periodic_orbits", not_the_last)
    found = room.exact_orbits(beam, 4.0, (0.1, 0.2, 0.3))
    assert np.isnan(found["exact_frequency"]).to_numpy().tolist() == [False, False, True]
    assert np.isnan(found["axis_x"].to_numpy()[2]).all()


def test_nothing_in_the_data_ends_the_script(data):
    nasty = data.copy()
    nasty["note"] = nasty["note"].astype(object)
    nasty["note"][:] = "</script><b>"
    page = explorer_page(nasty)
    assert page.count("</script>") == 2  # the theme's, before anything is drawn, and the page's
    document = page.split("const DATA = ", 1)[1].split(";\n", 1)[0]
    assert json.loads(document)["notes"][0] == "</script><b>"


def test_it_writes_one_page_and_says_where(call, tmp_path, monkeypatch):
    """A beam of a file has one of its own name."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(explorer, "explorer_data", lambda *_, **__: None)
    monkeypatch.setattr(explorer, "explorer_page", lambda _: "<!doctype html>ω")
    assert "site/explorer.html" in call("explore", "--out", "site/explorer.html")[1]
    (page,) = (tmp_path / "site").iterdir()
    assert page.read_text(encoding="utf-8") == "<!doctype html>ω"
    (tmp_path / "reed.toml").write_text(REED_TOML)
    assert "explorer-reed.html" in call("explore", "--config", "reed.toml")[1]


@pytest.mark.slow
def test_the_whole_page_is_small_enough(tmp_path):
    out = tmp_path / "explorer.html"
    main(["explore", "--out", str(out), "--jobs", "2"])
    assert 1e6 < out.stat().st_size < 6e6
