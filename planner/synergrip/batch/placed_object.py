"""An object at the place where it is held best."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.documents.naming import made_by
from synergrip.grasps.clearance import deepest
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.planning.outcome import Outcome
from synergrip.values import Value


@made_by("place_object(hand, object, ...)")
@dataclass(frozen=True, eq=False, repr=False)
class PlacedObject(Value):
    """Where an object is held best.

    Example:
        >>> found = PlacedObject(grasp=grasp, margin=11.3, tried=1800, touching=625)  # as place_object returns it
        >>> found.line
        'position = ["0 mm", "3.3454 mm", "148.8372 mm"]'
    """

    grasp: Grasp
    """The grasp there."""
    margin: float
    """[N] The largest slip margin that all contacts can keep in the linear model of this posture, at the worst of the
    instants that were looked at; minus infinity where the load is not held at all of them."""
    tried: int
    """Places that were closed on."""
    touching: int
    """Places of these at which all contacts touch."""
    notes: tuple[str, ...] = ()
    """What is doubtful, and which better places were set aside because no plan holds there."""
    outcome: Outcome | None = None
    """What `plan` says of the task there; None where it refuses the task."""
    planned: int = 0
    """Places at which it was planned, best first, until one had a plan."""

    @property
    def position(self) -> Array:
        """(3,) centre of the object in the palm frame [m]."""
        assert self.grasp.held is not None
        return self.grasp.held.body.position

    @property
    def inside(self) -> float:
        """How deep [m] the lines between links of the hand run inside the object; below 0 where they stay outside."""
        held = self.grasp.held
        assert held is not None
        assert held.body.shape is not None
        return float(deepest(held.hand, held.q[None], held.body.shape, self.position[None], held.touches)[0])

    @property
    def line(self) -> str:
        """The position as it stands in a problem file."""
        return position_line(self.position)


FOUND = '  # found by object.position = "auto"'
"""Ends an override by which an object is where it was found, so that an answer says who chose the place."""


def found_override(position: Array) -> str:
    """Return the override that puts an object at a position (3,) [m] which was looked for."""
    return f"object.{position_line(position).replace(' = ', '=')}{FOUND}"


def position_line(position: Array) -> str:
    """Return how a position (3,) [m] is written under [object]."""
    texts = (f'"{round(1e3 * float(value), 4) + 0.0:.10g} mm"' for value in position)
    return f"position = [{', '.join(texts)}]"
