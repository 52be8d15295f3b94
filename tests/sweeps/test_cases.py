"""The cache and elements of one's own: another code, another case."""

import importlib
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest
import xarray as xr

from analytic.input_checks import RotbeamWarning
from rotbeam_exu import load, sweep
from rotbeam_exu.fem.elements import FORMULATIONS, Cable
from rotbeam_exu.runs.oscillation import steady_oscillation
from rotbeam_exu.sweeps.cases import maker

COARSE = {
    "omegas": [6.0], "ramp_times": [3.0], "elements": 2, "step": 1e-2, "duration": 8.0, "jobs": 1,
}  # fmt: skip

MINE = """
from dataclasses import dataclass, replace
from rotbeam_exu.fem.elements import Cable
from softness import SHARE

@dataclass(frozen=True, kw_only=True)
class Softer(Cable):
    name = "cable"

    def lay(self, mbs, beam, elements):
        return super().lay(mbs, replace(beam, youngs_modulus=SHARE * beam.youngs_modulus), elements)
"""


@pytest.fixture
def author(tmp_path, monkeypatch):
    """Write the modules of an author of elements, and import them anew."""
    folder = tmp_path / "author"
    folder.mkdir()
    monkeypatch.syspath_prepend(folder)

    def write(mine=MINE, softness="SHARE = 0.5"):
        (folder / "mine.py").write_text(mine)
        (folder / "softness.py").write_text(softness)
        for name in ("softness", "mine"):
            monkeypatch.delitem(sys.modules, name, raising=False)
        importlib.invalidate_caches()
        return importlib.import_module("mine").Softer()

    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    yield write
    for name in ("softness", "mine"):
        sys.modules.pop(name, None)


def test_an_element_with_the_name_of_ours_is_computed(beam, tmp_path, author):
    ours = sweep(beam, **COARSE, cache=tmp_path)
    mine = author()
    assert mine.name == "cable"
    theirs = sweep(beam, **COARSE, element=mine, cache=tmp_path)
    xr.testing.assert_identical(theirs, sweep(beam, **COARSE, element=mine))
    # Half the stiffness swings further.
    assert theirs["amplitude"].item() > 1.2 * ours["amplitude"].item()
    assert len(list(tmp_path.glob("*.nc"))) == 2


def test_the_command_line_takes_it_by_module_and_class(call, tmp_path, author):
    """One run and, in this process, the same alone in a grid."""
    author()
    quick = ("--elements", "2", "--step", "0.01", "--duration", "8", "--out", tmp_path)
    motion = ("--omega", "4", "--ramp-time", "2.5")
    mine = ("--element", "mine:Softer", *quick, *motion)
    assert call("run", *mine, "--no-figure", "--no-exact")[0] == 0
    assert call("sweep", *mine, "--jobs", "1", "--cache", tmp_path / "cache")[0] == 0
    run = steady_oscillation(load(tmp_path / "Softer-2-omega-4-ramp-2.5.nc"))
    swept = load(tmp_path / "sweep-Softer-2.nc")["amplitude"].item()
    assert swept == pytest.approx(run.amplitude, rel=1e-9)
    for wrong in ("mine:Harder", "yours:Softer", "mine:SHARE"):
        code, _, error = call("run", "--element", wrong, *quick)
        assert (code, f"no element can be made of {wrong}" in error) == (2, True)


def test_any_change_of_code_makes_another_case(author):
    first = maker(author())
    assert first == maker(author())
    changed = [
        maker(author(MINE.replace("SHARE *", "2.0 * SHARE *"))),
        maker(author(MINE + "\ntwice = 2.0\n")),
        maker(author(softness="SHARE = 0.25")),
        maker("cable"),
    ]
    assert len({made["code"] for made in [first, *changed]}) == 5


def test_an_element_in_a_package_is_all_of_the_package(tmp_path, monkeypatch):
    """What a package reads of itself while it runs stands in no import."""
    package = tmp_path / "stiffness"
    (package / "shares").mkdir(parents=True)
    read = (
        "from importlib import import_module\nSHARE = import_module('stiffness.shares.one').SHARE"
    )
    body = MINE.replace("from softness import SHARE", read).replace("Softer", "SofterStill")
    (package / "mine.py").write_text(body)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    codes = []
    for share in (0.5, 0.25):
        (package / "shares" / "one.py").write_text(f"SHARE = {share}")
        codes.append(maker(importlib.import_module("stiffness.mine").SofterStill())["code"])
        for name in [name for name in sys.modules if name.startswith("stiffness")]:
            monkeypatch.delitem(sys.modules, name)
        importlib.invalidate_caches()
    assert codes[0] != codes[1]


def test_ours_are_cached_and_looking_at_their_code_imports_nothing():
    before = set(sys.modules)
    for name in FORMULATIONS:
        assert maker(name) is not None
    assert set(sys.modules) == before
    assert maker("cable")["class"] == "rotbeam_exu.fem.elements.cable.Cable"


@pytest.mark.slow
def test_an_element_of_ones_own_goes_to_other_processes(beam, author):
    grid = {**COARSE, "ramp_times": [3.0, 2.0], "element": author()}
    xr.testing.assert_identical(sweep(beam, **{**grid, "jobs": 2}), sweep(beam, **grid))


def test_an_element_that_its_source_does_not_tell_is_not_cached(beam, tmp_path):
    def soft(share):
        @dataclass(frozen=True, kw_only=True)
        class Soft(Cable):
            def lay(self, mbs, beam, elements):
                modulus = share * beam.youngs_modulus
                return super().lay(mbs, replace(beam, youngs_modulus=modulus), elements)

        return Soft()

    amplitudes = []
    for share in (1.0, 0.5):
        with pytest.warns(RotbeamWarning, match="do not determine .*Soft, .* not kept"):
            found = sweep(beam, **COARSE, element=soft(share), cache=tmp_path)
        amplitudes.append(found["amplitude"].item())
    assert amplitudes[1] > 1.2 * amplitudes[0]
    assert not list(tmp_path.glob("*.nc"))


def test_neither_is_one_from_a_prompt():
    names = {"__name__": "prompt"}
    typed = MINE.replace("from softness import SHARE", "SHARE = 0.5").replace("Softer", "Typed")
    exec(typed, names)
    assert maker(names["Typed"]()) is None


@dataclass(frozen=True, kw_only=True)
class Tapered(Cable):
    """An element whose option no file can hold."""

    widths: object = None


@dataclass(kw_only=True)
class Changeable(Cable.__base__):
    """An element that is no value."""


@pytest.mark.parametrize("element", [Tapered(widths=np.ones(2)), Changeable(), Cable, 3])
def test_what_cannot_be_recorded_is_refused(beam, element):
    with pytest.raises(TypeError, match="element must be the name .* of a frozen dataclass"):
        sweep(beam, **COARSE, element=element)
