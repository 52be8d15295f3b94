"""Forces and moments on the span in `space_exact`, compared with the exact blade."""

import numpy as np
import pytest

from analytic import Blade, LoadTable, PointLoad, Section, SpinUp, spin_up_response, steady_state
from rotbeam_exu import simulate
from rotbeam_exu.fem.elements import formulation
from rotbeam_exu.fem.linearization import Linearization

SECTION = Section(axial_stiffness=2e3, bending_stiffness=1.0, mass_per_length=1.0)
BLADE = Blade(length=2.0, section=SECTION).with_section_out_of_plane(0.5, 0.6)
BLADE = BLADE.with_twist(0.5).with_precone(0.05)
THEORY = formulation("space_exact").theory_of(BLADE)
OFFSET = Blade.from_stations(
    [0.0, 2.0], [[2e3, 1e3, 1e3, 0.6, 0.5, 1.0]] * 2, [[1.0, 2e-3, 1e-3, 1e-3]] * 2,
    twist=[0.0, 0.5], center=[[0.1, 0.05]] * 2, tension=[[0.06, -0.04]] * 2,
)  # fmt: skip
ON_SPAN = {"x": [0.5, 1.5], "force": [[0.0, 0.1, 0.2], [0.0, 0.2, 0.1]]}
MOMENT = [[0.1, 0.0, 0.0], [0.0, 0.1, 0.1]]


@pytest.mark.parametrize(
    "load",
    [
        PointLoad(force=(0.2, 0.1, 0.2), moment=(0.1, 0.2, -0.1), position=1.0),
        PointLoad(force=(0.0, 0.2, 0.3), following=True),
        LoadTable(**ON_SPAN, moment=MOMENT),
        LoadTable(**ON_SPAN, moment=MOMENT, following=True),
    ],
    ids=["point", "following tip", "table", "following table"],
)
@pytest.mark.parametrize("blade", [BLADE, OFFSET], ids=["bare", "offset centers"])
def test_the_tip_tends_to_that_of_the_exact_blade_with_order_two(load, blade):
    """At a node: between nodes the error follows the place in the cell, and is as small."""
    theory = formulation("space_exact").theory_of(blade)
    exact, free = (
        steady_state(blade, speed, loads=of, theory=theory).tip
        for speed, of in ((0.5, [load]), (0.0, []))
    )
    errors = [
        np.linalg.norm(
            Linearization.of(blade, 0.5, "space_exact", n, weight=[load]).tip - (exact - free) / 2.0
        )
        for n in (8, 16, 32)
    ]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize("following", [False, True])
def test_a_spin_up_under_a_load_that_grows_tends_to_the_exact_one(following):
    times = np.linspace(0.0, 4.0, 9)
    grows = np.sin(np.pi * times / 8.0)[:, None, None] ** 4
    load = LoadTable(
        x=ON_SPAN["x"], time=times, force=grows * ON_SPAN["force"], moment=grows * MOMENT,
        following=following,
    )  # fmt: skip
    spin_up = SpinUp(omega=1.0, ramp_time=2.0)
    exact = spin_up_response(BLADE, spin_up, times, loads=[load], theory=THEORY, tolerance=1e-3)
    errors = []
    for n, step in ((8, 0.02), (16, 0.01)):
        run = simulate(
            BLADE, spin_up, element="space_exact", elements=n, duration=4.0, step=step,
            loads=[load], stations=[0.0, 1.8],
        )  # fmt: skip
        moved = [np.interp(times, run["time"], run[name]) for name in ("q", "w")]
        away = np.transpose(moved) - (exact.tip - exact.tip[0])[:, 1:]
        errors.append(np.abs(away).max(axis=0))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert np.all(errors[1] < 0.02)
    # What the sections bear at the root, by inertia and loads outboard, is what the clamp bears.
    for kind in ("force", "moment"):
        clamp = np.array([run[f"root_{kind}_{axis}"][-1] for axis in "xyz"])
        found = run[kind].to_numpy()[-1]
        assert found[0] == pytest.approx(clamp, abs=3e-3 * np.abs(clamp).max())
        # The load ends at 1.5 m, and beyond only inertia acts.
        assert np.abs(found[1]).max() < 0.3 * np.abs(found[0]).max()


def test_an_element_of_the_plane_names_the_one_that_takes_it():
    with pytest.raises(ValueError, match="element 'cable' .* on the span: take element='space_ex"):
        simulate(
            Blade(length=2.0, section=SECTION), SpinUp(omega=1.0, ramp_time=2.0), duration=4.0,
            loads=[PointLoad(force=(0.0, 1.0, 0.0))],
        )  # fmt: skip


def test_a_place_beyond_the_tip_is_refused():
    with pytest.raises(ValueError, match="3 m"):
        simulate(
            BLADE, SpinUp(omega=1.0, ramp_time=2.0), element="space_exact", duration=4.0,
            step=0.02, loads=[PointLoad(force=(0.0, 0.1, 0.0), position=3.0)],
        )  # fmt: skip
