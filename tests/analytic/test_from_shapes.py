"""Blades from shapes and materials at stations, against closed forms and other ways to the same."""

import math

import numpy as np
import pytest

from analytic import Beam, Blade, Ellipse, Rectangle, Theory, Tube, linear_modes
from analytic.section_shapes import Box

E, RHO = 7e10, 2700.0


def test_a_uniform_strip_is_that_of_its_area_and_second_moment():
    """By the code for 6x6 matrices and by the ratios out of the plane: the same modes."""
    strip = Rectangle(height=0.08, width=0.01)
    blade = Blade.from_shapes([0.0, 2.0], [strip, strip], E, RHO)
    beam = Beam(
        length=2.0, area=8e-4, second_moment=0.08**3 * 0.01 / 12.0, youngs_modulus=E, density=RHO
    ).with_shape(strip)
    # A table tells the rotary inertia of its sections.
    theory = Theory(rotary_inertia=True)
    by_ratios = linear_modes(beam.with_twist(1e-12), 20.0, count=4, theory=theory).frequencies
    assert linear_modes(blade, 20.0, count=4).frequencies == pytest.approx(by_ratios, rel=1e-9)


@pytest.mark.parametrize(
    ("shape", "area", "along", "across", "torsion"),
    [
        (Ellipse(height=0.2, width=0.2), 1e-2, 2.5e-5, 2.5e-5, 5e-5),
        (Ellipse(height=0.4, width=0.2), 2e-2, 2e-4, 5e-5, 1.6e-4),
        (Tube(radius=0.15, wall=0.1), 3e-2, 3.75e-4, 3.75e-4, 7.5e-4),  # radii of 0.2 and 0.1
    ],
)
def test_round_shapes_have_the_closed_forms(shape, area, along, across, torsion):
    """Numbers of handbooks, all over π."""
    stiffness, mass = shape.of_material(E, RHO)
    told = np.array([area, torsion / 2.6, across, along]) * math.pi * E
    assert np.array(stiffness)[[0, 3, 4, 5]] == pytest.approx(told, rel=1e-12)
    inertia = np.array([area, along + across, across, along]) * math.pi * RHO
    assert mass == pytest.approx(inertia, rel=1e-12)


def test_a_box():
    """Its A and I are those of the outer rectangle less the inner."""
    stiffness, _ = Box(height=0.4, width=0.2, wall=0.01).of_material(E, RHO)
    hole = {"height": 0.38, "width": 0.18}
    outer, inner = (
        np.array(Rectangle(**sides).of_material(E, RHO)[0])
        for sides in ({"height": 0.4, "width": 0.2}, hole)
    )
    assert np.array(stiffness)[[0, 4, 5]] == pytest.approx((outer - inner)[[0, 4, 5]], rel=1e-12)


# height, width, wall [cm]; J, As/A by sectionproperties on triangles of wall²/6 to wall²/400.
MESHED = [
    ((6.0, 2.0, 0.05), 1.714375, 0.7002, 0.1365, 5e-4),
    ((6.0, 2.0, 0.2), 5.90047, 0.7147, 0.1333, 1.2e-3),
    ((6.0, 2.0, 0.4), 9.55519, 0.7376, 0.1318, 2e-4),
    ((6.0, 2.0, 0.7), 12.04011, 0.7820, 0.1438, 7e-4),
    ((2.0, 2.0, 0.5), 2.066417, 0.5442, 0.5442, 4e-4),
    ((2.0, 2.0, 0.8), 2.24401, 0.7471, 0.7471, 6e-3),
]


@pytest.mark.parametrize(("sides", "torsion", "along", "across", "close"), MESHED)
def test_a_box_of_any_wall_is_that_of_finite_elements(sides, torsion, along, across, close):
    """Thin and thick; a coarse mesh is too stiff by as much as stands there."""
    box = Box(**dict(zip(("height", "width", "wall"), sides, strict=True)), poisson_ratio=0.0)
    stiffness, (area, *_) = box.of_material(2.0, 1.0)
    assert stiffness[3] == pytest.approx(torsion, rel=close)
    shear = 0.09 if 3.0 * sides[2] > sides[1] * 1.1 else 0.04
    assert np.array(stiffness[1:3]) / area == pytest.approx([along, across], rel=shear)


def test_the_limits_of_a_box():
    """Bredt's t a³ and half the area for shear of a thin square, and a closed tube's torsion."""
    thin = Box(height=1.0001, width=1.0001, wall=1e-4, poisson_ratio=0.0).of_material(2.0, 1.0)
    assert thin[0][3] == pytest.approx(1e-4, rel=1e-4)
    assert thin[0][1] / thin[1][0] == pytest.approx(5.0 / 12.0, rel=1e-3)  # Cowper, at ν = 0
    closed = Box(height=1.0, width=1.0, wall=0.5).of_material(E, RHO)[0]
    full = Rectangle(height=1.0, width=1.0).of_material(E, RHO)[0]
    assert closed[3] == pytest.approx(full[3], rel=1.2e-2)


def test_the_shear_coefficients_are_cowpers():
    """Numbers of the table in his paper, at ν = 0.3: 0.850, 0.886 and, of a thin tube, 0.531."""
    shapes = (
        Rectangle(height=2.0, width=1.0),
        Ellipse(height=2.0, width=2.0),
        Tube(radius=1.0, wall=1e-4),
    )
    rows = [shape.of_material(2.6, 1.0)[0] for shape in shapes]  # G = 1
    assert [row[1] / row[0] * 2.6 for row in rows] == pytest.approx([0.850, 0.886, 0.531], abs=5e-4)


def test_stations_may_differ_in_shape_and_material():
    """Halfway, a column is the mean of its ends: of EA = 7 and 1, 4."""
    shapes = Rectangle(height=0.5, width=0.2), Box(height=0.4, width=0.3, wall=0.1)
    blade = Blade.from_shapes([0.0, 4.0], shapes, [70.0, 10.0], [1.0, 2.0], twist=[0.1, 0.0])
    assert blade.line.twist == ((0.0, 0.1), (4.0, 0.0))
    assert blade.mass == pytest.approx(4.0 * (0.1 + 2.0 * 0.1) / 2.0, rel=1e-9)


@pytest.mark.parametrize(
    ("shape", "sentence"),
    [
        (Tube(radius=0.1), r"needs wall \[m\]"),
        (Rectangle(height=0.1), r"needs width \[m\]"),
    ],
)
def test_a_shape_that_does_not_tell_all_is_refused(shape, sentence):
    with pytest.raises(ValueError, match=sentence):
        Blade.from_shapes([0.0, 1.0], [shape, shape], E, RHO)

    with pytest.raises(ValueError, match="needs height, width and wall"):
        Beam.reference().with_shape(Box())
