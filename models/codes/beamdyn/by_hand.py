"""Three choices of BeamDyn by hand: what its driver prints for a steadily turning blade.

A blade of 60 m with 13 key points on a hub of 1 m turns at 1.2 rad/s. Nothing here comes from this
package: numpy and scipy alone. The quadrature is BeamDyn's trapezoidal rule, refine 16. `PRINTED`
has its numbers, of OpenFAST 4, commit 2895884d2: order, then elongation of the tip [m] with a
stiffness of kinks, root's torsional moment [N m] with a twist of kinks, or turn of the tip's
section [rad] with a linear twist.
"""

import numpy as np
from numpy.polynomial import Polynomial
from numpy.polynomial.legendre import Legendre
from scipy.integrate import solve_bvp

HUB, LENGTH, OMEGA, MASS = 1.0, 60.0, 1.2, 200.0
STATIONS = np.linspace(0.0, LENGTH, 13)
EA = 1e9 * np.array([9.0, 9.0, 4.0, 4.0, 3.0, 2.5, 2.5, 1.6, 1.2, 0.8, 0.5, 0.3, 0.1])
EVEN_EA, GJ, EI_SUM, INERTIA = 3e9, 1e8, 2.5e9, 80.0
"""[N, N m², N m², kg m]: EI_SUM of both bendings, INERTIA the difference of both rotary ones."""
TWIST = np.radians([13.0, 13.0, 13.0, 11.0, 10.0, 9.0, 8.0, 6.0, 4.5, 3.0, 2.0, 0.5, 0.0])
LINEAR = np.radians(13.0) * (1.0 - STATIONS / LENGTH)

PRINTED = {
    "elongation": {5: 0.01123734249008379, 15: 0.01114280869677486, 25: 0.01114764617980768},
    "moment": {8: 853.7337053998065, 15: 853.7337641046014},
    "turn": {8: 1.548879072404149e-4, 10: 1.548879072404105e-4},
}


def elongation(order=None):
    """Elongation [m] with one polynomial for the stretch of all the blade, or exact.

    BeamDyn has one polynomial for each member, and EA is linear between the stations.
    """
    x = np.linspace(0.0, LENGTH, 16 * (STATIONS.size - 1) + 1)
    if order is None:  # N/EA of the rod, whose own stretch adds 1e-4 of the centrifugal force
        x = np.linspace(0.0, LENGTH, 400_001)
        stiff, u = np.interp(x, STATIONS, EA), np.zeros(x.size)
        for _ in range(3):
            force = OMEGA**2 * MASS * (HUB + x + u)
            outboard = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(x)))
            strain = (outboard[-1] - outboard) / stiff
            u = np.append(0.0, np.cumsum(0.5 * (strain[1:] + strain[:-1]) * np.diff(x)))
        return u[-1]
    weight = np.gradient(x)
    weight[[0, -1]] *= 0.5
    slopes = [Legendre.basis(k, [0.0, LENGTH]) for k in range(order)]
    shapes = np.stack([slope.integ(lbnd=0.0)(x) for slope in slopes])
    bent = np.stack([slope(x) for slope in slopes])
    turning = OMEGA**2 * MASS * weight
    matrix = (bent * weight * np.interp(x, STATIONS, EA)) @ bent.T - (shapes * turning) @ shapes.T
    return np.linalg.solve(matrix, shapes @ (turning * (HUB + x))) @ shapes[:, -1]


def torsion(twist, trapeze=0.0):
    """Root's moment [N m] and turn of the tip's section [rad] by the propeller moment.

    ((GJ + trapeze ε) φ')' = -ω² INERTIA sin(β + φ) cos(β + φ), of an initial twist β(x) [rad] and
    an axial strain ε. The mass lies along the axis of rotation, and turns away from it. In BeamDyn
    `trapeze` is the sum of both bending stiffnesses.
    """

    def slopes(x, state):
        phi, moment = state
        strain = (HUB * k * np.sin(k * (LENGTH - x)) + np.cos(k * x)) / np.cos(k * LENGTH) - 1.0
        turned = twist(x) + phi
        return np.stack((
            moment / (GJ + trapeze * strain), -OMEGA**2 * INERTIA * np.sin(turned) * np.cos(turned)
        ))  # fmt: skip

    k = OMEGA * np.sqrt(MASS / EVEN_EA)  # of the stretch u'' + k² (HUB + x + u) = 0
    x = np.linspace(0.0, LENGTH, 2401)
    found = solve_bvp(
        slopes, lambda a, b: np.array([a[0], b[1]]), x, np.zeros((2, x.size)), tol=1e-10,
        max_nodes=100_000,
    )  # fmt: skip
    return abs(found.y[1, 0]), abs(found.y[0, -1])


def table(x):
    """Twist of the table [rad], linear between its stations."""
    return np.interp(x, STATIONS, TWIST)


def fitted(degree=6):
    """Twist as BeamDyn fits it, by least squares between both ends: of degree six at most."""
    ends = Polynomial.fit(STATIONS[[0, -1]], TWIST[[0, -1]], 1, domain=[0.0, LENGTH])
    x = STATIONS / LENGTH
    between = np.stack([x * (1.0 - x) * x**k for k in range(degree - 1)], axis=1)
    of = np.linalg.lstsq(between, TWIST - ends(STATIONS))[0]
    bubble = Polynomial([0.0, 1.0, -1.0]) * Polynomial(of)
    return lambda x: ends(x) + bubble(x / LENGTH)


def linear(x):
    """Twist of 13 degrees that falls linearly."""
    return np.interp(x, STATIONS, LINEAR)


if __name__ == "__main__":
    exact = elongation()
    for order, printed in PRINTED["elongation"].items():
        print(f"elongation, order {order:2d}: {printed:.9f} m printed, {elongation(order):.9f} m")
    print(f"elongation, exact:    {exact:.9f} m")
    fit = fitted()
    print(f"twist: the fit is up to {np.degrees(abs(fit(STATIONS) - TWIST)).max():.2f} deg off")
    for order, printed in PRINTED["moment"].items():
        print(f"root's torsion, order {order:2d}: {printed:.4f} N m printed")
    for name, twist in ("fit", fit), ("table", table):
        print(f"root's torsion, of the {name}: {torsion(twist, EI_SUM)[0]:.4f} N m")
    print(f"turn of the tip: {PRINTED['turn'][10]:.8e} rad printed")
    for name, trapeze in ("with (EI + EI) ε", EI_SUM), ("without", 0.0):
        print(f"turn of the tip, {name}: {torsion(linear, trapeze)[1]:.8e} rad")
