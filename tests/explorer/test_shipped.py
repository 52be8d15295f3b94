"""The Explorer's page of the paper's beam comes with the package, and has what is computed."""

import base64
import json
import lzma
import re
from importlib import resources

import numpy as np
import pytest

import rotbeam_exu.explorer as room
from analytic import Beam, periodic_orbits, reduced_model
from rotbeam_exu.explorer import AMPLITUDES, EXACT_RAMP_TIMES, OMEGAS, SHIPPED, explorer_page
from rotbeam_exu.explorer.data import exact_spin_up
from tests.docs.test_readme import golden_points


@pytest.fixture(scope="module")
def shipped():
    return json.loads(lzma.decompress(resources.files(room).joinpath(SHIPPED).read_bytes()))


@pytest.fixture(scope="module")
def array(shipped):
    def of(name):
        kept = shipped["arrays"][name]
        values = np.frombuffer(base64.b64decode(kept["data"]), np.dtype(kept["dtype"]))
        return values.reshape(kept["shape"])

    return of


def test_it_is_the_page_of_the_paper_s_beam(shipped, array):
    assert shipped["blade"] == ""
    assert shipped["length"] == Beam.reference().length
    assert array("omega").tolist() == list(OMEGAS)
    assert array("a").tolist() == list(AMPLITUDES)
    assert array("exact_ramp_time").tolist() == list(EXACT_RAMP_TIMES)
    page = explorer_page()
    assert json.loads(re.search(r"const DATA = (.*);", page)[1]) == shipped


def test_its_orbits_and_models_are_those_of_the_package(shipped, array, beam):
    w, chosen = OMEGAS.index(6.0), [9, 29, 49]
    orbits = periodic_orbits(beam, 6.0, array("a")[chosen])
    assert array("exact_frequency")[w, chosen] == pytest.approx(orbits.frequency, rel=1e-9)
    for model in ("FrE", "FrM", "CI"):
        known = array("lambda_omega")[shipped["models"].index(model), w]
        assert known == pytest.approx(reduced_model(beam, 6.0, model).lambda_omega, rel=1e-9)


def test_its_spin_up_is_that_of_the_package(shipped, array, beam):
    ramp = EXACT_RAMP_TIMES.index(3.0)
    found = exact_spin_up(beam, 6.0, 3.0, shipped["duration"])
    q, left = found
    assert shipped["step"] * array("spin_up")[2, ramp] == pytest.approx(q, abs=shipped["step"])
    assert array("exact_left")[2, ramp] == pytest.approx(left, abs=1e-4)


def test_its_finite_elements_are_those_of_figure_14(array):
    """The paper's 24 spin-ups, on the same mesh."""
    ratio = array("fe_frequency") / array("fe_omega_n")
    for i, (_, amplitude, known) in enumerate(golden_points("paper")):
        order = np.argsort(amplitude)
        mine = np.argsort(array("fe_amplitude")[i])
        assert array("fe_amplitude")[i][mine] == pytest.approx(amplitude[order], rel=1e-5)
        assert ratio[i][mine] == pytest.approx(known[order], rel=1e-6)
