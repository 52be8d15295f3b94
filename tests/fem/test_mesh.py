"""Sections that step and bend, and masses anywhere: each element keeps its order."""

import numpy as np
import pytest

from analytic import Beam, Blade, Section, Theory, linear_modes
from rotbeam_exu import natural_frequencies
from rotbeam_exu.fem.elements import FORMULATIONS, Exact, SpaceCable
from rotbeam_exu.fem.mesh import Mesh

BEAM = Beam.reference()
OMEGA = 4.0
ELEMENTS = [
    *(FORMULATIONS[name]() for name in ("cable", "exact", "ancf3", "space_cable", "space_exact")),
    Exact(nodes=3),
]


def of_stations(x, factors):
    """Return the paper's beam on a hub, with stiffness and mass times factors at stations."""
    stiffness_and_mass = {
        name: tuple((at, getattr(BEAM, name) * f) for at, f in zip(x, factors, strict=True))
        for name in ("axial_stiffness", "bending_stiffness", "mass_per_length")
    }
    return Blade(length=8.0, section=Section(**stiffness_and_mass), hub_radius=0.5)


STEP = of_stations([0.0, 2.96, 2.9601, 8.0], [3.0, 3.0, 1.0, 1.0])
"""Of a third at 0.37 L; nodes at equal distances are as far off it with 16, 32 and 64 elements."""


CASES = {
    f"{kind}, {one.name}, {one.order:g}": (blade, one)
    for kind, blade in (("step", STEP), ("mass", BEAM.with_point_mass(0.5, 3.3)))
    for one in ELEMENTS
    if kind == "step" or not one.leaves_plane
}
CASES["mass, space_cable"] = (BEAM.with_point_mass(0.5, 3.0), SpaceCable())


@pytest.mark.parametrize(("blade", "element"), CASES.values(), ids=CASES)
def test_a_step_and_a_mass_leave_an_element_its_order(blade, element):
    """Against the exact answer; without nodes at the step 9e-4 stay in the first frequency.

    The stretches of a blade are not divided alike on all meshes, which moves slopes by 0.4.
    Sections of ancf3 grow thick, which leaves 2e-5 of its own.
    """
    if element.leaves_plane:
        blade = blade.with_section_out_of_plane(1.0, 0.8)
    theory = element.theory if element.shear_share else Theory()
    exact = linear_modes(blade, OMEGA, 3, theory=theory).frequencies
    errors = [
        natural_frequencies(blade, OMEGA, element=element, elements=n) / exact - 1.0
        for n in (8, 16, 32)
    ]
    # The first frequency, and the order in the third.
    assert abs(errors[-1][0]) < (4e-4 if element.order == 2.0 else 4e-5)
    coarse, fine = np.abs(np.diff(errors, axis=0))[:, 2]
    assert np.log2(coarse / fine) == pytest.approx(element.order, abs=0.45)


@pytest.mark.parametrize("element", ELEMENTS, ids=lambda one: f"{one.name}, {one.order:g}")
def test_fewer_elements_than_stretches_have_means(element):
    """Ten of 31 stretches that go up and down by a third: 2 % in three frequencies at most."""
    x = np.linspace(0.0, 8.0, 32)
    blade = of_stations(x, (1.5 - x / 8.0) * (1.0 + 0.2 * (-1.0) ** np.arange(32)))
    if element.leaves_plane:
        blade = blade.with_section_out_of_plane(1.0, 0.8)
    theory = element.theory if element.shear_share else Theory()
    exact = linear_modes(blade, OMEGA, 2, theory=theory).frequencies
    found = natural_frequencies(blade, OMEGA, element=element, elements=10, count=2)
    np.testing.assert_allclose(found, exact, rtol=0.02)


def test_equal_elements_unless_a_station_is_between():
    np.testing.assert_allclose(Mesh(blade=BEAM, elements=7).ends, np.linspace(0.0, 1.0, 8))
    ends = Mesh(blade=STEP, elements=8).ends
    # 0.37 in three and 0.63 in five; a step of a hundred-thousandth of the length has one node.
    wanted = np.append(np.linspace(0.0, 0.37, 4)[:-1], np.linspace(0.37, 1.0, 6))
    np.testing.assert_allclose(ends, wanted, rtol=1e-12)
    few = Mesh(blade=of_stations(np.linspace(0.0, 8.0, 32), np.ones(32)), elements=10)
    np.testing.assert_allclose(few.ends, np.linspace(0.0, 1.0, 11), rtol=1e-12)
