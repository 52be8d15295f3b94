"""Sweeps on a Dask cluster."""

from __future__ import annotations

import logging
from concurrent.futures import Executor
from typing import Any

_PATIENCE = 5.0  # s


def dask_executor(scheduler: str) -> tuple[Executor, Any]:
    """Return an executor on a Dask cluster, and the client to close after use.

    Parameters
    ----------
    scheduler : str
        Address of the scheduler, as "tcp://host:8786".

    Raises
    ------
    ImportError
        If Dask is not installed.
    OSError
        If the scheduler does not answer within five seconds.
    """
    try:
        from distributed import Client  # noqa: PLC0415  (an extra)
    except ImportError as error:
        raise ImportError(
            "Dask is not installed; install the extra: pip install '.[cluster]' in a clone"
        ) from error
    try:
        client: Any = Client(scheduler, timeout=_PATIENCE)
    except (OSError, ValueError) as error:
        raise OSError(
            f"the scheduler {scheduler} does not answer within {_PATIENCE:g} s: check its address "
            "and that it runs"
        ) from error
    # Of a scheduler that ends it logs a traceback; the sweep says it in a sentence.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    return client.get_executor(), client
