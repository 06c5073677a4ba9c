"""The kinds of the contacts of many grasps as arrays: what their parameters are, for cones that are made at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class KindsOfContact(Value):
    """One contact in N grasps."""

    classes: tuple[type[ContactKind], ...]
    """Of which it is in any of them."""
    which: NDArray[np.intp]
    """(N,) the one of these that it is of."""
    values: tuple[dict[str, Array], ...]
    """Of each class the parameters (N,), by their names; nan where the contact is of another."""

    @classmethod
    def of(cls, kinds: Sequence[ContactKind]) -> KindsOfContact:
        """Return what is known of the kinds (N) of one contact."""
        types: list[type[ContactKind]] = list(map(type, kinds))
        classes = tuple(dict.fromkeys(types))
        if len(classes) == 1:
            return cls(classes, np.zeros(len(kinds), dtype=np.intp), (_values(classes[0], kinds),))
        which, values = np.array([classes.index(each) for each in types]), []
        for i, each in enumerate(classes):
            places = np.flatnonzero(which == i)
            own = _values(each, [kinds[place] for place in places.tolist()])
            values.append({name: np.full(len(kinds), np.nan) for name in own})
            for name, value in own.items():
                values[-1][name][places] = value
        return cls(classes, which, tuple(values))

    def taken(self, places: Any) -> KindsOfContact:
        """Return it in some of the grasps."""
        values = tuple({name: value[places] for name, value in each.items()} for each in self.values)
        return KindsOfContact(self.classes, self.which[places], values)

    def cones(self, friction: Array | None) -> tuple[Array, ...]:
        """Return its cones (d, rows), or (N, d, rows), with friction multiplied by (N,) factors."""
        if len(self.classes) == 1:
            return self.classes[0].cones_with(self._slippery(0, friction))
        whole: list[Array] = []
        for i, each in enumerate(self.classes):
            if not len(places := np.flatnonzero(self.which == i)):
                continue
            own = each.cones_with({name: value[places] for name, value in self._slippery(i, friction).items()})
            whole = whole or [np.empty((len(self.which), *W.shape[-2:])) for W in own]
            for every, W in zip(whole, own, strict=True):
                every[places] = W
        return tuple(whole)

    def _slippery(self, i: int, friction: Array | None) -> dict[str, Array]:
        """Return the parameters () or (N,) of a class, those of friction multiplied by factors."""
        values = dict(self.values[i])
        if len(self.which) == 1:
            values = {name: value[0] for name, value in values.items()}
        if friction is not None:
            values |= {name: values[name] * friction for name in self.classes[i].frictions if name in values}
        return values


def _values(of: type[ContactKind], kinds: Sequence[ContactKind]) -> dict[str, Array]:
    """Return the parameters (N,) of contacts of one class."""
    return {name: np.fromiter(map(attrgetter(name), kinds), float, len(kinds)) for name in of.named()}


@dataclass(frozen=True, eq=False, repr=False)
class StackedKinds(Value):
    """The kinds of all contacts of N grasps."""

    contacts: tuple[KindsOfContact, ...]

    @classmethod
    def of(cls, grasps: Sequence[Grasp]) -> StackedKinds:
        """Return those of grasps with as many contacts each."""
        contacts, n_c = chain.from_iterable(map(attrgetter("contacts"), grasps)), grasps[0].n_c
        kinds = list(map(attrgetter("kind"), contacts))
        return cls(tuple(KindsOfContact.of(kinds[contact::n_c]) for contact in range(n_c)))

    def __len__(self) -> int:
        """Return N."""
        return len(self.contacts[0].which)

    def taken(self, places: Any) -> StackedKinds:
        """Return those of some of the grasps."""
        return StackedKinds(tuple(contact.taken(places) for contact in self.contacts))
