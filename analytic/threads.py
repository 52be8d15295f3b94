"""One thread for linear algebra: its matrices are small, and threads of BLAS wait for each other.

On a busy machine they cost up to 40 times the CPU of one.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


class _Limit:
    """One thread while any call runs, in whatever thread; the caller's number after the last."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.calls = 0
        self.libraries: Any = None
        self.before: list[int] = []

    def __enter__(self) -> None:
        with self.lock:
            self.calls += 1
            if self.calls > 1:
                return
            if self.libraries is None:
                # SciPy brings a BLAS of its own, which must be loaded to be found.
                import scipy.linalg  # noqa: F401, PLC0415
                from threadpoolctl import ThreadpoolController  # noqa: PLC0415

                found = ThreadpoolController().select(user_api="blas")
                self.libraries = found.lib_controllers
            self.before = [library.num_threads for library in self.libraries]
            for library in self.libraries:
                library.set_num_threads(1)

    def __exit__(self, *_: object) -> None:
        with self.lock:
            self.calls -= 1
            if self.calls == 0:
                for library, threads in zip(self.libraries, self.before, strict=True):
                    library.set_num_threads(threads)


_limit = _Limit()


def one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """Decorate a function that does its linear algebra in one thread."""

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> R:
        with _limit:
            return function(*args, **kwargs)

    return limited
