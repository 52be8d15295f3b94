"""MuJoCo: rigid links with hinges and springs, Runge-Kutta of order four."""

import sys
from importlib.metadata import version
from pathlib import Path

import mujoco
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, take_part

from rotbeam_exu.verification.cases import Case
from rotbeam_exu.verification.submission import Declaration

HUB = 1e8  # inertia of the hub, which the beam cannot turn [kg m²]


def build(case: Case, n: int, h: float):
    """Return model and data; the first joint is the hub's, which drives the clamp."""
    beam = case.blade
    l = beam.length / n
    m = beam.mass_per_length * l
    links = ""
    for k in range(n):
        spring = (1 if k else 2) * beam.bending_stiffness / l  # the clamp is half a link away
        links += (
            f'<body pos="{l if k else 0} 0 0"><joint type="hinge" axis="0 0 1" '
            f'stiffness="{spring}"/><inertial pos="{l / 2} 0 0" mass="{m}" '
            f'diaginertia="{m * l**2 / 1e4} {m * l**2 / 12} {m * l**2 / 12}"/>'
        )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{h}" integrator="RK4" gravity="0 0 0"><flag contact="disable" '
        'constraint="disable"/></option><worldbody><body><joint type="hinge" axis="0 0 1" '
        f'armature="{HUB}"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{links}'
        f'<site name="tip" pos="{l} 0 0"/>{"</body>" * n}</body></worldbody></mujoco>'
    )
    return model, mujoco.MjData(model)


def history(case: Case, n: int, h: float):
    """Set the hub's angle and rate before each step, and give it the torque of its acceleration."""
    model, data = build(case, n, h)
    t = h * np.arange(round(case.duration / h) + 1)
    angle, rate = case.rotation.angle(t), case.rotation.rate(t)
    torque, tip = HUB * case.rotation.acceleration(t + h / 2), [complex(case.blade.length)]
    for k in range(t.size - 1):
        data.qpos[0], data.qvel[0], data.qfrc_applied[0] = angle[k], rate[k], torque[k]
        mujoco.mj_step(model, data)
        if (k + 1) % round(SPACING / h) == 0:
            data.qpos[0] = angle[k + 1]
            mujoco.mj_kinematics(model, data)
            tip.append(complex(*data.site("tip").xpos[:2]))
            if any(warning.number for warning in data.warning):
                raise RuntimeError(f"unstable at {t[k]:.3g} s: MuJoCo warns of large accelerations")
    return across(case, tip)


def frequency(case: Case, n: int, speed: float) -> float:
    """Differentiate the accelerations about the straight turning chain."""
    model, data = build(case, n, 1e-3)

    def acceleration(state):
        data.qpos[1:], data.qvel[:] = state[:n], [speed, *state[n:]]
        mujoco.mj_forward(model, data)
        return data.qacc[1:].copy()

    columns = [acceleration(1e-7 * e) - acceleration(-1e-7 * e) for e in np.eye(2 * n)]
    system = np.vstack([np.eye(n, 2 * n, n), np.array(columns).T / 2e-7])
    return np.abs(np.linalg.eigvals(system).imag).min()


if __name__ == "__main__":
    told = Declaration(
        code="MuJoCo", version=version("mujoco"), url="https://mujoco.org", licence="Apache-2.0",
        element="rigid links, hinges with springs", inextensible=True, order=2.0, order_in_step=2.0,
    )  # fmt: skip
    runs = [(32, 2e-4), (32, 1e-4), (64, 1e-4), (64, 5e-5), (128, 2.5e-5)]
    take_part(__file__, told, history, {"S1": runs}, frequency, (32, 64, 128, 256))
