"""A chain of point masses and springs in space takes part in case K, and in S1.

    python in_space.py K 16 1e-4

writes K/m016_h1e-4.csv and a row of runs.csv in the folder where it is run. Nodes 0 to n stand L/n
apart, at places (x, y, z) along b1, b2, b3, which turn with the clamp; steps are leapfrog's. The
tube bends alike in all directions, so torsion does no work: sections follow without twist.
"""

import sys
import time
from itertools import pairwise
from pathlib import Path

import numpy as np

L, EA, EI, RHO_A = 8.0, 5.0326605e6, 566.3553, 0.20196333  # of K and S1, as in cases.csv
OMEGA, T, DURATION = 6.0, 3.0, 15.0
KICK = {"K": 2.0, "S1": 0.0}
COLUMNS = {"K": "time,lag,flap,twist", "S1": "time,q"}


def rate(t):
    """Return θ' of Eq. 1."""
    return OMEGA / T * (t - T / (2 * np.pi) * np.sin(2 * np.pi * t / T)) if t < T else OMEGA


def acceleration(t):
    """Return θ'' of Eq. 1."""
    return OMEGA / T * (1 - np.cos(2 * np.pi * t / T)) if t < T else 0.0


def cross(a, b):
    """Return a × b of vectors in rows."""
    return np.stack(
        [
            a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
            a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
            a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
        ],
        axis=1,
    )


def links(r):
    """Return lengths and directions of the links, the clamp's direction first."""
    d = np.diff(r, axis=0)
    s = np.sqrt((d * d).sum(axis=1))
    return s, np.vstack([[1.0, 0.0, 0.0], d / s[:, None]])


def spring_forces(r, l):
    """Return the forces on nodes 1 to n, of springs EA/l along links and EI/l between them."""
    s, u = links(r)
    axis = cross(u[:-1], u[1:])  # of the rotation from one link to the next
    sine = np.sqrt((axis * axis).sum(axis=1))
    angle = np.arctan2(sine, (u[:-1] * u[1:]).sum(axis=1))
    moment = EI / l * axis * np.where(sine > 1e-9, angle / np.maximum(sine, 1e-9), 1.0)[:, None]
    moment[0] *= 2  # the clamp is half a link away from the first one
    after = np.vstack([moment[1:], [[0.0, 0.0, 0.0]]])
    push = (EA / l * (s - l))[:, None] * u[1:] + cross(moment - after, u[1:]) / s[:, None]
    return np.vstack([push[1:], [[0.0, 0.0, 0.0]]]) - push


def twist(r):
    """Return the twist of the tip: b2 and b3 are carried from link to link without twist."""
    _, u = links(r)
    b2, b3 = np.eye(3)[1:]
    for one, other in pairwise(u):
        both = one + other  # the rotation from one to the other
        b2, b3 = (b - both * (b @ other) / (1 + one @ other) for b in (b2, b3))
    return np.arctan2(b2[2], b3[2])


def history(case, n, h):
    """Return the rows of the file, every 10 ms."""
    l = L / n
    mass = np.full((n, 1), RHO_A * l)
    mass[-1] /= 2
    r, v = np.zeros((n + 1, 3)), np.zeros((n, 3))
    x = r[:, 0] = np.arange(n + 1) * l
    v[:, 2] = KICK[case] * (x[1:] / L) ** 2 * (6 - 4 * x[1:] / L + (x[1:] / L) ** 2) / 3
    every, steps = max(1, int(0.01 / h + 1e-9)), int(np.ceil(DURATION / h - 1e-9))
    rows = []
    for k in range(steps + 1):
        t = k * h
        if k % every == 0 or k == steps:
            lag, flap = r[-1, 1:]
            rows.append((t, lag, flap, twist(r)) if case == "K" else (t, lag))
        w, a = rate(t), spring_forces(r, l) / mass
        a[:, 0] += w**2 * r[1:, 0] + acceleration(t) * r[1:, 1]
        a[:, 1] += w**2 * r[1:, 1] - acceleration(t) * r[1:, 0]
        c = w * h if k else w * h / 2  # the first step starts from the velocity at t = 0
        a *= h if k else h / 2
        # Coriolis' force 2 w (v_y, -v_x), half of it with the velocity after the step.
        p, q = v[:, 0] + c * v[:, 1] + a[:, 0], v[:, 1] - c * v[:, 0] + a[:, 1]
        v[:, 0], v[:, 1] = (p + c * q) / (1 + c**2), (q - c * p) / (1 + c**2)
        v[:, 2] += a[:, 2]
        r[1:] += h * v
    return rows


def main(case, elements, step):
    """Write the files of one run."""
    n, h, started = int(elements), float(step), time.perf_counter()
    longest = L / n * np.sqrt(RHO_A / EA)
    if case not in KICK:
        sys.exit(f"this starter knows cases K and S1, not {case}: add it from cases.csv")
    if not 0 < h <= longest:
        sys.exit(
            f"with {n} elements the step must be at most {longest:.1e} s, or waves along run away"
        )
    name = f"{case}/m{n:03d}_h{step}.csv"
    Path(case).mkdir(exist_ok=True)
    np.savetxt(name, history(case, n, h), "%.17g", ",", header=COLUMNS[case], comments="")
    is_new = not Path("runs.csv").exists()
    with Path("runs.csv").open("a") as file:
        if is_new:
            file.write("file,elements,dof,step,wall_s\n")
        file.write(f"{name},{n},{3 * n},{step},{time.perf_counter() - started:.6g}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
