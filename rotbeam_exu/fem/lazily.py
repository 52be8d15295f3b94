"""Exudyn, imported when it is first used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from analytic.lazily import Lazily


class _OfExudyn(Lazily):
    def __getattr__(self, name: str) -> Any:
        try:
            return super().__getattr__(name)
        except ImportError as error:
            raise ImportError(
                f"Exudyn cannot be imported ({error}): pip install exudyn; theory, judge and "
                "figures from files do without"
            ) from error


if TYPE_CHECKING:
    import exudyn
    from exudyn import itemInterface as items  # noqa: N813
else:
    exudyn, items = map(_OfExudyn, ("exudyn", "exudyn.itemInterface"))

__all__ = ["exudyn", "items", "require_exudyn"]


def require_exudyn() -> str:
    """Return where Exudyn is, or raise ImportError with a sentence: before work that needs it."""
    return str(exudyn.__file__)
