"""What the page is made of, without a browser."""

import json
from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial.chebyshev import chebpts1

from analytic import AmplitudeNotReachedError, periodic_orbits
from rotbeam_exu.explorer import exact, explorer_data, explorer_page
from rotbeam_exu.explorer.exact import in_between


def test_uneven_sliders_are_refused():
    with pytest.raises(ValueError, match="omegas must ascend in equal steps"):
        explorer_data(omegas=[0.0, 1.0, 3.0])
    with pytest.raises(ValueError, match="amplitudes must ascend in equal steps"):
        explorer_data(amplitudes=[0.2, 0.1])


def test_options_beside_data_are_refused(data):
    with pytest.raises(TypeError, match="data were given with jobs"):
        explorer_page(data, jobs=1)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_harmonics_left_out_are_small(beam, data):
    for omega in (0.0, 6.0, 12.0):
        kept = data["harmonics"].sel(omega=omega, a=0.6).to_numpy()
        all_of_them = periodic_orbits(beam, omega, [0.6]).harmonics[0]
        # A series through sixteen orbits; at 6 rad/s a narrow resonance leaves 4e-8.
        assert np.abs(kept[: all_of_them.size] - all_of_them[: kept.size]).max() < 1e-7
        assert np.abs(all_of_them[kept.size :]).sum() < 1e-6


def test_where_no_series_converges_orbits_are_shown_themselves(beam):
    a = np.array([0.1, 0.5])
    backbone = periodic_orbits(beam, 6.0, 0.5 * np.sqrt(0.5 + 0.5 * chebpts1(16)))
    assert in_between(backbone, a) is not None
    # As a tongue would bend it.
    bent = replace(backbone, frequency=backbone.frequency + 1e-3 * (backbone.amplitude > 0.3))
    assert in_between(bent, a) is None


def test_a_resonance_at_an_orbit_of_the_series_is_not_the_sliders_end(beam, monkeypatch):
    asked = []

    def meets_one(beam, omega, amplitudes):
        asked.append(len(amplitudes))
        if len(asked) == 1:
            raise AmplitudeNotReachedError("Newton's method does not converge")
        return periodic_orbits(beam, omega, amplitudes)

    monkeypatch.setattr(exact, "periodic_orbits", meets_one)
    a = tuple((np.arange(1, 26) / 100.0).tolist())
    found = exact.exact_orbits(beam, 4.0, a)
    assert asked == [16, 25]
    wanted = periodic_orbits(beam, 4.0, a).frequency
    np.testing.assert_allclose(found["exact_frequency"], wanted, rtol=1e-12)

    def not_the_last(beam, omega, amplitudes):
        raise AmplitudeNotReachedError("drifts", periodic_orbits(beam, omega, amplitudes[:-1]))

    monkeypatch.setattr(exact, "periodic_orbits", not_the_last)
    found = exact.exact_orbits(beam, 4.0, (0.1, 0.2, 0.3))
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
