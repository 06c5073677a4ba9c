"""Values that compare by content: equality and hashes that never raise, whatever arrays are inside."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np


class ByContent:
    """A dataclass (with ``eq=False``) that equals another of its type when all their fields are equal.

    Arrays are equal when shape and entries are, NaN to NaN. Fields with ``compare=False`` do not count.
    """

    def __eq__(self, other: object) -> bool:
        """Compare field by field."""
        if type(other) is not type(self):
            return NotImplemented
        return self is other or all(same(a, b) for a, b in zip(_kept(self), _kept(other), strict=True))

    def __hash__(self) -> int:
        """Return the same number for equal values."""
        return hash((type(self), *(_digest(value) for value in _kept(self))))


def same(a: Any, b: Any) -> bool:
    """Tell whether two values are equal; arrays by shape and entries."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        both = isinstance(a, np.ndarray) and isinstance(b, np.ndarray)
        return both and np.array_equal(a, b, equal_nan=np.asarray(a).dtype.kind == "f")
    if isinstance(a, tuple | list) and type(a) is type(b):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return list(a) == list(b) and all(same(a[key], b[key]) for key in a)
    return bool(a == b)


def _kept(value: Any) -> tuple[object, ...]:
    return tuple(getattr(value, field.name) for field in fields(value) if field.compare)


def _digest(value: object) -> int:
    if isinstance(value, np.ndarray):
        return hash((value.shape, (value + 0.0).tobytes() if value.dtype.kind == "f" else value.tobytes()))
    if isinstance(value, tuple | list):
        return hash(tuple(_digest(each) for each in value))
    if isinstance(value, Mapping):
        return hash(tuple((key, _digest(each)) for key, each in value.items()))
    return hash(value)
