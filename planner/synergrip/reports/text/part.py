"""A part of an answer: a table under a title with sentences below, for a terminal as for a page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from synergrip.reports.text.tables import table, wrapped


@dataclass(frozen=True)
class Part:
    """What is told under one title."""

    title: str
    head: tuple[str, ...] = ()
    """Names of the columns."""
    rows: tuple[tuple[str, ...], ...] = ()
    below: tuple[str, ...] = ()
    """Sentences below the table."""


def part_lines(part: Part) -> Iterator[str]:
    """Yield the lines of a part in a terminal; no title where that is empty."""
    if part.title:
        yield part.title
    if part.rows:
        yield table(part.head, part.rows)
    for each in part.below:
        yield from wrapped("         ", each)
