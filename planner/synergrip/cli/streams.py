"""Standard output that says why it failed, and standard error that never does."""

from __future__ import annotations

import errno
import io
import os
import select
import sys
from typing import TYPE_CHECKING, Any, TextIO

from synergrip.errors import OutputError

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

UNKNOWN_WIDTH = 80
"""Columns of what is no terminal."""
REASONS = {errno.EPIPE: "its reader has gone", errno.EBADF: "it is closed"}


class PrintError(OutputError):
    """Standard output takes no answer. It is no place to say so."""


def guard() -> None:
    """Put guarded streams in the place of the process's own, which may be closed.

    Closed ones are opened on nothing first, so that no file takes their number and with it what a library prints.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDONLY if number == 1 else os.O_RDWR)  # takes the lowest number that is free
    if sys.stdout is sys.__stdout__:
        sys.stdout = _stream(sys.stdout, _Answer(1, "w", closefd=False), lines=os.isatty(1))
    if sys.stderr is sys.__stderr__:
        sys.stderr = _stream(sys.stderr, _Messages(2, "w", closefd=False), lines=True)


def columns(stream: TextIO) -> int:
    """Return how wide a stream is: as COLUMNS says, as its terminal is, 80 where it is none."""
    stated = os.environ.get("COLUMNS", "")
    if stated.isascii() and stated.isdigit() and 0 < len(stated) < 6 and int(stated):
        return int(stated)
    try:
        return os.get_terminal_size(stream.fileno()).columns or UNKNOWN_WIDTH
    except (OSError, ValueError, AttributeError):  # of a pipe, or of what has no number
        return UNKNOWN_WIDTH


def colored(stream: TextIO) -> bool:
    """Return whether a stream wants colours: it is a terminal that has them, and nobody asked for none."""
    return stream.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM") != "dumb"


class _Patient(io.FileIO):
    """A stream that waits for a reader who is slow, also where the system would not."""

    def write(self, data: ReadableBuffer) -> int:
        """Write some of `data`, one byte at least, and return how many."""
        while (count := super().write(data)) is None:
            select.select([], [self], [])
        return count


class _Answer(_Patient):
    """Standard output: a failure is an error once, and then what is left goes nowhere."""

    failed = False

    def write(self, data: ReadableBuffer) -> int:
        """Write some of `data`.

        Raises:
            PrintError: it cannot be written.
        """
        if self.failed:
            return memoryview(data).nbytes
        try:
            return super().write(data)
        except OSError as error:
            self.failed = True
            reason = REASONS.get(error.errno or 0, error.strerror)
            raise PrintError(f"the answer could not be printed on standard output: {reason}") from None


class _Messages(_Patient):
    """Standard error: when nobody can be told, nobody is."""

    def write(self, data: ReadableBuffer) -> int:
        """Write some of `data`, or nothing."""
        try:
            return super().write(data)
        except OSError:
            return memoryview(data).nbytes


def _stream(own: Any, raw: io.FileIO, *, lines: bool) -> Any:
    """Return a text stream on `raw`, otherwise as the process's own; that itself when it is a console of Windows.

    A terminal that cannot show Γ is no reason to fail.
    """
    binary = getattr(own, "buffer", None)
    if own is not None and type(getattr(binary, "raw", binary)) is not io.FileIO:
        own.reconfigure(errors="replace")
        return own
    encoding = own.encoding if own is not None else None
    return io.TextIOWrapper(io.BufferedWriter(raw), encoding, "replace", line_buffering=lines)
