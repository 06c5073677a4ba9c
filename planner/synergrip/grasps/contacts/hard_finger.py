"""Hard finger: a point contact with Coulomb friction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class HardFinger:
    """Three force components; cone ``||(t, o)|| <= mu n``."""

    name: str = "hard"
    title: str = "hard-finger"
    components: tuple[str, ...] = ("n", "t", "o")

    @property
    def selection(self) -> Array:
        """(3, 6): the linear velocity."""
        return frozen(np.eye(3, 6))

    def cone(self, friction: float, spin_friction: float) -> Array:
        """Return (3, 3): rows mu n, t, o."""
        return frozen(np.diag([friction, 1.0, 1.0]))
