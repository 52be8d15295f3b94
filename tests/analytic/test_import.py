"""`import analytic`, and the numeric reduced models, load nothing heavy."""

import subprocess
import sys

import pytest

HEAVY = {"sympy", "matplotlib", "xarray", "exudyn", "rotbeam_exu"}


def modules_after(code):
    script = f"import sys\n{code}\nprint(*sorted({{m.split('.')[0] for m in sys.modules}}))"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_import_is_cheap():
    assert not modules_after("import analytic") & (HEAVY | {"scipy"})


def test_numbers_need_neither_sympy_nor_matplotlib():
    code = """
from analytic import Beam, periodic_orbits, reduced_model
for variant in ("FrE", "FrM", "P3"):
    reduced_model(Beam.reference(), 4.0, variant).exact_frequency([0.1])
periodic_orbits(Beam.reference(), 6.0, [0.1], functions=8)
"""
    assert not modules_after(code) & HEAVY


def test_public_names_resolve():
    import analytic

    assert all(getattr(analytic, name) is not None for name in analytic.__all__)
    with pytest.raises(AttributeError, match="nothing"):
        _ = analytic.nothing
