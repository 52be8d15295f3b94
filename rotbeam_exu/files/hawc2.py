"""Blades in HAWC2's files: the main file (.htc) with its c2_def, and structural data (_st).

HAWC2's axes are x along the chord to the leading edge, y along the thickness and z along the blade:
our 2, 3 and 1, with the same sign of twist. Its line goes through the half chord, from which
structural data have their centers; radii of gyration are about the elastic center.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.exact.continuum.vectors import about_axis
from analytic.station_section import moved
from analytic.warning import warn

from .foreign import ForeignText
from .key_points import line_through

_ORDER = [2, 0, 1, 5, 3, 4]  # of HAWC2's x, y, z, forces and moments, ours
_ENDS_APART = 0.01  # of the length, by which table and line may end apart


def blade_of_htc(path: Path) -> Blade:
    """Return the blade of a main file of HAWC2 and the structural data that it names.

    The blade is the first main body whose name begins with "blade" and that has a c2_def.

    Raises
    ------
    ValueError
        If there is none, or a number is missing or none.
    """
    text = ForeignText(path)
    for body in _blocks(text, "main_body", 0, len(text.lines)):
        if not _value(text, body, "name").lower().startswith("blade"):
            continue
        for curve in _blocks(text, "c2_def", *body):
            for data in _blocks(text, "timoschenko_input", *body):
                return _blade(text, curve, data)
    raise ValueError(
        f"{path} has no main_body whose name begins with blade, with a c2_def and a "
        "timoschenko_input"
    )


def _blade(text: ForeignText, curve: tuple[int, int], data: tuple[int, int]) -> Blade:
    count = _value(text, curve, "nsec")
    places = [k for k in range(*curve) if re.match(r"\s*sec\s", text.lines[k])]
    if not count.isdigit() or len(places) != int(count) or len(places) < 3:
        raise ValueError(
            f"{text.path}: its c2_def has {len(places)} lines sec, and nsec {count or 'nowhere'}: "
            "give three or more"
        )
    rows = np.array([text.cells(text.lines[k].split(";")[0].split()[1:], 5, k) for k in places])
    points = rows[:, [3, 1, 2]]
    if points[0].any():
        raise ValueError(f"{text.path}: the first sec of c2_def must be at 0 0 0")
    length, line = line_through(points, np.radians(rows[:, 4]))
    sets = _value(text, data, "set", 2).split()
    if len(sets) != 2 or not all(one.isdigit() for one in sets):
        raise ValueError(f"{text.path}: timoschenko_input must have set with two numbers")
    structure = ForeignText(text.beside(_value(text, data, "filename")))
    blade = _of_table(_table(structure, int(sets[0]), int(sets[1])), structure.path, length)
    return Blade(length=length, section=blade.section, line=line)


def blade_of_st(path: Path) -> Blade:
    """Return the straight, untwisted blade of structural data with one set, its first subset.

    A warning says where line and twist are.

    Raises
    ------
    ValueError
        If there are more sets, of which the main file names the blade's.
    """
    text = ForeignText(path)
    numbers = [int(match[1]) for line in text.lines if (match := re.match(r"\s*#\s*(\d+)", line))]
    if len(numbers) != 1:
        raise ValueError(
            f"{path} has {len(numbers)} sets, of bodies that the main file names: give that, .htc"
        )
    table = _table(text, numbers[0], 1)
    warn(f"{path} has no twist and no line: give the main file, .htc, which has them in c2_def")
    return _of_table(table, path, float(table[-1, 0]))


def _blocks(text: ForeignText, name: str, start: int, end: int) -> list[tuple[int, int]]:
    """Return first and last line of the blocks between begin and end of a name."""
    blocks, begin = list[tuple[int, int]](), None
    for k in range(start, end):
        words = text.lines[k].split(";")[0].lower().split()
        if words[:2] == ["begin", name]:
            begin = k + 1
        elif words[:2] == ["end", name] and begin is not None:
            blocks.append((begin, k))
            begin = None
    return blocks


def _value(text: ForeignText, block: tuple[int, int], name: str, count: int = 1) -> str:
    """Return what stands after the name of a command, nothing where there is none."""
    for line in text.lines[slice(*block)]:
        words = line.split(";")[0].split()
        if words and words[0].lower() == name:
            return " ".join(words[1 : 1 + count])
    return ""


def _table(text: ForeignText, main: int, sub: int) -> FloatArray:
    """Return the rows of a subset, (stations, 19 or 30)."""
    start = text.first(rf"^\s*#\s*{main}\b", f"set #{main}")
    following = text.lines[start + 1 :]
    end = next((k for k, one in enumerate(following, start + 1) if one.lstrip()[:1] == "#"), None)
    for k in range(start + 1, end or len(text.lines)):
        match = re.match(rf"\s*\$\s*{sub}\s+(\d+)\b", text.lines[k])
        if not match:
            continue
        count = int(match[1][:9])
        if count < 2 or k + 1 >= len(text.lines):
            break
        width = 30 if len(re.split(r"[;!#]", text.lines[k + 1])[0].split()) >= 30 else 19
        return np.array(text.rows(k + 1, count, width))
    raise ValueError(f"{text.path} has no subset ${sub} with two stations or more in its #{main}")


def _of_table(table: FloatArray, path: Path, length: float) -> Blade:
    """Return the blade of structural data, whose last station is the tip."""
    x = table[:, 0].copy()
    if abs(x[-1] - length) > _ENDS_APART * length or len(x) < 2 or x[-2] >= length:
        raise ValueError(
            f"{path} ends at {x[-1]:g} m, and the half chord line is {length:g} m long: give both "
            "to the same tip"
        )
    x[-1] = length
    m, center, gyration = table[:, 1], table[:, 2:4], table[:, 4:6]
    if table.shape[1] == 19:
        shear, (E, G, Ix, Iy, K, kx, ky, A) = table[:, 6:8], table[:, 8:16].T
        pitch, elastic = table[:, 16], table[:, 17:19]
        zero = np.zeros_like(m)
        stiffness = _turned(_diagonal(E * A, zero, zero, zero, E * Ix, E * Iy), pitch)
        across = _turned(_diagonal(zero, kx * G * A, ky * G * A, G * K, zero, zero), pitch)
        S = moved(stiffness, elastic) + moved(across, shear)
    else:
        pitch, elastic = table[:, 6], table[:, 7:9]
        S = np.zeros((len(m), 6, 6))
        S[:, *np.triu_indices(6)] = table[:, 9:]
        S = S + np.swapaxes(np.triu(S, 1), 1, 2)
        S = moved(_turned(S[:, _ORDER][:, :, _ORDER], pitch), elastic)
    j2, j3 = m * gyration.T**2
    none = np.zeros_like(m)
    M = moved(_diagonal(m, m, m, none, none, none), center - elastic)
    M[:, 3:, 3:] = _turned(_diagonal(none, none, none, j2 + j3, j2, j3), pitch)[:, 3:, 3:]
    return Blade.from_stations(x, S, moved(M, elastic))


def _diagonal(*entries: FloatArray) -> FloatArray:
    return np.stack(entries, axis=-1)[:, :, None] * np.eye(6)


def _turned(matrices: FloatArray, pitch: FloatArray) -> FloatArray:
    """Return matrices of principal axes in those of the chord, by the structural pitch [deg]."""
    turn = np.moveaxis(about_axis(np.radians(pitch)), -1, 0)
    both = np.zeros_like(matrices)
    both[:, :3, :3] = both[:, 3:, 3:] = turn
    return np.asarray(both @ matrices @ np.swapaxes(both, 1, 2))
