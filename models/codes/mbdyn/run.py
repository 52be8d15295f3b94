"""MBDyn: beams of three nodes with lumped bodies, their root driven by Eq. 1."""

import math
import os
import runpy
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import bends_in_space, output_of, rows_of, sampled, take_part, twist_of

from rotbeam_exu.verification.case import Case
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.submission import Declaration

PROGRAM = os.environ.get("WITH_MBDYN", "")
SHEAR, TURNING = 1.0, 0.1
"""GA over EA, and rotary inertia over m EI/EA: of a beam that hardly shears, as slender ones."""

RADIUS = 0.6
"""Spectral radius of the multistep rule, that of MBDyn's manual."""


def speed(case: Case) -> str:
    """Return θ'(t) of Eq. 1 as MBDyn reads it."""
    of = case.rotation
    share, turn = f"Time/{of.ramp_time!r}", 2.0 * math.pi
    ramp = f"({share}-sin({turn!r}*{share})/{turn!r})"
    return f"{of.omega!r}*((Time<{of.ramp_time!r})*{ramp}+(Time>={of.ramp_time!r}))"


def model(case: Case, elements: int, h: float) -> list[str]:
    """Return the lines of the input file; the blade lies along x and turns about z."""
    blade, count = case.blade, 2 * elements + 1
    EA, EI, m = blade.axial_stiffness, blade.bending_stiffness, blade.mass_per_length
    cell, hub = blade.length / (count - 1), blade.hub_radius
    flap, GJ, tip = bends_in_space(blade)
    twist = np.linspace(0.0, tip, count)
    kicked = np.zeros((count, 2))
    if case.kick:
        state = case.start(np.linspace(0.0, blade.length, count))
        kicked = np.stack((state.velocity[:, 2], state.spin[:, 1]), axis=1)
    stiffness = f"diag, {EA!r}, {SHEAR * EA!r}, {SHEAR * EA!r}, {GJ!r}, {flap!r}, {EI!r}"
    law = f"linear elastic generic, {stiffness}"
    if tau := blade.damping.bending:
        law = f"linear viscoelastic generic, {stiffness}, diag, 0., 0., 0., 0., 0., {tau * EI!r}"
    masses = m * cell * np.where(np.arange(count) % (count - 1), 1.0, 0.5)
    per_mass = (TURNING if blade.section.out_of_plane is None else 1.0) / EA
    masses[-1] += sum(one.mass for one in blade.point_masses)
    weight = sum(load.gravity for load in case.loads)
    nodes = [
        f"structural: {i + 1}, dynamic, {hub + i * cell!r}, 0., 0., 1, 1., 0., 0., 2, 0., "
        f"{math.cos(turn)!r}, {math.sin(turn)!r}, 0., 0., {up!r}, 0., {spin!r}, 0., "
        f"output, {'yes' if i == count - 1 else 'no'};"
        for i, (turn, (up, spin)) in enumerate(zip(twist.tolist(), kicked.tolist(), strict=True))
    ]
    bodies = [
        f"body: {i + 1}, {i + 1}, {mass!r}, null, diag, "
        f"{per_mass * mass * (flap + EI)!r}, {per_mass * mass * flap!r}, {per_mass * mass * EI!r};"
        for i, mass in enumerate(masses.tolist())
    ]
    beams = [
        f"beam3: {e + 1}, {2 * e + 1}, null, {2 * e + 2}, null, {2 * e + 3}, null, from nodes, "
        f"{law}, same, same;"
        for e in range(elements)
    ]
    return [
        "begin: data; problem: initial value; end: data;", "begin: initial value;",
        f"initial time: 0.; final time: {case.duration!r}; time step: {h!r}; method: ms, {RADIUS};",
        "tolerance: 1.e-5; max iterations: 100; derivatives tolerance: 1e3;",
        "derivatives max iterations: 10; linear solver: naive;", "end: initial value;",
        "begin: control data;", f"structural nodes: {count + 1}; rigid bodies: {count};",
        f"beams: {elements}; joints: 2;", "gravity;" if weight else "", "output precision: 14;",
        "default output: none; default output: structural nodes;",
        "default orientation: orientation vector;", "end: control data;",
        "begin: nodes;", "structural: 1000, static, null, eye, null, null;", *nodes, "end: nodes;",
        "begin: elements;", "joint: 1, clamp, 1000, node, node;",
        f'joint: 2, axial rotation, 1000, null, 1, {-hub!r}, 0., 0., string, "{speed(case)}";',
        *bodies, *beams, f"gravity: uniform, 0., -1., 0., {weight!r};" if weight else "",
        "end: elements;",
    ]  # fmt: skip


def history(case: Case, elements: int, h: float):
    """Return what the case asks of place and turn of the tip, by axes that do not turn."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "blade.mbd").write_text("\n".join(model(case, elements, h)) + "\n")
        output_of([PROGRAM, "-s", "-f", "blade.mbd", "-o", "blade"], cwd=folder)
        rows = np.genfromtxt(Path(folder, "blade.mov"), usecols=range(7))
    rows = rows[rows[:, 0] == 2 * elements + 1, 1:]
    time = h * np.arange(len(rows))
    angle = case.rotation.angle(time)
    q = ((rows[:, :2] @ (1.0, 1j)) * np.exp(-1j * angle)).imag
    if len(case.columns) == 1:
        return sampled(case, time, q)
    turn = Rotation.from_rotvec(rows[:, 3:])
    back = Rotation.from_rotvec(np.outer(-angle, [0.0, 0.0, 1.0]))
    twist = twist_of(back * turn * turn[0].inv())
    return sampled(case, time, np.stack((q, rows[:, 2], twist), axis=1))


if __name__ == "__main__":
    if not PROGRAM:
        print("MBDyn is left out: set WITH_MBDYN to its program")
        sys.exit()
    declaration = Declaration(
        code="MBDyn", version="1.7.3", licence="GPL-2.1",
        url="https://public.gitlab.polimi.it/DAER/mbdyn", order=2.0, order_in_step=2.0,
        element=f"beam3, three nodes, lumped bodies; multistep rule with spectral radius {RADIUS}",
    )  # fmt: skip
    runs = [(16, 4e-3), (32, 4e-3), (64, 4e-3), (32, 8e-3), (32, 2e-3)]
    cases = "S1", "V", "S2", "S3", "S4", "S1+h", "S1+m", "S1+d", "S1+g", "W", "K"
    finer = [(32, 4e-3), (64, 4e-3), (128, 4e-3), (64, 2e-3), (64, 1e-3)]
    # Linearized, and at rest in the frame that turns, as for the real blades.
    blades = runpy.run_path(str(Path(__file__).parents[1] / "mbdyn_blades/run.py"))
    speeds = {name: CASES[name].speeds for name in ("L", "F", "F+p", "P", "G")}
    tables = rows_of(blades["numbers"], (16, 32, 64), speeds)
    histories = {**dict.fromkeys(cases, runs), "S4": finer}
    take_part(__file__, declaration, history, histories, rows=tables)
