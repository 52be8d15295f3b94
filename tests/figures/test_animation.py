"""The moving picture of a spin-up."""

import io
import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.animation import FFMpegWriter
from matplotlib.text import Text
from PIL import Image
from rich.console import Console

from analytic import SpinUp, linear_response, spin_up_response
from rotbeam_exu import dataset_of, save
from rotbeam_exu.figures import animate, save_animation
from rotbeam_exu.figures import animation as animation_room
from rotbeam_exu.runs.shape import in_space

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def response(beam):
    times, points = np.linspace(0.0, 4.0, 21), np.linspace(0.0, beam.length, 41)
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    return spin_up_response(beam, spin_up, times, tolerance=1e-5, points=points)


def drawn(response, n):
    """Curves of the picture `n`, (points,) complex [m], by axes: the beam is the longest line."""
    animation = animate(dataset_of(response))
    animation._draw_frame(n)
    animation._draw_was_started = True
    inertial, rotating, history = animation._fig.axes
    beams = [seen_in(ax) for ax in (inertial, rotating)]
    dot = next(line for line in history.lines if line.get_marker() == "o")
    return animation, beams, (dot.get_xdata()[0], dot.get_ydata()[0])


def test_both_views_show_the_same_beam_turned(response):
    for n in (0, 7, 20):
        animation, (inertial, rotating), dot = drawn(response, n)
        angle = response.spin_up.angle(response.time[n])
        np.testing.assert_allclose(inertial, rotating * np.exp(1j * angle), atol=1e-12)
        tip = inertial[-1]
        np.testing.assert_allclose([tip.real, tip.imag], response.from_axis[n, :2], atol=1e-9)
        assert dot == (response.time[n], response.q[n] / response.blade.length)
        assert rotating[-1].imag == pytest.approx(response.q[n], abs=1e-9)
    animation._fig.draw_without_rendering()  # only now the axes take their shape
    for ax in animation._fig.axes[:2]:  # to scale
        box = ax.get_window_extent()
        across, up = box.width / np.ptp(ax.get_xlim()), box.height / np.ptp(ax.get_ylim())
        assert across == pytest.approx(up, rel=1e-9)


@pytest.fixture(scope="module")
def two_models(beam):
    """The exact and the linear response, 4 rad/s in 3 s, 20 pictures a second."""
    times, points = np.linspace(0.0, 4.0, 81), np.linspace(0.0, beam.length, 41)
    spin_up = SpinUp(omega=4.0, ramp_time=3.0)
    exact = spin_up_response(beam, spin_up, times, tolerance=1e-4, points=points)
    return exact, linear_response(beam, spin_up, times, points=points)


@pytest.fixture
def side_by_side(two_models):
    """The two views, the history, and what draws a picture."""
    exact, linear = two_models
    animation = animate(dataset_of(exact), beside=dataset_of(linear))
    animation._draw_was_started = True
    yield *animation._fig.axes, animation._draw_frame
    plt.close(animation._fig)


def seen_in(ax):
    """The beam in a view, (points,) complex [m]."""
    return max(ax.lines, key=lambda line: line.get_linewidth()).get_xydata() @ [1.0, 1j]


def from_outside(response):
    """Positions (times, points) in the inertial frame, complex [m]."""
    turn = np.exp(1j * response.spin_up.angle(response.time))
    return response.axis[..., :2] @ [1.0, 1j] * turn[:, None]


def test_two_models_are_seen_from_outside_on_one_scale(two_models, side_by_side):
    *views, history, draw = side_by_side
    draw(25)
    for ax, of in zip(views, two_models, strict=True):
        np.testing.assert_allclose(seen_in(ax), from_outside(of)[25], atol=1e-12)
    history.figure.draw_without_rendering()  # only now the axes take their shape
    sizes = [(*ax.get_window_extent().size, *ax.get_xlim(), *ax.get_ylim()) for ax in views]
    np.testing.assert_allclose(*sizes)
    for ax, name in zip(views, ("exact beam", "linear floating frame"), strict=True):
        (title,) = (text for text in ax.findobj(Text) if text.get_text() == name)
        box = title.get_window_extent()
        assert ax.bbox.y1 < box.y0 < box.y1 < history.figure.bbox.y1


def test_the_time_from_which_the_linear_one_is_unstable_is_said(two_models, side_by_side):
    (mark,) = (t.get_text() for t in side_by_side[2].texts if "unstable" in t.get_text())
    linear, passed = two_models[1], float(mark.split()[1])
    speeds = linear.spin_up.rate(np.array([passed - 0.01, passed + 0.01]))
    assert speeds[0] < linear.blade.omega_0 < speeds[1]


def test_what_is_far_is_drawn_out_of_the_view_at_a_finite_place(two_models, side_by_side):
    _, view, _, draw = side_by_side
    draw(80)
    far = 100.0 * two_models[1].blade.length
    assert np.abs(two_models[1].q[80]) > far
    assert np.abs(seen_in(view)[-1]) == pytest.approx(far)


def test_another_motion_beside_is_refused(beam, response):
    points = np.linspace(0.0, beam.length, 41)
    other = SpinUp(omega=4.0, ramp_time=3.0)
    for linear in (
        linear_response(beam, other, response.time, points=points),
        linear_response(beam, response.spin_up, response.time[:5], points=points),
    ):
        with pytest.raises(ValueError, match="must be of the same motion at the same times"):
            animate(dataset_of(response), beside=dataset_of(linear))


def test_a_blade_in_space_is_seen_from_above_and_from_the_side(beam):
    """Twisted, coned and on a hub; the strip is as wide as the chord is seen."""
    blade = beam.with_section_out_of_plane(0.25, 0.2).with_twist(0.8).with_precone(0.15)
    blade, length = blade.with_hub_radius(0.8), beam.length
    times, points = np.linspace(0.0, 0.8, 5), np.linspace(0.0, length, 9)
    motion = SpinUp(omega=2.0, ramp_time=0.8)
    data = dataset_of(spin_up_response(blade, motion, times, tolerance=1e-2, points=points))
    animation = animate(data)
    animation._draw_frame(4)
    animation._draw_was_started = True
    above, side, history = animation._fig.axes
    place, section = in_space(data)
    np.testing.assert_allclose(axis_in(above), place[4, :, :2] @ [1.0, 1j], atol=1e-12)
    # Turned back to the clamp's line; heights do not turn.
    along = place[4, :, :2] @ [1.0, 1j] * np.exp(-1j * motion.angle(0.8))
    np.testing.assert_allclose(axis_in(side), along.real + 1j * place[4, :, 2], atol=1e-12)
    assert axis_in(side)[0] == pytest.approx(0.8)  # the clamp, on its hub
    for ax, seen in ((above, [1.0, 1j, 0.0]), (side, None)):
        (strip,) = ax.patches
        edges = strip.get_xy()[:18] @ [1.0, 1j]
        chord = edges[:9] - edges[:8:-1]
        if seen:
            np.testing.assert_allclose(chord, 0.1 * length * section[4, ..., 1] @ seen, atol=1e-12)
        else:
            np.testing.assert_allclose(chord.imag, 0.1 * length * section[4, :, 2, 1], atol=1e-12)
    lines = {tuple(line.get_ydata()[-1:]) for line in history.lines if line.get_marker() == "o"}
    assert lines == {(data["q"][4].item() / length,), (data["place"][4, -1, 2].item() / length,)}
    plt.close(animation._fig)


def axis_in(ax):
    """The blade in a view of one in space, complex [m]: the line with as many points."""
    (line,) = (line for line in ax.lines if len(line.get_xdata()) == 9)
    return line.get_xydata() @ [1.0, 1j]


def test_a_gif_has_every_picture_in_real_time(beam, tmp_path):
    counted, points = [], np.linspace(0.0, beam.length, 11)
    spin_up, times = SpinUp(omega=6.0, ramp_time=3.0), np.linspace(0.0, 1.0, 6)
    response = spin_up_response(beam, spin_up, times, tolerance=1e-3, points=points)
    save_animation(dataset_of(response), tmp_path / "beam.gif", progress=counted.append)
    with Image.open(tmp_path / "beam.gif") as picture:
        assert picture.n_frames == response.time.size
        assert picture.info["duration"] == pytest.approx(200, abs=10)  # in 1/100 s
        first = np.asarray(picture.convert("RGB"))
        picture.seek(5)
        assert (np.asarray(picture.convert("RGB")) != first).any()
    assert counted == list(range(1, response.time.size + 1))


KILLED = """
import os, signal, sys
from pathlib import Path
from PIL import Image
from rotbeam_exu import load
from rotbeam_exu.figures import save_animation

def killed(picture, file, *_, **__):
    Path(file).write_bytes(b"")  # as Pillow begins
    os.kill(os.getpid(), int(sys.argv[2]))

Image.Image.save = killed
save_animation(load(sys.argv[1]), Path("film.gif"), rate=5.0)
"""


@pytest.mark.parametrize(
    "number", [signal.SIGKILL, pytest.param(signal.SIGTERM, marks=pytest.mark.slow)]
)
def test_a_film_that_is_killed_leaves_nothing_where_it_was_to_be(response, tmp_path, number):
    """It left a film of no bytes."""
    run = save(dataset_of(response).isel(time=[0, 1]), tmp_path / "run.nc")
    (tmp_path / "here").mkdir()
    (tmp_path / "temporary").mkdir()
    ended = subprocess.run(
        [sys.executable, "-c", KILLED, run, str(int(number))], cwd=tmp_path / "here", check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(tmp_path / "temporary")},
    )  # fmt: skip
    assert ended.returncode == -number
    assert not list((tmp_path / "here").iterdir())
    assert list((tmp_path / "temporary").rglob("film.gif"))


@pytest.mark.parametrize("soon", [0.0, 1e3])
def test_a_film_that_takes_longer_than_a_few_seconds_has_a_bar(
    response, tmp_path, monkeypatch, soon
):
    errors = io.StringIO()
    terminal = partial(Console, file=errors, force_terminal=True, width=80)
    monkeypatch.setattr(animation_room, "Console", terminal)
    monkeypatch.setattr(animation_room, "_SOON", soon)
    save_animation(dataset_of(response).isel(time=[0, 1]), tmp_path / "film.gif", rate=5.0)
    assert ("drawing" in errors.getvalue()) == (soon == 0.0)
    assert [path.name for path in tmp_path.iterdir()] == ["film.gif"]


@pytest.mark.skipif(not FFMpegWriter.isAvailable(), reason="no ffmpeg")
@pytest.mark.slow  # its pictures are those of the GIF
def test_an_mp4_where_ffmpeg_is(response, tmp_path):
    save_animation(dataset_of(response), tmp_path / "beam.mp4")
    assert (tmp_path / "beam.mp4").read_bytes()[4:8] == b"ftyp"


def test_nothing_to_animate_is_refused(beam):
    response = spin_up_response(beam, SpinUp(omega=6.0, ramp_time=3.0), [0.0, 0.1], tolerance=1e-5)
    with pytest.raises(ValueError, match="points along the beam, .* got 0 of them at 2 times"):
        animate(dataset_of(response))
