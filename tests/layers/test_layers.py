"""Who may import whom: what keeps the theory free of Exudyn, and each part free of those above."""

import ast
import graphlib
import re
from functools import cache
from pathlib import Path

import pytest

from docs._ext.derivation import imports_of, in_order, modules

ROOT = Path(__file__).parents[2]

# From the ground up: a part imports from parts below it only, and from itself.
LAYERS = {
    "analytic": [
        {"arrays", "description", "lazily", "letters", "threads", "warning"},
        {"input_checks", "quadrature", "methods", "plotting"},
        {"motion", "settled", "theory"},
        {"load"}, {"span_loads"},
        {"parts", "section", "loads", "ramps"},
        {"unit_blade"},
        {"shape_functions", "section_shape", "station_section"},
        {"blade_data"},
        {"blade", "meshed_section", "section_shapes"},
        {"beam", "blade_checks"},
        {"reduced", "exact"},  # neither knows the other
        {"spin_up", "sensitivity"},
    ],
    "rotbeam_exu": [
        {"lazily"}, {"labels", "paper"}, {"runs"}, {"files"}, {"result_columns"}, {"datasets"},
        {"fem"}, {"sweeps", "verification"}, {"comparison"}, {"figures", "explorer"}, {"report"},
        {"cli"},
    ],
}  # fmt: skip
ALLOWED = {
    "exudyn": ("rotbeam_exu/fem/",),
    # A result draws itself, on axes that only analytic.plotting makes, when it is asked to.
    "matplotlib": ("rotbeam_exu/figures/", "analytic/plotting.py"),
}


KNOWN = modules(*LAYERS)


@cache
def arrows():
    return [(name, target) for name in KNOWN for target in imports_of(name, KNOWN)]


def forbidden(name, target):
    """Why a module may not import another, or nothing."""
    library = target.partition(".")[0]
    path = KNOWN[name].relative_to(ROOT).as_posix()
    if library in ALLOWED and not path.startswith(ALLOWED[library]):
        return f"{path} imports {library}, which only {' and '.join(ALLOWED[library])} may"
    package = name.partition(".")[0]
    if package == "analytic" and library in ("rotbeam_exu", "xarray"):
        return f"{path} is theory and imports {library}"
    if library != package or target == package:
        return ""
    layers = [(layer, part) for layer, parts in enumerate(LAYERS[package]) for part in parts]
    place = {part: layer for layer, part in layers}
    above, below = (text.split(".")[1] if "." in text else "" for text in (name, target))
    if above and above != below and place[below] >= place[above]:
        return f"{path} imports {target}, from a part that is not below its own"
    return ""


# Inside `exact` too; a study that a result is asked for is imported then, inside the function.
PACKAGES_OF_EXACT = ("continuum", "linear", "stability", "free", "driven")


def test_the_parts_of_the_exact_beam_stand_on_each_other():
    folder = ROOT / "analytic" / "exact"
    assert {path.name for path in folder.iterdir() if path.is_dir()} - {"__pycache__"} == set(
        PACKAGES_OF_EXACT
    )
    for path in folder.glob("*/*.py"):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ImportFrom) and node.level == 2 and node.module:
                below = node.module.partition(".")[0]
                places = [PACKAGES_OF_EXACT.index(part) for part in (path.parent.name, below)]
                assert places[1] < places[0], f"{path.name} imports {node.module}"


def test_every_room_has_a_layer_no_arrow_points_up_and_each_library_has_its_room():
    for package, layers in LAYERS.items():
        parts = {name.split(".")[1] for name in KNOWN if name.startswith(f"{package}.")}
        assert parts == set().union(*layers)
    assert [why for arrow in arrows() if (why := forbidden(*arrow))] == []


@pytest.mark.parametrize(
    ("name", "target"),
    [
        ("analytic.beam", "exudyn"),
        ("analytic.methods.harmonic_balance", "analytic.exact.continuum.planar"),
        ("analytic.reduced.model", "analytic.exact.linear.modes"),
        ("analytic.exact.linear.modes", "rotbeam_exu.runs.check"),
        ("rotbeam_exu.verification.verify", "exudyn"),
        ("rotbeam_exu.fem.simulation", "rotbeam_exu.sweeps.grid"),
        ("rotbeam_exu.runs.oscillation", "rotbeam_exu.fem.case"),
        ("rotbeam_exu.cli.run", "matplotlib.pyplot"),
    ],
)
def test_an_import_the_wrong_way_is_found(name, target):
    assert forbidden(name, target)


def test_no_other_room_takes_exudyn_from_where_it_is_imported_lazily():
    taking = re.compile(r"^from \.+lazily import .*\b(exudyn|items)\b", re.MULTILINE)
    parts = {name.split(".")[1] for name in KNOWN if taking.search(KNOWN[name].read_text("utf-8"))}
    assert parts == {"fem"}


def test_a_command_writes_its_results_by_a_job():
    """What is refused, kept by Ctrl-C and listed is then the same in every command."""
    commands = (ROOT / "rotbeam_exu" / "cli").glob("*.py")
    writing = re.compile(r"from \.\.files\.results import .*\bsave", re.MULTILINE)
    assert {path.stem for path in commands if writing.search(path.read_text("utf-8"))} == {"job"}


def test_there_is_no_circle():
    graph = {name: set() for name in KNOWN}
    for name, target in arrows():
        # A package that only lists what it holds is no part of a circle with it.
        if target in KNOWN and target != name and not name.startswith(f"{target}."):
            graph[name].add(target)
    graphlib.TopologicalSorter(graph).prepare()


def test_the_reference_lists_what_is_built_on_first():
    theory = in_order("analytic")
    assert sorted(theory) == sorted(name for name in KNOWN if name.split(".")[0] == "analytic")
    for first, then in (
        ("analytic.beam", "analytic.reduced.shapes"),
        ("analytic.reduced.shapes", "analytic.reduced.lagrangian"),
        ("analytic.reduced.lagrangian", "analytic.reduced.model"),
        ("analytic.reduced.model_range", "analytic.reduced.tables"),
        ("analytic.methods.system", "analytic.exact.continuum.planar"),
        ("analytic.exact.continuum.planar", "analytic.exact.free.backbone"),
    ):
        assert theory.index(first) < theory.index(then)


def test_what_is_judged_needs_no_fem():
    inside = [
        (name, target)
        for name, target in arrows()
        if name == "rotbeam_exu.verification.verify" and target.startswith("rotbeam_exu.fem")
    ]
    assert inside == []
