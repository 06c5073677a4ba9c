"""Values of a JSON document, each judged where it is taken and refused by its key."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from synergrip.errors import InputError, kind_of
from synergrip.linalg import Array, frozen

T = TypeVar("T")


@dataclass(frozen=True)
class Told:
    """A table of a document, with the key it stands at."""

    values: Mapping[str, Any]
    key: str

    def get(self, name: str) -> Any:
        """Return a value as it is, or None."""
        return self.values.get(name)

    def perhaps(self, name: str, read: Callable[..., T], *how: Any) -> T | None:
        """Return a value as `read` takes it, such as `Told.number`; None where there is none."""
        return None if self.get(name) is None else read(self, name, *how)

    def refused(self, name: str, message: str) -> InputError:
        """Return the error at a value."""
        return InputError.at(self.at(name), message)

    def at(self, name: str) -> str:
        """Return the key of a value."""
        return f"{self.key}.{name}" if self.key else name

    def inside(self, name: str) -> Told:
        """Return a table in it."""
        value = self.get(name)
        if not isinstance(value, dict):
            raise self.refused(name, self._wanted("a table", value))
        return Told(value, self.at(name))

    def several(self, name: str) -> list[Told]:
        """Return a list of tables in it, one at least."""
        value = self.get(name)
        if not isinstance(value, list) or not value or not all(isinstance(each, dict) for each in value):
            raise self.refused(name, self._wanted("a list of tables", value))
        return [Told(each, f"{self.at(name)}[{i}]") for i, each in enumerate(value)]

    def text(self, name: str) -> str:
        """Return a text."""
        value = self.get(name)
        if not isinstance(value, str):
            raise self.refused(name, self._wanted("a text", value))
        return value

    def texts(self, name: str) -> Sequence[str]:
        """Return a list of texts."""
        value = self.get(name)
        if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
            raise self.refused(name, self._wanted("a list of texts", value))
        return value

    def number(self, name: str) -> float:
        """Return a finite number."""
        return float(self.array(name, ()))

    def positive(self, name: str) -> float:
        """Return a finite number greater than 0."""
        value = self.number(name)
        if not value > 0:
            raise self.refused(name, f"must be greater than 0, got {value:g}")
        return value

    def array(self, name: str, shape: tuple[int | None, ...]) -> Array:
        """Return finite numbers of a shape, where None is any length from 1."""
        value, wanted = self.get(name), " x ".join("n" if n is None else str(n) for n in shape)
        expected = f"{wanted} finite numbers" if shape else "a finite number"
        try:
            found = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            raise self.refused(name, self._wanted(expected, value)) from None
        fits = found.ndim == len(shape) and all(
            length >= 1 if n is None else length == n for length, n in zip(found.shape, shape, strict=True)
        )
        if value is None or not fits or not np.all(np.isfinite(found)):
            raise self.refused(name, self._wanted(f"{expected}", value, f" of shape {found.shape}"))
        return frozen(found)

    def _wanted(self, expected: str, value: object, shape: str = "") -> str:
        if value is None:
            return f"is missing; expected {expected}"
        return f"expected {expected}, got {kind_of(value)}{shape}; was the file changed by hand? plan again"
