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


@pytest.mark.parametrize("variant", ["FrE", "FrM", "P3"])
def test_numeric_models_need_no_sympy(variant):
    code = (
        "from analytic import Beam, reduced_model\n"
        f"reduced_model(Beam.reference(), 4.0, '{variant}').exact_frequency([0.1])"
    )
    assert not modules_after(code) & HEAVY


def test_public_names_resolve():
    import analytic

    assert all(getattr(analytic, name) is not None for name in analytic.__all__)
    with pytest.raises(AttributeError, match="nothing"):
        _ = analytic.nothing
