"""Values one after the other that also have names: found by place or by name, and both errors tell what there is."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeVar

from synergrip.documents.places import place_of
from synergrip.errors import Issue, UnknownNameError, one_of

V = TypeVar("V")


class InOrder(tuple[V, ...]):
    """A tuple whose entries have their names in an attribute; of entries of one name the first is found by it."""

    key: str
    """What the entries are, in errors."""
    name: str
    """Attribute that holds their names."""

    def __new__(cls, key: str, values: Iterable[V], name: str = "name") -> InOrder[V]:
        """Return the values in their order."""
        made = super().__new__(cls, values)
        made.key, made.name = key, name
        return made

    def __getitem__(self, which: Any) -> Any:
        """Return the entry at a place or of a name; a tuple for a slice.

        Raises:
            UnknownNameError: there is no such name.
            UnknownPlaceError: there is no such place.
        """
        if isinstance(which, slice):
            return super().__getitem__(which)
        if not isinstance(which, str):
            return super().__getitem__(place_of(self.key, which, len(self)))
        names = [getattr(each, self.name) for each in self]
        if which not in names:
            raise UnknownNameError([Issue(one_of(which, names), key=self.key)])
        return super().__getitem__(names.index(which))

    def __reduce__(self) -> tuple[type[InOrder[V]], tuple[str, tuple[V, ...], str]]:
        """Pickle and copy what it is made of."""
        return type(self), (self.key, tuple(self), self.name)
