"""Files for ParaView, read back by a reader that is not ours."""

import numpy as np
import pytest

from analytic import Beam, Blade, SpinUp, Tube, periodic_orbits, spin_up_response, steady_state
from rotbeam_exu import dataset_of, load, save, simulate
from rotbeam_exu.files.vtk import save_vtk
from rotbeam_exu.runs.shape import in_space, outer_strain, shape_of, sides_of

meshio = pytest.importorskip("meshio")

STATIONS = np.linspace(0.0, 8.0, 9)
MOTION = SpinUp(omega=3.0, ramp_time=3.0)


def read(path, n):
    return meshio.read(path.with_suffix("") / f"{path.stem}-{n:04d}.vtu")


@pytest.fixture(scope="module")
def shape(beam):
    response = spin_up_response(beam, MOTION, [1.0, 2.0, 3.0], tolerance=1e-5, points=STATIONS)
    return dataset_of(response)


def test_a_line_comes_back_with_every_digit(shape, tmp_path):
    path = save_vtk(shape, tmp_path / "blade.pvd")
    times = [float(part.partition('"')[0]) for part in path.read_text().split('timestep="')[1:]]
    assert times == [1.0, 2.0, 3.0]
    for n, angle in enumerate(shape["angle"].to_numpy()):
        found, here = read(path, n), shape.isel(time=n)
        np.testing.assert_array_equal(found.points, in_space(shape)[0][n])
        # The paper's beam is planar and has no hub: from outside it is turned alone.
        x, y, _ = here["place"].to_numpy().T
        np.testing.assert_allclose(
            found.points[:, :2] @ [1.0, 1j], (x + 1j * y) * np.exp(1j * angle), atol=1e-12
        )
        (lines,) = found.cells
        assert lines.type == "line"
        np.testing.assert_array_equal(lines.data, np.stack((np.arange(8), np.arange(1, 9)), 1))
        for name in ("force", "moment", "strain", "station"):
            np.testing.assert_array_equal(found.point_data[name], here[name])
        along = np.diff(found.points, axis=0).sum(axis=0)
        assert found.point_data["normal"].sum(axis=0) @ along > 0.0
        np.testing.assert_array_equal(
            found.point_data["thickness"], np.tile([0.0, 0.0, 1.0], (9, 1))
        )


def test_a_body_has_the_volume_of_the_blade_and_the_stress_in_its_corners(beam, shape, tmp_path):
    height = np.sqrt(12.0 * beam.second_moment / beam.area)
    width = beam.area / height
    path = save_vtk(shape, tmp_path / "blade.pvd", height=height, width=width)
    found = read(path, 1)
    (bodies,) = found.cells
    assert bodies.type == "hexahedron"
    corners = found.points[bodies.data]
    # By three edges of each, right-handed as VTK has them; curved axes are longer than chords.
    edges = (corners[:, k] - corners[:, 0] for k in (1, 3, 4))
    volume = np.linalg.det(np.stack(list(edges), axis=-1))
    np.testing.assert_allclose(volume, beam.area * 1.0, rtol=1e-2)
    stress = found.point_data["stress"].reshape(9, 4)
    largest = outer_strain(shape, height, width).isel(time=1) * beam.youngs_modulus
    np.testing.assert_allclose(np.abs(stress).max(axis=1), largest, rtol=1e-12, atol=1e-3)
    # M h/2I, on the side from which the blade bends away.
    moment = shape["moment"].sel(section_axis="thickness").isel(time=1, station=0).item()
    bent = 0.5 * (stress[0, 0] - stress[0, 1])
    assert bent == pytest.approx(0.5 * moment * height / beam.second_moment, rel=1e-12)


def test_a_coned_blade_turns_about_its_axis_and_rests_where_no_angle_is_told(tmp_path):
    blade = Beam.reference().with_section_out_of_plane(0.25, 0.2).with_twist(0.5)
    blade = blade.with_precone(0.1).with_hub_radius(0.5)
    loads = steady_state(blade, 2.0).section_loads(STATIONS)
    found = read(save_vtk(shape_of(loads), tmp_path / "blade.pvd"), 0)
    np.testing.assert_allclose(found.points[0], [0.5, 0.0, 0.0], atol=1e-15)
    axes = np.stack([found.point_data[name] for name in ("normal", "chord", "thickness")], axis=-1)
    unit = np.broadcast_to(np.eye(3), axes.shape)
    np.testing.assert_allclose(np.swapaxes(axes, 1, 2) @ axes, unit, atol=1e-14)
    np.testing.assert_allclose(axes[0, :, 0], [np.cos(0.1), 0.0, np.sin(0.1)], atol=1e-14)
    # The clamp holds the section: its chord is in the plane of rotation.
    np.testing.assert_allclose(axes[0, :, 1], [0.0, 1.0, 0.0], atol=1e-14)


def test_a_run_is_saved_with_its_stations_and_an_orbit_is_written_too(beam, tmp_path):
    run = simulate(
        beam, SpinUp(omega=1.0, ramp_time=1.0), elements=2, duration=1.5, step=5e-3,
        stations=[0.0, 8.0],
    )  # fmt: skip
    again = load(save(run, tmp_path / "run.nc"))
    assert again.identical(run)
    path = save_vtk(again.isel(time=[-1]), tmp_path / "run.pvd")
    tip = read(path, 0).points[-1]
    np.testing.assert_allclose(tip[:2], [run["tip_x"][-1], run["tip_y"][-1]], atol=1e-9)
    orbit = periodic_orbits(beam, 3.0, [0.2])
    around = shape_of(orbit.section_loads(0, STATIONS, [0.0, 1.0]))
    place = read(save_vtk(around, tmp_path / "orbit.pvd"), 1).points
    np.testing.assert_allclose(place[:, 1], orbit.axis(0, STATIONS, [1.0])[0, :, 1], atol=1e-12)


def test_what_has_no_sections_is_refused(beam, shape, tmp_path):
    bare = dataset_of(spin_up_response(beam, MOTION, [1.0, 2.0], tolerance=1e-4))
    for data in (bare, shape.isel(station=[0])):
        with pytest.raises(
            ValueError, match="give simulate stations=, or spin_up_response points="
        ):
            save_vtk(data, tmp_path / "blade.pvd")
    with pytest.raises(ValueError, match="ending must be .pvd"):
        save_vtk(shape, tmp_path / "blade.vtu")
    assert not list(tmp_path.iterdir())


def test_sides_of_a_tapered_blade_are_given_at_its_stations(beam, tmp_path):
    """One height of a blade whose height varies is refused, one width that does not is good."""
    blade = beam.with_taper(height=0.4)
    orbit = periodic_orbits(blade, 3.0, [0.2]).section_loads(0, STATIONS, [1.0])
    loads = shape_of(orbit).isel(time=0)
    root = np.sqrt(12.0 * beam.second_moment / beam.area)
    height, width = root * (1.0 - 0.05 * STATIONS), beam.area / root
    with pytest.raises(
        ValueError, match="height of this blade varies .* to 0.6 of its largest: gi"
    ):
        outer_strain(loads, root)
    with pytest.raises(ValueError, match="height of this blade varies .* at each of the 9 station"):
        save_vtk(loads, tmp_path / "blade.pvd", height=root, width=width)
    assert not list(tmp_path.iterdir())
    strain = outer_strain(loads, height, width)
    by_hand = abs(loads["strain"]) + 0.5 * abs(loads["curvature"][:, 2]) * height
    np.testing.assert_allclose(strain, by_hand, rtol=1e-12)
    # At one station alone, too.
    one = outer_strain(loads.isel(station=3), [height[3]], width)
    np.testing.assert_allclose(one, by_hand[3], rtol=1e-12)
    found = read(save_vtk(loads, tmp_path / "blade.pvd", height=height, width=width), 0)
    corners = found.points.reshape(9, 4, 3)
    np.testing.assert_allclose(
        np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1), height, rtol=1e-9
    )
    np.testing.assert_allclose(
        np.linalg.norm(corners[:, 2] - corners[:, 1], axis=1), width, rtol=1e-9
    )
    largest = np.abs(found.point_data["strain"].reshape(9, 4)).max(axis=1)
    np.testing.assert_allclose(largest, strain, rtol=1e-12)


def test_sides_of_other_blades_that_vary(beam):
    """By the stiffness in the plane and out of it, of coefficients, ratios and tables."""
    chord, thick = np.array([0.4, 0.3]), np.array([0.1, 0.1])
    EA, m = 7e10 * chord * thick, 2700.0 * chord * thick
    stiffness = np.stack([EA, EA, EA, EA * thick**2 / 3.0, EA * thick**2 / 12, EA * chord**2 / 12])
    mass = np.stack([m, m * chord**2 / 12, m * thick**2 / 12, m * chord**2 / 12])
    table = Blade.from_stations([0.0, 8.0], stiffness.T, mass.T)
    at, flat = np.array([2.0, 6.0]), beam.with_taper(width=0.5)
    assert sides_of(flat, at, height=0.2).tolist() == [[0.2], [0.2]]
    assert sides_of(table, at, width=0.1).tolist() == [[0.1], [0.1]]
    assert sides_of(beam.with_shape(Tube()), at, height=0.2, width=0.2).shape == (2, 2)
    for blade, name in (
        (flat, "width"), (table, "height"), (beam.with_shape(Tube()).with_taper(0.3, 0.3), "width")
    ):  # fmt: skip
        with pytest.raises(ValueError, match=f"the {name} of this blade varies"):
            sides_of(blade, at, **{name: 0.2})
        given = sides_of(blade, at, **{name: [0.2, 0.1]})
        assert given.ravel().tolist() == [0.2, 0.1]
    with pytest.raises(ValueError, match="height must be one number in m, or one at each of the 2"):
        sides_of(table, at, height=[0.3, 0.2, 0.1])
    with pytest.raises(ValueError, match="width must not be negative, got -0.1 m"):
        sides_of(table, at, width=[0.3, -0.1])
