"""The place where text is shown: how wide it is, and whether it takes colours."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

LEAST = 40
"""Columns below which nothing is laid out: what is narrower has lines of this length."""
PARAGRAPH = 110
"""Columns of the longest line of prose; longer ones are hard to read, however wide the place is."""


@dataclass(frozen=True)
class Screen:
    """A place where text is shown.

    Attributes:
        width: its columns.
        color: whether it takes colours.
    """

    width: int = 80
    color: bool = False


ANYWHERE = Screen()
UNFOLDED = Screen(107)
"""A place where messages are read by programs, line by line: none is continued."""
_HERE: ContextVar[Screen] = ContextVar("screen", default=ANYWHERE)


def screen() -> Screen:
    """Return where text is shown: 80 columns without colours, unless somebody said otherwise."""
    return _HERE.get()


@contextmanager
def shown_on(place: Screen) -> Iterator[None]:
    """Let text that is made in this block fit a place."""
    before = _HERE.set(place)
    try:
        yield
    finally:
        _HERE.reset(before)
