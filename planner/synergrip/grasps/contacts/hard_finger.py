"""Hard finger: a point contact with Coulomb friction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.kind import FRICTION, ByFormula, Parameter, diagonal
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class HardFinger(ByFormula):
    """Point contact with friction: three force components; cone ``||(t, o)|| <= mu n``.

    Args:
        friction: Coulomb coefficient mu, greater than 0.

    Raises:
        InputError: a friction that is no finite number greater than 0.

    Example:
        >>> HardFinger(friction=0.6).components
        ('n', 't', 'o')
    """

    friction: float

    name: ClassVar[str] = "hard"
    title: ClassVar[str] = "hard-finger"
    components: ClassVar[tuple[str, ...]] = ("n", "t", "o")
    parameters: ClassVar[tuple[Parameter, ...]] = (replace(FRICTION, hint="; for no friction use Frictionless()"),)

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """(3, 3): rows mu n, t, o."""
        return (diagonal(values["friction"], 1.0, 1.0),)
