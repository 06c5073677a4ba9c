"""Where data is found (a path or the name of something bundled) and where and how results are written."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from synergrip.scratch import scratch, synced

_PACKAGE = Path(__file__).resolve().parent
_CARRIED = _PACKAGE / "bundled"
"""Where a wheel has its data: `problems` beside this file is code."""
_CHECKOUT = _PACKAGE.parent.parent
IMPOSSIBLE = (errno.ENOTDIR, errno.EEXIST, errno.ENAMETOOLONG, errno.ELOOP)
"""What the system says of a path that can be no file's, whatever the disk and the rights are."""


def bundled(kind: str) -> Path:
    """Return the folder of the bundled ``"models"``, ``"problems"`` or ``"docs"``, or the file ``"README.md"``.

    In a checkout they stand at the top of the repository; a wheel carries them inside the package, beside each other as
    there, so that links from page to page lead where they lead in a checkout.
    """
    return (_CARRIED if _CARRIED.is_dir() else _CHECKOUT) / kind


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """Yield a temporary path of the same name; move it to `path` only when the block ends without an error.

    What a link leads to is replaced, not the link.

    Raises:
        OSError: it cannot be written, or something that is no file stands there.
    """
    refuse_other_than_file(path)
    path = Path(os.path.realpath(path))
    with scratch(path.parent) as folder:
        temporary = folder / path.name
        yield temporary
        synced(temporary)
        temporary.replace(path)


def refuse_other_than_file(path: Path) -> None:
    """Raise the OSError that says why no file can take the place of what stands at `path`; a link counts as its end."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, "it is a folder", str(path))
    if not stat.S_ISREG(mode):
        raise FileExistsError(errno.EEXIST, "it is a device or a pipe and no file", str(path))


def refuse_unwritable(path: Path) -> None:
    """Raise the OSError that writing a file would raise, as far as it can be told without trying."""
    refuse_other_than_file(path)
    refuse_unwritable_folder(Path(os.path.realpath(path)).parent)


def refuse_unwritable_folder(folder: Path) -> None:
    """Raise the OSError that making or writing into `folder` would raise, as far as it can be told without trying."""
    nearest = folder
    while True:
        try:
            mode = nearest.stat().st_mode
            break
        except FileNotFoundError:
            nearest = nearest.parent
    if not stat.S_ISDIR(mode):
        raise NotADirectoryError(errno.ENOTDIR, f"'{nearest}' is a file and no folder", str(folder))
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, f"'{nearest}' may not be written", str(folder))
