"""The backbone as a branch: internal resonances by their own exponents, folds, and one answer."""

import warnings

import numpy as np
import pytest

from analytic import Beam, Damping, Theory, backbone, periodic_orbits
from analytic.exact.free.internal_resonance import frequency_ratios
from analytic.input_checks import RotbeamWarning
from tests.beams import unit_beam


def orbits(beam, omega, amplitudes, *, functions=8, **options):
    """By eight functions: of sixteen these frequencies differ by 1e-12."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RotbeamWarning)
        return periodic_orbits(beam, omega, amplitudes, functions=functions, **options)


@pytest.fixture(scope="module")
def around_a_tongue(beam):
    """Below, beyond and within the tongue of 6:1, at 2 rad/s."""
    return orbits(beam, 2.0, [0.63, 0.7, 0.64], theory=Theory(extension=False))


def test_the_answer_does_not_depend_on_the_list(beam, around_a_tongue):
    found = [
        orbits(beam, 2.0, asked, theory=Theory(extension=False)).frequency[-1]
        for asked in ([0.6, 0.7], [0.7])
    ]
    assert found == pytest.approx([around_a_tongue.frequency[1]] * 2, rel=1e-12)


def test_across_a_resonance_its_harmonic_turns_around(around_a_tongue):
    """Driven through resonance, mode 2 answers against the sixth harmonic, then with it."""
    found = around_a_tongue
    sixth = found.harmonics[:, 5] / found.harmonics[:, 0]
    assert sixth[:2] == pytest.approx([-7.3e-3, 6.8e-3], abs=1e-4)
    # Beyond the fold of the lower side, at 0.6374, there is only the upper one.
    assert sixth[2] > 0.02


def test_ratios_start_from_the_linear_modes_and_change_with_the_square(beam):
    of = backbone(beam, 2.0)
    small = [of.path.at(a) for a in (0.05, 0.1, 0.15)]
    modes, ratios = frequency_ratios(of, small)
    assert modes == ["lag 2", "lag 3", "lag 4", "lag 5"]
    linear = of.modes[1:5] / of.modes[0]
    changes = (ratios - linear) / np.array([[0.05], [0.1], [0.15]]) ** 2
    # The next term is of the fourth power, and multipliers of fast modes are right to 1e-4.
    assert changes[0] == pytest.approx(changes[1], rel=0.05)
    assert np.all(changes < 0.0)


@pytest.fixture(scope="module")
def branch():
    # The fold of twelve functions is this one to 1e-7.
    of = backbone(Beam.reference(), 2.0, theory=Theory(extension=False), functions=6)
    return of.branch(up_to=0.68)


def test_the_6_to_1_resonance_is_found_and_its_tongue_followed(branch):
    (met,) = [one for one in branch.resonances if (one.harmonic, one.mode) == (6, "lag 2")]
    # Between the fold of the lower side and the orbits beyond.
    assert 0.6374 < met.amplitude < 0.65
    (fold,) = branch.folds
    assert fold.amplitude == pytest.approx(0.63745, abs=1e-5)
    assert fold.frequency == pytest.approx(3.0465, abs=2e-4)
    # In the tongue the amplitude falls again while the second mode takes over.
    tongue = branch.amplitude[branch.piece == 1]
    assert tongue.max() > tongue[0]
    assert tongue[-1] < tongue.max() - 0.02
    assert "6:lag 2 at 0.64" in str(branch)
    state = branch.state(len(branch.amplitude) - 1, [8.0], phase=0.3)
    assert np.isfinite(state.place).all()


@pytest.mark.slow
def test_a_twisted_blade_has_tongues_of_other_families():
    """Flap at 1.5 rad/s has a fifth harmonic that meets flap 2, whose multiplier is 1 there."""
    blade = unit_beam(1e-3).with_section_out_of_plane(0.3, 0.2).with_twist(0.3)
    found = backbone(blade, 1.5, "flap 1").branch(up_to=0.2)
    (met,) = found.resonances
    assert (met.harmonic, met.mode) == (5, "flap 2")
    assert met.amplitude == pytest.approx(0.186, abs=2e-3)
    nearest = int(np.argmin(np.abs(found.amplitude - met.amplitude)))
    assert np.abs(found.multipliers[nearest][2:] - 1.0).min() < 0.05
    # In the tongue are other orbits of the same amplitudes, with far more of the harmonic.
    tongue = np.flatnonzero(found.piece == 1)
    inside = tongue[found.amplitude[tongue] < 0.16][0]
    main = np.interp(found.amplitude[inside], *(
        one[found.piece == 0] for one in (found.amplitude, found.frequency)
    ))  # fmt: skip
    assert main - found.frequency[inside] > 1e-3
    orbit = found.nondimensional[inside]
    assert orbit.residual < 1e-4
    assert orbit.invariant_drift < 1e-7
    fifth = np.abs(orbit.gauge_harmonics[5])
    assert fifth > 10.0 * np.abs(found.nondimensional[0].gauge_harmonics[5])


def test_pieces_leave_the_main_path_and_hold_orbits(branch):
    a, w, piece = branch.amplitude, branch.frequency, branch.piece
    main = piece == 0
    assert sorted(set(piece.tolist())) == [0, 1, 2]
    assert np.all(np.diff(a[main]) > 1e-3)
    assert a[main][-1] == 0.68
    low = {
        (one.harmonic, one.mode): one for one in branch.resonances if one.mode in ("lag 2", "lag 3")
    }
    assert {met: one.amplitude for met, one in low.items()} == pytest.approx(
        {(17, "lag 3"): 0.1254, (6, "lag 2"): 0.6443},
        abs=5e-4,  # six functions have the third mode to 2e-3
    )
    assert [one.amplitude for one in branch.resonances] == sorted(
        one.amplitude for one in branch.resonances
    )
    for one in branch.resonances:
        assert one.frequency == pytest.approx(np.interp(one.amplitude, a[main], w[main]), rel=1e-6)
    orbits = np.array(branch.nondimensional, dtype=object)
    for tongue in (1, 2):
        here = piece == tongue
        # It begins with an orbit of the main path, and in it the sixth harmonic takes over.
        assert orbits[here][0] in orbits[main].tolist()
        share = np.array([o.gauge_sines[5] / o.gauge_sines[0] for o in orbits[here]])
        assert np.all(np.diff(np.abs(share)) > 0.0)
        assert abs(share[-1]) > 3.0 * abs(share[0])
        assert 12 <= here.sum() <= 15
        # The invariant drifts where harmonics end; from there on the path is told roughly.
        assert max(o.invariant_drift for o in orbits[here]) < 1e-4
    # From below it turns around, from beyond it comes down.
    below, beyond = (np.sign(np.diff(a[piece == tongue])).tolist() for tongue in (1, 2))
    assert below == sorted(below, reverse=True)
    assert beyond == [-1.0] * len(beyond)
    fold = branch.marks.index("fold")
    assert a[fold] == a[piece == 1].max()


def test_a_branch_without_a_felt_resonance_is_the_backbone(beam):
    branch = backbone(beam, 6.0).branch(up_to=0.3)
    assert not branch.folds
    assert np.all(branch.piece == 0)
    assert branch.stable.all()
    same = orbits(beam, 6.0, branch.amplitude, functions=16)
    assert branch.frequency == pytest.approx(same.frequency, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("functions", [16, 22])
@pytest.mark.parametrize(
    ("omega", "up_to", "resonances", "folds"),
    [
        (2.0, 0.8535, {(17, 3): 0.125, (33, 4): 0.262, (6, 2): 0.637, (32, 4): 0.668,
                       (16, 3): 0.682, (31, 4): 0.845}, [0.63741, 0.66866, 0.85339]),
        (4.0, 0.9, {(16, 3): 0.128, (30, 4): 0.606, (6, 2): 0.737, (15, 3): 0.793,
                    (29, 4): 0.897}, [0.73567, 0.79202, 0.79411]),
        (6.0, 0.9, {(15, 3): 0.431, (28, 4): 0.530}, []),
        (8.0, 0.9, {(26, 4): 0.855}, []),
    ],
)  # fmt: skip
def test_branches_of_the_papers_beam_by_two_resolutions(
    beam, omega, up_to, resonances, folds, functions
):
    """As in the table of docs/theory/harmonic_balance.md."""
    found = backbone(beam, omega, functions=functions).branch(up_to=0.9)
    met = {
        (r.harmonic, int(r.mode.removeprefix("lag "))): r.amplitude
        for r in found.resonances
        if r.mode <= "lag 4" and r.amplitude < up_to - 1e-3  # where more functions move the end
    }
    assert met == pytest.approx(resonances, abs=2e-3)
    turns = sorted(fold.amplitude for fold in found.folds if fold.amplitude < up_to)
    assert turns == pytest.approx(folds, abs=1e-5)
    assert found.amplitude.max() > up_to - 1e-3


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda beam: backbone(beam, 6.0).branch(up_to=1.0), "up_to must be below 1"),
        (lambda beam: backbone(beam.with_damping(Damping(axial=0.1)), 6.0),
         "no free periodic orbits"),
    ],
)  # fmt: skip
def test_bad_input(beam, call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call(beam)
