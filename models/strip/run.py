"""The strip's spin-up out of its plane by three codes, into a table each: hours in all.

``python models/strip/run.py exact 112 2e-3``, ``88``, ``72``, ``56``, ``exudyn 128 2.5e-4``,
``exudyn 64 2.5e-4``, ``mujoco 64 1e-4`` and ``mujoco 32 1e-4``. MuJoCo wants ``pip install
mujoco``. The rectangle with the paper's A and I turns by Eq. 1, up to 6 rad/s in 3 s, and starts at
rest, 8 mm out of the plane in its first flap mode. No code has the trapeze effect.

The exact blade has 56 functions for flap up to 0.55 s, and then as many as asked. The tables of 112
and 88 took half of the time, 17 and 10 minutes of CPU. They have half as many functions in lag (64
and 56) and fewer in torsion (84 and 72) and along the axis (34 and 30). Their steps are 2 ms, from
1 s on 1.25 ms, and from 1.25 s on 0.6 ms.

Two other cases start 1e-6 L out of the plane, by the exact blade alone. One is ``exact 136 2e-3
small``, ``112`` and ``88``, which took 68, 39 and 23 minutes of CPU. It has more functions from
0.6 s on, with 136 of them 76 for lag, and steps of 0.6 ms from 1 s on. The other is ``exact 40
2.5e-3 mildest`` and ``exact 32 2.5e-3 mildest``.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analytic import Beam, Rectangle, SpinUp, Theory, linear_modes
from analytic.arrays import FloatArray
from analytic.exact.continuum.discretization import space_continuum
from analytic.exact.continuum.planar_rotation import on_more
from analytic.exact.driven.transient import integrated
from analytic.exact.linear.families import flap_shape
from analytic.motion import SpeedChange
from analytic.threads import one_thread
from rotbeam_exu import kicked, simulate

HERE = Path(__file__).parent
STRIP = Beam.reference().with_shape(Rectangle())
MOTION, KICK = SpinUp(omega=6.0, ramp_time=3.0), 1e-3
TIMES = np.linspace(0.0, 1.5, 151)
CASES = {  # ramp, kick over L, times, and row of the time up to which few functions do
    "": (MOTION, KICK, TIMES, 55),
    "small": (MOTION, 1e-6, TIMES, 60),
    "mildest": (SpinUp(omega=2.0, ramp_time=3.375), 1e-6, np.linspace(0.0, 1.4, 141), 100),
}
FEW = 56
THEORY = Theory(trapeze=False, rotary_inertia=True)


@dataclass(frozen=True, kw_only=True)
class FirstHalf(SpeedChange):
    """The motion up to the last of TIMES, and then steady, for a code that runs all of a ramp."""

    start, omega = 0.0, 0.5 * MOTION.omega
    ramp_time, shortest_wave = 0.5 * MOTION.ramp_time, MOTION.ramp_time

    def _within(self, t: Any, derivative: int) -> Any:
        return (MOTION.angle, MOTION.rate, MOTION.acceleration)[derivative](t)


HEADER = "time,along,lag,flap,twist"  # places of the tip over L, in the frame that turns


def write(code: str, time: FloatArray, tip: FloatArray, twist: FloatArray) -> None:
    """Write the table of a code."""
    rows = np.column_stack((time, tip, twist))
    np.savetxt(HERE / f"{code}.csv", rows, "%.10g", ",", header=HEADER, comments="")


@one_thread
def exact(functions: str, step: str = "1.25e-3", case: str = "") -> None:
    """Radau steps of order 15, by functions for each curvature.

    `spin_up_response` chooses both by itself; it has fewer functions than the buckling asks.
    """
    motion, kick, times, few = CASES[case]
    model = space_continuum(STRIP, THEORY, min(FEW, int(functions)))
    q, rates, rows = kick * flap_shape(model), 0.0, []
    for part in filter(len, (times[: few + 1], times[few:])):
        grid = np.linspace(part[0], part[-1], round((part[-1] - part[0]) / float(step)) + 1)
        found = integrated(STRIP, motion, (), model, grid, part, times[:0], q, rates)
        if found is None:
            raise SystemExit("Newton's method fails: take a shorter step")
        rows.append(np.column_stack((found.tip, found.twist))[bool(rows) :])
        fewer, model = model, space_continuum(STRIP, THEORY, int(functions))
        q, rates = on_more(found.steps.passed[:, -1], fewer.families, model.families)
    name = "_".join(filter(None, ("exact", case, functions)))
    table = np.concatenate(rows)
    write(name, times, table[:, :3], table[:, 3])


def exudyn(elements: str, step: str) -> None:
    """Elements of order 2, which shear."""
    run = simulate(
        STRIP, FirstHalf(), element="space_exact", elements=int(elements), step=float(step),
        duration=1.51, initial_state=kicked(STRIP, KICK, by_mode=True),
    )  # fmt: skip
    run = run.sel(time=TIMES, method="nearest")
    write(
        f"exudyn_{elements}",
        TIMES,
        run["axis"].isel(node=-1).to_numpy() / STRIP.length,
        run["twist"],
    )


def mujoco(links: str, step: str) -> None:
    """Rigid links, which do not stretch: three hinges with springs at each joint."""
    import mujoco as mj  # noqa: PLC0415

    count, h, hub = int(links), float(step), 1e8  # inertia of the hub, which the strip cannot turn
    beam, out = STRIP.section, STRIP.section.out_of_plane
    link = STRIP.length / count
    mass = beam.mass_per_length * link
    j = mass * beam.bending_stiffness / beam.axial_stiffness
    hinges = (("0 0 1", 1.0), ("0 -1 0", out.bending_ratio), ("1 0 0", out.torsion_ratio))
    chain = ""
    for k in range(count):
        spring = (1 if k else 2) * beam.bending_stiffness / link  # the clamp is half a link away
        chain += f'<body pos="{link if k else 0} 0 0">' + "".join(
            f'<joint type="hinge" axis="{axis}" stiffness="{ratio * spring}"/>'
            for axis, ratio in hinges
        )
        j2 = j * out.bending_ratio
        chain += (
            f'<inertial pos="{link / 2} 0 0" mass="{mass}" '
            f'diaginertia="{j + j2} {mass * link**2 / 12 + j2} {mass * link**2 / 12 + j}"/>'
        )
    model = mj.MjModel.from_xml_string(
        f'<mujoco><option timestep="{h}" integrator="RK4" gravity="0 0 0"><flag contact="disable" '
        'constraint="disable"/></option><worldbody><body><joint type="hinge" axis="0 0 1" '
        f'armature="{hub}"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{chain}'
        f'<site name="tip" pos="{link} 0 0"/>{"</body>" * count}</body></worldbody></mujoco>'
    )
    data, tip = mj.MjData(model), []
    middles = (np.arange(count) + 0.5) * link
    near = np.add.outer(1e-4 * link * np.array([1.0, -1.0]), middles)
    flap = linear_modes(STRIP, 0.0, 1, only="flap").shapes(near.ravel())[2].real
    above, below = flap.reshape(2, -1)
    slopes = KICK * STRIP.length * (above - below) / (2e-4 * link)
    data.qpos[2::3] = np.diff(slopes, prepend=0.0)
    t = h * np.arange(round(TIMES[-1] / h) + 1)
    angle, rate, push = MOTION.angle(t), MOTION.rate(t), hub * MOTION.acceleration(t + h / 2)
    for k in range(t.size):
        data.qpos[0] = angle[k]
        if k % round(TIMES[1] / h) == 0:
            mj.mj_kinematics(model, data)
            x, y, z = data.site("tip").xpos / STRIP.length
            turned = (x + 1j * y) * np.exp(-1j * angle[k])
            section = data.site("tip").xmat.reshape(3, 3)
            tip.append((turned.real, turned.imag, z, np.arctan2(section[2, 1], section[2, 2])))
        data.qvel[0], data.qfrc_applied[0] = rate[k], push[k]
        mj.mj_step(model, data)
    write(f"mujoco_{links}", TIMES, np.array(tip)[:, :3], np.array(tip)[:, 3])


if __name__ == "__main__":
    {one.__name__: one for one in (exact, exudyn, mujoco)}[sys.argv[1]](*sys.argv[2:])
