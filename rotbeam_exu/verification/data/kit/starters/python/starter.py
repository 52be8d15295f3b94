"""A chain of point masses, axial springs and rotational springs takes part in case S1.

    python starter.py S1 16 1e-4

writes S1/m016_h1e-4.csv and a row of runs.csv in the folder where it is run. Nodes 0 to n stand L/n
apart, as complex numbers z = x + iy in the frame that turns with the clamp; steps are leapfrog's.
"""

import sys
import time
from pathlib import Path

import numpy as np

L, EA, EI, RHO_A = 8.0, 5.0326605e6, 566.3553, 0.20196333  # of S1, as in cases.csv
OMEGA, T, DURATION = 6.0, 3.0, 15.0


def rate(t):
    """Return θ' of Eq. 1."""
    return OMEGA / T * (t - T / (2 * np.pi) * np.sin(2 * np.pi * t / T)) if t < T else OMEGA


def acceleration(t):
    """Return θ'' of Eq. 1."""
    return OMEGA / T * (1 - np.cos(2 * np.pi * t / T)) if t < T else 0.0


def spring_forces(z, l):
    """Return the forces on nodes 1 to n, of springs EA/l along links and EI/l between them."""
    d = np.diff(z)
    s = np.abs(d)
    # The clamp is half a link away from the first one, hence a spring twice as stiff.
    bend = np.concatenate(([2 * np.angle(d[0])], np.angle(d[1:] * d[:-1].conj()), [0.0])) * EI / l
    push = EA / l * (s - l) * d / s + (bend[:-1] - bend[1:]) * 1j * d / s**2
    return np.append(push[1:], 0.0) - push


def history(n, h):
    """Return time, q and dq/dt, every 10 ms."""
    l = L / n
    mass = np.full(n, RHO_A * l)
    mass[-1] /= 2
    z, v = np.arange(n + 1) * l + 0j, np.zeros(n, dtype=complex)
    every, steps = max(1, int(0.01 / h + 1e-9)), int(np.ceil(DURATION / h - 1e-9))
    rows = []
    for k in range(steps + 1):
        t = k * h
        w, before = rate(t), v
        a = spring_forces(z, l) / mass + (w**2 - 1j * acceleration(t)) * z[1:]
        v = ((1 - 1j * w * h) * v + h * a) / (1 + 1j * w * h)  # Coriolis' force of both half steps
        if k % every == 0 or k == steps:
            rows.append((t, z[-1].imag, (before[-1].imag + v[-1].imag) / 2))
        z[1:] += h * v
    return rows


def main(case, elements, step):
    """Write the files of one run."""
    n, h, started = int(elements), float(step), time.perf_counter()
    longest = L / n * np.sqrt(RHO_A / EA)
    if case != "S1":
        sys.exit(f"this starter knows case S1, not {case}: add it from cases.csv")
    if not 0 < h <= longest:
        sys.exit(
            f"with {n} elements the step must be at most {longest:.1e} s, or waves along run away"
        )
    name = f"S1/m{n:03d}_h{step}.csv"
    Path("S1").mkdir(exist_ok=True)
    np.savetxt(name, history(n, h), "%.17g", ",", header="time,q,q_dot", comments="")
    is_new = not Path("runs.csv").exists()
    with Path("runs.csv").open("a") as file:
        if is_new:
            file.write("file,elements,dof,step,wall_s\n")
        file.write(f"{name},{n},{2 * n},{step},{time.perf_counter() - started:.6g}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
