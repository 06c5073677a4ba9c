"""Arguments of limits and goals, judged as the values of a problem file are."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Self

import numpy as np

from synergrip.documents.judging import described
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen

OneOrEach = Any
"""A number for all, or one for each of some; arrays (n,) once the grasp is known."""
PLURALS = {"joint": "joints", "synergy": "synergies", "contact": "contacts"}


def size(key: str, value: Any, wanted: str, *, above: float = -math.inf, at_least: float = -math.inf) -> float:
    """Return a finite number as it is to be kept.

    Args:
        key: limit or goal with its argument, for example ``ElasticMotion.limit``.
        value: what was given.
        wanted: what is expected, in words.
        above: what it must be greater than.
        at_least: what it must not be less than.

    Raises:
        InputError: no such number.
    """
    fits = is_number(value) and math.isfinite(value) and value > above and value >= at_least
    if not fits:
        raise InputError.at(key, f"expected {wanted}, got {described(value)}")
    return float(value)


def sizes(key: str, value: Any, of: str) -> Array:
    """Return one size for all or one for each, all greater than 0; infinity stands for no bound.

    Args:
        key: limit or goal with its argument.
        value: a number, or a sequence of them.
        of: what there is one of for each: "joint", "synergy" or "contact".

    Raises:
        InputError: no numbers, or numbers that are no sizes.
    """
    found = numbers(key, value, of)
    if np.any(np.isnan(found)):
        raise InputError.at(key, "expected numbers, got nan; infinity stands for no bound")
    if np.any(found <= 0):
        raise InputError.at(key, f"expected sizes greater than 0, got {float(np.min(found)):g}")
    return found


def numbers(key: str, value: Any, of: str) -> Array:
    """Return a number for all, (), or numbers for each, (n,); arrays that are kept already stay what they are.

    Raises:
        InputError: something else.
    """
    wanted = f"a number, or one for each {of}"
    try:
        found = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        found = None
    if found is None or value is None or isinstance(value, bool | str):
        raise InputError.at(key, f"expected {wanted}, got {described(value)}")
    if found.ndim > 1:
        raise InputError.at(key, f"expected {wanted}, got an array of shape {found.shape}")
    own = found is value and not found.flags.writeable and found.flags.owndata
    return found if own else frozen(np.array(found))


def one_each(key: str, value: Array, names: Sequence[str], of: str) -> Array:
    """Return one number for each name (n,), after noting that there are as many.

    Raises:
        InputError: more numbers or fewer.
    """
    if value.ndim and value.shape != (len(names),):
        message = (
            f"expected {len(names)} numbers, one for each of the {PLURALS[of]} {', '.join(names)}; got {len(value)}"
        )
        raise InputError.at(key, message)
    return value if value.ndim else frozen(np.full(len(names), float(value)))


def is_number(value: Any) -> bool:
    """Return whether a value is one number: `True` and texts are none."""
    return isinstance(value, int | float | np.number) and not isinstance(value, bool)


class Complete:
    """Classes that say at once, and by name, which of their methods are still to be written."""

    def __new__(cls, *_: Any, **__: Any) -> Self:
        """Refuse a class that leaves a method out.

        Raises:
            InputError: with the methods.
        """
        missing = sorted(getattr(cls, "__abstractmethods__", ()))
        if missing:
            raise InputError.at(cls.__name__, f"has no method {' and none '.join(map(repr, missing))}; write it")
        return super().__new__(cls)
