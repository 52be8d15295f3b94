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
    """One thread of BLAS while the first thread's calls run, which alone can restore the number."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.owner, self.calls = 0, 0
        self.controller: Any = None
        self.limiter: Any = None

    def __enter__(self) -> None:
        with self.lock:
            if self.calls == 0:
                self.owner = threading.get_ident()
                if self.controller is None:
                    # SciPy brings a BLAS of its own, which must be loaded to be found.
                    import scipy.linalg  # noqa: F401, PLC0415
                    from threadpoolctl import ThreadpoolController  # noqa: PLC0415

                    self.controller = ThreadpoolController()
                self.limiter = self.controller.limit(limits=1, user_api="blas")
            self.calls += self.owner == threading.get_ident()

    def __exit__(self, *_: object) -> None:
        with self.lock:
            if self.calls and self.owner == threading.get_ident():
                self.calls -= 1
                if self.calls == 0:
                    self.limiter.restore_original_limits()


_limit = _Limit()


def one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """Decorate a function that does its linear algebra in one thread."""

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> R:
        with _limit:
            return function(*args, **kwargs)

    return limited
