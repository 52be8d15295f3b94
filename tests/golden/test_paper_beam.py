"""The numbers of the paper's beam, kept to the last digit across every change of the code.

They are this package's own, so they prove nothing but that nothing moved; what is right is tested
elsewhere. `python tests/golden/test_paper_beam.py` writes them anew, after a change that should
move them.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from analytic import (
    VARIANTS,
    Beam,
    SpinUp,
    Theory,
    campbell,
    linear_modes,
    periodic_orbits,
    reduced_model,
    spin_up_response,
)

KEPT = Path(__file__).with_name("paper_beam.json")
SPEEDS = (0.0, 2.0, 4.0, 6.0, 8.0)


def modes(beam):
    return {
        "frequencies": [linear_modes(beam, omega).frequencies.tolist() for omega in SPEEDS],
        "inextensible": linear_modes(
            beam, 6.0, theory=Theory(extension=False)
        ).frequencies.tolist(),
        "rotary inertia": linear_modes(
            beam, 6.0, theory=Theory(rotary_inertia=True)
        ).frequencies.tolist(),
        "Campbell": campbell(beam, SPEEDS).frequencies.tolist(),
    }


def reduced(beam):
    models = {
        name: [reduced_model(beam, omega, name) for omega in (2.0, 6.0)]
        for name in sorted(VARIANTS)
    }
    return {
        name: {
            "omega_n": [model.omega_n for model in pair],
            "g1": [model.g1 for model in pair],
            "g2": [model.g2 for model in pair],
            "lambda_omega": [model.lambda_omega for model in pair],
            "lambda_x": [model.lambda_x for model in pair],
            "frequency": [float(model.exact_frequency(0.2)) for model in pair],
        }
        for name, pair in models.items()
    }


def orbits(beam):
    result = {}
    for omega in (0.0, 6.0):
        found = periodic_orbits(beam, omega, [0.1, 0.5])
        result[f"{omega:g} rad/s"] = {
            "omega_n": found.omega_n,
            "lambda_omega": found.lambda_omega,
            "frequency": found.frequency.tolist(),
            "harmonics": found.harmonics[:, :4].tolist(),
            "peak_time": found.peak_time.tolist(),
            "state": found.state(1, [4.0], phase=1.0).place[:, 1].tolist(),
        }
    return result


def spin_up(beam):
    found = spin_up_response(beam, SpinUp(omega=6.0, ramp_time=3.0), np.linspace(0.0, 5.0, 11))
    tip = found.from_axis[:, :2].tolist()
    return {"q": found.q.tolist(), "q_dot": found.q_dot.tolist(), "tip": tip}


def simulation(beam):
    from rotbeam_exu import natural_frequencies, simulate, steady_oscillation

    result = {}
    for frame in ("inertial", "rotating"):
        run = simulate(beam, SpinUp(omega=6.0, ramp_time=3.0), duration=8.0, step=2e-3, frame=frame)
        steady = steady_oscillation(run)
        result[frame] = {
            "q": run["q"].to_numpy()[::50].tolist(),
            "jacobi_energy": run["jacobi_energy"].to_numpy()[::50].tolist(),
            "amplitude": steady.amplitude,
            "frequency": steady.frequency,
        }
    # Linear elements are unstable at the speeds of the paper.
    for element, omega in (
        ("cable", 6.0), ("exact", 6.0), ("ancf3", 6.0), ("linear", 0.2), ("substructures", 2.0)
    ):  # fmt: skip
        result[element] = natural_frequencies(beam, omega, element=element, elements=16).tolist()
    return result


PARTS = {function.__name__: function for function in (modes, reduced, orbits, spin_up, simulation)}


def leaves(value, name=""):
    """The arrays of a tree, by their names."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, f"{name}/{key}")
    else:
        yield name, np.asarray(value, dtype=float)


@pytest.mark.parametrize("part", PARTS)
def test_no_number_moves(beam, part):
    # One part in 1e12 of the largest of a kind; an Exudyn run multiplies round-off in its steps,
    # λ_ω is what two frequencies differ by, over the squares of amplitudes of 0.02 and 0.04, and
    # where a peak is flat its time takes no part in what is solved.
    loose = {"simulation": 1e-9, "lambda_omega": 1e-10, "peak_time": 1e-10}
    kept = dict(leaves(json.loads(KEPT.read_text(encoding="utf-8"))[part]))
    found = dict(leaves(PARTS[part](beam)))
    assert found.keys() == kept.keys()
    for name, values in kept.items():
        share = loose.get(part, loose.get(name.split("/")[-1], 1e-12))
        assert np.abs(found[name] - values).max() <= share * np.abs(values).max(), name


if __name__ == "__main__":
    reference = Beam.reference()
    numbers = {name: part(reference) for name, part in PARTS.items()}
    KEPT.write_text(json.dumps(numbers, indent=1) + "\n", encoding="utf-8")
