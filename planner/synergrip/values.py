"""Frozen values: compared by identity, shown in a few lines, and read-only again when they come out of a pickle."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import fields

import numpy as np

from synergrip.errors import shortened

FEW = 6
"""Numbers of an array, or entries of a collection of words, that are shown; of more only how many there are."""
LONGEST = 400
"""Characters of a whole value."""


class Value:
    """The base of frozen dataclasses that hold arrays; they are declared with ``eq=False, repr=False``.

    Two of them are equal when they are the same one: a comparison entry by entry would be an array and no answer.
    """

    def __repr__(self) -> str:
        """Return the fields, arrays by their shape and values inside by their class."""
        named = (each.name for each in fields(self) if each.repr)  # type: ignore[arg-type]
        return told(type(self).__name__, (f"{name}={brief(getattr(self, name))}" for name in named))

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Come out of a pickle, which forgets that arrays are read-only."""
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(state)


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
