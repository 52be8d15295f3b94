"""PyElastica: a Cosserat rod with shear and rotary inertia, position Verlet."""

import sys
from importlib.metadata import version
from pathlib import Path

import elastica
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import SPACING, across, take_part

from analytic import Theory
from rotbeam_exu.verification.cases import Case
from rotbeam_exu.verification.submission import Declaration

NU, K_S = 0.3, 27 / 28  # of a round section, as the code has it


class Clamp(elastica.ConstraintBase):
    """Turns the first element about its middle, where the sections stand that the clamp holds."""

    def __init__(self, half: float, h: float, case: Case, **others: object) -> None:
        super().__init__(**others)
        t = h / 2 * np.arange(2 * round(case.duration / h) + 3)  # Verlet asks at half steps, too
        self.half, self.h, self.rate = half, h, case.rotation.rate(t)
        angle = case.rotation.angle(t)
        self.c, self.s = np.cos(angle), np.sin(angle)

    def constrain_values(self, system, time):
        """Set its first node and its directors."""
        k = round(2 * time / self.h)
        c, s = self.c[k], self.s[k]
        system.position_collection[:, 0] = -self.half * c, -self.half * s, 0.0
        system.director_collection[:, :, 0] = (0.0, 0.0, 1.0), (s, -c, 0.0), (c, s, 0.0)

    def constrain_rates(self, system, time):
        """Set their rates."""
        k = round(2 * time / self.h)
        v = self.half * self.rate[k]
        system.velocity_collection[:, 0] = v * self.s[k], -v * self.c[k], 0.0
        system.omega_collection[:, 0] = self.rate[k], 0.0, 0.0


class World(elastica.BaseSystemCollection, elastica.Constraints):
    """One rod and its clamp."""


def history(case: Case, n: int, h: float):
    """Spin up a solid round rod with the beam's EA, EI and mass."""
    beam = case.blade
    link = beam.length / (n - 0.5)
    radius = 2.0 * np.sqrt(beam.bending_stiffness / beam.axial_stiffness)
    area = np.pi * radius**2
    E = beam.axial_stiffness / area
    rod = elastica.CosseratRod.straight_rod(
        n, np.array([-link / 2, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]),
        n * link, radius, beam.mass_per_length / area, youngs_modulus=E,
        shear_modulus=E / (2 * (1 + NU)),
    )  # fmt: skip
    world, verlet = World(), elastica.PositionVerlet()
    world.append(rod)
    world.constrain(rod).using(Clamp, half=link / 2, h=h, case=case)
    world.finalize()
    time, tip = np.float64(0.0), [complex(beam.length)]
    for _ in range(round(case.duration / SPACING)):
        for _ in range(round(SPACING / h)):
            time = verlet.step(world, time, h)
        tip.append(complex(*rod.position_collection[:2, -1]))
        if not abs(tip[-1]) < 2.0 * beam.length:
            raise RuntimeError(f"unstable at {time:.3g} s")
    return across(case, tip)


if __name__ == "__main__":
    told = Declaration(
        code="PyElastica", version=version("pyelastica"), licence="MIT",
        url="https://www.cosseratrods.org", element="Cosserat rod, staggered grid, Verlet",
        theory=Theory(shear=K_S / (2 * (1 + NU)), rotary_inertia=True),
        order=2.0, order_in_step=2.0,
    )  # fmt: skip
    runs = [(16, 5e-6), (32, 5e-6), (64, 5e-6), (16, 4e-6), (128, 5e-6)]
    take_part(__file__, told, history, {"S1": runs})
