"""Hidden folders in which files are made whole before they take their place, and the locks that guard them."""

from __future__ import annotations

import errno
import os
import re
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from synergrip.signals import held_back

try:
    import fcntl
except ImportError:  # Windows has no locks of folders
    fcntl = None  # type: ignore[assignment]

NAME = re.compile(r"\.synergrip-[0-9a-f]{16}")
PATIENCE_S = 10.0
"""How long to wait for another run that writes into the same folder, which takes it milliseconds."""
LONG_AGO_S = 86400.0
"""Age from which a hidden folder is taken for left behind where there are no locks to tell."""


@contextmanager
def scratch(parent: Path) -> Iterator[Path]:
    """Yield a new hidden folder in `parent`, which is made when it is missing; the hidden one is gone at the end.

    Signals that end the program wait until then. What a killed run has left in `parent` is removed.
    """
    parent.mkdir(parents=True, exist_ok=True)
    with held_back():
        sweep(parent)
        folder, lock = _made(parent)
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)
            _unlock(lock)


def sweep(parent: Path) -> None:
    """Remove the hidden folders that killed runs have left in `parent`, if it is there: those nobody holds."""
    with suppress(OSError):
        for path in parent.iterdir():
            if NAME.fullmatch(path.name) and not path.is_symlink():
                with suppress(OSError):
                    _remove_unless_held(path)


def _remove_unless_held(folder: Path) -> None:
    lock = _lock(folder)
    try:
        if lock is not None or time.time() - folder.stat().st_mtime > LONG_AGO_S:
            shutil.rmtree(folder, ignore_errors=True)
    finally:
        _unlock(lock)


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Keep other runs from changing files together in `folder`, which is there, until the block ends.

    Raises:
        BlockingIOError: another run has held it for `PATIENCE_S`.
    """
    until = time.monotonic() + PATIENCE_S
    while not _is_there(folder, lock := _lock(folder, until)):
        _unlock(lock)  # another run has just put a new folder in its place
    try:
        yield
    finally:
        _unlock(lock)


def synced(path: Path) -> None:
    """Have a file or folder on the disk itself, as far as the system knows how.

    Raises:
        OSError: the disk is full or broken, which some systems say only now.
    """
    folder = path.is_dir()
    if folder and os.name == "nt":
        return
    handle = os.open(path, os.O_RDONLY if folder else os.O_RDWR)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOSYS, errno.ENOTSUP):
            raise
    finally:
        os.close(handle)


def _is_there(folder: Path, lock: int | None) -> bool:
    """Return whether what is locked is still the folder of that name."""
    try:
        return lock is None or os.path.samestat(os.fstat(lock), os.stat(folder))
    except FileNotFoundError:
        return False


def _made(parent: Path) -> tuple[Path, int | None]:
    """Return a new hidden folder and its lock; a run that sweeps just now may have taken it for left behind."""
    while True:
        folder = parent / f".synergrip-{os.urandom(8).hex()}"
        folder.mkdir()
        try:
            lock = _lock(folder)
            if _is_there(folder, lock):
                return folder, lock
            _unlock(lock)  # swept between the opening and the locking of it
        except (FileNotFoundError, BlockingIOError):
            continue
        except OSError:
            folder.rmdir()
            raise


def _lock(folder: Path, until: float = 0.0) -> int | None:
    """Return a handle that holds the lock of a folder, which ends with the process; None where there are no locks.

    Raises:
        BlockingIOError: somebody else holds it, still at the time `until` of the monotonic clock.
    """
    if fcntl is None:
        return None
    handle = os.open(folder, os.O_RDONLY)
    while True:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return handle
        except OSError as error:
            held = error.errno in (errno.EAGAIN, errno.EACCES)
            if held and time.monotonic() < until:
                time.sleep(0.01)
                continue
            os.close(handle)
            if held:
                raise BlockingIOError(errno.EAGAIN, "another run of synergrip is writing there") from None
            return None


def _unlock(lock: int | None) -> None:
    if lock is not None:
        os.close(lock)
