"""Places of an object with how well it is held there, and of these the best ones that are far from each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.grasps.place_search import TouchingPlaces
from synergrip.linalg import Array
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class JudgedPlaces(Value):
    """N places at which all contacts touch."""

    places: TouchingPlaces
    margins: Array
    """(N,) [N] the largest slip margin in the linear model of the posture there; -inf where a load is not held."""

    def joined(self, other: JudgedPlaces) -> JudgedPlaces:
        """Return these places, then others."""
        return JudgedPlaces(self.places.joined(other.places), np.concatenate([self.margins, other.margins]))

    def far_from(self, chosen: Array, apart: float, most: int) -> TouchingPlaces:
        """Return the best of them that are `apart` [m] from a place (3,) and from each other, best first.

        Those of which there is less doubt go first, then those with the larger margin; those at which a load is not
        held are left out.
        """
        taken, found = [chosen], list[int]()
        for index in np.lexsort((-self.margins, self.places.doubts)).tolist():
            if len(found) == most:
                break
            place = self.places.positions[index]
            if np.isfinite(self.margins[index]) and min(np.linalg.norm(place - each) for each in taken) >= apart:
                taken.append(place)
                found.append(index)
        return self.places.taken(np.array(found, dtype=int))
