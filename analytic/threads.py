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
    """One thread of BLAS while a call runs; the thread that set it restores the number before.

    Calls of other threads meanwhile change nothing: the number is one for the whole process.
    """

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.owner, self.calls = 0, 0
        self.libraries: Any = None
        self.before: list[int] = []

    def __enter__(self) -> None:
        with self.lock:
            if self.calls == 0:
                self.owner = threading.get_ident()
                self._set_one()
            self.calls += self.owner == threading.get_ident()

    def _set_one(self) -> None:
        if self.libraries is None:
            # SciPy brings a BLAS of its own, which must be loaded to be found.
            import scipy.linalg  # noqa: F401, PLC0415
            from threadpoolctl import ThreadpoolController  # noqa: PLC0415

            self.libraries = ThreadpoolController().select(user_api="blas").lib_controllers
        self.before = [library.num_threads for library in self.libraries]
        for library in self.libraries:
            library.set_num_threads(1)

    def __exit__(self, *_: object) -> None:
        with self.lock:
            if self.calls == 0 or self.owner != threading.get_ident():
                return
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
