"""Linear algebra takes one thread, and the caller's number is as it was afterwards."""

import threading

import numpy as np
import pytest
import scipy.linalg  # noqa: F401 - its BLAS is one more, loaded before any is counted
from threadpoolctl import threadpool_info, threadpool_limits

from analytic import Beam, Theory, backbone
from analytic.exact.free import backbone as backbones
from analytic.threads import one_thread


def threads():
    return [one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"]


@pytest.fixture
def two():
    """The caller has asked for two threads."""
    np.linalg.inv(np.eye(2))
    with threadpool_limits(limits=2, user_api="blas"):
        if max(threads()) < 2:
            pytest.skip("this BLAS has one thread only")
        yield threads()


def test_inside_there_is_one_and_afterwards_what_was_before(two):
    assert one_thread(threads)() == [1] * len(two)
    assert threads() == two
    nested = one_thread(lambda: (one_thread(threads)(), threads()))
    assert nested() == ([1] * len(two), [1] * len(two))
    assert threads() == two


def test_after_an_error_it_is_as_it_was(two):
    def fails():
        raise ArithmeticError

    with pytest.raises(ArithmeticError):
        one_thread(fails)()
    assert threads() == two


def test_a_call_that_another_thread_makes_meanwhile_changes_nothing(two):
    """The first to end would restore its number, and the other then set one for good."""
    entered, leave, seen = threading.Event(), threading.Event(), []

    def waits():
        seen.append(threads())
        entered.set()
        leave.wait(10.0)

    other = threading.Thread(target=one_thread(waits))

    def starts_another():
        other.start()
        entered.wait(10.0)

    one_thread(starts_another)()
    assert seen == [[1] * len(two)]
    assert threads() == two
    leave.set()
    other.join()
    assert threads() == two


@pytest.mark.parametrize("twist", [0.0, 0.3])
def test_orbits_in_the_plane_and_in_space_take_one_thread(two, twist, monkeypatch):
    """An orbit in space took forty times its processor time with two threads."""
    seen = []
    monkeypatch.setattr(backbones, "orbits_of", lambda *_: seen.append(threads()))
    blade = Beam.reference().with_section_out_of_plane(0.25, 0.2).with_twist(twist)
    backbone(blade, 6.0, theory=Theory(extension=False)).orbits([0.1])
    assert seen == [[1] * len(two)]
