"""Joints near the middle of their ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from synergrip.conic.arguments import OneOrEach
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, squares_of
from synergrip.conic.limits.joint_range import JointRange, refuse_some_of
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp


@naming_arguments
@dataclass(frozen=True, eq=False)
class CentredJoints(Goal):
    """Minimise the sum of squared distances of the joints from the middle of their ranges, in half ranges.

    Joints without two ends are left out. What is not given is what the hand of the grasp says.

    Args:
        start: joint values (n_q,) at the start [rad or m], or one for all.
        lower: ends of their ranges (n_q,), or one for all.
        upper: the same.

    Raises:
        InputError: no numbers, or a lower end above an upper one.

    Example:
        ``CentredJoints()`` on a hand; ``CentredJoints(start=0.2, lower=-1.0, upper=1.0)`` on matrices
    """

    in_natural_units = True
    start: OneOrEach = None
    lower: OneOrEach = None
    upper: OneOrEach = None
    name = "centred joints"

    def __new__(cls, *values: OneOrEach, **named: OneOrEach) -> Self:
        """Refuse one or two numbers without names, the first of which would be the start and not an end."""
        refuse_some_of(cls, values, named)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        """Judge the ranges as those of the limit."""
        judged = JointRange(self.start, self.lower, self.upper, of="CentredJoints")
        for end in ("start", "lower", "upper"):
            object.__setattr__(self, end, getattr(judged, end))

    def on(self, grasp: Grasp) -> CentredJoints:
        """Return it with ranges and posture of the hand where none are given."""
        found = JointRange(self.start, self.lower, self.upper, of="CentredJoints").on(grasp)
        if not np.any(_half(found) > 0):
            message = "no joint has two ends to be centred between; give lower and upper, or leave the goal out"
            raise InputError.at("CentredJoints.lower", message)
        return CentredJoints(found.start, found.lower, found.upper)

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares."""
        own = self.on(formulation.response.grasp)
        half = _half(own)
        ends = half > 0
        middle = (np.where(ends, own.lower, 0.0) + np.where(ends, own.upper, 0.0)) / 2
        weights = np.where(ends, 1 / np.where(ends, half, 1.0), 0.0)
        return Objective((squares_of(formulation.joint.plus(own.start - middle), weights),))


def _half(own: JointRange | CentredJoints) -> Array:
    """Return half the range of each joint; 0 where it has none, or no two ends."""
    whole = np.asarray(own.upper - own.lower)
    return np.where(np.isfinite(whole), whole / 2, 0.0)


IN_FILE = {"centred": CentredJoints()}
