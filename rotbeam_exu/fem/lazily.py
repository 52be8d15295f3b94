"""Exudyn, imported when it is first used: formulations have names and options without it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..lazily import Lazily

if TYPE_CHECKING:
    import exudyn
    from exudyn import itemInterface as items  # noqa: N813
else:
    exudyn, items = Lazily("exudyn"), Lazily("exudyn.itemInterface")

__all__ = ["exudyn", "items"]
