"""Tables 1-5 as printed, compared with the values that the package derives."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any

from ..beam import BETA_1, Beam
from ..input_checks import whole_number
from .lagrangian import EnergyCoefficients, energy_coefficients
from .model_range import reduced_model
from .shapes import CantileverMode, static_deflection

PRINTED_BETA = 1.8751
"""β as the paper rounded it, in Eq. 78 at least."""

_SYMBOLS = {
    "phi_v": "φ_v",
    "phi_u": "φ_u L",
    "omega_0": "ω0",
    "omega_n_squared": "ω_n²",
    "g1": "g1",
    "g2": "g2",
    "lambda_omega": "λ_ω",
    "lambda_x": "λ_x",
}


def _printed(table: str) -> dict[str, Any]:
    path = Path(__file__).with_name("printed.toml")
    return dict(tomllib.loads(path.read_text(encoding="utf-8")).get(table, {}))


@dataclass(frozen=True, kw_only=True)
class TableRow:
    """One entry of a table: as printed, as derived, how far apart, and an erratum if there is one.

    `difference` is "0" or "differs" where both are exact, and derived - printed where they are
    decimals.
    """

    quantity: str
    printed: str
    derived: str
    difference: str
    note: str = ""


@dataclass(frozen=True, kw_only=True)
class PaperTable:
    """One of the paper's tables next to its derivation."""

    number: int
    title: str
    rows: tuple[TableRow, ...]


def paper_table(number: int) -> PaperTable:
    """Return Table `number`, 1 to 5, as printed and as derived.

    Raises
    ------
    ValueError
        If the paper has no such table.

    Examples
    --------
    >>> from analytic import paper_table
    >>> for row in paper_table(1).rows[2:6]:
    ...     print(f"{row.quantity:6} {row.printed:24} {row.derived:24} {row.difference}")
    ω0     sqrt(140/11)             2·sqrt(385)/11           0
    ω_n²   350·Ω^2/121 + 140/11     350·Ω^2/121 + 140/11     0
    g1     144/11 - 9940·Ω^2/1331   144/11 - 9940·Ω^2/1331   0
    g2     142/121                  142/121                  0
    """
    number = whole_number("table", number)
    if number > 5:
        raise ValueError(f"table must be 1 to 5, got {number}: the paper has no other")
    return _rational_table(number) if number < 4 else (_table_4, _table_5)[number - 4]()


def closed_form(
    coefficients: EnergyCoefficients, beta: float = BETA_1
) -> dict[tuple[str, str], float]:
    """Return Eqs. 42-44, 64, 65 or Table 4: (quantity, monomial in Ω and μ) to coefficient.

    For a shape that does not depend on Ω, with w̄ = `beta`²Ω. λ_ω and λ_x share the denominator
    ω_n²; their numerators are returned.
    """
    c, s = coefficients, beta**4
    omega_n_squared = {
        "1": c.bending,
        "Ω²": c.spin * s,
        "Ω²μ": c.thinning * s,
        "Ω⁴μ": c.stretching * s**2,
    }
    g1 = {"1": c.cubic_bending, "Ω²": c.cubic_spin * s}
    lambda_omega = {k: c.g2 / 4.0 * w - 0.375 * g1.get(k, 0.0) for k, w in omega_n_squared.items()}
    lambda_x = {k: c.g2 / 16.0 * w - g1.get(k, 0.0) / 32.0 for k, w in omega_n_squared.items()}
    quantities = {
        "ω0": {"1": c.bending**0.5},
        "ω_n²": omega_n_squared,
        "g1": g1,
        "g2": {"1": c.g2},
        "λ_ω ω_n²": lambda_omega,
        "λ_x ω_n²": lambda_x,
    }
    return {(q, k): value for q, terms in quantities.items() for k, value in terms.items()}


def half_unit(printed: str) -> float:
    """Return half a unit of the last digit of a printed decimal, the most rounding can do."""
    exponent = Decimal(printed).as_tuple().exponent
    return 0.5 * 10.0 ** int(exponent)


def _rational_table(number: int) -> PaperTable:
    # sympy is loaded only where exact forms are asked for.
    import sympy as sp  # type: ignore[import-untyped]  # noqa: PLC0415

    from .symbolic import OMEGA, X, symbolic_forms  # noqa: PLC0415

    forms = symbolic_forms(static_deflection(number + 2), "inextensible")
    errata = _printed(f"errata_{number}")
    rows = []
    for name, printed in _printed(f"table_{number}").items():
        derived = getattr(forms, "omega_0_squared" if name == "omega_0" else name)
        derived = sp.sqrt(derived) if name == "omega_0" else derived
        difference = "not printed"
        if "?" not in printed:
            expression = sp.sympify(printed, locals={"Omega": OMEGA, "x": X})
            difference = "0" if sp.simplify(expression - derived) == 0 else "differs"
        rows.append(
            TableRow(
                quantity=_SYMBOLS[name],
                printed=_readable(printed),
                derived=_readable(str(derived)),
                difference=difference,
                note=errata.get(name, ""),
            )
        )
    title = f"polynomial shape of degree {number + 2}; x = η/L, ω0 in units of √(EI/mL³)"
    return PaperTable(number=number, title=title, rows=tuple(rows))


def _table_4() -> PaperTable:
    derived = closed_form(energy_coefficients(CantileverMode(), "sine"))
    rows = tuple(
        _decimal_row(f"{q}: {term}", printed, derived[q, term], "the print used β = 1.8751")
        for q, terms in _printed("table_4").items()
        for term, printed in terms.items()
    )
    title = "cantilever mode with elongation (CE): coefficients of the monomials in Ω and μ"
    return PaperTable(number=4, title=title, rows=rows)


def _table_5() -> PaperTable:
    rows = []
    for at, printed in _printed("table_5").items():
        model = reduced_model(Beam.reference(), float(at), "FrE")
        derived = {"ω_n [rad/s]": model.omega_n, "λ_ω": model.lambda_omega, "λ_x": model.lambda_x}
        # With both, and ω_n² over (1.8751/β)⁴, 8 of the 12 entries agree within the rounding.
        note = f"the print used degree 36 and, most likely, β = {PRINTED_BETA}"
        rows += [
            _decimal_row(f"{name} at {float(at):g} rad/s", text, value, note)
            for (name, value), text in zip(derived.items(), printed, strict=True)
        ]
    return PaperTable(number=5, title="rotating mode with elongation (FrE)", rows=tuple(rows))


def _decimal_row(quantity: str, printed: str, derived: float, note: str) -> TableRow:
    """Two digits more than printed; the note applies beyond the rounding of the last digit."""
    digits = -int(Decimal(printed).as_tuple().exponent) + 2
    difference = derived - float(printed)
    return TableRow(
        quantity=quantity,
        printed=printed,
        derived=f"{derived:.{digits}f}",
        difference=f"{difference:+.1e}",
        # One part in 1e9 of slack: the printed decimal itself is not a binary number.
        note="" if abs(difference) <= half_unit(printed) * (1.0 + 1e-9) else note,
    )


def _readable(expression: str) -> str:
    return (
        expression.replace("**", "^")
        .replace("*", "·")
        .replace(")/(", ") / (")
        .replace("Omega", "Ω")
    )
