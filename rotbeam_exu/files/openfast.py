"""Blades in OpenFAST's files: BeamDyn's two, to read and to write, and ElastoDyn's.

BeamDyn's axes are 1 flapwise to the suction side, 2 to the trailing edge and 3 along the blade, and
its twist turns about -3: our 1, 2, 3 are its 3, -2, 1, and our twist has the other sign.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from analytic import Blade, Damping
from analytic.arrays import FloatArray
from analytic.input_checks import along, positive
from analytic.warning import warn

from .foreign import ForeignText
from .key_points import key_points, line_through
from .results import whole_file

_AXES = np.kron(np.eye(2), np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]]))
"""Components along our axes of those along BeamDyn's, and the other way round."""

_ROUNDED = 1e-4  # by which digits of tables leave j1 off j2 + j3

_ELASTODYN = {
    "BlFract": "x [m], the length times it", "StrcTwst": "twist [deg], with the other sign",
    "BMassDen": "m [kg/m]", "FlpStff": "EI2 [N m^2]", "EdgStff": "EI3 [N m^2]",
    "GJStff": "GJ [N m^2]", "EAStff": "EA [N]",
}  # fmt: skip
"""Columns of ElastoDyn's table, and their names here."""
_OFFSETS = {"Alpha", "PrecrvRef", "PreswpRef", "FlpcgOf", "EdgcgOf", "FlpEAOf", "EdgEAOf"}
"""Columns of FAST 7 that move or turn a section."""


def elastodyn_names(title: str) -> str:
    """Return the name here of a column of ElastoDyn, none of other titles."""
    ours = {name.lower(): name_here for name, name_here in _ELASTODYN.items()}
    return ours.get(title.partition("[")[0].partition("(")[0].strip().lower(), "")


def blade_of_beamdyn(path: Path) -> Blade:
    """Return the blade of a primary file of BeamDyn and of the blade file that it names.

    The line goes through the key points, which BeamDyn itself fits by polynomials. It starts at the
    clamp, without hub and cone. Damping proportional to the stiffness is read, of which BeamDyn's
    acts on strains of its reference line and ours on those about the center of tension. Modal
    damping is not, and a warning says so.

    Raises
    ------
    ValueError
        If a number is missing or none, or a count is wrong.
    """
    text = ForeignText(path)
    count = text.count("kp_total", 3)
    start = text.first(r"^\s*kp_xr\s+kp_yr", "header kp_xr kp_yr kp_zr initial_twist") + 2
    points = np.array(text.rows(start, count, 4))
    if start + count < len(text.lines) and re.match(r"\s*[-+]?\.?\d", text.lines[start + count]):
        raise ValueError(f"{path} has more than the {count} key points of its kp_total")
    if points[0, :3].any():
        raise ValueError(f"{path}: the first key point must be 0 0 0, got {points[0, :3].tolist()}")
    length, line = line_through(points[:, [2, 1, 0]] * [1.0, -1.0, 1.0], -np.radians(points[:, 3]))
    sections = ForeignText(text.beside(text.value("BldFile")))
    eta, stiffness, mass = _sections(sections)
    blade = Blade.from_stations(length * eta, stiffness, mass)
    return Blade(length=length, section=blade.section, line=line, damping=_damping(sections))


def _sections(text: ForeignText) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return places over the length, and stiffness and mass there in our axes."""
    count, start = text.count("station_total", 2), text.first(
        r"distributed\s+properties", "line DISTRIBUTED PROPERTIES"
    ) + 1  # fmt: skip
    filled = [k for k in range(start, len(text.lines)) if text.lines[k].strip("- \t")]
    if len(filled) != 13 * count:
        raise ValueError(
            f"{text.path} has {len(filled)} lines of distributed properties, and its {count} "
            "stations need 13 each, a place and twice six rows: is it whole?"
        )
    eta = np.array([text.row(k, 1)[0] for k in filled[::13]])
    if eta[0] != 0.0 or eta[-1] != 1.0:
        raise ValueError(
            f"{text.path}: stations must run from 0 to 1, got {eta[0]:g} to {eta[-1]:g}"
        )
    rows = np.array([text.row(k, 6) for n, k in enumerate(filled) if n % 13])
    matrices = _AXES @ rows.reshape(count, 2, 6, 6) @ _AXES
    return eta, matrices[:, 0], matrices[:, 1]


def _damping(text: ForeignText) -> Damping:
    """Return the damping proportional to the stiffness; warn of another one."""
    kind = text.value("damp_type")
    if kind == "1":
        mu = text.row(text.first(r"mu1\s+mu2\s", "line mu1") + 2, 6)
        axial, *shears, torsion, out_of_plane, bending = np.abs(_AXES) @ mu
        shear = 0.5 * sum(shears)
        if shears[0] != shears[1]:
            warn(
                f"{text.path} damps both shear forces unlike, and their mean is taken, {shear:g} s"
            )
        return Damping(
            bending=bending, axial=axial, out_of_plane=out_of_plane, torsion=torsion, shear=shear
        )
    if kind != "0":
        warn(f"the damping in {text.path} is not read: give [blade.damping] in a TOML file")
    return Damping()


def blade_of_elastodyn(
    path: Path,
    *,
    length: float | None = None,
    axial_stiffness: ArrayLike | None = None,
    torsion_stiffness: ArrayLike | None = None,
) -> Blade:
    """Return the blade of a blade file of ElastoDyn, which bends in two planes.

    Masses and stiffnesses have the factors AdjBlMs, AdjFlSt and AdjEdSt of the file.

    Parameters
    ----------
    path : Path
    length : float
        Of the blade [m], TipRad less HubRad of the turbine.
    axial_stiffness, torsion_stiffness : float or array_like (stations,)
        EA [N] and GJ [N m²], which ElastoDyn does not know: it has both rigid.

    Raises
    ------
    ValueError
        If one of them is missing, or a number of the file.
    """
    text = ForeignText(path)
    count = text.count("NBlInpSt", 2)
    header = text.first(r"^\s*BlFract\s", "header BlFract StrcTwst BMassDen FlpStff EdgStff")
    names = text.lines[header].split()
    table = dict(zip(names, np.array(text.rows(header + 2, count, len(names))).T, strict=True))
    needed = list(_ELASTODYN)[:5]
    if missing := [name for name in needed if name not in table]:
        raise ValueError(f"{path} lacks the column {', '.join(missing)}")
    eta, twist, m, flap, lag = (table[name] for name in needed)
    EA, GJ = (
        table.get(name) if given is None else along(key, given, count, unit)
        for name, key, given, unit in (("EAStff", "axial_stiffness", axial_stiffness, "N"),
                                       ("GJStff", "torsion_stiffness", torsion_stiffness, "N m^2"))
    )  # fmt: skip
    if length is None or EA is None or GJ is None:
        raise ValueError(
            f"{path} has no length, EA and GJ, for ElastoDyn has the last two rigid: in "
            f'[blade.stations] of a TOML file give file = "{path.name}", length [m], '
            "axial_stiffness [N] and torsion_stiffness [N m²], one number or one at each of its "
            f"{count} stations; {1e3 * max(flap.max(), lag.max()):.0e} for both is as good as rigid"
        )
    if dropped := [name for name in table if name in _OFFSETS and table[name].any()]:
        warn(f"the columns {', '.join(dropped)} of {path} are not read: give offsets and line")
    m, flap, lag = (
        values * text.number(factor)
        for values, factor in ((m, "AdjBlMs"), (flap, "AdjFlSt"), (lag, "AdjEdSt"))
    )
    stiffness = np.stack([EA, EA, EA, GJ, flap, lag], axis=-1)
    j2, j3 = m * flap / EA, m * lag / EA
    return Blade.from_stations(
        positive("length", length, "m") * eta, stiffness, np.stack([m, j2 + j3, j2, j3], axis=-1),
        twist=-np.radians(twist),
    )  # fmt: skip


def write_beamdyn(blade: Blade, path: Path) -> list[Path]:
    """Write a blade of stations as a primary file of BeamDyn and its blade file; return both.

    In the format of OpenFAST 5, with one member and BeamDyn's default numerics. Hub, cone and
    setting angle are in other files of OpenFAST.

    Raises
    ------
    ValueError
        If the blade is not from stations, or has what BeamDyn's files cannot hold.
    """
    if (table := blade.table) is None:
        raise ValueError("BeamDyn's files hold 6x6 matrices: make the blade by Blade.from_stations")
    for name, there in (("point masses", blade.point_masses), ("kinks", blade.line.kinks),
                        ("external damping", blade.damping.external)):  # fmt: skip
        if there:
            raise ValueError(f"BeamDyn's files hold no {name}: write the blade without, or as TOML")
    _, points, angles = key_points(blade)
    keys = np.column_stack((points[:, [2, 1, 0]] * [1.0, -1.0, 1.0], -np.degrees(angles)))
    beside = blade_file_of(path)
    eta = np.array(table.x) / blade.length
    stations = ""
    matrices = np.array((table.stiffness, table.mass))
    polar, due = matrices[1, :, 3, 3], matrices[1, :, 4, 4] + matrices[1, :, 5, 5]
    if (far := np.abs(polar / due - 1.0) > _ROUNDED).any():
        raise ValueError(
            f"BeamDyn takes sections whose polar inertia is the sum of both others, and at "
            f"{table.x[far.argmax()]:g} m it is {polar[far.argmax()]:g} of {due[far.argmax()]:g} "
            "kg m: set j1 = j2 + j3, as of a thin slice"
        )
    matrices[1, :, 3, 3] = due  # BeamDyn compares all digits
    for place, *both in zip(eta, *(_AXES @ matrices @ _AXES), strict=True):
        stations += f"{place:.16f}\n" + "".join(f"{_rows(one)}\n\n" for one in both)
    damped, mu = int(bool(blade.damping)), np.abs(_AXES) @ blade.damping.of_strains
    contents = {
        path: _PRIMARY.format(count=len(keys), keys=_rows(keys + 0.0), blade=beside.name),
        beside: _BLADE.format(
            count=eta.size, damped=damped, mu=_rows(mu[None]),
            stations=stations,
        ),
    }  # fmt: skip
    for target, content in contents.items():
        with whole_file(target) as partial:
            partial.write_text(content, encoding="ascii")
    return list(contents)


def blade_file_of(path: Path) -> Path:
    """Return the path of the blade file that `write_beamdyn` writes next to a primary file."""
    return path.with_name(f"{path.stem}_Blade{path.suffix}")


def _rows(numbers: FloatArray) -> str:
    return "\n".join("  ".join(f"{one:23.16E}" for one in row) for row in numbers)


_PRIMARY = """\
--------- BEAMDYN INPUT FILE ---------------------------------------------------
Written by rotbeam_exu; SI units
---------------------- SIMULATION CONTROL --------------------------------------
False         Echo             - Echo input data (flag)
True          QuasiStaticInit  - Quasi-static start with centripetal accelerations (flag)
0             rhoinf           - Numerical damping of generalized-alpha (-)
2             quadrature       - 1: Gauss; 2: trapezoidal at the stations (switch)
"DEFAULT"     refine           - Refinement of trapezoidal quadrature (-)
"DEFAULT"     n_fact           - Iterations between factorizations (-)
"DEFAULT"     DTBeam           - Time step (s)
"DEFAULT"     load_retries     - Retries of a load (-)
"DEFAULT"     NRMax            - Largest number of iterations (-)
"DEFAULT"     stop_tol         - Tolerance (-)
"DEFAULT"     tngt_stf_fd      - Tangent by finite differences (flag)
"DEFAULT"     tngt_stf_comp    - Comparison of both tangents (flag)
"DEFAULT"     tngt_stf_pert    - Perturbation for finite differences (-)
"DEFAULT"     tngt_stf_difftol - Largest difference of both tangents (-)
True          RotStates        - States in the rotating frame during linearization (flag)
---------------------- GEOMETRY PARAMETER --------------------------------------
1             member_total     - Number of members (-)
{count:<13d} kp_total         - Number of key points (-)
1  {count}
kp_xr  kp_yr  kp_zr  initial_twist
(m)  (m)  (m)  (deg)
{keys}
---------------------- MESH PARAMETER ------------------------------------------
5             order_elem       - Order of the element (-)
---------------------- MATERIAL PARAMETER --------------------------------------
"{blade}"    BldFile - Name of the blade file (quoted string)
---------------------- OUTPUTS -------------------------------------------------
True          SumPrint         - Print summary data (flag)
"ES16.8E3"    OutFmt           - Format of the output (quoted string)
0             NNodeOuts        - Number of nodes to output (-)
1             OutNd            - Nodes whose values are output (-)
              OutList          - Output parameters
"RootFxr, RootFyr, RootFzr"
"RootMxr, RootMyr, RootMzr"
"TipTDxr, TipTDyr, TipTDzr"
"TipRDxr, TipRDyr, TipRDzr"
END of input file
--------------------------------------------------------------------------------
"""
_BLADE = """\
------- BEAMDYN INDIVIDUAL BLADE INPUT FILE ------------------------------------
Written by rotbeam_exu; SI units
------ Blade Parameters --------------------------------------------------------
{count:<13d} station_total    - Number of blade input stations (-)
{damped:<13d} damp_type        - 0: none; 1: proportional to stiffness; 2: modal (switch)
------ Stiffness-Proportional Damping [used only if damp_type=1] ---------------
mu1  mu2  mu3  mu4  mu5  mu6
(s)  (s)  (s)  (s)  (s)  (s)
{mu}
------ Modal Damping [used only if damp_type=2] --------------------------------
1             n_modes          - Number of modal damping coefficients (-)
0.0           zeta             - Damping ratio of each mode (-)
------ Distributed Properties --------------------------------------------------
{stations}"""
