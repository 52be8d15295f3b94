"""Other codes, compared: two tables and a figure, from the folders beside this script.

``python models/codes/overview.py`` prints the tables and writes results/codes.svg.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path

import numpy as np
from common import HERE
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.convergence import Convergence, Order
from rotbeam_exu.verification.judgement import Judgement, judged
from rotbeam_exu.verification.outcomes import worst_of
from rotbeam_exu.verification.submission import Submission
from rotbeam_exu.verification.submission_files import read_submission

CASE, ERRORS = "S1", (1e-2, 1e-3)
"""Case whose cost is compared, and the errors of q(t), over max|q|, at which it is."""


@dataclass(frozen=True)
class Code:
    """A folder, judged today; `unit` is the CPU time of the kit's starter there [s]."""

    handed: Submission
    found: Judgement
    unit: float

    @property
    def name(self) -> str:
        """The name that the code declares."""
        return self.found.declaration.code

    def verdict(self, case: str) -> str:
        """Return the worst outcome of a case; nothing of one that was not submitted."""
        findings = list(self.found.findings.get(case, {}).values())
        if not findings:
            return ""
        said = worst_of(findings).said.replace(" to the reference", "")
        speeds = sorted({one.speed for one in self.handed.rows})
        whole = case != "L" or len(speeds) == len(CASES["L"].speeds)
        return said if whole else f"{said} (only at {', '.join(map('{:g}'.format, speeds))} rad/s)"

    @property
    def is_timed(self) -> bool:
        """Whether it has runs of CASE, with their CPU times."""
        runs = self.found.histories[CASE].runs if CASE in self.found.histories else ()
        return bool(runs) and all(run.cpu > 0.0 for run in runs)

    @property
    def runs(self) -> list[tuple[float, float]]:
        """CPU time over the unit and error of each run of CASE, cheap to dear."""
        of = self.found.histories[CASE].differences
        return sorted((run.cpu / self.unit, float(np.abs(d).max())) for run, d in of.items())

    @property
    def front(self) -> list[tuple[float, float]]:
        """The runs that are better than all cheaper ones."""
        runs = self.runs
        return [one for k, one in enumerate(runs) if all(one[1] < cheap[1] for cheap in runs[:k])]

    def cost(self, error: float) -> str:
        """Return the CPU time over the unit at an error, interpolated along the front."""
        times, errors = np.log(self.front).T
        if math.log(error) >= errors[0]:
            return f"< {_two(math.exp(times[0]))}"
        if math.log(error) < errors[-1]:
            return f"> {_two(math.exp(times[-1]))}"
        return _two(math.exp(np.interp(-math.log(error), -errors, times)))


def codes() -> list[Code]:
    """Judge all folders."""
    made = []
    for record in sorted(HERE.glob("*/record.toml")):
        unit = float(tomllib.loads(record.read_text())["calibration_s"])
        handed = read_submission(record.parent / "submission")
        made.append(Code(handed, judged(handed), unit))
    return sorted(made, key=lambda one: one.name.lower())


def verdicts(of: Iterable[Code]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the table of codes and cases."""
    of = list(of)
    cases = [case for case in CASES if any(case in one.found.findings for one in of)]
    rows = []
    for one in of:
        told = one.found.declaration
        rows.append([f"{one.name} {told.version}", told.element, *map(one.verdict, cases)])
    return ["code", "element", *cases], rows


def costs(of: Iterable[Code]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the table of errors, orders and cost in CASE, of timed codes."""
    rows = []
    for one in (one for one in of if one.is_timed):
        finding = one.found.findings[CASE]["history"]
        fit, finest = finding.runs, one.found.histories[CASE].finest
        cells = [
            one.name,
            f"{finest.elements}, {finest.step_in_words}",
            f"{abs(finding.difference):.0e}",
        ]
        cells += [_two(finest.cpu / one.unit), *map(one.cost, ERRORS)]
        cells += [_order(fit.orders.get(part)) for part in ("mesh", "step")] if fit else ["", ""]
        rows.append([*cells, _needed(fit, ERRORS[-1]) if fit else ""])
    at = [f"at {error:g}" for error in ERRORS]
    header = ["code", "finest run", "its error", "CPU", *at, "order, mesh", "order, step"]
    return [*header, f"a run within {ERRORS[-1]:g}"], rows


def figure(of: Iterable[Code]) -> Axes:
    """Draw errors of CASE over CPU time, of timed codes."""
    _, ax = plt.subplots(figsize=(5.0, 3.4), layout="constrained")
    ax.set_prop_cycle(color=plt.colormaps["tab10"].colors)  # as many as there are codes
    for one, mark in zip((one for one in of if one.is_timed), cycle("os^vD<>PX*ph")):
        (line,) = ax.loglog(*zip(*one.front, strict=True), "-", lw=0.9)
        ax.loglog(*zip(*one.runs, strict=True), mark, ms=5, color=line.get_color(), label=one.name)
    ax.set(xlabel="CPU time over that of the starter", ylabel="error of q(t) over max|q|")
    ax.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return ax


def _needed(fit: Convergence, error: float) -> str:
    """Return the mesh and the step that would leave half of an error each."""
    mesh, step = abs(float(fit.in_mesh[-1])), abs(float(fit.in_step[-1]))
    elements = fit.elements[-1] * (2.0 * mesh / error) ** (1.0 / fit.powers[0])
    smaller = fit.steps[-1] * (0.5 * error / step) ** (1.0 / fit.powers[1]) if step else math.inf
    largest = fit.steps.max()
    of_step = (
        f"{_two(1e3 * smaller)} ms" if smaller < largest else f"any step to {1e3 * largest:g} ms"
    )
    return f"{math.ceil(elements)} elements, {of_step}"


def _order(order: Order | None) -> str:
    known = order is not None and math.isfinite(order.value)
    return f"{order.value:.1f} ± {order.bar:.1f}" if order is not None and known else "not measured"


def _two(value: float) -> str:
    """Return two digits."""
    return f"{float(f'{value:.1e}'):g}"


def _printed(header: list[str], rows: list[list[str]]) -> None:
    for line in (header, ["---"] * len(header), *rows):
        print(f"| {' | '.join(line)} |")


if __name__ == "__main__":
    judged_codes = codes()
    _printed(*verdicts(judged_codes))
    print()
    _printed(*costs(judged_codes))
    Path("results").mkdir(exist_ok=True)
    figure(judged_codes).get_figure().savefig("results/codes.svg")
