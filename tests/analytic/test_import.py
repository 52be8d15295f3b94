"""`import analytic`, and the numeric reduced models, load nothing heavy."""

import subprocess
import sys

import pytest

HEAVY = {"sympy", "matplotlib", "xarray", "exudyn", "rotbeam_exu"}


def test_import_is_cheap_and_numbers_need_neither_sympy_nor_matplotlib():
    code = """
import sys
import analytic
print(*sorted({name.split(".")[0] for name in sys.modules}))
for variant in ("FrE", "FrM", "P3"):
    analytic.reduced_model(analytic.Beam.reference(), 4.0, variant).exact_frequency([0.1])
analytic.periodic_orbits(analytic.Beam.reference(), 6.0, [0.1], functions=8)
print(*sorted({name.split(".")[0] for name in sys.modules}))
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    imported, computed = (set(line.split()) for line in run.stdout.splitlines())
    assert not imported & (HEAVY | {"scipy"})
    assert not computed & HEAVY


def test_public_names_resolve():
    import analytic

    assert all(getattr(analytic, name) is not None for name in analytic.__all__)
    with pytest.raises(AttributeError, match="nothing"):
        _ = analytic.nothing
