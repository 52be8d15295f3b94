"""Examples in docstrings run and print what they say."""

import doctest
import importlib
import pkgutil

import pytest

import analytic
import rotbeam_exu

MODULES = sorted(
    module.name
    for package in (analytic, rotbeam_exu)
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + ".")
    if not module.name.endswith("__main__")
)


# Half a second and more, of eight a limit of stability; tests of their own ask the same for less.
SLOW = {
    "analytic.exact.driven.forced", "analytic.exact.driven.forced_orbits",
    "analytic.exact.free.backbone", "analytic.exact.free.leaving", "analytic.exact.linear.campbell",
    "analytic.exact.stability.growth", "analytic.exact.free.stability_limit",
    "analytic.reduced.symbolic", "analytic.reduced.tables", "analytic.spin_up.design",
    "analytic.spin_up.quiet", "rotbeam_exu.sweeps.grid", "rotbeam_exu.verification.verify",
}  # fmt: skip


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] if n in SLOW else []) for n in MODULES]
)
def test_examples(name):
    result = doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
    assert result.failed == 0
