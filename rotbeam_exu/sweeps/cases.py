"""Cases of a sweep: the finished ones on disk, and the processes that compute the others."""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from analytic.input_checks import whole_number
from analytic.warning import warn

from ..fem.elements import Formulation, formulation
from ..files.results import load, save, writable_folder
from ..lazily import xr
from ..runs.attributes import versions


class Cache:
    """A folder of results: a file for each, named by its inputs, versions and what made it."""

    def __init__(self, folder: str | os.PathLike[str], *, made_by: Mapping[str, str]) -> None:
        self._folder = writable_folder(folder)
        made_with = {k: v for k, v in versions().items() if k != "python"}
        self._made = {**made_with, **made_by}

    def get(self, description: dict[str, object]) -> xr.Dataset | None:
        """Return the result kept for a description, or None.

        A file that cannot be read is named in a warning and set aside, not used or lost.
        """
        path = self._path(description)
        if not path.exists():
            return None
        try:
            result = load(path)
            if result.attrs.pop("case", None) != path.stem:
                raise ValueError(f"{path} does not hold the case it is named after")
        except ValueError as error:
            aside = path.with_suffix(".damaged")
            path.replace(aside)
            warn(f"{error}; it is set aside as {aside.name} and computed again")
            return None
        return result

    def put(self, description: dict[str, object], result: xr.Dataset) -> None:
        """Keep a result; the file is written whole or not at all."""
        path = self._path(description)
        try:
            save(result.assign_attrs(case=path.stem), path)
        except OSError as error:
            raise OSError(
                f"cannot keep a finished case in {self._folder}: {error.strerror or error}; "
                "those already there stay, make room and run again"
            ) from error

    def _path(self, description: dict[str, object]) -> Path:
        content = json.dumps({"case": description, "made": self._made}, sort_keys=True)
        return self._folder / f"{hashlib.sha256(content.encode()).hexdigest()[:32]}.nc"


def cache_of(folder: str | os.PathLike[str], element: str | Formulation) -> Cache | None:
    """Return the cache in a folder; none, with a warning, of an element that no file defines."""
    if made_by := maker(element):
        return Cache(folder, made_by=made_by)
    warn(
        f"files do not determine {type(element).__qualname__}, so its cases are not kept in the "
        "cache: define it at the top level of a module on file"
    )
    return None


def maker(element: str | Formulation) -> dict[str, str] | None:
    """Return what besides its inputs makes the result of a case: the element's class and the code.

    The code is a digest of the files of both packages and of those of the element's class and its
    bases: all of a package, or a module with its neighbors. Any change of a file counts, that of
    a docstring too. None if the files do not determine the class: it is not on file, as in an
    interactive session, or it is made inside a function, whose values it may use.
    """
    cls = type(formulation(element))
    tops = {base.__module__.partition(".")[0] for base in cls.__mro__} - sys.stdlib_module_names
    code = _code(*tops)
    if any("<locals>" in base.__qualname__ for base in cls.__mro__) or not code:
        return None
    return {"class": f"{cls.__module__}.{cls.__qualname__}", "code": code}


def _code(*tops: str) -> str:
    """Return a digest of the files of both packages and others; none if one is not on file."""
    sources = [_files(name) for name in sorted({"analytic", "rotbeam_exu", *tops})]
    return hashlib.sha256(repr(sources).encode()).hexdigest() if all(sources) else ""


def _files(name: str) -> list[tuple[str, bytes]]:
    """Return the files of a package, or of the folder of a module; none if it is not on file."""
    module = sys.modules.get(name)
    file = getattr(module, "__file__", None)
    folders = list(getattr(module, "__path__", [])) or ([Path(file).parent] if file else [])
    pattern = "**/*.py" if hasattr(module, "__path__") else "*.py"
    return sorted(
        (path.relative_to(folder).as_posix(), path.read_bytes())
        for folder in folders
        for path in Path(folder).glob(pattern)
    )


@contextmanager
def worker_pool(executor: Executor | None, jobs: int | None, most: int) -> Iterator[Executor]:
    """Give the caller's executor, left open, or our own spawned processes, closed at the end.

    These are `jobs`, by default one per core, but no more than the `most` that have work.
    """
    if executor is not None:
        yield executor
        return
    cores = os.cpu_count() or 1
    workers = min(cores if jobs is None else whole_number("jobs", jobs), max(most, 1))
    spawn = multiprocessing.get_context("spawn")
    pool: Any = _Processes(workers, mp_context=spawn, initializer=_obey_parent)
    try:
        yield pool
    except BaseException:
        # Do not wait for what nobody asks for any more. What waits is dropped first: the pool's
        # thread fails whatever it still has when a process dies, which a canceled future refuses.
        # It does so only while the pool lives.
        processes, thread = list((pool._processes or {}).values()), pool._executor_manager_thread
        pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.terminate()
        if thread is not None:
            thread.join()
        raise
    pool.shutdown()


@contextmanager
def kept_workers(
    of: Mapping[str, object], jobs: int | None, most: int, *,
    cache: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[Executor]:  # fmt: skip
    """Give workers for `sampled`, whose samples of one answer stay in a cache.

    What the answer is `of`, as JSON, and their changes name them there.
    """
    store = None if cache is None else Cache(cache, made_by={"code": _code()})
    with worker_pool(None, jobs, most) as pool:
        yield _Kept(pool, of, store, progress)


class _Kept(Executor):
    def __init__(
        self, pool: Executor, of: Mapping[str, object], store: Cache | None,
        progress: Callable[[int, int], None] | None,
    ) -> None:  # fmt: skip
        self._pool, self._of, self._store, self._progress = pool, of, store, progress

    def map(self, fn: Any, *iterables: Any, **options: Any) -> Iterator[Any]:
        """Yield (numbers, reason) of each sample in order."""
        del options
        (cases,) = map(list, iterables)
        named: list[dict[str, object]] = [
            {"answer": self._of, "changes": {k: v.tolist() for k, v in case.items()}}
            for case in cases
        ]
        kept = {k: self._store.get(one) for k, one in enumerate(named)} if self._store else {}
        waiting = {
            k: self._pool.submit(fn, case) for k, case in enumerate(cases) if kept.get(k) is None
        }
        for k, one in enumerate(named):
            result = kept.get(k)
            if result is None:
                numbers, reason = waiting[k].result()
                result = xr.Dataset({"number": ("output", numbers)}, attrs={"failure": reason})
                if self._store:
                    self._store.put(one, result)
            if self._progress:
                self._progress(k + 1, len(cases))
            yield result["number"].to_numpy(), result.attrs["failure"]


class _Processes(ProcessPoolExecutor):
    """Processes that Ctrl-C does not meet while they start: they inherit that it is blocked."""

    def submit(self, *task: Any, **options: Any) -> Future[Any]:
        if not hasattr(signal, "pthread_sigmask"):  # Windows
            return super().submit(*task, **options)
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            return super().submit(*task, **options)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _obey_parent() -> None:
    """Leave Ctrl-C to the parent, and do not outlive it, should it be killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
