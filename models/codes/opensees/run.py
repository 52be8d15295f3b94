"""OpenSees: dispBeamColumn in corotational frames of space, which turn farther than the plane's."""

import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from scipy.linalg import eigh

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, take_part

from rotbeam_exu.verification.cases import Case
from rotbeam_exu.verification.submission import Declaration


def build(case: Case, n: int, clamped: int) -> float:
    """Make the model, whose clamp turns if `clamped` is 0, and return the mass of a node."""
    beam = case.blade
    link = beam.length / n
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i in range(n + 1):
        ops.node(i, i * link, 0.0, 0.0)
        ops.fix(i, *((1, 1, 1, 1, 1, clamped) if i == 0 else (0, 0, 1, 1, 1, 0)))
    ops.geomTransf("Corotational", 1, 0.0, 0.0, 1.0)
    E, A, I = beam.youngs_modulus, beam.area, beam.second_moment
    ops.section("Elastic", 1, E, A, I, I, E / 2, 2 * I)
    ops.beamIntegration("Legendre", 1, 1, 2)  # two points: bending moments are linear
    for i in range(n):
        ops.element("dispBeamColumn", i, i, i + 1, 1, 1, "-mass", beam.mass_per_length)
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.constraints("Transformation")
    ops.test("NormDispIncr", 1e-9, 50)
    ops.algorithm("Newton")
    return beam.mass_per_length * link


def history(case: Case, n: int, h: float):
    """Lead the clamp by its angle at each step; Newmark's trapezoidal rule."""
    build(case, n, 0)
    steps = round(case.duration / h)
    angles = [float(case.rotation.angle(k * h)) for k in range(steps + 2)]
    ops.timeSeries("Path", 1, "-dt", h, "-values", *angles)
    ops.pattern("Plain", 1, 1)
    ops.sp(0, 6, 1.0)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    tip = [complex(case.blade.length)]
    for _ in range(round(case.duration / SPACING)):
        if ops.analyze(round(SPACING / h), h):
            raise RuntimeError(f"Newton's method fails at {ops.getTime():.4g} s")
        tip.append(complex(case.blade.length + ops.nodeDisp(n, 1), ops.nodeDisp(n, 2)))
    return across(case, tip)


def frequency(case: Case, n: int, speed: float) -> float:
    """Stretch by centrifugal forces; add Coriolis' to the stiffness that OpenSees has there."""
    mass = build(case, n, 1)
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    shares = mass * np.array([*(n - 1) * [1.0], 0.5])
    for repeat in range(4):  # at the stretched places
        ops.remove("loadPattern", 1)
        ops.timeSeries("Constant", repeat + 2)
        ops.pattern("Plain", 1, repeat + 2)
        for i in range(1, n + 1):
            place = ops.nodeCoord(i, 1) + ops.nodeDisp(i, 1)
            ops.load(i, shares[i - 1] * speed**2 * place, *5 * [0.0])
        if ops.analyze(1):
            raise RuntimeError("Newton's method fails")
    K = np.array(ops.printA("-ret")).reshape(3 * n, 3 * n)
    M, found = np.diag(np.kron(shares, [1.0, 1.0, 0.0])), 0.0  # turns have no mass
    swap = np.kron(np.diag(shares), [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    for _ in range(5):  # x as a cosine, y as a sine
        still = K - speed**2 * M - 2.0 * speed * found * swap
        found = eigh(M, still, eigvals_only=True)[-1] ** -0.5
    return found


if __name__ == "__main__":
    told = Declaration(
        code="OpenSees", version=version("openseespy"), url="https://opensees.berkeley.edu",
        licence="BSD-like, not for sale", element="dispBeamColumn, corotational; lumped mass",
        order=2.0, order_in_step=2.0,
    )  # fmt: skip
    runs = [(32, 2e-3), (64, 2e-3), (32, 4e-3), (32, 1e-3), (128, 2e-3)]
    take_part(__file__, told, history, {"S1": runs}, frequency, (32, 64, 128))
