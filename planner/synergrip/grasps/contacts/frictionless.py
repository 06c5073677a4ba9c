"""Frictionless point contact: it pushes along the normal and nothing else."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class Frictionless:
    """One component: the normal force. Its margin is the distance to lift-off, n itself."""

    name: str = "frictionless"
    title: str = "frictionless"
    components: tuple[str, ...] = ("n",)

    @property
    def selection(self) -> Array:
        """(1, 6): the normal velocity."""
        return frozen([[1, 0, 0, 0, 0, 0]])

    def cone(self, friction: float, spin_friction: float) -> Array:
        """Return (1, 1): the ray n >= 0."""
        return frozen([[1.0]])
