"""The notebook of the class is the class's page, and what it shows is computed."""

import json
import sys

import matplotlib.pyplot as plt
import pytest

from docs.sentences import ROOT


@pytest.fixture(scope="module")
def room():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(ROOT / "tools")
        import notebook

        yield notebook
    sys.modules.pop("notebook", None)


@pytest.fixture(scope="module")
def kept(room):
    return json.loads(room.NOTEBOOK.read_text(encoding="utf-8"))["cells"]


def test_its_cells_are_those_of_the_page(room, kept):
    assert [(one["cell_type"], one["source"]) for one in kept] == room.cells()
    prose = "".join(one["source"] for one in kept if one["cell_type"] == "markdown")
    assert "{py:" not in prose
    assert "](" not in prose.replace("](https:", "")


def test_its_cells_show_what_they_compute(room, kept, monkeypatch):
    monkeypatch.setattr(plt, "show", lambda: None)
    for one, again in zip(kept, room.executed(), strict=True):
        seen, found = ([list(out["data"]) for out in of.get("outputs", [])] for of in (one, again))
        assert seen == found
        words, anew = (
            [out["data"].get("text/markdown") for out in of.get("outputs", [])]
            for of in (one, again)
        )
        assert words == anew
    assert sum("image/png" in out["data"] for one in kept for out in one.get("outputs", [])) == 2
