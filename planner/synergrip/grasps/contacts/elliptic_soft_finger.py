"""Soft finger with an elliptic limit surface: friction of its own along each tangent, and a spin moment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.kind import FRICTION, SPIN_FRICTION, ByFormula, Parameter, diagonal
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class EllipticSoftFinger(ByFormula):
    """Soft finger that slips more easily one way: ``(t / mu_t)^2 + (o / mu_o)^2 + (m / nu)^2 <= n^2``.

    For each normal force the forces and moments that it withstands fill an ellipsoid with semi-axes of their own: the
    limit surface of a pad with ridges, or of skin that is stretched. With one friction both ways it is a `SoftFinger`.

    The slip margin is ``mu (n - sqrt(...))`` with the smaller mu of the two: whatever tangential force of that size
    comes on top, in whatever direction, the contact holds.

    Args:
        friction: mu_t, Coulomb coefficient along t of the contact frame.
        cross_friction: mu_o, the one along o.
        spin_friction: nu, spin moment carried for each newton of normal force [m].

    Raises:
        InputError: a parameter that is no finite number greater than 0.

    Example:
        >>> EllipticSoftFinger(friction=0.8, cross_friction=0.4, spin_friction=0.01).least_friction
        0.4
    """

    friction: float
    cross_friction: float
    spin_friction: float  # [m]

    name: ClassVar[str] = "soft-elliptic"
    title: ClassVar[str] = "elliptic soft-finger"
    components: ClassVar[tuple[str, ...]] = ("n", "t", "o", "m")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        FRICTION, Parameter("cross_friction", "coefficient of friction along o of the contact", "0.4"), SPIN_FRICTION,
    )  # fmt: skip

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """(4, 4): rows mu n, mu t / mu_t, mu o / mu_o, mu m / nu."""
        along, across = values["friction"], values["cross_friction"]
        mu = np.minimum(along, across)
        return (diagonal(mu, mu / along, mu / across, mu / values["spin_friction"]),)

    def with_friction(self, friction: float) -> Self:
        """Return it with another friction along t, and one across in the same proportion."""
        return replace(self, friction=friction, cross_friction=friction * (self.cross_friction / self.friction))
