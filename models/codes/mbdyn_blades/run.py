"""MBDyn on real blades: beams of three nodes between the stations of a table, by its matrices."""

import os
import re
import sys
import tempfile
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.linalg import LinearOperator, eigs, splu
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import bends_in_space, output_of, root_axes, rows_of, sampled, take_part, twist_of

from analytic import Blade, Theory
from analytic.exact.continuum.unit import space_unit
from analytic.quadrature import gauss_points
from analytic.station_section import StationSection
from rotbeam_exu.verification.case import Asked, Case
from rotbeam_exu.verification.cases import CASES, SHEAR
from rotbeam_exu.verification.submission import Declaration

PROGRAM = os.environ.get("WITH_MBDYN", "")
MEMBERS = 1, 2, 4
"""Beams between two stations."""

STEP, STILL = 20.0, 20
"""Step [s] by which the steady state is found, and steps after speed and weight are raised: the
multistep rule with spectral radius 0 damps all motion between."""

RAISED = 80, 400
"""Steps in which they are raised, of the real blades and of a plastic one."""

STIFF = 10.0
"""GA over EA of a beam that does not shear."""

ROUND_OFF = 3e-15
"""Residual that is left, over the largest stiffness times the number of beams."""

RADIUS = 0.6
"""Spectral radius of the rule in a run-up, that of MBDyn's manual."""


@dataclass(frozen=True)
class Motion:
    """Time, and the motion of the frame, which turns about z, as an input file has them."""

    solver: str
    end: float
    speed: str  # drives [rad/s], [rad/s²], and of gravity's three components
    acceleration: str
    gravity: str


def steady(case: Case, omega: float) -> Motion:
    """Raise the speed, then the weight, which is along the axis, and wait."""
    weight = sum(load.gravity for load in case.loads)
    half = 0.5 * STEP * RAISED[not isinstance(case.blade.section, StationSection)]
    end = 2.0 * half + STILL * STEP
    speed, down = (
        f"ramp, {of / half!r}, {start!r}, {start + half!r}, 0."
        for of, start in ((omega, 0.0), (weight, half))
    )
    eigen = f"eigenanalysis: {end!r}, parameter, 1e-2, output sparse matrices, "
    eigen += "matrix output precision, 16;"
    return Motion(
        solver=f"method: ms, 0.; {eigen * (case.asked is Asked.FREQUENCIES)}", end=end,
        speed=speed, acceleration="null", gravity=f"uniform, 0., 0., -1., {down}",
    )  # fmt: skip


def run_up(case: Case, h: float) -> Motion:
    """Raise the weight at rest and wait; then Eq. 1, in whose frame the weight turns."""
    raised = STEP * RAISED[0]
    start = raised + STEP * STILL
    of, t = case.rotation, f"(Time-{start!r})"
    ramp, wave = of.ramp_time, f"{2.0 * np.pi / of.ramp_time!r}*{t}"
    began, ended = f"({t}>0.)", f"({t}>={ramp!r})"
    first = f"({t}^2/2.+{(ramp / (2.0 * np.pi)) ** 2!r}*(cos({wave})-1.))"
    angle = f"{began}*{of.omega!r}*((1-{ended})*{first}/{ramp!r}+{ended}*({t}-{0.5 * ramp!r}))"
    share = f"{t}/{ramp!r}-sin({wave})/{2.0 * np.pi!r}"
    speed = f"{began}*{of.omega!r}*((1-{ended})*({share})+{ended})"
    acceleration = f"{began}*(1-{ended})*{of.omega / ramp!r}*(1.-cos({wave}))"
    (load,) = case.loads
    down = f"-{load.gravity / raised!r}*((Time<{raised!r})*Time+(Time>={raised!r})*{raised!r})"
    now = f"(Time<{start - 0.5 * STEP!r})"
    return Motion(
        solver=f'method: ms, string, "{RADIUS}*(1-{now})"; '
        f'strategy: change, string, "{STEP!r}*{now}+{h!r}*(1-{now})"; min time step: {h / 2!r}; '
        f"max time step: {STEP!r};",
        end=start + case.duration,
        speed=f'string, "{speed}"', acceleration=f'string, "{acceleration}"',
        gravity=f'component, string, "{down}*sin({angle})", string, "{down}*cos({angle})", null',
    )  # fmt: skip


def joined(values) -> str:
    """Return numbers as MBDyn reads them."""
    return ", ".join(f"{value!r}" for value in np.ravel(values).tolist())


def lumped(mass: np.ndarray) -> str:
    """Return mass, its center and the inertia about this, of a 6x6 matrix about a node."""
    m = mass[0, 0]
    center = np.array([mass[1, 5], mass[2, 3], mass[0, 4]]) / m
    cross = np.cross(np.eye(3), center)
    inertia = mass[3:, 3:] - m * cross @ cross.T
    return f"{float(m)!r}, {joined(center)}, matr, {joined(0.5 * (inertia + inertia.T))}"


def sections(blade: Blade) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return stations [m], and stiffness and mass there; of a uniform blade that hardly shears."""
    section = blade.section
    if isinstance(section, StationSection):
        return tuple(map(np.array, (section.x, section.stiffness, section.mass)))
    flap, GJ, _ = bends_in_space(blade)
    EA, EI, m = blade.axial_stiffness, blade.bending_stiffness, blade.mass_per_length
    turning = m / EA * np.array([flap + EI, flap, EI])
    stiffness = np.diag([EA, STIFF * EA, STIFF * EA, GJ, flap, EI])
    ends = np.ones((2, 1, 1))
    return blade.length * np.arange(2), ends * stiffness, ends * np.diag([m, m, m, *turning])


def unloaded(blade: Blade, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return places [m] of the line, (places, 3), and axes of its sections, in the root's axes."""
    if isinstance(blade.section, StationSection):
        place, axes = space_unit(blade).unloaded(x / blade.length)
        return blade.length * place, axes
    along = np.outer(x, [1.0, 0.0, 0.0])
    twist = bends_in_space(blade)[2] / blade.length
    return along, Rotation.from_rotvec(twist * along).as_matrix()


def model(case: Case, each: int, motion: Motion) -> list[str]:
    """Return the lines of the input file; the hub is along x."""
    blade = case.blade
    table, stiffness, mass = sections(blade)
    ends = np.unique(np.concatenate([np.linspace(a, b, each + 1) for a, b in pairwise(table)]))
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    x = np.sort(np.concatenate((ends, middle)))
    (place, axes), root = unloaded(blade, x), root_axes(blade)
    place, axes = place @ root.T + [blade.hub_radius, 0.0, 0.0], root @ axes

    def linear(matrices: np.ndarray, at: np.ndarray) -> np.ndarray:
        """Return matrices of the table at places, linear between its stations."""
        flat = matrices.reshape(table.size, 36).T
        return np.stack([np.interp(at.ravel(), table, one) for one in flat], 1).reshape(-1, 6, 6)

    inner, weights = gauss_points(2)
    halves = np.sort(np.concatenate((x, 0.5 * (x[1:] + x[:-1]))))
    points = halves[:-1, None] + np.outer(np.diff(halves), inner)
    at_points = linear(mass, points).reshape(-1, 2, 6, 6)
    of_halves = np.einsum("c,g,cgij->cij", np.diff(halves), weights, at_points)
    bodies = np.zeros((x.size, 6, 6))
    bodies[:-1] += of_halves[::2]
    bodies[1:] += of_halves[1::2]
    laws = [linear(stiffness, middle + sign * half / np.sqrt(3.0)) for sign in (-1.0, 1.0)]
    law = "from nodes, linear elastic generic, matr"
    spin = [f"single, 0., 0., 1., {one}" for one in (motion.speed, motion.acceleration)]
    return [
        "begin: data; problem: initial value; end: data;", "begin: initial value;",
        f"initial time: 0.; final time: {motion.end!r}; time step: {STEP!r};", motion.solver,
        f"tolerance: {ROUND_OFF * middle.size * stiffness[:, :3].max():.3g}; "
        "max iterations: 200; derivatives tolerance: 1e9;",
        "derivatives max iterations: 10; linear solver: naive;", "end: initial value;",
        "begin: control data;",
        f"structural nodes: {x.size}; rigid bodies: {x.size}; beams: {middle.size}; joints: 1;",
        f"rigid body kinematics: drive, angular velocity, {spin[0]}, "
        f"angular acceleration, {spin[1]};", "gravity; output precision: 16;",
        "default output: none; default output: structural nodes, joints;",
        "default orientation: orientation vector;", "end: control data;", "begin: nodes;",
        *(f"structural: {k + 1}, dynamic, {joined(p)}, 1, {joined(a[:, 0])}, 2, {joined(a[:, 1])}, "
          f"null, null, output, {'yes' if k == x.size - 1 else 'no'};"
          for k, (p, a) in enumerate(zip(place, axes, strict=True))),
        "end: nodes;", "begin: elements;", "joint: 1, clamp, 1, node, node;",
        *(f"body: {k + 1}, {k + 1}, {lumped(one)};" for k, one in enumerate(bodies)),
        *(f"beam3: {e + 1}, {2 * e + 1}, null, {2 * e + 2}, null, {2 * e + 3}, null, "
          f"{law}, {joined(one)}, {law}, {joined(two)};"
          for e, (one, two) in enumerate(zip(*laws, strict=True))),
        f"gravity: {motion.gravity};", "end: elements;",
    ]  # fmt: skip


def computed(case: Case, each: int, motion: Motion) -> tuple[np.ndarray, str]:
    """Return lag, flap and twist of the tip and the root's moment over time, and eigenanalysis."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "blade.mbd").write_text("\n".join(model(case, each, motion)) + "\n")
        output_of([PROGRAM, "-s", "-f", "blade.mbd", "-o", "blade"], cwd=folder)
        tip = np.loadtxt(Path(folder, "blade.mov"), usecols=range(1, 7))
        moment = np.loadtxt(Path(folder, "blade.jnt"), usecols=range(10, 13))
        eigen = Path(folder, "blade_0.m")
        text = eigen.read_text() if eigen.exists() else ""
    root, hub = root_axes(case.blade), [case.blade.hub_radius, 0.0, 0.0]
    place, turn = (tip[:, :3] - hub) @ root, Rotation.from_rotvec(tip[:, 3:])
    back = Rotation.from_matrix(root.T)
    twist = twist_of(back * turn * turn[0].inv() * back.inv())
    return np.column_stack((place[:, 1:], twist, moment @ root)), text


def history(case: Case, each: int, h: float):
    """Return the tip and the root's moment in a run-up."""
    found, _ = computed(case, each, run_up(case, h))
    found = found[-round(case.duration / h) - 1 :]
    return sampled(case, h * np.arange(len(found)), found)


def numbers(case: Case, each: int, omega: float) -> list[float]:
    """Return frequencies [rad/s] about the steady state, or its tip."""
    found, text = computed(case, each, steady(case, omega))
    return frequencies(text, case.count) if text else found[-1, :3].tolist()


def frequencies(text: str, count: int) -> list[float]:
    """Return the lowest ones, of F/x' ± c F/x in MBDyn's file of eigenanalysis."""
    c = float(re.search(r"dCoef = ([^;]*);", text)[1])
    plus, minus = (
        np.fromstring(re.search(rf"A{name} = \[([^]]*)\]", text)[1].replace(";", " "), sep=" ")
        .reshape(-1, 3).T for name in ("plus", "minus")
    )  # fmt: skip
    size = int(plus[:2].max())
    plus, minus = (
        coo_array((one[2], (one[:2] - 1.0).astype(int)), shape=(size, size)).tocsc()
        for one in (plus, minus)
    )
    # λ rates + stiffness = 0, both singular: the largest 1/(λ - 1).
    rates, stiffness = 0.5 * (plus + minus), 0.5 / c * (plus - minus)
    factors = splu((stiffness + rates).tocsc())
    inverse = LinearOperator((size, size), matvec=lambda v: -factors.solve(rates @ v), dtype=float)
    found = 1.0 / eigs(inverse, 2 * count + 14, return_eigenvectors=False)
    return sorted(found.imag[found.imag > 1e-3 * found.imag.max()].tolist())[:count]


if __name__ == "__main__":
    if not PROGRAM:
        print("MBDyn is left out: set WITH_MBDYN to its program")
    else:
        declaration = Declaration(
            code="MBDyn, real blades", version="1.7.3", licence="GPL-2.1", order=2.0,
            url="https://public.gitlab.polimi.it/DAER/mbdyn", order_in_step=2.0,
            theory=Theory(shear=SHEAR, rotary_inertia=True),
            element="beam3, three nodes, lumped bodies; elements are beams between two stations",
        )  # fmt: skip
        runs = [(1, 5e-3), (2, 5e-3), (4, 5e-3), (2, 2.5e-3), (2, 1.25e-3)]
        speeds = {name: CASES[name].speeds for name in ("F+N", "G+N", "F+I", "G+I")}
        tables = rows_of(numbers, MEMBERS, speeds)
        take_part(__file__, declaration, history, dict.fromkeys(("W+N", "W+I"), runs), rows=tables)
