"""The slip margin that a task asks of every contact."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from synergrip.conic.arguments import size
from synergrip.conic.limits.dial import Dial
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.friction_cone import FRICTION, FrictionCone
from synergrip.conic.limits.limit import Limit
from synergrip.documents.fields import Force
from synergrip.documents.naming import naming_arguments
from synergrip.grasps.grasp import Grasp

KEY = "limits.margin"
MARGIN = "a slip margin in newtons of at least 0; 0 asks only that nothing slips"


@naming_arguments
@dataclass(frozen=True)
class SlipMargin(FrictionCone):
    """Every contact force at least so far inside its friction cone: ``mu n - ||(t, o)|| >= margin``.

    Friction cones always hold; this says by how much.

    Args:
        margin: [N], 0 or more.
        key: what asks for it, in messages and proofs; without a margin it is a friction cone.

    Raises:
        InputError: no such force.

    Example:
        ``SlipMargin(0.5)``
    """

    key: str = field(default=KEY, repr=False)

    def __post_init__(self) -> None:
        """Judge the margin."""
        object.__setattr__(self, "margin", size("SlipMargin.margin", self.margin, MARGIN, at_least=0.0))
        if not self.margin and self.key == KEY:
            object.__setattr__(self, "key", FRICTION)

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """The margin, where one is asked for: without one it is a friction cone, which is physics."""
        if not self.margin:
            return ()
        return (Dial("margin", self.key, self.margin, "N", lambda value: replace(self, margin=value), "down", 0.0),)


IN_FILE = FileKey(
    "margin", SlipMargin, Force, "distance of every contact force to its friction cone",
    default="0 N",
)  # fmt: skip
