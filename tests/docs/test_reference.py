"""The reference has a page for each public name, with an example, and for no other."""

import ast
import inspect
import pkgutil
import re
from pathlib import Path

import pytest

import analytic
import rotbeam_exu
from analytic.description import Described

ROOT = Path(__file__).parents[2]
TOP = {f"{p.__name__}.{name}" for p in (analytic, rotbeam_exu) for name in p.__all__}


@pytest.fixture(scope="module")
def groups():
    return pkgutil.resolve_name("docs._ext.reference_groups")


def test_every_public_name_has_one_page_and_no_other_has_one(groups):
    names = list(groups.public_names())
    assert len(names) == len(set(names))
    assert len(TOP) <= 50, "what a call returns is public in its module, not at the top"
    assert set(names) >= TOP
    for name in names:
        assert pkgutil.resolve_name(name) is not None
        assert "._" not in name, "of a module from which users import as well"
    assert not any("warn_if_rpm" in name for name in names)
    pages = [groups.page_of(name).casefold() for name in names]
    assert len(pages) == len(set(pages)), "on a disk that knows no case, too"


def has_example(name):
    value, short = pkgutil.resolve_name(name), name.rpartition(".")[2]
    shown = getattr(value, "__name__", short) == short  # its own page, not a former name's
    return shown and "Examples\n--------\n>>> " in (inspect.getdoc(value) or "")


def test_every_verb_and_every_kind_of_argument_has_an_example(groups):
    """Errors explain themselves, and a verb's example shows its result; one of a family will do."""
    shown = {n for n in set(groups.public_names()) - set(groups.DATA) if has_example(n)}
    of_none = {object, Described}
    families = {base for n in shown for base in getattr(pkgutil.resolve_name(n), "__mro__", ())}
    for name in set(groups.public_names()) - set(groups.DATA) - shown:
        value = pkgutil.resolve_name(name)
        assert isinstance(value, type), f"{name} has no example"
        needless = issubclass(value, Exception) or name not in TOP
        assert needless or families & set(value.__mro__) - of_none, f"{name} has no example"


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
