"""Sections by the finite elements of sectionproperties: what we take of them, and ours beside."""

from types import SimpleNamespace

import numpy as np
import pytest

from analytic import Blade, Ellipse, Rectangle, Tube
from analytic.meshed_section import matrices_of
from analytic.section_shapes import Box

E, RHO, NU = 7e10, 2700.0, 0.3


def standing_in(a_sxy=np.inf, **more):
    """A rectangle, 0.06 along x and 0.02 along y, with its center at (0.1, -0.02)."""
    numbers = {
        "get_area": 1.2e-3, "get_ic": (4e-8, 3.6e-7, 0.0), "get_c": (0.1, -0.02), "get_j": 1.2e-7,
        "get_sc": (0.1, -0.02), "get_as": (1e-3, 9e-4), "is_composite": False,
        "calculate_geometric_properties": None, "calculate_warping_properties": None,
    } | more  # fmt: skip
    answers = {name: lambda value=value: value for name, value in numbers.items()}
    return SimpleNamespace(**answers, section_props=SimpleNamespace(a_sxy=a_sxy))


def test_a_meshed_section_is_the_station_of_its_columns():
    G = 0.5 * E / (1.0 + NU)
    columns = [E * 1.2e-3, G * 1e-3, G * 9e-4, G * 1.2e-7, E * 4e-8, E * 3.6e-7]
    inertia = [RHO * 1.2e-3, RHO * 4e-7, RHO * 4e-8, RHO * 3.6e-7]
    at = {name: [(0.1, -0.02)] * 2 for name in ("tension", "shear", "center")}
    known = Blade.from_stations([0.0, 2.0], [columns] * 2, [inertia] * 2, **at)
    S, M = matrices_of(standing_in(), E, RHO, NU)
    found = Blade.from_stations([0.0, 2.0], [S, S], [M, M])
    for name in ("stiffness", "mass"):
        ours, theirs = (np.array(getattr(one.section, name)) for one in (found, known))
        assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-9)


def test_products_of_inertia_and_of_shear_have_their_signs():
    """The rectangle turned about the origin by 0.3 has the turned matrices."""
    c, s = np.cos(0.3), np.sin(0.3)
    R = np.array([[c, -s], [s, c]])
    at = R @ (0.1, -0.02)
    soft = R @ np.diag([1 / 1e-3, 1 / 9e-4]) @ R.T
    ic = (c**2 * 4e-8 + s**2 * 3.6e-7, c**2 * 3.6e-7 + s**2 * 4e-8, s * c * 3.2e-7)
    oblique = standing_in(
        a_sxy=1.0 / soft[0, 1], get_ic=ic, get_c=at, get_sc=at,
        get_as=(1.0 / soft[0, 0], 1.0 / soft[1, 1]),
    )  # fmt: skip
    turn = np.eye(6)
    turn[1:3, 1:3] = turn[4:, 4:] = R
    found, straight = (matrices_of(one, E, RHO) for one in (oblique, standing_in()))
    for ours, theirs in zip(found, straight, strict=True):
        size = np.sqrt(np.diag(ours))
        assert np.all(np.abs(ours - turn @ theirs @ turn.T) < 1e-12 * np.outer(size, size))


@pytest.mark.parametrize(
    ("section", "numbers", "error", "sentence"),
    [
        (Rectangle(height=1.0, width=1.0), (E, RHO), TypeError, "a Section of sectionproperties"),
        (standing_in(is_composite=True), (E, RHO), ValueError, "several materials"),
        (standing_in(), (np.nan, RHO), ValueError, "youngs_modulus must be finite"),
        (standing_in(), (E, "2700"), TypeError, "density must be a number"),
        (standing_in(), (E, RHO, -0.3), ValueError, "poisson_ratio must not be negative"),
        (standing_in(), (True, RHO), TypeError, "youngs_modulus must be a number"),
        (standing_in(get_area=np.nan), (E, RHO), ValueError, "must be finite"),
    ],
)
def test_what_is_no_section_or_number_is_refused(section, numbers, error, sentence):
    with pytest.raises(error, match=sentence):
        S, M = matrices_of(section, *numbers)
        Blade.from_stations([0.0, 1.0], [S, S], [M, M])


def meshed(geometry, size):
    sections = pytest.importorskip("sectionproperties.analysis")
    return sections.Section(geometry.create_mesh([size]))


@pytest.mark.parametrize(
    ("shape", "shear"),
    [
        (Rectangle(height=0.06, width=0.02), 2e-2),
        (Ellipse(height=0.06, width=0.02), 6e-2),
        (Ellipse(height=0.02, width=0.02), 2e-2),
        (Tube(radius=0.02, wall=0.008), 2e-2),
        (Box(height=0.06, width=0.02, wall=0.002), 3e-2),
        (Box(height=0.06, width=0.02, wall=0.007), 4e-2),
    ],
)
def test_shapes_by_hand_are_those_of_finite_elements(shape, shear):
    """Area, EI, GJ to the mesh; GA2 and GA3, which Cowper defines otherwise, to `shear`."""
    pytest.importorskip("sectionproperties")
    from sectionproperties.pre import library

    if isinstance(shape, Box):
        geometry = library.rectangular_hollow_section(
            d=shape.width, b=shape.height, t=shape.wall, r_out=0.0, n_r=1
        )
    elif isinstance(shape, Tube):
        outer = 2.0 * shape.radius + shape.wall
        geometry = library.circular_hollow_section(d=outer, t=shape.wall, n=256)
    elif isinstance(shape, Ellipse):
        geometry = library.elliptical_section(d_x=shape.height, d_y=shape.width, n=256)
    else:
        geometry = library.rectangular_section(d=shape.width, b=shape.height)
    size = getattr(shape, "wall", 0.01)
    S, M = matrices_of(meshed(geometry.align_center(), size**2 / 40.0), E, RHO, 0.0)
    ours = type(shape)(**{**vars(shape), "poisson_ratio": 0.0})
    stiffness, mass = (np.array(one) for one in ours.of_material(E, RHO))
    assert stiffness[[0, 3, 4, 5]] == pytest.approx(np.diag(S)[[0, 3, 4, 5]], rel=2e-3)
    assert stiffness[1:3] == pytest.approx(np.diag(S)[1:3], rel=shear)
    assert mass == pytest.approx(np.diag(M)[[0, 3, 4, 5]], rel=1e-3)


def test_a_section_that_is_turned_has_turned_matrices():
    """An angle, whose axes of bending and of shear are oblique, about the origin by 0.5."""
    pytest.importorskip("sectionproperties")
    from sectionproperties.pre import library

    geometry = library.angle_section(d=0.1, b=0.06, t=0.01, r_r=0.0, r_t=0.0, n_r=1)
    turned = geometry.rotate_section(0.5, rot_point=(0.0, 0.0), use_radians=True)
    straight, oblique = (matrices_of(meshed(one, 2e-6), E, RHO) for one in (geometry, turned))
    c, s = np.cos(0.5), np.sin(0.5)
    R = np.kron(np.eye(2), np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]))
    for ours, theirs in zip(oblique, straight, strict=True):
        size = np.sqrt(np.diag(ours))
        off = np.abs(ours - R @ theirs @ R.T) / np.outer(size, size)
        assert off.max() < 1e-3  # of two meshes
