"""The content of a submission's files: of regular files below its folder alone, up to a limit.

Who judges the folders of strangers has files of his own, to which links lead, and memory, which a
pipe or a device fills. All files of a submission are read here.
"""

from __future__ import annotations

import os
from pathlib import Path

from .faults import Faults

LARGEST = 100_000_000
"""Bytes of a file that is read; a history of a million samples has less."""

LARGEST_TOML = 32_000
"""Bytes of entry.toml."""

OUTSIDE = "is a link that leads out of the folder: put what it names in its place"


def below(folder: Path, file: str) -> Path | None:
    """Return the place below the folder to which links lead; None if they lead out."""
    root, real = os.path.realpath(folder), Path(os.path.realpath(folder / file))
    return real.relative_to(root) if real.is_relative_to(root) else None


def content_of(folder: Path, file: str, largest: int = LARGEST) -> bytes:
    """Return the bytes of a regular file below a folder.

    Raises
    ------
    ValueError
        If it is none, or too large; the sentence goes on after the file's name.
    OSError
        If it cannot be read.
    """
    place = below(folder, file)
    if place is None:
        raise ValueError(OUTSIDE)
    path = folder / place
    if path.is_dir():
        raise ValueError("is a folder: put a file in its place")
    if path.exists() and not path.is_file():
        raise ValueError("is no regular file but a pipe or a device: put a file in its place")
    with path.open("rb") as opened:
        content = opened.read(largest + 1)
    if len(content) > largest:
        raise ValueError(
            f"has more than {largest:,} bytes: hand in what the kit asks for, and sample less often"
        )
    return content


def text_of(folder: Path, file: str, faults: Faults, largest: int = LARGEST) -> str | None:
    """Return the text of a file, its lines ended by LF; None, and why, where it is no text."""
    try:
        # Some editors begin a file with a byte order mark, which "utf-8-sig" skips.
        text = content_of(folder, file, largest).decode("utf-8-sig")
        if "\0" in text:
            raise ValueError("is not text (it holds zero bytes): write it as UTF-8")
    except UnicodeDecodeError as error:
        said = f"is not text (byte {error.start} is no UTF-8): write it as UTF-8"
    except FileNotFoundError:
        said = "there is no such file"
    except OSError as error:
        said = f"cannot be read: {error.strerror or error}"
    except ValueError as error:
        said = str(error)
    else:
        return text.replace("\r\n", "\n").replace("\r", "\n")
    faults.add(file, said)
    return None
