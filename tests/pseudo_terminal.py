"""The command line in a pseudo-terminal of many widths: an answer is found once, and shown in each of them."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from itertools import pairwise
from pathlib import Path
from typing import Any, TextIO

import pytest
from typer.main import get_command

from synergrip.cli.app import app
from synergrip.documents.quantities import UNITS

WIDE = 9_999
"""Columns in which no line needs to be continued."""
ESCAPE = re.compile(r"\x1b\[[\d;?]*[A-Za-z]")
NAMES = {unit for units in UNITS.values() for unit in units} | {"%"}


class Terminal:
    """A pseudo-terminal; what is written to it is read by a thread."""

    def __init__(self) -> None:
        self.reader, self.writer = pty.openpty()
        self.stream: TextIO = os.fdopen(self.writer, "w", encoding="utf-8", newline="\n")
        self._read = bytearray()
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def resize(self, columns: int) -> None:
        fcntl.ioctl(self.writer, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))

    def close(self) -> str:
        """Return all that was written."""
        self.stream.close()
        self._thread.join(60)
        os.close(self.reader)
        return self._read.decode().replace("\r\n", "\n")

    def _listen(self) -> None:
        while True:
            try:
                part = os.read(self.reader, 65536)
            except OSError:  # the other end is closed
                return
            if not part:
                return
            self._read += part


def shown(arguments: tuple[str, ...], widths: tuple[int, ...], patch: pytest.MonkeyPatch) -> dict[int, str]:
    """Return what a command writes into terminals of some widths, from one run of it."""
    told = dict[int, str]()

    def each(show: Callable[..., None]) -> Callable[..., None]:
        def on_all(*parts: Any) -> None:
            for width in widths:
                with _terminal(width, told):
                    show(*parts)

        return on_all

    for name, module in list(sys.modules.items()):
        if name.startswith("synergrip.cli.") and hasattr(module, "show"):
            patch.setattr(module, "show", each(module.show))
    with _terminal(widths[0], {}), suppress(SystemExit):  # progress goes here, and what is wrong
        get_command(app).main(list(arguments), standalone_mode=False)
    assert told, arguments
    return told


@contextmanager
def _terminal(columns: int, told: dict[int, str]) -> Iterator[Terminal]:
    terminal = Terminal()
    terminal.resize(columns)
    try:
        with redirect_stdout(terminal.stream), redirect_stderr(terminal.stream):
            yield terminal
    finally:
        told[columns] = terminal.close()


def run_in_terminal(arguments: tuple[str, ...], columns: int, folder: Path, **environment: str) -> str:
    """Return what the program writes, a process of its own, to a terminal that is its standard output and error."""
    terminal = Terminal()
    terminal.resize(columns)
    command = [sys.executable, "-m", "synergrip", *arguments]
    subprocess.run(
        command, stdout=terminal.writer, stderr=terminal.writer, cwd=folder, check=False,
        env={**os.environ, **environment},
    )  # fmt: skip
    return terminal.close()


def plain(text: str) -> str:
    return ESCAPE.sub("", text)


def too_long(text: str, columns: int) -> list[str]:
    """Return lines beyond the width, but for the path of a file alone on its line, which is never split."""
    lines = re.split(r"[\r\n]", plain(text))
    return [line for line in lines if len(line) > columns and not re.fullmatch(r"\s*\S*/\S*", line)]


def broken(text: str, wide: str) -> list[str]:
    """Return words of the text that are none of the same text in wide lines, and those that are gone."""
    narrow, whole = (Counter(plain(each).split()) for each in (text, wide))
    made = [word for word in narrow if word.removesuffix(":") not in whole and word not in whole]
    return made + [word for word in whole if word not in narrow and f"{word}:" not in narrow]


def apart(text: str) -> list[str]:
    """Return pairs of lines of which the first ends in a number and the second begins with its unit."""
    return [
        f"{line}|{after}"
        for line, after in pairwise(plain(text).split("\n"))
        if re.search(r"\d$", line) and re.match(r"\s+\S", after) and after.split()[0].rstrip(".,;:)") in NAMES
    ]
