"""Theory of the exact beam, from a file and from the command line."""

import numpy as np
import pytest

from analytic import Beam, Theory, linear_modes
from analytic.theory import BERNOULLI_EULER
from rotbeam_exu import load
from rotbeam_exu.runs.attributes import theory_attributes, theory_of

STUBBY = """[beam]
length = 1.0
axial_stiffness = 1e3
bending_stiffness = 1.0
mass_per_length = 1.0
[theory]
shear = 0.3
rotary_inertia = true
"""
BEAM = Beam.from_stiffness(
    length=1.0, axial_stiffness=1e3, bending_stiffness=1.0, mass_per_length=1.0
)


@pytest.mark.parametrize(
    ("option", "theory"),
    [
        ((), Theory(shear=0.3, rotary_inertia=True)),
        (("--theory", "rotary_inertia=false"), Theory(shear=0.3)),
        (
            ("--theory", 'trapeze="elastic"'),
            Theory(shear=0.3, rotary_inertia=True, trapeze="elastic"),
        ),
        (("--theory", "shear=false", "trapeze=false"), Theory(rotary_inertia=True, trapeze=False)),
    ],
)
def test_a_file_has_a_theory_and_options_replace_its_values(call, tmp_path, option, theory):
    """Shear and rotary inertia lower the third frequency by 5 and 2 %."""
    (tmp_path / "beam.toml").write_text(STUBBY)
    code, _, _ = call(
        "campbell", "--omega-min", "1", "--omega-max", "2", "--points", "2", "--orders", "1",
        *option, "--config", tmp_path / "beam.toml", "--out", tmp_path,
    )  # fmt: skip
    assert code == 0
    data = load(next(tmp_path.glob("*.nc")))
    known = linear_modes(BEAM, 2.0, theory=theory).frequencies
    np.testing.assert_allclose(data["frequency"][1], known, rtol=1e-8)
    assert theory_of(data.attrs) == theory


def test_attributes_hold_every_theory():
    for theory in (Theory(extension=False), Theory(shear=True), Theory(shear=1.0, engesser=True)):
        assert theory_of(theory_attributes(theory)) == theory
    assert theory_attributes(BERNOULLI_EULER) == {}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("trapez=true", "unknown key 'trapez' in --theory; did you mean 'trapeze'?"),
        ("trapeze=1", "trapeze must be True or False, got 1"),
        ("trapeze='none'", "trapeze must be True, False or \"elastic\", got 'none'"),
        (
            "trapeze=no",
            "takes key=value as in a file, as trapeze=false shear=0.3, got 'trapeze=no'",
        ),
        ("shear=-1", "shear must be positive, got -1.0"),
    ],
)
def test_a_wrong_theory_is_one_sentence(call, tmp_path, text, sentence):
    code, out, error = call("campbell", "--theory", text)
    assert (code, out, error.count("\n")) == (2, "", 1)
    assert sentence in error
    (tmp_path / "t.toml").write_text(f"[theory]\n{text}\n")
    code, _, error = call("campbell", "--config", tmp_path / "t.toml")
    assert (code, error.count("\n")) == (2, 1)
    assert "t.toml" in error


def test_a_theory_without_the_exact_beam_is_refused(call):
    code, _, error = call(
        "backbone", "--omega", "6", "--variant", "FrM", "--theory", "extension=false"
    )
    assert code == 2
    assert "Theory(extension=False) is a theory of the exact beam: add --exact" in error
