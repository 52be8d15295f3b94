"""Numbers that stand on the pages in words, where no block computes them."""

import math
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from scipy import optimize

from analytic import (
    Blade,
    Damping,
    Rectangle,
    Section,
    SpinUp,
    damping_ratios,
    design_ramp,
    linear_modes,
    residual_amplitude,
    spin_up_response,
)
from analytic.reduced.any_blade import blade_oscillator
from rotbeam_exu import kicked, natural_frequencies, simulate, steady_oscillation
from rotbeam_exu.fem.elements import Cable

DOCS = Path(__file__).parents[2] / "docs"
_GRAVITY = 9.81  # [m/s²]


@dataclass(frozen=True, kw_only=True)
class OtherQuadrature(Cable):
    """The cable with another of Exudyn's integration schemes."""

    quadrature: int = 0

    name: ClassVar[str] = "other quadrature"

    def lay(self, mbs, beam, elements):
        chain = super().lay(mbs, beam, elements)
        for body in chain.bodies:
            mbs.SetObjectParameter(body, "useReducedOrderIntegration", self.quadrature)
        return chain


def says(page, words):
    return words in " ".join((DOCS / page).read_text(encoding="utf-8").split())


def elements_by_quadrature():
    return ((0, OtherQuadrature(quadrature=0)), (1, OtherQuadrature(quadrature=1)), (2, Cable()))


def test_reduced_integration_costs_accuracy_in_linear_frequencies(beam):
    assert says("gotchas.md", "it is two to three times farther")
    exact = linear_modes(beam, 6.0).frequencies[0]
    off = {
        q: natural_frequencies(beam, 6.0, element=element, elements=8, count=1)[0] / exact - 1.0
        for q, element in elements_by_quadrature()
    }
    for q in (0, 1):
        assert 2.0 < off[2] / off[q] < 3.0


@pytest.mark.slow
def test_reduced_integration_helps_large_oscillations(beam):
    assert says("gotchas.md", "`useReducedOrderIntegration=2`, which is used here, is ten times")
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    runs = {
        q: simulate(beam, spin_up, element=element, elements=8, step=2e-3, duration=8.0)["q"]
        for q, element in elements_by_quadrature()
    }
    exact = spin_up_response(beam, spin_up, runs[2]["time"].to_numpy(), tolerance=1e-5).q
    off = {q: np.abs(run.to_numpy() - exact).max() for q, run in runs.items()}
    for q in (0, 1):
        assert off[q] / off[2] > 10.0


@pytest.mark.slow
@pytest.mark.parametrize(("omega", "ratio"), [(2.0, 3.5), (8.0, 19.0)])
def test_the_rotating_frame_has_the_smaller_step_error(beam, omega, ratio):
    assert says("theory/finite_element.md", "3.5 times at 2 rad/s to 19 times at 8 rad/s")
    by_step = {}
    for frame in ("inertial", "rotating"):
        runs = [
            simulate(beam, SpinUp(omega=omega, ramp_time=3.0), elements=8, step=step, frame=frame)
            for step in (2e-3, 1e-3)
        ]
        coarse, fine = (steady_oscillation(run).frequency for run in runs)
        by_step[frame] = coarse - fine
    assert by_step["inertial"] / by_step["rotating"] == pytest.approx(ratio, rel=0.1)


def test_gravity_would_bend_and_buckle_the_strip(beam):
    """Both of its directions as cantilevers under their weight; 12.85 by another test."""
    page = "theory/planar.md"
    assert says(page, "without gravity")
    assert says(page, "the strip sags by 0.22 $L$ in its stiff direction")
    assert says(page, "length of 2.36 m it buckles under its own weight")
    assert says(page, r"$I_y=I_z=8.2189\cdot10^{-9}$ m⁴: most likely a thin tube")
    section = beam.with_shape(Rectangle()).section.out_of_plane
    weight = beam.mass_per_length * _GRAVITY
    sag = weight * beam.length**3 / (8.0 * beam.bending_stiffness)  # over L
    assert round(sag, 2) == 0.22
    stiffness = math.sqrt(section.bending_ratio * section.torsion_ratio) * beam.bending_stiffness
    assert round((12.85 * stiffness / weight) ** (1.0 / 3.0), 2) == 2.36
    assert round(math.sqrt(2.0 * beam.second_moment / beam.area), 4) == 0.015
    height, width = math.sqrt(12.0 * beam.second_moment / beam.area), 2.0e-3
    assert says(page, "36.7 mm high and 2.0 mm thick")
    assert round(height, 4) == 0.0367
    assert beam.area / height == pytest.approx(width, rel=0.01)


@pytest.mark.slow  # designed ramps are tested in test_residual
def test_a_designed_ramp_swings_on_the_way_and_knows_its_blade(beam):
    page, findings = "theory/spin_up.md", "findings.md"
    assert says(page, "the tip goes to $-0.71L$")
    assert says(page, r"is $2.1\cdot10^{-2}L$, with 0.1 % it is $2\cdot10^{-3}L$")
    assert says(page, r"causes $2.1\cdot10^{-2}L$ instead of $3\cdot10^{-6}L$")
    assert says(findings, "in 2 s, the residual amplitude is 3e-6 L")
    assert says(
        findings,
        "the tip is at -0.71 L, and an error of 1 % in the blade's frequency causes 2.1e-2 L",
    )
    ramp = design_ramp(beam, omega=6.0, duration=2.0)
    assert residual_amplitude(beam, ramp, exact=True) == pytest.approx(3e-6, rel=0.1)
    way = spin_up_response(beam, ramp, np.linspace(0.0, 2.0, 201)).q / beam.length
    assert round(way.min(), 2) == -0.71

    def left(change):
        other = replace(beam, youngs_modulus=beam.youngs_modulus * (1.0 + change) ** 2)
        return residual_amplitude(other, ramp, exact=True)

    assert left(0.01) == pytest.approx(2.1e-2, rel=0.03)
    assert left(-0.01) == pytest.approx(2.1e-2, rel=0.03)
    assert left(1e-3) == pytest.approx(2e-3, rel=0.1)


@pytest.mark.parametrize(("angle", "zero"), [(0.5 * math.pi, 0.900803), (0.0, 3.59302)])
def test_flap_softens_at_a_lower_speed_than_lag(beam, angle, zero):
    """Computed by another code, to six digits."""
    assert says(
        "theory/continuum.md", r"flap softens from $\bar\omega=0.9008$ on, lag only from 3.5930"
    )
    unit = beam.with_setting_angle(angle).unit
    below, above = (
        blade_oscillator(unit, zero + change, coriolis=True).oscillator.lambda_omega
        for change in (-5e-6, 5e-6)
    )
    assert below < 0.0 < above


def test_where_twice_the_flap_frequency_is_that_of_lag():
    words = r"at $\bar\omega=1.441$, with lag's $EI$, if it is a sixteenth"
    assert says("theory/continuum.md", words)
    section = Section(axial_stiffness=1e9, bending_stiffness=1.0, mass_per_length=1.0)
    blade = Blade(length=1.0, section=section).with_section_out_of_plane(1.0 / 16.0, math.inf)

    def apart(w_bar):
        flap, lag = (
            linear_modes(blade, w_bar, 1, only=plane).frequencies[0] for plane in ("flap", "lag")
        )
        return 2.0 * flap - lag

    assert optimize.brentq(apart, 1.0, 2.0, xtol=1e-6) == pytest.approx(1.441, abs=5e-4)
    quarter = blade.with_section_out_of_plane(0.25, math.inf)
    at_rest = [linear_modes(quarter, 0.0, 1, only=p).frequencies[0] for p in ("flap", "lag")]
    assert 2.0 * at_rest[0] == pytest.approx(at_rest[1], rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("elements", "by_mode", "time", "lag", "words"),
    [
        (32, False, 1.2, 0.107, "it is twisted by 0.1 at 1.2 s, bent by 0.107 $L$ (32 elements"),
        (64, True, 1.17, 0.1, "1.17 s and 0.100 $L$ with 64"),
    ],
)
def test_the_strip_buckles_on_the_mildest_ramp_already(beam, elements, by_mode, time, lag, words):
    assert says("theory/planar.md", words)
    motion = SpinUp(omega=2.0, ramp_time=3.375)
    settings = {"element": "space_exact", "duration": 3.4, "elements": elements, "step": 2.5e-4}
    strip = beam.with_shape(Rectangle())
    run = simulate(strip, motion, initial_state=kicked(strip, by_mode=by_mode), **settings)
    at = int((np.abs(run["twist"]) > 0.1).argmax("time"))
    # Another code, a discrete rod that starts on an arc, has 1.20 s and 0.106.
    assert float(run["time"][at]) == pytest.approx(time, abs=0.01)
    assert abs(float(run["q"][at])) / beam.length == pytest.approx(lag, abs=2e-3)


def test_point_masses_have_no_external_damping(beam):
    """ζ = d ∫φ²dx/(2 ω_n M₁): a tip mass is in M₁ only."""
    blade = beam.with_tip_mass(0.3 * beam.mass).with_damping(Damping(external=1e-3))
    modes = linear_modes(blade, 0.0, 1)
    x, weights = np.polynomial.legendre.leggauss(40)
    shape = modes.shapes(0.5 * (x + 1.0) * beam.length)[1, :, 0].real  # one at the tip
    area = 0.5 * beam.length * weights @ shape**2
    inertia = beam.mass_per_length * area + 0.3 * beam.mass
    # Coefficients and modes are resolved to 1e-9.
    assert damping_ratios(blade, 0.0, 1)[0] == pytest.approx(
        1e-3 * area / (2.0 * modes.frequencies[0] * inertia), rel=1e-7
    )


def test_the_strip_buckles_laterally_where_the_page_says(beam):
    """Lateral buckling of a cantilever at rest by a force at its tip, P L² = 4.0126 EI √(rg)."""
    across = beam.with_shape(Rectangle()).section.out_of_plane
    found = 4.0126 / 3.0 * math.sqrt(across.bending_ratio * across.torsion_ratio)
    assert says("theory/planar.md", rf"$\tfrac13\,4.0126\sqrt{{rg}}\,L={found:.4f}\,L$")


def test_the_birth_of_the_whirl_follows_from_its_printed_formula():
    page = (DOCS / "theory/planar.md").read_text(encoding="utf-8")
    (p,), (c,), (ratio,), (delta,), (born,) = (
        map(float, re.findall(pattern, page))
        for pattern in (
            r"\$p=([\d.]+)\$ be the hardening",
            r"\$c=([\d.]+)\$ that of",
            r"With \$r=([\d.]+)\$, so",
            r"0\.998}=([\d.]+)\$, this",
            r"gives \$a_0\$ = ([\d.]+)\. ",
        )
    )
    assert delta == pytest.approx(1.0 - math.sqrt(ratio), abs=5e-8)
    assert born == pytest.approx(math.sqrt(delta / (c - 2.0 * p)), abs=5e-7)
