"""What is wrong with several things, each judged though others are refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from synergrip.errors import InputError, Issue

T = TypeVar("T")


def gathered(issues: list[Issue], part: Callable[[], T]) -> T | None:
    """Return what a part gives; add its issues to the others instead when it is refused."""
    try:
        return part()
    except InputError as error:
        issues += error.issues
        return None
