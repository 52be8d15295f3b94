"""A beam or a blade from a TOML file, and a run's motion and numerics where it holds them."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from analytic import AnyBlade, Beam, Blade, Damping, PointMass, Section
from analytic.description import from_description
from analytic.input_checks import positive, rotation_speed, whole_number
from analytic.loads import Load
from analytic.parts import Line
from analytic.section import OutOfPlane
from analytic.section_shapes import SectionShape

from . import beam_tables as tables
from .beam_tables import Table, require_keys
from .stations_file import blade_of_csv

_DECIMAL_COMMA = re.compile(r"^\s*[\w.]+\s*=\s*([+-]?\d+),(\d+)\s*(?:#.*)?$", re.MULTILINE)


@dataclass(frozen=True, kw_only=True)
class RunFile:
    """Content of a file about a run.

    Attributes
    ----------
    beam : Beam or Blade
        The paper's beam, where the file has none.
    motion : dict
        `omega` [rad/s] and `ramp_time` [s], if the file holds them.
    loads : sequence of Load
    numerics : dict
        `element`, `elements`, `step` [s], `duration` [s] and `frame`, if it holds them.
    """

    beam: AnyBlade
    motion: Mapping[str, float] = field(default_factory=dict)
    loads: Sequence[Load] = ()
    numerics: Mapping[str, Any] = field(default_factory=dict)


def load_beam(path: str | os.PathLike[str]) -> AnyBlade:
    """Read a beam from the table [beam] of a TOML file, or a blade from [blade], in SI units.

    [beam] gives length, area, second_moment, youngs_modulus and density, or length,
    axial_stiffness, bending_stiffness and mass_per_length. [blade] gives length and, where they are
    not zero, hub_radius [m] and setting_angle [rad]; [blade.section] gives axial_stiffness,
    bending_stiffness, mass_per_length and rotary_inertia, each a number, coefficients of x/L, or
    stations [x, value]; [blade.section.out_of_plane] bending_ratio and, if known,
    torsion_ratio, or [beam.shape] and [blade.section.shape] the kind of a shape and its
    lengths [m]; each [[blade.point_mass]] position, mass, inertia and offset; [blade.line] twist
    [rad], precone [rad], prebend and sweep [1/m], mass_offset and tension_offset [m], kinks;
    [blade.stations], in place of length and section, the keywords of `Blade.from_stations` or of
    `Blade.from_shapes`, or the name of a `file` that `blade_of_csv` reads; [blade.damping] ratio,
    of mode 1 in the plane at rest, or bending [s], axial [s] and external [kg/(m s)], relative to
    the turning frame and not of point masses, each zero where it is not given.

    Raises
    ------
    ValueError
        If the file is not TOML, or a key is missing, unknown or has a value that is refused; the
        sentence names the file and the key.
    FileNotFoundError
        If there is no such file.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rotbeam_exu.files.beam_file import load_beam
    >>> numbers = "length = 8.0, area = 7.3e-5, second_moment = 8.218e-9, density = 2766.67"
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "beam.toml"
    ...     _ = path.write_text(f"beam = {{ {numbers}, youngs_modulus = 6.8952e10 }}")
    ...     beam = load_beam(path)
    >>> print(f"{beam.omega_0:.4f} rad/s")
    2.9100 rad/s
    """
    source = Path(path)
    document = _read_toml(source)
    for others in ("motion", "numerics", "loads"):  # of a run, which `load_run_file` reads
        document.pop(others, None)
    return _beam_from(document, source)


def load_run_file(path: str | os.PathLike[str]) -> RunFile:
    """Read [beam] or [blade], as `load_beam` does, and the tables [motion], [numerics], [[loads]].

    [motion] may hold omega [rad/s] and ramp_time [s]; [numerics] element, elements, step [s],
    duration [s] and frame; each [[loads]] the kind of a load and its fields. A file with one of
    these may do without a beam.

    Raises
    ------
    ValueError
        If `load_beam` refuses the file, or a key is unknown or has a value that is refused; the
        sentence names the file and the key.
    FileNotFoundError
        If there is no such file.
    """
    source = Path(path)
    document = _read_toml(source)
    run: dict[str, Any] = {
        name: _checked(document.pop(name), f"[{name}]", source, keys)
        for name, keys in (("motion", tables.MOTION), ("numerics", tables.NUMERICS))
        if name in document
    }
    if "loads" in document:
        run["loads"] = _loads(document.pop("loads"), source)
    beam = _beam_from(document, source) if document or not run else Beam.reference()
    return RunFile(beam=beam, **run)


def _loads(told: Any, source: Path) -> list[Load]:
    if not (isinstance(told, list) and all(isinstance(one, dict) for one in told)):
        raise ValueError(f'{source}: write each [[loads]] as a table, with kind = "Gravity"')
    try:
        return [from_description(one, Load) for one in told]
    except (OverflowError, TypeError, ValueError) as error:
        raise ValueError(f"{source}: [[loads]]: {error}") from error


def _checked(table: Any, title: str, source: Path, keys: Table) -> dict[str, Any]:
    require_keys(table, title, source, keys)
    try:
        return {name: _number(name, value, keys.optional[name]) for name, value in table.items()}
    except (OverflowError, TypeError, ValueError) as error:
        raise ValueError(f"{source}: {title}: {error}") from error


def _number(name: str, value: object, kind: type) -> Any:
    """Return a number or a name of [motion] and [numerics]; but for the speed, times [s]."""
    if kind is str:
        if not isinstance(value, str):
            raise TypeError(f"{name} must be a name in quotes, got {value!r}")
        return value
    if kind is int:
        return whole_number(name, value)
    return rotation_speed(value) if name == "omega" else positive(name, value, "s")


def _read_toml(source: Path) -> dict[str, Any]:
    """Return the tables of a TOML file; refuse other files."""
    if not source.is_file():
        raise FileNotFoundError(f"there is no file {source}")
    try:
        # Some editors begin a file with a byte order mark, which "utf-8-sig" skips.
        return tomllib.loads(source.read_text(encoding="utf-8-sig"))
    except ValueError as error:  # of TOML, of UTF-8, or of an integer with too many digits
        comma = _DECIMAL_COMMA.search(source.read_text(encoding="utf-8", errors="replace"))
        hint = f"; write {comma[1]}.{comma[2]} for {comma[1]},{comma[2]}" if comma else ""
        raise ValueError(f"{source} is not valid TOML: {error}{hint}") from error


def _beam_from(document: dict[str, Any], source: Path) -> AnyBlade:
    """Return the beam of a document, as `load_beam` does; `source` is named in its errors."""
    for name in document:
        if name not in ("beam", "blade"):
            raise ValueError(
                f"{source}: unknown table or key {name!r}; the beam is in [beam], a blade in "
                "[blade], what a run needs in [motion], [numerics] and [[loads]]"
            )
    if len(document) == 2:
        raise ValueError(f"{source} has both [beam] and [blade]: keep one")
    kind = "blade" if "blade" in document else "beam"
    table = document.get(kind)
    if not isinstance(table, dict):
        raise ValueError(f"{source} has no table [beam] with {', '.join(tables.BEAM.required)}")
    try:
        return _blade(table, source) if kind == "blade" else _beam(table, source)
    except (OverflowError, TypeError, ValueError) as error:
        text = str(error)
        raise ValueError(text if text.startswith(str(source)) else f"{source}: {text}") from error


def _beam(table: dict[str, Any], source: Path) -> AnyBlade:
    by_stiffness = bool(set(table) & {*tables.SECTION.required})
    require_keys(table, "[beam]", source, tables.BEAM_BY_STIFFNESS if by_stiffness else tables.BEAM)
    if by_stiffness:
        return Beam.from_stiffness(**table)
    material = {name: table[name] for name in tables.BEAM.required}
    return _shaped(Beam(**material), table.get("shape"))


def _blade(table: dict[str, Any], source: Path) -> AnyBlade:
    keys = tables.BLADE_AT_STATIONS if "stations" in table else tables.BLADE
    require_keys(table, "[blade]", source, keys)
    parts, line, shape = dict(table), table.get("line", {}), None
    masses = parts.pop("point_mass", [])
    if not isinstance(masses, list):
        raise ValueError(f"{source}: write each [[blade.point_mass]] as a table")
    if "stations" in table:
        at = _at_stations(parts.pop("stations"), source)
        parts |= {"length": at.length, "section": at.section}
        line = {"twist": at.line.twist, **line}
    else:
        parts["section"], shape = _section(table["section"], source)
    damping = parts.pop("damping", {})
    ratio = isinstance(damping, dict) and "ratio" in damping
    title, keys = "[blade.damping]", tables.DAMPING_BY_RATIO if ratio else tables.table_of(Damping)
    require_keys(damping, title, source, keys)
    parts["line"] = _part(Line, line, "[blade.line]", source)
    parts["point_masses"] = tuple(
        _part(PointMass, one, "[[blade.point_mass]]", source) for one in masses
    )
    blade = _shaped(Blade(**parts), shape).blade
    if ratio:
        return blade.with_damping(Damping.from_ratio(blade, 1, damping["ratio"]))
    return blade.with_damping(Damping(**damping))


def _at_stations(table: dict[str, Any], source: Path) -> Blade:
    title = "[blade.stations]"
    if "file" in table:
        require_keys(table, title, source, tables.STATIONS_OF_FILE)
        return blade_of_csv(source.parent / str(table["file"]))
    if "shapes" in table:
        require_keys(table, title, source, tables.STATIONS_OF_SHAPES)
        shapes = list(map(_shape, table["shapes"]))
        return Blade.from_shapes(**{**table, "shapes": shapes})
    require_keys(table, title, source, tables.STATIONS)
    return Blade.from_stations(**table)


def _section(table: dict[str, Any], source: Path) -> tuple[Section, Any]:
    """Return a section, and the table of its shape."""
    require_keys(table, "[blade.section]", source, tables.SECTION)
    section = dict(table)
    shape = section.pop("shape", None)
    if "out_of_plane" in section:
        title = "[blade.section.out_of_plane]"
        section["out_of_plane"] = _part(OutOfPlane, section["out_of_plane"], title, source)
        if shape is not None:
            raise ValueError(f"{source} has {title} and a shape, which say the same: keep one")
    return Section(**section), shape


def _shaped(beam: AnyBlade, shape: object) -> AnyBlade:
    """Return the beam with the shape of a table, or itself without one."""
    return beam if shape is None else beam.with_shape(_shape(shape))


def _shape(shape: object) -> SectionShape:
    if not isinstance(shape, dict):
        raise ValueError('write a shape as a table, as { kind = "Rectangle", width = 0.002 }')
    return from_description(shape, SectionShape)


def _part(cls: type[Any], table: Any, title: str, source: Path) -> Any:
    """Return the value whose fields are the keys of a table."""
    require_keys(table, title, source, tables.table_of(cls))
    return cls(**table)
