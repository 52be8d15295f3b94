"""`rotbeam backbone`: nonlinear frequencies of the reduced models."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
from cyclopts import Parameter

from analytic import VARIANTS, Beam, periodic_orbits, reduced_model

from ..files.beam_file import load_beam
from .cost import require_affordable
from .options import Whole
from .output import Format, print_columns

_SECONDS_PER_ORBIT = 0.05


def backbone(
    *,
    omega: float,
    amplitude: Annotated[list[float], Parameter(consume_multiple=True)] = [0.05, 0.1, 0.15, 0.2],  # noqa: B006
    variant: str = "FrE",
    all_variants: Annotated[bool, Parameter(negative=())] = False,
    exact: Annotated[bool, Parameter(negative=())] = False,
    functions: Whole = 16,
    config: Path | None = None,
    form: Annotated[Format, Parameter(name="--format")] = "table",
) -> None:
    """Print the backbone of a reduced model: frequency against amplitude.

    Parameters
    ----------
    omega
        Rotation speed [rad/s].
    amplitude
        Amplitudes over the length, one or several.
    variant
        CI, CE, FrI, FrE, P3, P4, P5, FrC, FrM or FrM5.
    all_variants
        Every variant, one below the other.
    exact
        Add the exact backbone, by harmonic balance on the exact beam.
    functions
        Functions that resolve the exact beam along its length.
    config
        TOML file with the beam; without it, the paper's beam.
    form
        A table for the reader, or CSV with all digits.
    """
    beam = Beam.reference() if config is None else load_beam(config)
    if exact:
        require_affordable(
            f"{len(amplitude)} exact orbits with {functions} functions",
            memory=8.0 * (16.0 * functions) ** 2,
            seconds=_SECONDS_PER_ORBIT * len(amplitude) * (functions / 16.0) ** 2,
            remedy="take fewer",
        )
    names = list(VARIANTS) if all_variants else [variant]
    models = [reduced_model(beam, omega, name) for name in names]
    perturbed = np.concatenate([model.frequency(amplitude) for model in models])
    title = "\n".join(map(repr, models))
    columns: dict[str, list[str] | list[float]] = {
        "variant": [name for name in names for _ in amplitude],
        "amplitude a/L": amplitude * len(models),
        "Eq. 63 [rad/s]": perturbed.tolist(),
        "Eq. 41 exactly [rad/s]": np.concatenate(
            [model.exact_frequency(amplitude) for model in models]
        ).tolist(),
        "ω_NL/ω_n": (
            perturbed / np.repeat([model.omega_n for model in models], len(amplitude))
        ).tolist(),
    }
    if exact:
        truth = periodic_orbits(beam, omega, amplitude, functions=functions)
        columns["exact beam [rad/s]"] = truth.frequency.tolist() * len(models)
        title = f"{title}\n{truth}"
    print_columns(columns, form, title=title)
