"""The Explorer of a blade that is not the paper's beam."""

import numpy as np
import pytest

from analytic import periodic_orbits, reduced_model
from rotbeam_exu.explorer import explorer_data, explorer_page


@pytest.mark.slow
def test_a_blade_has_a_page_of_its_own(open_page, drawn, beam, tmp_path):
    blade = beam.with_hub_radius(0.5 * beam.length).with_tip_mass(0.5 * beam.mass)
    data = explorer_data(
        blade, omegas=(0.0, 6.0, 12.0), amplitudes=(0.1, 0.2, 0.3), finite_element_omegas=(6.0,),
        ramp_times=(8.0,), exact_ramp_times=(8.0,), elements=4, jobs=2,
    )  # fmt: skip
    path = tmp_path / "blade.html"
    path.write_text(explorer_page(data), encoding="utf-8")
    page = open_page(path.as_uri() + "#view=expert")
    assert "on a hub of 4 m" in page.locator("#blade").inner_text()
    model = reduced_model(blade, 6.0, "FrM")
    row = page.locator("tr[data-model=FrM]")
    assert row.locator("td.linear").inner_text() == f"{model.omega_n:.4f}"
    assert row.locator("td.lambda").inner_text() == f"{model.lambda_omega:.5f}"
    assert page.locator("tr[data-model=FrE] td").all_inner_texts() == ["–"] * 5
    exact = periodic_orbits(blade, 6.0, [0.1, 0.2, 0.3])
    x, y = drawn(page, "backbone", "path[data-model=exact]")
    np.testing.assert_allclose(y[1:], exact.frequency / exact.omega_n, atol=3e-4)
    # λ above the close-up of the paper's beam is on the paper all the same.
    x, y = drawn(page, "softening", "path[data-model=exact]")
    assert y[np.argmin(np.abs(x - 6.0))] == pytest.approx(exact.lambda_omega, abs=1e-3)
    assert exact.lambda_omega > 0.06
    assert page.evaluate("softening.y(D.exact_lambda_omega[1]) > softening.y1")


def test_it_begins_in_the_middle_of_what_there_is(open_page, page, data, tmp_path):
    start = "[D.omega[state.w], T(), finiteElements().length]"
    assert page.evaluate(start) == [6.0, 3.0, 2]
    scaled = data.assign_coords({name: 20.0 * data[name] for name in ("omega", "fe_omega")})
    times = {name: data[name] / 20.0 for name in ("ramp_time", "exact_ramp_time", "time")}
    path = tmp_path / "shorter.html"
    path.write_text(explorer_page(scaled.assign_coords(times)), encoding="utf-8")
    assert open_page(path.as_uri() + "#view=expert").evaluate(start) == [120.0, 0.15, 2]
