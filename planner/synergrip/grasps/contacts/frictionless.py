"""Frictionless point contact: it pushes along the normal and nothing else."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.kind import ByFormula
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class Frictionless(ByFormula):
    """One component: the normal force. Its margin is the distance to lift-off, n itself.

    Example:
        >>> Frictionless().components
        ('n',)
    """

    name: ClassVar[str] = "frictionless"
    title: ClassVar[str] = "frictionless"
    components: ClassVar[tuple[str, ...]] = ("n",)

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """(1, 1): the ray n >= 0."""
        return (np.ones((1, 1)),)
