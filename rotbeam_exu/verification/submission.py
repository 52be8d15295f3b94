"""Submissions of a code: its declaration, tables and histories, from files or a call."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from analytic.arrays import FloatArray
from analytic.input_checks import finite_number
from analytic.letters import plain_text
from analytic.theory import BERNOULLI_EULER, Theory

from .case import Case

TEXTS = "benchmark", "code", "version", "url", "licence", "element", "machine", "remarks"
ORDERS = "order", "order_in_step"
LEAST_ORDER, MOST_ORDER = 0.1, 20.0
LONGEST_NAME, LONGEST_REMARKS = 200, 2000
"""Letters of a text that an author declares, and of the remarks."""


@dataclass(frozen=True, kw_only=True)
class Declaration:
    """The author's declaration of a code; the file entry.toml.

    Attributes
    ----------
    code, version, url, licence, element, machine, remarks : str
    authors : tuple of str
    theory : Theory
        The beam that the elements tend to: from the tags shear (k_s and ν) and rotary-inertia.
    inextensible : bool
        Whether the elements cannot stretch.
    order, order_in_step : float, optional
        Orders declared in mesh and step.
    benchmark : str
        Version of the benchmark.
    """

    code: str
    version: str = ""
    url: str = ""
    licence: str = ""
    element: str = ""
    machine: str = ""
    remarks: str = ""
    authors: tuple[str, ...] = ()
    theory: Theory = BERNOULLI_EULER
    inextensible: bool = False
    order: float | None = None
    order_in_step: float | None = None
    benchmark: str = ""

    def __post_init__(self) -> None:
        """Check the texts and the orders."""
        for key in (*TEXTS, "authors"):
            object.__setattr__(self, key, declared(key, getattr(self, key)))
        for key in ORDERS:
            if getattr(self, key) is not None:
                object.__setattr__(self, key, declared(key, getattr(self, key)))


def declared(key: str, value: object) -> object:
    """Return a text, an order or the authors; TypeError or ValueError with the sentence."""
    if key in ORDERS:
        order = finite_number(key, value)
        if not LEAST_ORDER <= order <= MOST_ORDER:
            bounds = f"from {LEAST_ORDER:g} to {MOST_ORDER:g}"
            raise ValueError(f"{key} must be {bounds}, got {order:g}: leave out what is not known")
        return order
    if key == "remarks" and isinstance(value, str):  # of several lines
        plain_text(key, value.replace("\n", " ").replace("\t", " "), LONGEST_REMARKS)
        return value
    if key in TEXTS:
        return plain_text(key, value, LONGEST_NAME)
    if not isinstance(value, list | tuple) or len(value) > LONGEST_NAME:
        raise ValueError(f'{key} must be a short list of texts, as {key} = ["...", "..."]')
    return tuple(plain_text(f"each of the {key}", one, LONGEST_NAME) for one in value)


@dataclass(frozen=True, kw_only=True)
class Row:
    """Numbers of one mesh at one place of a table.

    Attributes
    ----------
    case : str
        Name of the case.
    elements : int
    speed : float
        Of the steady rotation [rad/s].
    amplitude : float
        Peak |q|/L of a backbone's point.
    number : int
        Of the natural frequency, the first being 1.
    values : tuple of float
        The frequency [rad/s], or lag [m], flap [m] and twist [rad] of the tip; empty of a failure.
    failure : str
        The code's own sentence, if it failed.
    rounding : tuple of float
        Errors of the last digits of the values; empty of numbers written to many.
    """

    case: str = "L"
    elements: int
    speed: float
    amplitude: float = 0.0
    number: int = 1
    values: tuple[float, ...] = ()
    failure: str = ""
    rounding: tuple[float, ...] = field(default=(), repr=False)

    @property
    def place(self) -> tuple[float, float, int]:
        """Place in the table, the same on all meshes."""
        return self.speed, self.amplitude, self.number


@dataclass(frozen=True, kw_only=True, eq=False)
class Run:
    """A history of the tip.

    Attributes
    ----------
    case : str
        Name of the case.
    elements : int
    step, tolerance : float
        Step of the integration [s], or the tolerance of one that chooses its steps; the other is
        NaN.
    time, q : ndarray (samples,)
        [s], and q [m] of Eq. 16, in space the columns of the case (samples, n); empty of a run that
        failed.
    failure : str
        The code's own sentence, if it failed.
    file : str
        Where it was read from, or how it was made.
    dof : int, optional
    wall, cpu : float
        Time spent [s]; NaN if not given.
    remark : str
        The code's own objection to the run.
    rounding : float or ndarray (3,)
        Error of q that the last digits of time and q leave, where they were written to few.
    """

    case: str
    elements: int
    step: float = math.nan
    tolerance: float = math.nan
    time: FloatArray = field(repr=False)
    q: FloatArray = field(repr=False)
    failure: str = ""
    file: str = ""
    dof: int | None = None
    wall: float = math.nan
    cpu: float = math.nan
    remark: str = ""
    rounding: float | FloatArray = field(default=0.0, repr=False)

    @property
    def is_adaptive(self) -> bool:
        """Whether a tolerance stands for the step."""
        return math.isnan(self.step)

    @property
    def refinement(self) -> float:
        """The step [s] or the tolerance: what is made smaller."""
        return self.tolerance if self.is_adaptive else self.step

    @property
    def fineness(self) -> tuple[int, float]:
        """Grows with mesh and step: the finest mesh is last, on it the smallest step."""
        return self.elements, -self.refinement

    @property
    def step_in_words(self) -> str:
        """The step in ms, or the tolerance."""
        return f"tol {self.tolerance:g}" if self.is_adaptive else f"{1e3 * self.step:.3g} ms"


@dataclass(frozen=True, kw_only=True, eq=False)
class Submission:
    """A submission: the data by which a code is judged. Empty fields were not submitted."""

    declaration: Declaration
    rows: tuple[Row, ...] = ()
    runs: tuple[Run, ...] = ()

    def has(self, case: Case) -> bool:
        """Return whether something of a case was submitted."""
        return case.name in {row.case for row in self.rows} | {run.case for run in self.runs}
