"""The versions of the libraries that a result depends on."""

from __future__ import annotations

import platform
from importlib import metadata

from .. import __version__


def versions() -> dict[str, str]:
    """Return the versions that a result depends on, of the libraries that are installed."""
    found = {"rotbeam-exu": __version__, "python": platform.python_version()}
    for name in ("exudyn", "numpy", "scipy"):
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return found
