"""The least cost of holding: the mean over time of squared actuator efforts or joint torques, which heats motors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares, squares_of
from synergrip.conic.rows import Earlier
from synergrip.documents.judging import is_word
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.linalg import Array, frozen

Held = Literal["actuator", "torque"]


@naming_arguments
@dataclass(frozen=True)
class LeastHolding(Goal):
    """Minimise ``integral of ||sigma||^2 dt / duration``, or of ``||tau||^2``: the heat that motors have to lose.

    Values are on straight lines between the knots, whose squares are integrated exactly. Torques are divided by the
    length of the grasp, and the mean is times the number of knots, so that weights mean the same as those of an effort.
    A single knot counts as it is.

    Args:
        of: "actuator" effort, or joint "torque".

    Raises:
        InputError: `of` is none of these.

    Example:
        ``LeastHolding()``
    """

    in_natural_units = True
    of: Held = "actuator"
    watches = "forces"
    settles_forces = True

    def __post_init__(self) -> None:
        """Judge the kind of effort."""
        if not is_word(self.of, get_args(Held)):
            raise InputError.at("LeastHolding.of", one_of(self.of, get_args(Held)))

    @property
    def name(self) -> str:
        """Name in messages."""
        return f"least {self.of} holding"

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares, in units of the force unit times the length."""
        value = formulation.torque if self.of == "torque" else formulation.effort
        unit = formulation.force_unit * formulation.response.scale.length
        if formulation.knots < 2:
            return Objective((squares_of(value, 1 / unit),))
        return Objective(mean_squares(value, unit, formulation.times))


def mean_squares(value: Affine, unit: float, times: Array) -> tuple[Squares, Squares]:
    """Return squares whose sum is T times the mean over time of those of what is straight between T knots.

    ``a^2 + a b + b^2 = 3 ((a + b) / 2)^2 + ((b - a) / 2)^2`` for the values a, b at both ends of a step.
    """
    shares = np.sqrt(len(times) * np.diff(times) / (times[-1] - times[0]))
    middle = _steps(value, unit, shares / 2, shares / 2)
    apart = _steps(value, unit, shares / np.sqrt(12), -shares / np.sqrt(12))
    return middle, apart


def _steps(value: Affine, unit: float, newest: Array, before: Array) -> Squares:
    """Return the squares of each step's values at its end and its start, times weights (T - 1,)."""
    matrix, known = frozen(value.matrix / unit), value.constant / unit
    constant = newest[:, None] * known[1:] + before[:, None] * known[:-1]
    earlier = tuple(Earlier(lag, matrix, frozen(weights)) for lag, weights in enumerate((newest, before)))
    return Squares(frozen(np.zeros_like(matrix)), frozen(constant), earlier)


IN_FILE = {"holding": LeastHolding()}
