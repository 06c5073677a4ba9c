"""Some of many that do, none of which can be left out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

T = TypeVar("T")


def irreducible(every: Sequence[T], do: Callable[[Sequence[T]], bool]) -> tuple[T, ...]:
    """Return some of many that do together, as all of them do: without any one of them they do no more.

    They are left out one after the other, the last one first, as long as the rest do.

    Args:
        every: all of them.
        do: whether some do; more than such do, too.
    """
    kept = list(every)
    for k in reversed(range(len(kept))):
        fewer = kept[:k] + kept[k + 1 :]
        if do(fewer):
            kept = fewer
    return tuple(kept)
