"""Section data out of the plane: shapes, what contradicts them, values that travel."""

import json
import math
from dataclasses import dataclass

import numpy as np
import pytest

from analytic import Beam, Blade, Ellipse, Rectangle, RotbeamWarning, Section, Tube
from analytic.description import describe, from_description
from analytic.section import OutOfPlane
from analytic.section_shape import Count, Gyration, Length, SectionShape
from analytic.section_shapes import Box
from rotbeam_exu.cli.options import blade_of

BEAM = Beam.reference()
UNIT = Blade(
    length=1.0, section=Section(axial_stiffness=1e6, bending_stiffness=1.0, mass_per_length=1.0)
)


@pytest.mark.parametrize(
    ("ratio", "torsion"),
    # J/(longer shorter³), Timoshenko and Goodier, table in Sec. 109, to its print.
    [(1.0, 0.1406), (1.5, 0.196), (2.0, 0.229), (3.0, 0.263), (5.0, 0.291), (10.0, 0.312)],
)
@pytest.mark.parametrize("standing", [True, False])
def test_torsion_of_the_rectangle(ratio, torsion, standing):
    shape = Rectangle(ratio=ratio if standing else 1.0 / ratio, poisson_ratio=0.0)
    section = UNIT.with_shape(shape).section.out_of_plane
    inertia = (ratio**3 if standing else ratio) / 12.0  # in the plane, shorter side 1
    assert 2.0 * inertia * section.torsion_ratio == pytest.approx(torsion * ratio, rel=3e-3)
    assert section.bending_ratio == pytest.approx(ratio ** (-2 if standing else 2))


def test_the_sections_with_the_a_and_i_of_the_paper(beam):
    rectangle = beam.with_shape(Rectangle()).section.out_of_plane
    assert rectangle.bending_ratio**-0.5 == pytest.approx(18.5, abs=0.05)
    mine = beam.with_shape(Rectangle(height=0.03675, width=0.001986)).section.out_of_plane
    assert mine.bending_ratio == pytest.approx(rectangle.bending_ratio, rel=1e-3)
    assert beam.with_shape(Tube(radius=0.015, wall=0.77e-3)) == beam.with_shape(Tube())


@pytest.mark.parametrize("ratio", [0.5, 1.0, 4.0])
def test_torsion_of_the_ellipse(ratio):
    """GJ = G π a³b³/(a² + b²) by quadrature of Prandtl's stress function (1 - y²/a² - z²/b²)."""
    a, b = ratio, 1.0
    r, weights = np.polynomial.legendre.leggauss(8)
    r, weights = 0.5 * (r + 1.0), 0.5 * weights
    stress = a**2 * b**2 / (a**2 + b**2) * (1.0 - r**2)
    J = 2.0 * 2.0 * math.pi * a * b * np.sum(weights * r * stress)
    shape = Ellipse(ratio=ratio, poisson_ratio=0.25)
    section = UNIT.with_shape(shape).section.out_of_plane
    assert section.torsion_ratio == pytest.approx(J / (2.5 * 0.25 * math.pi * a**3 * b))
    assert section.bending_ratio == pytest.approx(1.0 / ratio**2)


def test_a_round_ellipse_is_a_circle_and_a_thick_tube():
    circle = UNIT.with_shape(Ellipse(ratio=1.0))
    assert UNIT.with_shape(Tube()) == circle
    assert circle.section.out_of_plane == OutOfPlane(bending_ratio=1.0, torsion_ratio=1.0 / 1.3)
    UNIT.with_shape(Ellipse(height=4e-3, ratio=1.0))


def test_they_are_values_and_travel(beam):
    blade = beam.with_section_out_of_plane(0.01, math.inf)
    again = from_description(json.loads(json.dumps(describe(blade))), Blade)
    assert again == blade
    assert hash(again) == hash(blade)
    assert again.section.out_of_plane.torsion_ratio == math.inf
    assert blade.unit == beam.unit, "nothing in the plane knows of it"
    assert beam.section.out_of_plane is None


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (
            lambda: BEAM.with_shape(Rectangle(height=0.04, width=0.002)),
            "has I/A = .* 18.5 % from .* fits it",
        ),
        (
            lambda: BEAM.with_shape(Rectangle(height=0.03675, width=0.004)),
            "has A = .* 101 % from .* fits it",
        ),
        (
            lambda: BEAM.with_shape(Tube(radius=0.02, wall=0.001)),
            "radius=0.015, wall=0.0007746 fits it",
        ),
        (lambda: BEAM.with_shape(Tube(radius=0.001, wall=0.003)), "0.002 m is the full circle"),
        (lambda: UNIT.with_shape(Rectangle()), "needs its width"),
        (lambda: UNIT.with_shape(Rectangle(width=1.0, ratio=2.0)), "not both"),
        (lambda: UNIT.with_shape(Rectangle(width=-1.0)), "width must be positive"),
        (lambda: UNIT.with_shape(Rectangle(height=1.0, width=0.1)), "height=0.003464 fits it"),
        (lambda: UNIT.with_shape(Tube(radius=1.0, wall=0.1)), "radius=0.001414 fits it"),
        (lambda: UNIT.with_section_out_of_plane(0.0), "bending_ratio must be positive"),
        (lambda: UNIT.with_section_out_of_plane(1.0, -1.0), "torsion_ratio must be positive"),
        (lambda: Rectangle(ratio=2.0, poisson_ratio=0.6), "poisson_ratio must be at most 0.5"),
        (lambda: UNIT.with_shape(Tube()).with_taper(height=0.5), "taper both alike"),
    ],
)
def test_contradictions_are_refused(wrong, sentence):
    with pytest.raises(ValueError, match=sentence):
        wrong()


def test_what_the_sentences_advise_works():
    Beam.reference().with_shape(Tube(radius=0.015, wall=0.0007746))
    Beam.reference().with_shape(Rectangle(height=0.03675, width=0.001986))
    UNIT.with_shape(Rectangle(height=0.003464, width=0.1))
    UNIT.with_shape(Tube(radius=0.001414, wall=1e-5))
    UNIT.with_shape(Tube()).with_taper(width=0.5, height=0.5)
    UNIT.with_taper(height=0.5).with_shape(Tube())


@dataclass(frozen=True, kw_only=True)
class Diamond(SectionShape):
    """A square that stands on its edge."""

    side: Length | None = None

    def _fitting(self, own):
        return {"side": math.sqrt(12.0 * own.squared)}

    def _gyration(self, lengths):
        return Gyration(squared=lengths["side"] ** 2 / 12.0, area=lengths["side"] ** 2)

    def _ratios(self, lengths):
        return 1.0, 12.0 * 0.1406

    def _shear(self, lengths):
        return 5.0 / 6.0, 5.0 / 6.0


def test_a_new_shape_is_one_class():
    blade = UNIT.with_shape(Diamond())
    square = UNIT.with_shape(Rectangle(ratio=1.0)).section.out_of_plane
    assert blade.section.out_of_plane.torsion_ratio == pytest.approx(square.torsion_ratio, rel=1e-3)
    assert from_description(describe(Diamond(side=0.1)), SectionShape) == Diamond(side=0.1)
    assert blade_of(UNIT, {"section": "diamond"}) == blade
    with pytest.raises(ValueError, match="Diamond.*has I/A = .*side=0.003464 fits it"):
        UNIT.with_shape(Diamond(side=0.1))
    # No square has both I and A of the strip, and I and A alone make no box.
    for shape in (Diamond(side=0.1), Diamond(), Box(height=0.1, width=0.1, wall=0.01)):
        with pytest.raises(ValueError, match="m² of this blade: take another shape"):
            BEAM.with_shape(shape)
    with pytest.raises(TypeError, match="a SectionShape is needed, got 'Tube'"):
        UNIT.with_shape("Tube")


class OfSides:
    """A full regular polygon of so many sides, with a J that is only near."""

    def _shares(self):
        """Return A/R² and I/R⁴."""
        angle = 2.0 * math.pi / self.sides
        area = 0.5 * self.sides * math.sin(angle)
        return area, area * (2.0 + math.cos(angle)) / 12.0

    def _fitting(self, own):
        area, inertia = self._shares()
        return {"radius": math.sqrt(own.squared * area / inertia)}

    def _gyration(self, lengths):
        (area, inertia), r = self._shares(), lengths["radius"]
        if self.sides < 3:
            raise ValueError(f"sides must be at least 3, got {self.sides}")
        return Gyration(squared=inertia / area * r**2, area=area * r**2)

    def _ratios(self, lengths):
        return 1.0, 2.0

    def _shear(self, lengths):
        return 0.9, 0.9


@dataclass(frozen=True, kw_only=True)
class Polygon(OfSides, SectionShape):
    """A polygon that says what its fields are."""

    sides: Count = 6
    radius: Length | None = None


@dataclass(frozen=True, kw_only=True)
class Unclear(OfSides, SectionShape):
    """A polygon that does not."""

    sides: int = 6
    radius: Length | None = None


def test_fields_of_a_shape_say_what_they_are():
    """A whole number is neither converted to a length nor asked of a blade as one."""
    many = Polygon(sides=96, radius=0.1).of_material(7e10, 2700.0)
    circle = Ellipse(height=0.2, width=0.2).of_material(7e10, 2700.0)
    assert many[0][0] == pytest.approx(circle[0][0], rel=1e-3)
    assert many[0][5] == pytest.approx(circle[0][5], rel=2e-3)
    assert UNIT.with_shape(Polygon()).is_planar
    for sides in (6.5, True, "6", None):
        with pytest.raises(TypeError, match="sides must be a whole number, got"):
            Polygon(sides=sides, radius=0.1)
    with pytest.raises(ValueError, match="sides must be at least 1, got -3$"):
        Polygon(sides=-3)
    with pytest.raises(ValueError, match="sides must be at least 3, got 2"):
        Polygon(sides=2, radius=0.1)
    with pytest.raises(ValueError, match=r"along a blade needs radius \[m\]"):
        Polygon().of_material(7e10, 2700.0)
    with pytest.raises(TypeError, match="Unclear does not say what sides is: let its type be Leng"):
        Unclear()


@pytest.mark.parametrize(
    ("made", "sentence"),
    [
        (lambda: Tube(radius=0.01, wall=0.03), "wall of a tube is at most twice its mean radius"),
        (lambda: Box(height=0.1, width=0.2, wall=0.06), "overlap: take wall below 0.05 m"),
        (lambda: Rectangle(ratio=0.0), "ratio must be positive"),
    ],
)
def test_a_shape_that_is_none_is_refused_where_it_is_made(made, sentence):
    with pytest.raises(ValueError, match=sentence):
        made()


def test_a_wall_above_the_radius_is_asked_about():
    with pytest.warns(RotbeamWarning, match=r"between the radii 0.005 and 0.035 m"):
        Tube(radius=0.02, wall=0.03)
