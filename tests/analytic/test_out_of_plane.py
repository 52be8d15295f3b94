"""Section data out of the plane: shapes, what contradicts them, values that travel."""

import json
import math

import pytest

from analytic import Beam, Blade, OutOfPlane, Section
from analytic.description import describe, from_description

UNIT = Blade(
    length=1.0,
    section=Section(axial_stiffness=1e6, bending_stiffness=1.0, mass_per_length=1.0),
)


@pytest.mark.parametrize(
    ("ratio", "torsion"),
    # J/(longer shorter³), Timoshenko and Goodier, table in Sec. 109, to its print.
    [(1.0, 0.1406), (1.5, 0.196), (2.0, 0.229), (3.0, 0.263), (5.0, 0.291), (10.0, 0.312)],
)
@pytest.mark.parametrize("standing", [True, False])
def test_torsion_of_the_rectangle(ratio, torsion, standing):
    section = OutOfPlane.rectangle(ratio if standing else 1.0 / ratio, poisson_ratio=0.0)
    inertia = (ratio**3 if standing else ratio) / 12.0  # in the plane, shorter side 1
    assert 2.0 * inertia * section.torsion_ratio == pytest.approx(torsion * ratio, rel=3e-3)
    assert section.bending_ratio == pytest.approx(ratio ** (-2 if standing else 2))


def test_the_sections_with_the_a_and_i_of_the_paper(beam):
    rectangle = beam.rectangle().section.out_of_plane
    assert rectangle.bending_ratio**-0.5 == pytest.approx(18.5, abs=0.05)
    assert beam.rectangle(0.03675, 0.001986).section.out_of_plane.bending_ratio == pytest.approx(
        rectangle.bending_ratio, rel=1e-3
    )
    assert beam.tube(0.015, 0.77e-3) == beam.with_out_of_plane(OutOfPlane.circle())


def test_they_are_values_and_travel(beam):
    blade = beam.with_section_out_of_plane(0.01, math.inf, 0.0)
    again = from_description(json.loads(json.dumps(describe(blade))), Blade)
    assert again == blade
    assert hash(again) == hash(blade)
    assert again.section.out_of_plane.torsion_ratio == math.inf
    assert blade.unit == beam.blade.unit, "nothing in the plane knows of it"
    assert beam.blade.section.out_of_plane is None


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (lambda: Beam.reference().rectangle(0.04, 0.002), "has I/A = .* 18.5 % from .* fits it"),
        (lambda: Beam.reference().rectangle(0.03675, 0.004), "has A = .* 101 % from .* fits it"),
        (lambda: Beam.reference().tube(0.02, 0.001), "radius=0.015, wall=0.0007746 fits it"),
        (lambda: Beam.reference().tube(0.001, 0.003), "0.002 m is the full circle"),
        (UNIT.rectangle, "needs its width"),
        (lambda: UNIT.rectangle(1.0, 0.1), "height=0.003464 fits it"),
        (lambda: UNIT.tube(1.0, 0.1), "radius=0.001414 fits it"),
        (lambda: UNIT.with_section_out_of_plane(0.0), "bending_ratio must be positive"),
        (lambda: UNIT.with_section_out_of_plane(1.0, -1.0), "torsion_ratio must be positive"),
        (lambda: UNIT.with_section_out_of_plane(1.0, 1.0, -1.0), "polar_inertia must not be"),
        (lambda: OutOfPlane.rectangle(1e-4), "between 0.001 and 1000, got 0.0001"),
        (lambda: OutOfPlane.rectangle(2.0, 0.6), "poisson_ratio must be at most 0.5"),
        (
            lambda: UNIT.with_out_of_plane(OutOfPlane.circle()).with_taper(height=0.5),
            "taper both alike",
        ),
    ],
)
def test_contradictions_are_refused(wrong, sentence):
    with pytest.raises(ValueError, match=sentence):
        wrong()


def test_what_the_sentences_advise_works():
    Beam.reference().tube(radius=0.015, wall=0.0007746)
    Beam.reference().rectangle(height=0.03675, width=0.001986)
    UNIT.rectangle(height=0.003464, width=0.1)
    UNIT.tube(radius=0.001414, wall=1e-5)
    UNIT.with_out_of_plane(OutOfPlane.circle()).with_taper(width=0.5, height=0.5)
    UNIT.with_taper(height=0.5).with_out_of_plane(OutOfPlane.circle())
