"""Soft finger: Coulomb friction and a spin moment about the normal, coupled by an ellipsoid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class SoftFinger:
    """Four components; cone ``sqrt((t^2 + o^2) / mu^2 + (m / nu)^2) <= n``."""

    name: str = "soft"
    title: str = "soft-finger"
    components: tuple[str, ...] = ("n", "t", "o", "m")

    @property
    def selection(self) -> Array:
        """(4, 6): the linear velocity and the spin about the normal."""
        return frozen(np.eye(4, 6))

    def cone(self, friction: float, spin_friction: float) -> Array:
        """Return (4, 4): rows mu n, t, o, mu m / nu."""
        return frozen(np.diag([friction, 1.0, 1.0, friction / spin_friction]))
