"""Several sums of squares at once, each with its weight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from synergrip.conic.arguments import size
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares
from synergrip.documents.judging import described, is_list
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import frozen

if TYPE_CHECKING:
    from synergrip.conic.limits.limit import Watches
    from synergrip.grasps.grasp import Grasp

EXAMPLE = "write for example WeightedSum(((LeastEffort(), 1.0), (LeastMotion('rates'), 0.1)))"


@naming_arguments
@dataclass(frozen=True)
class WeightedSum(Goal):
    """Minimise the sum of weight times goal, over goals that are sums of squares, each in the units stated for it.

    Args:
        goals: pairs of a goal and its weight, greater than 0.

    Raises:
        InputError: no goals, no such weights, or a goal that is no sum of squares.

    Example:
        ``WeightedSum(((LeastEffort(), 1.0), (LeastMotion(of="rates"), 0.1)))``
    """

    goals: tuple[tuple[Goal, float], ...]

    def __post_init__(self) -> None:
        """Judge goals and weights."""
        pairs = list(self.goals) if is_list(self.goals) else []
        if not pairs:
            got = "none" if isinstance(self.goals, tuple) else described(self.goals)
            message = f"expected pairs of a goal and its weight, got {got}"
            raise InputError.at("WeightedSum.goals", f"{message}; {EXAMPLE}")
        kept = tuple(_pair(f"WeightedSum.goals[{index}]", pair) for index, pair in enumerate(pairs))
        for index, (goal, _) in enumerate(kept):
            if goal in [other for other, _ in kept[:index]]:
                raise InputError.at(f"WeightedSum.goals[{index}]", f"'{goal.name}' is listed twice")
        object.__setattr__(self, "goals", kept)

    @property
    def name(self) -> str:
        """Name in messages."""
        return " + ".join(f"{weight:g} {goal.name}" for goal, weight in self.goals)

    @property
    def watches(self) -> Watches:
        """What any of the goals depends on."""
        found = {goal.watches for goal, _ in self.goals}
        return "references" if "references" in found else "motion" if "motion" in found else "forces"

    @property
    def settles_forces(self) -> bool:
        """Whether one of them does: no other plan has as small a sum."""
        return any(goal.settles_forces for goal, _ in self.goals)

    def on(self, grasp: Grasp) -> WeightedSum:
        """Return the sum of the goals for one grasp."""
        return WeightedSum(tuple((goal.on(grasp), weight) for goal, weight in self.goals))

    def objective(self, formulation: Formulation) -> Objective:
        """Return all the squares, each times the root of its weight."""
        stated = replace(formulation, units=formulation.stated)
        parts = ((part, weight) for goal, weight in self.goals for part in goal.weighed().objective(stated).squares)
        return Objective(tuple(_times(part, float(np.sqrt(weight))) for part, weight in parts))


def _pair(key: str, pair: Any) -> tuple[Goal, float]:
    """Return a goal and its weight, judged."""
    if not isinstance(pair, Sequence) or isinstance(pair, str) or len(pair) != 2 or not isinstance(pair[0], Goal):
        raise InputError.at(key, f"expected a pair of a goal and its weight, got {described(pair)}; {EXAMPLE}")
    goal, weight = pair
    if goal.has_scalar:
        raise InputError.at(key, f"'{goal.name}' is no sum of squares; only sums of squares have weights")
    return goal, size(key, weight, "a weight greater than 0", above=0.0)


def _times(squares: Squares, factor: float) -> Squares:
    earlier = tuple(replace(part, weights=frozen(factor * part.weights)) for part in squares.earlier)
    matrix, constant = frozen(factor * squares.matrix), frozen(factor * squares.constant)
    return replace(squares, matrix=matrix, constant=constant, earlier=earlier)
