"""The least motion of the synergy references: away from the start, from knot to knot, or in its bends."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, Self, get_args

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares, squares_of
from synergrip.conic.rows import Earlier
from synergrip.errors import InputError, one_of
from synergrip.linalg import Array, frozen

STIFFEST, RESCALED = 1e6, 1e4
"""Largest entry of the Hessian of rates and accelerations; beyond, rounding would drown the bends between many knots.
A factor before a goal changes no plan, only how closely the solver looks at it: less closely, but to the end, with the
second, which is for programs that do not verify with the first."""


Motion = Literal["references", "rates", "accelerations"]


@dataclass(frozen=True)
class LeastMotion(Goal):
    """Minimise the sum of squares of the synergy references, of their rates, or of their accelerations.

    "references": ``||dz_r||^2`` at every knot, so that the hand stays near the posture in which it starts. "rates":
    of the steps between knots over their durations, averaged over time: the least travel. "accelerations": of the
    second differences, averaged over time: smooth references. Time counts in durations of the task, and averages
    times the number of knots, so that weights mean the same for any number. Rates and accelerations say nothing
    about where the references are, or how fast they go; what they leave open is for the next goal.

    Args:
        of: "references", "rates" or "accelerations".

    Raises:
        InputError: `of` is none of these.

    Example:
        ``LeastMotion(of="rates")``
    """

    of: Motion = "references"
    exact: bool = field(default=False, repr=False)
    """Whether the factor before the goal counts, as in a weighted sum, or may be chosen for the solver's sake."""
    stiffest: float = field(default=STIFFEST, repr=False)
    """What that factor makes of the largest entry of the Hessian, at most."""

    def __post_init__(self) -> None:
        """Judge the kind of motion."""
        if self.of not in get_args(Motion):
            raise InputError.at("LeastMotion.of", one_of(self.of, get_args(Motion)))

    @property
    def name(self) -> str:
        """Name in messages."""
        return {"references": "least motion", "rates": "least travel", "accelerations": "smoothest references"}[self.of]

    @property
    def rescaled(self) -> Self | None:
        """The same goal looked at less closely; None when there is no such way."""
        if self.exact or self.of == "references" or self.stiffest <= RESCALED:
            return None
        return replace(self, stiffest=RESCALED)

    def weighed(self) -> Self:
        """Return it with the factor of its definition, which counts beside other goals."""
        return replace(self, exact=True)

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares, in reference units over the duration of the task."""
        unit = formulation.units.reference
        if self.of == "references":
            return Objective((squares_of(formulation.reference, 1 / unit),))
        order = 1 if self.of == "rates" else 2
        if formulation.knots <= order:
            return Objective()
        return Objective((_differences(formulation, order, unit, np.inf if self.exact else self.stiffest),))


def _differences(formulation: Formulation, order: int, unit: float, stiffest: float) -> Squares:
    """Return first or second differences over uneven knots; their sum of squares is T times an integral over [0, 1].

    A row is divided by nothing that changes from knot to knot but by weights, since one matrix serves all knots:
    the weight of the newest knot stands before the whole row.
    """
    weights = _weights(formulation.times, order)  # (K, order + 1), newest first
    weights = weights * np.sqrt(formulation.knots)
    weights = weights * min(1.0, np.sqrt(stiffest) / float(np.abs(weights).max()))
    value = formulation.reference
    matrix, known = value.matrix / unit, value.constant / unit
    count = len(weights)
    constant = sum(weights[:, lag, None] * known[order - lag : order - lag + count] for lag in range(order + 1))
    earlier = tuple(Earlier(lag, frozen(matrix), frozen(weights[:, lag])) for lag in range(order + 1))
    time = (formulation.times - formulation.times[0]) / (formulation.times[-1] - formulation.times[0])
    unseen = np.column_stack([np.ones(len(time)), 2 * time - 1])[:, :order]
    return Squares(frozen(np.zeros_like(matrix)), frozen(constant), earlier, frozen(unseen))


def _weights(times: Array, order: int) -> Array:
    """Return the weights of knots k, k - 1, ... in each difference, for a task that lasts 1."""
    h = np.diff(times) / (times[-1] - times[0])
    if order == 1:
        root = 1 / np.sqrt(h)
        return np.column_stack([root, -root])
    before, after = h[:-1], h[1:]
    span = (before + after) / 2
    root = np.sqrt(span)
    return np.column_stack([root / (span * after), -root * (1 / after + 1 / before) / span, root / (span * before)])


IN_FILE = {
    "references": LeastMotion(),
    "travel": LeastMotion("rates"),
    "smooth": LeastMotion("accelerations"),
}
