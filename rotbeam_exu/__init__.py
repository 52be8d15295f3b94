"""The rotating cantilever beam in Exudyn: models, sweeps, comparison with the theory, figures."""

from __future__ import annotations

__version__ = "0.1.0"
