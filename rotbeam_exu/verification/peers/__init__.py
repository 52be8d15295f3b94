"""Other codes beside ours that come with an adapter; each is a class in a file of its own."""

from __future__ import annotations

from typing import ClassVar, Protocol

from ..verify import Entry
from .kratos import Kratos


class Peer(Protocol):
    """A code with an adapter."""

    name: ClassVar[str]
    """Name that the user gives."""
    package: ClassVar[str]
    """Package that has to be installed, in words."""

    def is_installed(self) -> bool:
        """Say whether the code is at hand, without importing it."""

    def entry(self) -> Entry:
        """Return the code with a mesh and a step that its order of accuracy needs."""


PEERS: dict[str, Peer] = {one.name: one for one in (Kratos(),)}
"""The other codes, by name."""


class NotInstalledError(ModuleNotFoundError, ValueError):
    """Another code was asked for that is not installed."""


def peer(name: str) -> Entry:
    """Return the entry of another code.

    Raises
    ------
    ValueError
        If the name is not known.
    NotInstalledError
        If the code is not installed; the sentence says how to.
    """
    if name not in PEERS:
        raise ValueError(f"unknown code {name!r}; known are {', '.join(map(repr, PEERS))}")
    if not installed(name):
        raise NotInstalledError(
            f"{PEERS[name].package} is not installed; pip install '.[peers]' in a clone"
        )
    return PEERS[name].entry()


def installed(name: str) -> bool:
    """Say whether another code is at hand, without importing it: it would print a banner."""
    return name in PEERS and PEERS[name].is_installed()
