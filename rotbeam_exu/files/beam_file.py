"""A beam or a blade from a TOML file, with stations from CSV, and a run's motion and numerics."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

from analytic import Beam, Blade, Damping, PointMass, Section, Theory
from analytic.description import from_description
from analytic.input_checks import not_negative, positive, rotation_speed, shown, whole_number
from analytic.lazily import Lazily
from analytic.loads import Load
from analytic.parts import Line
from analytic.section import OutOfPlane
from analytic.section_shapes import SectionShape

from .beam_tables import BEAM, NUMERICS, require_keys
from .blade_files import blade_by, blade_of_file, reader_of
from .load_file import load_of
from .stations_file import text_of

_exact = Lazily("analytic.exact.linear.damping")  # which most files do not need
_DECIMAL_COMMA = re.compile(r"^\s*[\w.]+\s*=\s*([+-]?\d+),(\d+)\s*(?:#.*)?$", re.MULTILINE)


@dataclass(frozen=True, kw_only=True)
class RunFile:
    """Content of a file about a run, as far as it has any; the paper's beam where it has none."""

    blade: Blade
    motion: Mapping[str, float] = field(default_factory=dict)
    loads: Sequence[Load] = ()
    numerics: Mapping[str, Any] = field(default_factory=dict)
    theory: Mapping[str, Any] = field(default_factory=dict)
    uncertainty: Mapping[str, float] = field(default_factory=dict)


def load_beam(path: str | os.PathLike[str]) -> Blade:
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
    `Blade.from_shapes`, or the name of a `file`; [blade.damping] ratio, of mode 1 in the plane at
    rest or, as { "flap 1" = 0.005, "lag 1" = 0.005 }, of modes by name, or bending [s], axial [s]
    and external [kg/(m s)], relative to the turning frame and not of point masses, each zero where
    it is not given.

    Such a `file`, which may be read alone too, is a CSV as `blade_of_csv` reads, BeamDyn's primary
    file, HAWC2's .htc or _st, or, with length, axial_stiffness and torsion_stiffness besides, a
    blade file of ElastoDyn.

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
    return load_run_file(path, needs_beam=True).blade


def load_run_file(path: str | os.PathLike[str], *, needs_beam: bool = False) -> RunFile:
    """Read [beam] or [blade], as `load_beam` does, and the tables of a run.

    [motion] may hold omega [rad/s] and ramp_time [s]; [numerics] element, elements, step [s],
    duration [s] and frame; [theory] the arguments of a `Theory`; [uncertainty] standard deviations
    of the blade's numbers by name, and a correlation `length` [m]; each [[loads]] the kind of a
    load and its fields, of a LoadTable also the name of a CSV `file`, as `load_table` reads. A file
    with one of these may do without a beam, unless it `needs_beam`. Errors are those of
    `load_beam`.
    """
    source = Path(path)
    if reader := reader_of(source):
        return RunFile(blade=blade_by(reader, source, {}))
    document = _read_toml(source)
    try:
        if "beam" in document and "blade" in document:
            raise ValueError("it has both [beam] and [blade]: keep one")
        require_keys(document)
        if "blade" in document:
            blade = _blade(document["blade"], source.parent)
        elif "beam" in document:
            blade = _beam(document["beam"])
        elif document and not needs_beam:
            blade = Beam.reference()
        else:
            raise ValueError(f"it has no table [beam] with {', '.join(BEAM.required)}")
        run = {
            name: {key: _number(key, value) for key, value in document[name].items()}
            for name in ("motion", "numerics")
            if name in document
        }
        theory = document.get("theory", {})
        Theory(**theory)
        uncertainty = {
            name: not_negative(f"{name} of [uncertainty]", value)
            for name, value in document.get("uncertainty", {}).items()
        }
        loads = [load_of(one, source.parent) for one in document.get("loads", [])]
    except (OverflowError, TypeError, ValueError) as error:
        raise ValueError(f"{source}: {error}") from error
    return RunFile(blade=blade, loads=loads, theory=theory, uncertainty=uncertainty, **run)


def _number(name: str, value: object) -> Any:
    """Return a number or a name of [motion] and [numerics]; but for the speed, times [s]."""
    if name in ("element", "frame"):
        if not isinstance(value, str):
            raise TypeError(f"{name} must be a name in quotes, got {value!r}")
        if value not in (names := get_args(NUMERICS.optional[name])):
            more = "; a class of your own is for --element alone" if ":" in value else ""
            listed = ", ".join(map(repr, names))
            raise ValueError(
                f"unknown {name} {shown(value)} in [numerics]; known are {listed}{more}"
            )
        return value
    if name == "elements":
        return whole_number(name, value)
    return rotation_speed(value) if name == "omega" else positive(name, value, "s")


def _read_toml(source: Path) -> dict[str, Any]:
    """Return the tables of a TOML file; refuse other files."""
    text = text_of(source)
    try:
        return tomllib.loads(text)
    except ValueError as error:  # of TOML, or of an integer with too many digits
        comma = _DECIMAL_COMMA.search(text)
        hint = f"; write {comma[1]}.{comma[2]} for {comma[1]},{comma[2]}" if comma else ""
        raise ValueError(f"{source} is not valid TOML: {error}{hint}") from error


def _beam(table: dict[str, Any]) -> Blade:
    if "axial_stiffness" in table:
        return Beam.from_stiffness(**table)
    material = {name: table[name] for name in BEAM.required}
    return _shaped(Beam(**material), table.get("shape"))


def _blade(table: dict[str, Any], folder: Path) -> Blade:
    parts: dict[str, Any] = dict(table)
    masses, damping, line = (
        parts.pop(name, default)
        for name, default in (("point_mass", []), ("damping", {}), ("line", {}))
    )
    shape = None
    if "stations" in parts:
        at = _at_stations(parts.pop("stations"), folder)
        parts |= {"length": at.length, "section": at.section}
        twist: Any = at.line.twist or ()
        if "twist" in line and any(angle for _, angle in twist):
            raise ValueError(
                "[blade.line] and [blade.stations] both give a twist: keep that of the stations"
            )
        curves = {name: getattr(at.line, name) for name in ("prebend", "sweep")}
        line = {"twist": at.line.twist, **{k: v for k, v in curves.items() if v}, **line}
    else:
        section = dict(parts["section"])
        shape = section.pop("shape", None)
        if "out_of_plane" in section:
            if shape is not None:
                raise ValueError(
                    "a shape and out_of_plane of [blade.section] say the same: keep one"
                )
            section["out_of_plane"] = OutOfPlane(**section["out_of_plane"])
        parts["section"] = Section(**section)
    point_masses = tuple(PointMass(**one) for one in masses)
    blade = _shaped(Blade(**parts, line=Line(**line), point_masses=point_masses), shape)
    if isinstance(ratio := damping.get("ratio"), dict):
        return blade.with_damping(_exact.modal_damping(blade, ratio))
    if ratio is not None:
        return blade.with_damping(Damping.from_ratio(blade, 1, ratio))
    return blade.with_damping(Damping(**damping))


def _at_stations(table: dict[str, Any], folder: Path) -> Blade:
    if "file" in table:
        given = dict(table)
        return blade_of_file(folder / str(given.pop("file")), given)
    if "shapes" in table:
        shapes = [from_description(one, SectionShape) for one in table["shapes"]]
        return Blade.from_shapes(**{**table, "shapes": shapes})
    return Blade.from_stations(**table)


def _shaped(blade: Blade, shape: Any) -> Blade:
    """Return the beam with the shape of a table, or itself without one."""
    return blade if shape is None else blade.with_shape(from_description(shape, SectionShape))
