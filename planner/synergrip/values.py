"""Frozen values: shown in a few lines, compared without ever raising, read-only again out of a pickle."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, Self, TypeVar

import numpy as np

from synergrip.errors import Issue, UnknownNameError, one_of, shortened

FEW = 6
"""Numbers of an array, or entries of a collection of words, that are shown; of more only how many there are."""
LONGEST = 400
"""Characters of a whole value."""


class Kept:
    """What values share: they stay as they are, and a comparison with an array is no array."""

    __array_ufunc__ = None

    @classmethod
    def of_known(cls, **values: object) -> Self:
        """Return a value of fields that are known to fit each other, which nobody judges: all that have no default."""
        made = object.__new__(cls)
        made.__dict__.update(values)
        return made

    def with_judged(self, **values: object) -> Self:
        """Return the same value with others in some fields, which nobody needs to judge."""
        made, own = object.__new__(type(self)), self.__dict__
        made.__dict__.update({name: own[name] for name in self.__dataclass_fields__ if name in own}, **values)  # type: ignore[attr-defined]
        return made

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Come out of a pickle or a copy, which forgets that arrays are read-only."""
        for value in state.values():
            for part in value if isinstance(value, tuple) else (value,):
                if isinstance(part, np.ndarray):
                    part.setflags(write=False)
        self.__dict__.update(state)


V = TypeVar("V")


class ByName(dict[str, V]):
    """Values by name, which tell what names there are when they are asked for another."""

    def __init__(self, key: str, values: Mapping[str, V]) -> None:
        """Keep values; `key` says in errors of what they are."""
        super().__init__(values)
        self.key = key

    def __missing__(self, name: object) -> V:
        """Raise the error that lists the names."""
        raise UnknownNameError([Issue(one_of(name, self), key=self.key)])

    def __reduce__(self) -> tuple[type[ByName[V]], tuple[str, dict[str, V]]]:
        """Pickle and copy what it is made of."""
        return type(self), (self.key, dict(self))


class Value(Kept):
    """The base of frozen dataclasses that hold arrays; they are declared with ``eq=False, repr=False``.

    Two of them are equal when they are the same one: a comparison entry by entry would be an array and no answer.
    """

    def __repr__(self) -> str:
        """Return the fields, arrays by their shape and values inside by their class."""
        named = (each.name for each in fields(self) if each.repr)  # type: ignore[arg-type]
        return told(type(self).__name__, (f"{name}={brief(getattr(self, name))}" for name in named))


class ByContent(Kept):
    """A dataclass (with ``eq=False``) that equals another of its type when all their fields are equal.

    Arrays are equal when shape and entries are, NaN to NaN. Fields with ``compare=False`` do not count.
    """

    def __eq__(self, other: object) -> bool:
        """Compare field by field."""
        if type(other) is not type(self):
            return NotImplemented
        if not is_dataclass(self):  # nothing is known of what it is made of
            return self is other
        return self is other or all(same(a, b) for a, b in zip(_kept(self), _kept(other), strict=True))

    def __hash__(self) -> int:
        """Return the same number for equal values."""
        if not is_dataclass(self):
            return object.__hash__(self)
        return hash((type(self), *(_digest(value) for value in _kept(self))))


def told(name: str, parts: Iterable[str]) -> str:
    """Return ``name(parts)``, cut when it is very long."""
    return shortened(f"{name}({', '.join(parts)})", LONGEST)


def brief(value: object) -> str:
    """Return a value in a few words: what is inside it is counted, or named by its class."""
    if value is None or isinstance(value, bool | int):
        return repr(value)
    if isinstance(value, float | np.number):
        return f"{value:.6g}"
    if isinstance(value, str):
        return repr(shortened(value))
    if isinstance(value, np.ndarray):
        few = value.ndim == 1 and value.size <= FEW and value.dtype.kind in "fi"
        numbers = " ".join(f"{each:.4g}" for each in value) if few else ""
        return f"[{numbers}]" if few else f"<{' x '.join(map(str, value.shape))} array>"
    if isinstance(value, Mapping):
        return f"{{{', '.join(map(brief, value))}}}" if len(value) <= FEW else f"<{len(value)} entries>"
    if isinstance(value, Collection):
        plain = len(value) <= FEW and all(isinstance(each, str | int | float) for each in value)
        return f"({', '.join(map(brief, value))})" if plain else f"<{len(value)} entries>"
    return f"<{type(value).__name__}>"


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
