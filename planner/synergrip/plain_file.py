"""The files of a user: plain files only, and of each no more bytes than any input needs.

A pipe would wait for its writer for ever, a device never ends, and a file may grow while it is read or claim a size
of 0, as those of the system do. So what a path leads to is looked at before it is opened, and bytes are counted.
"""

from __future__ import annotations

import os
import stat
from itertools import islice
from pathlib import Path

from synergrip.errors import InputError, Issue, suggest

LARGEST_FILE = 32_000_000
"""Bytes that are read of a file."""
MOST_NEIGHBOURS = 1000
"""Files of a folder among which a misspelt name is looked for."""

_CHUNK = 1 << 20
_SORTS = {stat.S_IFIFO: "pipe", stat.S_IFCHR: "device", stat.S_IFBLK: "device", stat.S_IFSOCK: "socket"}
_FLAGS = ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")  # not all of them on every system


def read_bytes(path: Path, kind: str = "file", key: str = "", limit: int = LARGEST_FILE) -> bytes:
    """Return the bytes of a plain file.

    Args:
        path: the file.
        kind: what it is to the user, for messages.
        key: the key that names the file; when given, the issue leaves its place to `Document.locate`.
        limit: bytes that may be read.

    Raises:
        InputError: missing, a directory, a pipe or a device, unreadable, or larger than the limit.
    """

    def refuse(message: str) -> InputError:
        return InputError([Issue(message, key=key, file="" if key else str(path))])

    try:
        raw = _read(path, limit)
    except _NotPlainError as error:
        hint = f"expected a {kind}"
        if error.sort != "directory":
            hint += "; write what comes from there into a plain file first"
        raise refuse(f"'{path}' is a {error.sort}; {hint}") from None
    except FileNotFoundError:
        raise refuse(f"{kind} '{path}' not found{_similar(path)}") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "the name is not a file name"
        raise refuse(f"{kind} '{path}' cannot be read: {reason}") from None
    if len(raw) > limit:
        raise refuse(f"'{path}' is larger than {limit / 1e6:.3g} MB, the most that is read here; is it a {kind}?")
    return raw


def read_text(path: Path, kind: str = "file", key: str = "", limit: int = LARGEST_FILE) -> str:
    """Return the text of a plain file, without a byte order mark and with plain line feeds.

    The arguments are those of `read_bytes`.

    Raises:
        InputError: what `read_bytes` refuses, or bytes that are not UTF-8.
    """
    raw = read_bytes(path, kind, key, limit)
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - raw.rfind(b"\n", 0, error.start)
        message = f"byte {column} of this line is not UTF-8; save the {kind} as UTF-8"
        raise InputError([Issue(message, key=key, file=str(path), line=line, column=column)]) from None
    return text.replace("\r\n", "\n")


class _NotPlainError(Exception):
    def __init__(self, sort: str) -> None:
        super().__init__(sort)
        self.sort = sort


def _read(path: Path, limit: int) -> bytes:
    """Return at most one byte more than `limit`."""
    _check_plain(os.stat(path))  # before it is opened: to open a device may be to start it
    descriptor = os.open(path, os.O_RDONLY | sum(getattr(os, name, 0) for name in _FLAGS))
    try:
        state = os.fstat(descriptor)
        _check_plain(state)  # once more, of the very file that is read
        left = limit + 1
        if state.st_size > limit:
            return bytes(left)  # nobody looks at the bytes of a file that is too large
        chunks = []
        while left > 0 and (chunk := os.read(descriptor, min(left, _CHUNK))):
            chunks.append(chunk)
            left -= len(chunk)
        return b"".join(chunks)
    finally:
        os.close(descriptor)


def _check_plain(state: os.stat_result) -> None:
    if stat.S_ISDIR(state.st_mode):
        raise _NotPlainError("directory")
    if not stat.S_ISREG(state.st_mode):
        raise _NotPlainError(_SORTS.get(stat.S_IFMT(state.st_mode), "special file"))


def neighbours(path: Path) -> list[str]:
    """Return the names in the folder of a file, in order; of very many some."""
    return sorted(entry.name for entry in islice(path.parent.iterdir(), MOST_NEIGHBOURS))


def _similar(path: Path) -> str:
    try:
        return suggest(path.name, neighbours(path))
    except OSError:
        return f"; there is no directory '{path.parent}'"
