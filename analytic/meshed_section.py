"""A section of any shape, by the finite elements of the package sectionproperties."""

from __future__ import annotations

from typing import Any

import numpy as np

from .arrays import FloatArray
from .input_checks import not_negative, positive, shown
from .station_section import moved


def matrices_of(
    section: Any, youngs_modulus: float, density: float, poisson_ratio: float = 0.3
) -> tuple[FloatArray, FloatArray]:
    """Return stiffness and mass, each (6, 6), of a station of `Blade.from_stations`.

    About the origin of the geometry, with x along the chord to the leading edge and y along the
    thickness. Tension, bending, torsion and shear are about their own centers.

    Parameters
    ----------
    section : sectionproperties.analysis.Section
        A meshed geometry of one material; its properties are computed here. The shear areas have
        the Poisson ratio of that material, zero by default.
    youngs_modulus, density, poisson_ratio : float
        E [N/m²], ρ [kg/m³], and ν of the shear modulus E/(2 (1 + ν)).

    Raises
    ------
    TypeError
        If `section` is none.
    ValueError
        If it has several materials.

    Examples
    --------
    With the extra `sections`::

        from sectionproperties.analysis import Section
        from sectionproperties.pre.library import rectangular_hollow_section

        box = rectangular_hollow_section(d=0.2, b=0.6, t=0.02, r_out=0.0, n_r=1)
        S, M = matrices_of(Section(box.create_mesh(1e-4)), 7e10, 2700.0)
        blade = Blade.from_stations([0.0, 20.0], [S, S], [M, M])
    """
    if not hasattr(section, "calculate_warping_properties"):
        raise TypeError(f"a Section of sectionproperties is needed, got {shown(section)}")
    if section.is_composite():
        raise ValueError("the section has several materials: give one of a single material")
    E, rho = (
        positive("youngs_modulus", youngs_modulus, "Pa"),
        positive("density", density, "kg/m^3"),
    )
    G = 0.5 * E / (1.0 + not_negative("poisson_ratio", poisson_ratio))
    section.calculate_geometric_properties()
    section.calculate_warping_properties()
    A, (Ixx, Iyy, Ixy) = section.get_area(), section.get_ic()
    (along, across), both = section.get_as(), section.section_props.a_sxy
    bending = np.array([[Ixx, -Ixy], [-Ixy, Iyy]])
    shear = np.linalg.inv(1.0 / np.array([[along, both], [both, across]]))
    tension, mass, torsion = np.zeros((3, 1, 6, 6))
    tension[0, 0, 0] = E * A
    tension[0, 4:, 4:] = E * bending
    torsion[0, 1:3, 1:3] = G * shear
    torsion[0, 3, 3] = G * section.get_j()
    mass[0, [0, 1, 2], [0, 1, 2]] = rho * A
    mass[0, 3, 3], mass[0, 4:, 4:] = rho * (Ixx + Iyy), rho * bending
    centroid, center = (np.array([one()]) for one in (section.get_c, section.get_sc))
    stiffness = moved(tension, centroid) + moved(torsion, center)
    return stiffness[0], moved(mass, centroid)[0]
