"""Linear algebra takes one thread, and the caller's number is as it was afterwards."""

import threading

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from analytic import Beam, periodic_orbits
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


def test_a_public_verb_leaves_the_setting(two):
    periodic_orbits(Beam.reference(), 6.0, [0.1], functions=8)
    assert threads() == two
