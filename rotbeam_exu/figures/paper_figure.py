"""Captions of the paper's figures: their content, the beam, and the paper's claim on them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple, TypeVar

import xarray as xr

from analytic import Beam

from ..paper import MODEL_NAMES, MODELS, RAMP_TIMES, SPEEDS
from ..runs.attributes import beam_of
from .style import quantity, typeset

T = TypeVar("T")

EXACT_BEAM = "the geometrically exact beam, by harmonic balance"
EXACT = f"black: {EXACT_BEAM}"


class PaperFigure(NamedTuple):
    """Words on a figure of the paper: of its data what is drawn; the paper's claim, our answer."""

    shows: Callable[[xr.Dataset], str]
    claim: str


PAPER_FIGURES: dict[int, PaperFigure] = {}
"""The figures of the paper by number: all but Figures 1, 2, 6 and 7, which are drawings."""


def paper_figure(
    *, shows: Callable[[xr.Dataset], str], claim: str
) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Decorate the drawing `figure_N` of the data of that name: Figure N."""

    def registered(draw: Callable[..., T]) -> Callable[..., T]:
        number = int(draw.__name__.removeprefix("figure_"))
        PAPER_FIGURES[number] = PaperFigure(shows, claim)
        return draw

    return registered


def caption(number: int, data: xr.Dataset) -> str:
    """Return a figure's caption: the content, the beam, the paper's claim, and our answer.

    Claim and answer are about the paper's beam and speeds, and are left out of other data.

    Parameters
    ----------
    number : int
        3, 4, 5, or 8 to 15.
    data : Dataset
        The data, as made by the function `figure_...` of `rotbeam_exu.comparison`.
    """
    figure = PAPER_FIGURES[number]
    claim = figure.claim if _of_paper(data) else ""
    words = " ".join([figure.shows(data), _beam(data), claim])
    return typeset(" ".join(words.split()))


def _of_paper(data: xr.Dataset) -> bool:
    """Return whether data are of the paper's beam, and of all its spin-ups if it has a grid."""
    if beam_of(data.attrs) != Beam.reference():
        return False
    grid = {"omega": SPEEDS, "ramp_time": RAMP_TIMES} if "ramp_time" in data.dims else {}
    return all(set(values) <= set(data[name].values.tolist()) for name, values in grid.items())


def _beam(data: xr.Dataset) -> str:
    blade = beam_of(data.attrs)
    return (
        f"Beam: L = {quantity(blade.length, 'm')}, EI = {blade.bending_stiffness:.5g} N m², "
        f"EA = {quantity(blade.axial_stiffness, 'N', 4)}, "
        f"ρA = {blade.mass_per_length:.5g} kg/m, "
        f"μ = {blade.slenderness:.4g}."
    )


def numerics(data: xr.Dataset) -> str:
    """Return how the runs behind a figure were computed."""
    attrs = data.attrs
    if "meshes" in attrs:
        return f"Exudyn: {attrs['meshes']}."
    elements = f"{attrs['elements']} " if "elements" in attrs else ""
    return (
        f"Exudyn: {elements}{attrs['element']} elements, step {1e3 * attrs['step']:g} ms, "
        f"{attrs['frame']} frame."
    )


def models(data: xr.Dataset) -> str:
    """Return the reduced models, spelled out."""
    names = [name for name in data["model"].values.tolist() if name in MODELS]
    return ", ".join(f"{name} ({MODEL_NAMES[name]})" for name in names)


def spin_ups(data: xr.Dataset) -> str:
    """Return the grid of spin-ups."""
    return f"spin-ups to ω = {listed(data['omega'])} rad/s in T = {listed(data['ramp_time'])} s"


def listed(values: Iterable[float]) -> str:
    """Return numbers in a sentence."""
    *most, last = [f"{float(value):g}" for value in values]
    return f"{', '.join(most)} and {last}" if most else last
