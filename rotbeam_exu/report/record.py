"""A judgement with all that a reader needs to repeat it."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib.metadata import version

from ..verification.judgement import Judgement
from ..verification.mistakes import Mistake
from ..verification.submission import Submission


def _versions() -> dict[str, str]:
    libraries = ("numpy", "scipy", "xarray")
    return {
        "rotbeam_exu": version("rotbeam-exu"),
        "python": platform.python_version(),
        **{name: version(name) for name in libraries},
    }


@dataclass(frozen=True, kw_only=True, eq=False)
class Record:
    """What was handed in, what was found, and by what.

    Attributes
    ----------
    submission : Submission
    judgement : Judgement
        Of it, or of some of its cases.
    mistakes : tuple of Mistake
    digests : mapping
        SHA-256 by file.
    date : datetime
        Of the judgement.
    versions : mapping
        Of what judged, by name.
    """

    submission: Submission
    judgement: Judgement
    mistakes: tuple[Mistake, ...] = ()
    digests: Mapping[str, str] = field(default_factory=dict)
    date: datetime = field(default_factory=lambda: datetime.now(UTC))
    versions: Mapping[str, str] = field(default_factory=_versions)

    @property
    def name(self) -> str:
        """Code and version."""
        return f"{self.judgement.declaration.code} {self.judgement.declaration.version}".strip()
