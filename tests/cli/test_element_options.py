"""Options of a formulation on the command line."""

import json

import pytest

from rotbeam_exu import load
from rotbeam_exu.cli import main

SHORT = ("run", "--omega", "2", "--ramp-time", "1", "--elements", "2", "--duration", "8",
         "--step", "0.01", "--no-figure")  # fmt: skip


def test_options_reach_the_element_and_the_file(tmp_path, capsys):
    options = ("--option", "law=coupled", "--option", "poisson_ratio=0.25")
    main([*SHORT, "--element", "ancf3", *options, "--out", str(tmp_path)])
    assert "ancf3, law=coupled, poisson_ratio=0.25" in capsys.readouterr().out
    run = load(next(tmp_path.glob("*.nc")))
    assert run.attrs["element"] == "ancf3"
    assert json.loads(run.attrs["element_options"]) == {
        "kind": "Ancf3", "law": "coupled", "poisson_ratio": 0.25, "shear_correction": 1.0,
    }  # fmt: skip


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
def test_refuses(tmp_path, capsys, arguments, sentence):
    with pytest.raises(SystemExit) as stop:
        main([*SHORT, *arguments, "--out", str(tmp_path)])
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert len(error.strip().splitlines()) == 1
