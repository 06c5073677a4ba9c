"""Files of one folder that change together or not at all.

A folder that holds nothing else is exchanged for a new one in one step of the file system, where it has such a step
(Linux): at every instant there is one whole answer, the old or the new. Elsewhere, and where the folder itself must
stay, files are moved one by one in an order in which files of two answers never stand side by side.
"""

from __future__ import annotations

import errno
import os
import shutil
import stat
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from synergrip.files import refuse_other_than_file
from synergrip.scratch import alone_in, scratch, sweep, synced
from synergrip.signals import held_back


def replace_together(folder: Path, names: Sequence[str], write: Callable[[Path], object]) -> None:
    """Replace the files of `names` in a folder by those that are written anew; those not written are removed.

    Args:
        folder: where; made when it is missing. A link to a folder stays a link.
        names: of all files that belong together, the one that readers look at first in front.
        write: writes some of them into the empty folder it is given. It may be called twice.

    Raises:
        OSError: it cannot be done, and the folder is as it was.
    """
    folder = Path(os.path.realpath(folder))
    refuse_others(folder, names)
    with held_back():
        for place in (folder, folder.parent):
            sweep(place)
        if not folder.exists() and _moved_whole(folder, write):
            return
        if _holds_only(folder, names) and _exchanged(folder, names, write):
            return
        with ExitStack() as stack:
            with alone_in(folder):  # else another run may be exchanging the folder just now, and what begins in it
                aside = stack.enter_context(scratch(folder))
            new = _written(aside, write)
            with alone_in(folder):
                _move_one_by_one(new, folder, names, aside)


def refuse_others(folder: Path, names: Sequence[str]) -> None:
    """Raise the OSError that names what stands in the place of a file of `names` and is none."""
    for name in names:
        try:
            refuse_other_than_file(folder / name)
        except OSError as error:
            raise type(error)(error.errno, f"'{name}' is there, and {error.strerror}") from None


def _written(aside: Path, write: Callable[[Path], object]) -> Path:
    """Return a folder in `aside` with the new files, which are on the disk."""
    new = aside / "new"
    new.mkdir()
    write(new)
    for path in new.iterdir():
        synced(path)
    synced(new)
    return new


def _moved_whole(folder: Path, write: Callable[[Path], object]) -> bool:
    """Put the new files where there is no folder yet; False when another run was quicker."""
    with scratch(folder.parent) as aside:
        new = _written(aside, write)
        try:
            new.rename(folder)
        except FileExistsError:
            return False
        except OSError as error:
            if error.errno != errno.ENOTEMPTY:
                raise
            return False
    return True


def _exchanged(folder: Path, names: Sequence[str], write: Callable[[Path], object]) -> bool:
    """Put a folder with the new files in the place of the old one; False, and nothing done, where that cannot be."""
    if not os.access(folder.parent, os.W_OK | os.X_OK):
        return False
    with scratch(folder.parent) as aside:
        new = _written(aside, write)
        with alone_in(folder):
            if not (_made_like(new, folder) and _holds_only(folder, names) and _exchange(new, folder)):
                return False
            for late in new.iterdir():  # came between the last look and the exchange
                if late.name not in names:
                    late.rename(folder / late.name)
    return True


def _holds_only(folder: Path, names: Sequence[str]) -> bool:
    """Return whether a folder holds nothing but files of `names`, and no process stands in it, who would lose it."""
    if set(os.listdir(folder)) - set(names) or not os.path.isdir("/proc/self"):  # where nobody tells, somebody may
        return False
    here = folder.stat()
    for process in filter(str.isdigit, os.listdir("/proc")):
        with suppress(OSError):  # another user's, or ended meanwhile
            if os.path.samestat(os.stat(f"/proc/{process}/cwd"), here):
                return False
    return True


def _made_like(new: Path, folder: Path) -> bool:
    """Give a new folder the mode of the old one; return whether it is as the old one in all else too."""
    with suppress(OSError):
        new.chmod(stat.S_IMODE(folder.stat().st_mode))
        return _marks(new) == _marks(folder)
    return False


def _marks(folder: Path) -> tuple[object, ...]:
    """Return mode, owner, group, file system and further attributes."""
    found = folder.stat()
    attributes = {name: os.getxattr(folder, name) for name in os.listxattr(folder)} if sys.platform == "linux" else {}
    return found.st_mode, found.st_uid, found.st_gid, found.st_dev, attributes


def _exchange(a: Path, b: Path) -> bool:
    """Exchange two folders in one step; False where the system or the file system has no such step."""
    if sys.platform != "linux":
        return False
    import ctypes

    here, exchange = -100, 2  # AT_FDCWD, RENAME_EXCHANGE
    try:
        rename = ctypes.CDLL(None).renameat2
    except (OSError, AttributeError):
        return False
    return bool(rename(here, os.fsencode(a), here, os.fsencode(b), exchange) == 0)


def _move_one_by_one(new: Path, folder: Path, names: Sequence[str], aside: Path) -> None:
    """Move the new files into a folder: first the old ones go, all but one; that one is replaced; the others come.

    So there is no instant with files of two answers, and none without a file when old and new have one in common.
    An error takes everything back, in the reverse order.
    """
    there = [name for name in names if os.path.lexists(folder / name)]
    coming = [name for name in names if (new / name).exists()]
    first = next((name for name in coming if name in there), None)
    with _undoing() as undo:
        if first is not None:
            shutil.copy2(folder / first, aside / first, follow_symlinks=False)
        for name in there:
            if name != first:
                (folder / name).rename(aside / name)
                undo.append((aside / name, folder / name))
        for name in sorted(coming, key=lambda name: name != first):
            (new / name).replace(folder / name)
            undo.append((aside / name, folder / name) if name == first else (folder / name, new / name))


@contextmanager
def _undoing() -> Iterator[list[tuple[Path, Path]]]:
    """Yield a list of moves that take back what was done, made from the last to the first when the block fails."""
    moves: list[tuple[Path, Path]] = []
    try:
        yield moves
    except BaseException:
        for source, target in reversed(moves):
            source.replace(target)
        raise
