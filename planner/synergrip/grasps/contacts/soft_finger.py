"""Soft finger: Coulomb friction and a spin moment about the normal, coupled by an ellipsoid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.kind import FRICTION, SPIN_FRICTION, ByFormula, Parameter, diagonal
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class SoftFinger(ByFormula):
    """Four components; cone ``sqrt((t^2 + o^2) / mu^2 + (m / nu)^2) <= n``.

    Args:
        friction: Coulomb coefficient mu.
        spin_friction: nu, the spin moment carried for each newton of normal force [m].

    Raises:
        InputError: a parameter that is no finite number greater than 0.

    Example:
        >>> SoftFinger(friction=0.8, spin_friction=0.01).components
        ('n', 't', 'o', 'm')
    """

    friction: float
    spin_friction: float  # [m]

    name: ClassVar[str] = "soft"
    title: ClassVar[str] = "soft-finger"
    components: ClassVar[tuple[str, ...]] = ("n", "t", "o", "m")
    parameters: ClassVar[tuple[Parameter, ...]] = (FRICTION, SPIN_FRICTION)

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """(4, 4): rows mu n, t, o, mu m / nu."""
        mu = values["friction"]
        return (diagonal(mu, 1.0, 1.0, mu / values["spin_friction"]),)
