"""Other codes, compared: three tables and a figure, from the folders beside this script.

``python models/codes/overview.py`` prints the tables and writes results/codes.png.
"""

from __future__ import annotations

import math
import tomllib
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from common import HERE
from matplotlib.axes import Axes

from rotbeam_exu.figures.style import columns, house_axes, save_figure
from rotbeam_exu.paper import BLUE, RED
from rotbeam_exu.verification.case import Level
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.convergence import Convergence, Order
from rotbeam_exu.verification.judgement import Judgement, judged
from rotbeam_exu.verification.outcomes import Outcome, worst_of
from rotbeam_exu.verification.submission import Submission
from rotbeam_exu.verification.submission_files import read_submission

CASE, ERRORS = "S1", (1e-2, 1e-3)
"""Case whose cost is compared, and the errors of q(t), over max|q|, at which it is.

A cost is that of the mesh and the step that the fit to all runs asks for. No run has a cost by
itself: its errors of mesh and step may cancel.
"""


_SHARES = np.linspace(0.01, 0.99, 99)  # of the mesh in an error


@dataclass(frozen=True)
class Code:
    """A folder, judged today; `unit` is the CPU time of the kit's starter there [s].

    Settings are the words of its README.
    """

    handed: Submission
    found: Judgement
    unit: float
    settings: str = ""

    @property
    def name(self) -> str:
        """The name that the code declares."""
        return self.found.declaration.code

    def verdict(self, case: str) -> tuple[Outcome, str]:
        """Return the worst outcome of a case that was submitted, and the rest of the sentence."""
        worst = worst_of(list(self.found.findings[case].values()))
        speeds = sorted({one.speed for one in self.handed.rows if one.case == case})
        more = worst.said.removeprefix(worst.outcome)
        if len(speeds) not in (0, len(CASES[case].speeds)):
            more += f" (only at {', '.join(map('{:g}'.format, speeds))} rad/s)"
        return worst.outcome, more

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
    def fit(self) -> Convergence | None:
        """Errors of mesh and step in CASE; None if the runs leave them open by all of q."""
        fit = self.found.findings[CASE]["history"].runs
        return fit if fit is not None and fit.bar < 1.0 else None

    def needed(self, error: float) -> tuple[float, float]:
        """Return the mesh and the step [s] of least work whose errors add up to one, by the fit.

        The mesh is not coarser than any that was run. The step is at most the largest one that was
        run on a mesh as fine, or on the finest: others may not be stable.
        """
        fit = self.fit
        assert fit is not None
        n, h = fit.elements, fit.steps
        mesh, step = abs(float(fit.in_mesh[-1])), max(abs(float(fit.in_step[-1])), 1e-30)
        elements = n[-1] * (mesh / (error * _SHARES)) ** (1.0 / fit.powers[0])
        elements = np.maximum(elements, n.min())
        steps = h[-1] * (error * (1.0 - _SHARES) / step) ** (1.0 / fit.powers[1])
        steps = np.minimum(steps, [h[n >= min(one, n.max())].max() for one in elements])
        least = np.argmin(elements / steps)
        return float(elements[least]), float(steps[least])

    @property
    def law(self) -> tuple[float, float, float]:
        """Power p and factor c of CPU time over the unit, c (elements/step)ᵖ; its worst misfit."""
        runs = self.found.histories[CASE].runs
        work = np.log([run.elements / run.refinement for run in runs])
        times = np.log([run.cpu / self.unit for run in runs])
        power, constant = np.polyfit(work, times, 1)
        misfit = np.abs(times - power * work - constant).max()
        return float(power), math.exp(constant), math.exp(misfit)

    def cost(self, error: float) -> float:
        """Return the CPU time over the unit of the mesh and the step that are needed."""
        power, factor, _ = self.law
        elements, step = self.needed(error)
        return factor * (elements / step) ** power

    def is_outside(self, error: float) -> bool:
        """Return whether what is needed is more work than any run had, or less."""
        elements, step = self.needed(error)
        work = [run.elements / run.refinement for run in self.found.histories[CASE].runs]
        return not min(work) <= elements / step <= max(work)


def codes() -> list[Code]:
    """Judge all folders."""
    made = []
    for record in sorted(HERE.glob("*/record.toml")):
        unit = float(tomllib.loads(record.read_text())["calibration_s"])
        handed = read_submission(record.parent / "submission")
        _, *words = (record.parent / "README.md").read_text(encoding="utf-8").splitlines()
        settings = " ".join(line for line in words if line and "authors of the bench" not in line)
        made.append(Code(handed, judged(handed), unit, settings))
    return sorted(made, key=lambda one: one.name.lower())


def verdicts(of: Iterable[Code], *, real: bool = False) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the table of codes and cases, of real blades or all others.

    A column has the cases of one outcome, with what else there is to say of them.
    """
    cases = [name for name, case in CASES.items() if (case.level is Level.REAL) == real]
    rows = []
    for one in of:
        alike = defaultdict(list)
        for case in filter(one.found.findings.get, cases):
            outcome, more = one.verdict(case)
            alike[outcome].append(f"{case}{more}")
        if alike:
            declared = one.found.declaration
            cells = [", ".join(alike[outcome]) for outcome in Outcome]
            rows.append([one.name, declared.version, declared.element, *cells])
    header = ["code", "version", "element", *Outcome]
    some = [k for k, name in enumerate(header) if any(row[k] for row in rows) or k < 3]
    return [header[k] for k in some], [[row[k] for k in some] for row in rows]


def costs(of: Iterable[Code]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the table of errors, orders and cost in CASE, of timed codes."""
    rows = []
    for one in (one for one in of if one.is_timed):
        fit, finest = one.fit, one.found.histories[CASE].finest
        power, _, misfit = one.law
        cells = [
            one.name,
            f"{finest.elements}, {finest.step_in_words}",
            f"{float(np.abs(one.found.histories[CASE].differences[finest]).max()):.0e}",
            _two(finest.cpu / one.unit),
            *(_order(fit.orders.get(part) if fit else None) for part in ("mesh", "step")),
            f"{power:.1f} (× {misfit:.1f})",
        ]
        if fit:
            elements, step = one.needed(ERRORS[-1])
            cells.append(f"{math.ceil(elements)}, {_two(1e3 * step)} ms")
            cells += [
                _two(one.cost(error)) + " †" * int(one.is_outside(error)) for error in ERRORS[::-1]
            ]
        rows.append(cells + [""] * (10 - len(cells)))
    header = ["code", "finest run", "its error", "its CPU", "order, mesh", "order, step"]
    header += ["power of CPU", f"needed for {ERRORS[-1]:g}"]
    return [*header, *(f"CPU at {error:g}" for error in ERRORS[::-1])], rows


def conditions(of: Iterable[Code]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the table of machines and settings, of timed codes."""
    header = ["code", "processor", "starter [s]", "elements and settings"]
    return header, [
        [one.name, one.found.declaration.machine, f"{one.unit:.2f}", one.settings]
        for one in of
        if one.is_timed
    ]


def figure(of: Iterable[Code]) -> Axes:
    """Draw errors of CASE over CPU time, a panel for each timed code; return the first."""
    timed = [one for one in of if one.is_timed]
    rows = math.ceil(len(timed) / 3)
    with house_axes(
        None, columns(), 0.3 + 1.4 * rows, nrows=rows, ncols=3, sharex=True, sharey=True
    ) as grid:
        for one, ax in zip(timed, grid.flat, strict=False):
            _draw(one, ax)
        for ax in grid.flat[len(timed) :]:
            ax.set_visible(False)
        for ax in grid.flat[max(len(timed) - 3, 0) : len(timed)]:  # the last of each column
            ax.tick_params(labelbottom=True)
            ax.set_xlabel("CPU time over that of the starter")
        grid[rows // 2, 0].set_ylabel("error of q(t) over max|q|")
    first: Axes = grid[0, 0]
    return first


def _draw(one: Code, ax: Axes) -> None:
    ax.set_title(one.name, loc="left")
    ax.axhline(ERRORS[-1], color="0.6", lw=0.6, ls="--")
    ax.loglog(*zip(*one.runs, strict=True), "o", ms=4, color=BLUE)
    if one.fit:
        errors = np.geomspace(3e-4, 3e-1, 61)
        inner = [e for e in errors if one.needed(e)[0] > one.fit.elements.min()]
        ax.loglog([one.cost(e) for e in inner], inner, color="0.6", zorder=0)
        ax.loglog([one.cost(ERRORS[-1])], [ERRORS[-1]], "s", ms=5, mfc="none", color=RED)


def _order(order: Order | None) -> str:
    known = order is not None and math.isfinite(order.value)
    if order is not None and order.exponential:
        return str(order)
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
    _printed(*verdicts(judged_codes, real=True))
    print()
    _printed(*costs(judged_codes))
    print()
    _printed(*conditions(judged_codes))
    Path("results").mkdir(exist_ok=True)
    save_figure(figure(judged_codes), "results/codes")
