"""Options of a formulation on the command line."""

import json

import pytest

from rotbeam_exu import load

SHORT = ("run", "--omega", "2", "--ramp-time", "3", "--elements", "2", "--duration", "8",
         "--step", "0.01", "--no-figure")  # fmt: skip


def test_options_reach_the_element_and_the_file(call, tmp_path):
    options = ("--option", "nodes=3", "--option", "poisson_ratio=0.25")
    out = call(*SHORT, "--element", "exact", *options, "--out", tmp_path)[1]
    assert "exact, nodes=3, poisson_ratio=0.25" in out
    run = load(next(tmp_path.glob("*.nc")))
    assert run.attrs["element"] == "exact"
    made = {"kind": "Exact", "nodes": 3, "poisson_ratio": 0.25}
    assert made.items() <= json.loads(run.attrs["element_options"]).items()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--option", "nodes=3"), "element 'cable' has no option 'nodes'; it has no options"),
        (("--element", "exact", "--option", "nodes"), "given as name=value, got 'nodes'"),
        (("--element", "exact", "--option", "nodes=5"), "nodes must be 2 or 3, got 5"),
        (("--element", "substructures", "--option", "frame=chord"), "unknown frame 'chord'"),
        (("--element", "ancf3", "--option", "poisson_ratio=much"), "poisson_ratio must be a numb"),
    ],
)
def test_refuses(call, tmp_path, arguments, sentence):
    code, _, error = call(*SHORT, *arguments, "--out", tmp_path)
    assert code == 2
    assert sentence in error
    assert len(error.strip().splitlines()) == 1
