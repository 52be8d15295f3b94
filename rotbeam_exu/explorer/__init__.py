"""The Explorer: one self-contained page that shows every model, the exact beam and the mesh.

`explorer_data` computes, `explorer_page` writes: the files in page/ joined into one.
"""

from __future__ import annotations

import base64
import json
import lzma
from importlib import resources

import numpy as np
from numpy.typing import ArrayLike

from ..lazily import xr
from .data import AMPLITUDES, EXACT_RAMP_TIMES, OMEGAS, explorer_data

__all__ = ["AMPLITUDES", "EXACT_RAMP_TIMES", "OMEGAS", "explorer_data", "explorer_page"]

_SCRIPTS = (
    "data", "state", "drawing", "chart", "backbones", "orbit", "softening", "beam", "spin_up",
    "turning", "table", "table_file", "own", "export", "main",
)  # fmt: skip
"""Scripts of page/, in the order in which they run."""
SHIPPED = "reference.json.xz"
"""Data of the paper's beam, as `packed` gives them; written by tools/explorer.py."""
_STEP = 5e-5
"""Step to which positions are rounded, of the length: a hundredth of a pixel."""
_FINE = 2.0**-23
"""Step to which harmonics and amplitudes are rounded, that of single precision near one."""
_UNKNOWN = -32768
"""In their place where there are none."""


def explorer_page(data: xr.Dataset | None = None) -> str:
    """Return the Explorer as the text of an HTML page, which needs nothing else to be viewed.

    Parameters
    ----------
    data : Dataset, optional
        As made by `explorer_data`; by default those of the paper's beam, which come with the
        package.

    Examples
    --------
    >>> from pathlib import Path
    >>> _ = Path("explorer.html").write_text(explorer_page(), encoding="utf-8")  # doctest: +SKIP
    """
    document = _shipped() if data is None else packed(data)
    scripts = "\n".join(_part(f"{name}.js") for name in _SCRIPTS)
    page = _part("page.html").replace("/*STYLE*/", _part("style.css"))
    page = page.replace("/*THEME*/", _part("theme.js")).replace("/*SCRIPTS*/", scripts)
    # "<" escaped: no text in the data can end the script.
    return page.replace("/*DATA*/null", document.replace("<", "\\u003c"))


def _part(name: str) -> str:
    return resources.files(__name__).joinpath("page", name).read_text(encoding="utf-8")


def _shipped() -> str:
    return lzma.decompress(resources.files(__name__).joinpath(SHIPPED).read_bytes()).decode()


def packed(data: xr.Dataset) -> str:
    """Return the data as JSON that the page's scripts read: numbers, and arrays in base64."""
    whole = (
        "omega", "a", "omega_n", "lambda_omega", "kappa", "h2", "lambda_x", "exact_omega_n",
        "exact_lambda_omega", "exact_frequency", "fe_omega", "fe_amplitude", "fe_frequency",
        "fe_omega_n", "ramp_time", "exact_ramp_time", "ramp_curve",
    )  # fmt: skip
    half = ("first_harmonic", "harmonics", "exact_left", "closed_left")
    document = {
        "models": data["model"].to_numpy().tolist(),
        "notes": data["note"].to_numpy().tolist(),
        "frequencyScale": data.attrs["frequency_scale"],
        "length": data.attrs["length"],
        "elements": data.attrs["elements"],
        "blade": data.attrs["blade"],
        "duration": float(data["time"][-1]),
        "step": _STEP,
        "unknown": _UNKNOWN,
        "arrays": {
            **{name: _packed(data[name], "float64") for name in whole},
            **{name: _packed(np.rint(data[name] / _FINE) * _FINE, "float32") for name in half},
            **{name: _rounded(data[name]) for name in ("axis_x", "axis_y", "spin_up")},
        },
    }
    return json.dumps(document)


def _rounded(values: xr.DataArray) -> dict[str, object]:
    return _packed(np.rint((values / _STEP).fillna(_UNKNOWN)), "int16")


def _packed(values: ArrayLike, dtype: str) -> dict[str, object]:
    """Return an array as base64 of its little-endian bytes, which a browser reads at once."""
    array = np.asarray(values).astype(np.dtype(dtype).newbyteorder("<"))
    return {
        "dtype": dtype,
        "shape": array.shape,
        "data": base64.b64encode(array.tobytes()).decode(),
    }
