"""Sections between stations: columns and centers are linear, however the blade is written."""

import numpy as np
import pytest

from analytic import Blade, Theory, linear_modes
from analytic.description import describe, from_description
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import finite_elements

RIGID, SHEARED = Theory(trapeze=False), Theory(shear=True, trapeze=False)
X = np.linspace(0.0, 1.0, 9)
STIFFNESS = [4e3, 4e3, 4e3, 0.08, 0.0625, 1.0] * (1.0 - X[:, None] * [0.5, 0.5, 0.5, 0.7, 0.7, 0.7])
MASS = [1.0, 3e-3, 2e-3, 1e-3] * (1.0 - X[:, None] * [0.5, 0.0, 0.0, 0.0])
TWIST = 0.3 * X
CENTERS = ("tension", "shear", "center")


def jumps(size, *names):
    """Centers that jump from station to station, in units of the length."""
    return {
        name: size * np.random.default_rng(seed).standard_normal((X.size, 2))
        for seed, name in enumerate(CENTERS)
        if name in names
    }


def blade_of(centers, parts=1, **more):
    """The table with stations inserted, by interpolation of what it gives."""
    x = np.linspace(0.0, 1.0, (X.size - 1) * parts + 1)

    def inserted(values):
        return np.stack([np.interp(x, X, column) for column in np.transpose(values)], axis=-1)

    return Blade.from_stations(
        x, inserted(STIFFNESS), inserted(MASS), twist=np.interp(x, X, TWIST),
        **{name: inserted(center) for name, center in centers.items()}, **more,
    )  # fmt: skip


def by_hand(stiffness, mass, tension, shear, center):
    """Matrices (stations, 6, 6) of columns, from strains and velocities at their centers."""
    S, M = np.zeros((2, len(stiffness), 6, 6))
    for k, (stiff, (m, *j)) in enumerate(zip(stiffness, mass, strict=True)):
        (t2, t3), (s2, s3), (c2, c3) = tension[k], shear[k], center[k]
        strains = np.eye(6)
        strains[0, 4:] = t3, -t2
        strains[1:3, 3] = -s3, s2
        S[k] = strains.T @ np.diag(stiff) @ strains
        turning = np.array([[0.0, c3, -c2], [-c3, 0.0, 0.0], [c2, 0.0, 0.0]])
        velocity = np.hstack([np.eye(3), turning])
        M[k] = m * velocity.T @ velocity
        M[k, 3:, 3:] += np.diag(j)
    return S, M


def frequencies(blade, omega=0.0, count=4, theory=SHEARED):
    return linear_modes(blade, omega, count, theory=theory, tolerance=1e-9).frequencies


@pytest.mark.parametrize("size", [0.03, 0.005, 0.001])
def test_stations_in_between_change_nothing(size):
    """Whatever the size of the jumps, over radii of gyration of 0.016 at the root."""
    coarse, fine = (frequencies(blade_of(jumps(size, "tension"), n), theory=RIGID) for n in (1, 4))
    assert coarse == pytest.approx(fine, rel=2e-9)


def test_stations_in_between_change_nothing_in_rotation():
    """With all centers, which jump by a tenth of a radius of gyration and more."""
    coarse, fine = (frequencies(blade_of(jumps(0.002, *CENTERS), n), 4.0) for n in (1, 3))
    assert coarse == pytest.approx(fine, rel=1e-7)


def test_a_section_between_two_bends_as_the_mean_of_both():
    """About its center of tension, as columns say; about the line it had EA Δc²/4 more, 3.99."""
    section = blade_of(jumps(0.03, *CENTERS)).section
    soft = np.linalg.inv(section.matrices(np.array([0.0, 0.0625, 0.125]))[0])
    bends = 1.0 / soft[:, [4, 5], [4, 5]]
    assert bends[1] == pytest.approx(0.5 * (bends[0] + bends[2]), rel=1e-12)


def test_no_section_is_stiffer_than_both_about_its_center():
    """Of random matrices, in any direction of bending; and every one is positive."""
    rng = np.random.default_rng(3)
    for _ in range(50):
        root = rng.standard_normal((2, 6, 6))
        S = root @ np.swapaxes(root, 1, 2) + 0.1 * np.eye(6)
        blade = Blade.from_stations([0.0, 1.0], S, [MASS[0]] * 2)
        at = blade.section.matrices(np.linspace(0.0, 1.0, 7))[0]
        assert np.linalg.eigvalsh(at).min() > 0.0
        assert at[[0, -1]] == pytest.approx(S, rel=1e-12, abs=1e-12)
        across = at[:, 0, 4:]
        bending = at[:, 4:, 4:] - across[:, :, None] * across[:, None] / at[:, :1, :1]
        strongest = np.linalg.eigvalsh(bending)[:, -1]
        assert strongest.max() <= strongest[[0, -1]].max() * (1.0 + 1e-12)


def test_principal_axes_that_turn_are_linear_in_the_axes_of_the_table():
    """Equal sections, turned by α: (EI3 - EI2) sin²(α/2) more midway about the softer axis."""
    S, angle = np.diag(STIFFNESS[0]), 0.4
    turn = np.eye(6)
    turn[4:, 4:] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    blade = Blade.from_stations([0.0, 1.0], [S, turn @ S @ turn.T], [MASS[0]] * 2)
    bending = blade.section.matrices(np.array([0.5]))[0, 0, 4:, 4:]
    soft, stiff = STIFFNESS[0, 4:]
    known = soft + (stiff - soft) * np.sin(0.5 * angle) ** 2
    assert np.linalg.eigvalsh(bending)[0] == pytest.approx(known, rel=1e-12)


def test_a_blade_is_the_same_however_it_is_written(tmp_path):
    """Columns, matrices made by hand, TOML of both, and CSV."""
    centers = jumps(0.01, *CENTERS)
    known = frequencies(blade_of(centers))
    S, M = by_hand(STIFFNESS, MASS, *centers.values())
    ways = [Blade.from_stations(X, S, M, twist=TWIST)]
    tables = {
        "columns": {"stiffness": STIFFNESS, "mass": MASS, **centers},
        "matrices": {"stiffness": S, "mass": M},
    }
    for name, table in tables.items():
        file = tmp_path / f"{name}.toml"
        keys = {"x": X, "twist": TWIST, **table}.items()
        file.write_text("[blade.stations]\n" + "".join(f"{k} = {v.tolist()}\n" for k, v in keys))
        ways.append(load_beam(file))
    titles = ["x [m]", "twist [rad]", *(f"{name} [N]" for name in ("EA", "GA2", "GA3"))]
    titles += [*(f"{name} [N m^2]" for name in ("GJ", "EI2", "EI3")), "m [kg/m]"]
    titles += [f"j{axis} [kg m]" for axis in (1, 2, 3)]
    titles += [f"{name}{axis} [m]" for name in CENTERS for axis in (2, 3)]
    rows = np.column_stack([X, TWIST, STIFFNESS, MASS, *(centers[name] for name in CENTERS)])
    lines = [",".join(titles), *(",".join(map(repr, row)) for row in rows.tolist())]
    (tmp_path / "stations.csv").write_text("\n".join(lines))
    (tmp_path / "csv.toml").write_text('[blade.stations]\nfile = "stations.csv"\n')
    ways.append(load_beam(tmp_path / "csv.toml"))
    for blade in ways:
        assert frequencies(blade) == pytest.approx(known, rel=1e-10)


def test_finite_elements_of_sections_made_by_hand_have_its_frequencies():
    """Centers of tension, shear and mass that move by 3, 2 and 4 % of the length.

    Linear elements with a section each, of columns and centers at its middle: errors fall by fours.
    """
    x = np.array([0.0, 1.0])
    ends = {
        "tension": np.array([[0.0, 0.01], [0.03, -0.01]]),
        "shear": np.array([[-0.01, 0.0], [0.01, 0.01]]),
        "center": np.array([[0.01, -0.02], [0.0, 0.02]]),
    }
    blade = Blade.from_stations(x, STIFFNESS[[0, -1]], MASS[[0, -1]], **ends)
    known = frequencies(blade, count=5)
    found = []
    for n in (64, 128):
        nodes = np.linspace(0.0, 1.0, n + 1)[:, None] * [1.0, 0.0, 0.0]
        middles = (np.arange(n) + 0.5) / n

        def at_middles(values, middles=middles):
            return values[0] + middles[:, None] * (values[-1] - values[0])

        sections = by_hand(
            at_middles(STIFFNESS), at_middles(MASS), *(at_middles(ends[k]) for k in CENTERS)
        )
        found.append(finite_elements(nodes, np.tile(np.eye(3), (n, 1, 1)), *sections, 5))
    assert (4.0 * found[1] - found[0]) / 3.0 == pytest.approx(known, rel=1e-6)


def test_matrices_linear_about_the_line_as_in_beamdyn():
    """Frequencies of this package before it interpolated components; the third is 18 % higher."""
    centers = jumps(0.005, *CENTERS)
    known = [4.284364327306014, 4.5665221143000325, 7.784755764320086, 10.944690045547175]
    blade = blade_of(centers, interpolation="matrix")
    assert frequencies(blade, 4.0) == pytest.approx(known, rel=1e-8)
    assert from_description(describe(blade), Blade) == blade
    S, M = by_hand(STIFFNESS, MASS, *centers.values())
    same = Blade.from_stations(X, S, M, twist=TWIST, interpolation="matrix").section
    x = np.array([0.0625])
    assert same.matrices(x)[:, 0] == pytest.approx(0.5 * np.stack([S, M])[:, :2].sum(axis=1))


def test_another_way_of_interpolation_is_refused():
    with pytest.raises(ValueError, match=r'must be "components" or "matrix", got .linear'):
        blade_of({}, interpolation="linear")
