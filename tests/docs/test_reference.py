"""The reference has a page for each public name, with an example, and for no other."""

import ast
import inspect
import pkgutil
import re
from pathlib import Path

import pytest

import analytic
import rotbeam_exu

ROOT = Path(__file__).parents[2]
PLAIN = {
    "records that the example of what makes them shows": (
        "analytic.exact.free.curve.BackboneCurve analytic.spin_up.quiet.QuietRamps "
        "analytic.exact.linear.campbell.Crossing analytic.reduced.linear_frame.LinearResponse "
        "analytic.exact.free.internal_resonance.Resonance analytic.exact.free.branch.SpecialPoint "
        "analytic.exact.free.stability_limit.StabilityLimit "
        "analytic.exact.driven.response.SpinUpResponse analytic.exact.free.backbone.Backbone "
        "analytic.exact.free.branches.BackboneBranch "
        "analytic.exact.free.stability_limit.Tongue rotbeam_exu.fem.RotatingBeam "
        "analytic.reduced.model.ReducedModel rotbeam_exu.runs.oscillation.SteadyOscillation"
    ),
    "loads and shapes that are used as TipForce and Rectangle are": (
        "analytic.DistributedForce analytic.Ellipse analytic.SpeedRipple analytic.Tube"
    ),
    "errors, which their message explains": (
        "analytic.AmplitudeNotReachedError analytic.ResponseNotReachedError "
        "rotbeam_exu.SimulationError"
    ),
    "a type, a list of names, a protocol": (
        "analytic.VARIANTS rotbeam_exu.fem.elements.Formulation"
    ),
}
"""Names without an example, by the reason."""
PLAIN_NAMES = set(" ".join(PLAIN.values()).split())
BEYOND = {
    "analytic.exact.continuum.state", "analytic.exact.driven.forced_orbits",
    "analytic.exact.driven.response", "analytic.exact.free.backbone",
    "analytic.exact.free.branch", "analytic.exact.free.branches", "analytic.exact.free.curve",
    "analytic.exact.free.internal_resonance", "analytic.exact.free.leaving",
    "analytic.exact.free.orbits", "analytic.exact.linear.campbell",
    "analytic.exact.linear.modes", "analytic.exact.stability.growth",
    "analytic.exact.free.stability_limit", "analytic.exact.linear.space_modes",
    "analytic.reduced.linear_frame", "analytic.reduced.model", "analytic.reduced.model_range",
    "analytic.section", "analytic.spin_up.quiet",
    "rotbeam_exu.fem", "rotbeam_exu.fem.elements", "rotbeam_exu.fem.linearization",
    "rotbeam_exu.files.beam_file", "rotbeam_exu.files.vtk", "rotbeam_exu.runs.shape",
    "rotbeam_exu.runs.oscillation", "rotbeam_exu.sweeps.grid",
    "rotbeam_exu.verification.entries", "rotbeam_exu.verification.judgement",
    "rotbeam_exu.verification.submission_files", "rotbeam_exu.verification.verify",
}  # fmt: skip
"""Modules from which users import as well."""


@pytest.fixture(scope="module")
def groups():
    return pkgutil.resolve_name("docs._ext.reference_groups")


def test_every_public_name_has_one_page_and_no_other_has_one(groups):
    names = list(groups.public_names())
    assert len(names) == len(set(names))
    listed = {f"{p.__name__}.{name}" for p in (analytic, rotbeam_exu) for name in p.__all__}
    assert len(listed) <= 50, "what a call returns is public in its module, not at the top"
    assert listed <= set(names)
    for name in set(names) - listed:
        module, _, short = name.rpartition(".")
        assert module in BEYOND
        assert not short.startswith("_")
    assert not any("warn_if_rpm" in name for name in names)
    pages = [groups.page_of(name).casefold() for name in names]
    assert len(pages) == len(set(pages)), "on a disk that knows no case, too"


def test_every_name_has_an_example_or_a_reason(groups):
    without = set()
    for name in groups.public_names():
        value, short = pkgutil.resolve_name(name), name.rpartition(".")[2]
        shown = getattr(value, "__name__", short) == short  # its own page, not a former name's
        if not shown or "Examples\n--------\n>>> " not in (inspect.getdoc(value) or ""):
            without.add(name)
    assert without == PLAIN_NAMES


def test_what_can_draw_itself_does_so_in_its_example(groups):
    drawn = [n for n in groups.public_names() if hasattr(pkgutil.resolve_name(n), "plot")]
    assert len(drawn) >= 3
    for name in drawn:
        example = inspect.getdoc(pkgutil.resolve_name(name)).partition("Examples\n")[2]
        assert ".plot()" in example


def test_a_docstring_begins_with_its_noun_or_its_verb():
    first = re.compile(r"\s*(What|That|Of|Those)\b")
    for path in (p for room in ("analytic", "rotbeam_exu") for p in (ROOT / room).rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                for line in node.body:  # of a module's constants and a class's fields too
                    text = getattr(getattr(line, "value", None), "value", None)
                    if isinstance(line, ast.Expr) and isinstance(text, str):
                        assert not first.match(text), f"{path}:{line.lineno} {text}"
