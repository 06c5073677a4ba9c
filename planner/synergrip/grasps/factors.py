"""By what a problem file multiplies what its contacts are stated to have."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Factors(Value):
    """What is in the numbers of a grasp already, so that another factor can be told as one of the file."""

    friction: Mapping[str, float] = field(default_factory=dict)
    """By the name of the contact; 1 for those that are not there."""
    stiffness: float = 1.0
    """Of all contacts."""
