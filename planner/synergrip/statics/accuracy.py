"""How well the maps of a grasp are known: what arithmetic may have lost, what digits that nobody has would change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.values import ByName

FIGURES = tuple(f"d{name}_{cause}" for name in ("lambda", "u", "tau", "sigma", "z", "q") for cause in ("dzr", "dw"))
"""The maps whose accuracy is known, in the order of `figures`."""


@dataclass(frozen=True)
class Accuracy:
    """How well a map is known, by largest entries; lengths and newtons as `Scale` makes them comparable."""

    size: float
    """Of the map."""
    whole: float
    """What a share is a share of: `size`, or the terms that the entries are sums of where the map may be 0; 0 where it
    is 0 for sure."""
    lost: float
    """What the arithmetic may have lost."""
    changed: float
    """About what changes when the grasp's numbers change by less than half a unit of their last digit."""

    @property
    def error(self) -> float:
        """What the arithmetic may have lost, as a share of the map."""
        return self._share(self.lost)

    @property
    def sensitivity(self) -> float:
        """What the digits that the grasp's numbers do not have would change, as a share of the map."""
        return self._share(self.changed)

    @property
    def unknown(self) -> float:
        """The larger of what is lost and what changes, in the unit of the map."""
        return max(self.lost, self.changed)

    @property
    def doubt(self) -> float:
        """The same as a share of the map."""
        return self._share(self.unknown)

    def _share(self, amount: float) -> float:
        return amount / self.whole if self.whole > 0 else 0.0 if amount == 0 else np.inf


def accuracies(known: Array) -> ByName[Accuracy]:
    """Return what `figures` (12, 4) say of the maps of one grasp, by their names."""
    return ByName("accuracy", {name: Accuracy(*row) for name, row in zip(FIGURES, known.tolist(), strict=True)})


def shares(amounts: Array, figures: Array) -> Array:
    """Return amounts (...) as shares of their maps; of their terms where a map may be 0.

    Args:
        amounts: in the units of the maps.
        figures: (..., 4) the fields of `Accuracy`.
    """
    whole = figures[..., 1]
    none = np.where(amounts == 0, 0.0, np.inf)
    return np.where(whole > 0, amounts / np.where(whole > 0, whole, 1.0), none)
