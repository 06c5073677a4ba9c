"""Recordings as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def written(header: Sequence[str], rows: Iterable[Iterable[object]], mark: str = ",", end: str = "\n") -> str:
    """Return a header and lines, cells parted by `mark`."""
    return end.join([mark.join(header), *(mark.join(map(str, row)) for row in rows), ""])
