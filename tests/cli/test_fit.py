"""`rotbeam fit`: from a file of frequencies to numbers, and to a blade."""

import numpy as np
import pytest

from analytic import Beam, linear_modes
from analytic.sensitivity import parameters_of
from analytic.theory import BERNOULLI_EULER
from rotbeam_exu import load
from rotbeam_exu.files.beam_file import load_beam


def test_it_prints_numbers_and_writes_the_blade(call, tmp_path):
    stiff = parameters_of(Beam.reference(), BERNOULLI_EULER)["EI3"].changed(1.1)
    values = linear_modes(stiff, 0.0, 2).frequencies
    rows = [f"{k + 1},{value / (2.0 * np.pi)!r},1" for k, value in enumerate(values.tolist())]
    (tmp_path / "f.csv").write_text("\n".join(["mode,frequency [Hz],deviation [%]", *rows]))
    command = ("fit", tmp_path / "f.csv", "--free", "EI3", "m", "--prior", "m=0.001")
    code, out, error = call(*command, "-o", tmp_path / "out")
    assert code == 0, error
    assert "their ratio alone" in " ".join(out.split())
    (kept,) = map(load, (tmp_path / "out").glob("*.nc"))
    np.testing.assert_allclose(kept["values"], [1.1, 1.0], rtol=1e-3)
    again = linear_modes(load_beam(tmp_path / "out" / "fit.toml"), 0.0, 2).frequencies
    np.testing.assert_allclose(again, values, rtol=1e-5)
    code, _, error = call(*command, "-o", tmp_path / "out")
    assert (code, "fit.toml is there" in error) == (2, True)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--free", "EI3"), "MEASURED is missing"), (("f.csv",), "--free is missing"),
        (("f.csv", "--free", "EI9"), "the blade has no parameter 'EI9'"),
        (("f.csv", "--free", "EI3", "--prior", "EI3"), "--prior takes name=deviation"),
        (("none.csv", "--free", "EI3"), "there is no file none.csv"),
    ],
)  # fmt: skip
def test_bad_input(call, tmp_path, monkeypatch, arguments, sentence):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "f.csv").write_text("mode,frequency [Hz]\nlag 1,0.5\n")
    code, _, error = call("fit", *arguments)
    assert code == 2
    assert sentence in error
