"""What every goal is: squares to be small, or a scalar to be small, and the rows that tie the scalar to the plan."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from synergrip.conic.affine import Affine, times
from synergrip.conic.arguments import Complete
from synergrip.conic.formulation import Formulation
from synergrip.conic.rows import Earlier, Rows
from synergrip.documents.judging import Arguments, are_floats, described
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, sealed
from synergrip.values import ByContent, Value

if TYPE_CHECKING:
    from synergrip.conic.limits.limit import Limit, Watches
    from synergrip.grasps.grasp import Grasp


@dataclass(frozen=True, eq=False, repr=False)
class Squares(Value):
    """Half the sum of squares of ``matrix v_k + constant[k]``, and of what earlier knots add to it."""

    matrix: Array  # (m, n_v), or (T, m, n_v) with one for each knot
    constant: Array  # (K, m); K = T, or T - lag when earlier knots add to it
    earlier: tuple[Earlier, ...] = ()

    def at(self, v: Array) -> Array:
        """Return the values (K, m) whose squares are summed, at unknowns v (T, n_v)."""
        count = len(self.constant)
        value = self.constant + times(self.matrix, v)[len(v) - count :]
        for part in self.earlier:
            start = len(v) - count - part.lag
            value = value + part.weights[:, None] * times(part.matrix, v)[start : start + count]
        return np.asarray(value)


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class Objective(Value):
    """The squares of a goal, plus ``epigraph`` times its scalar s when it has one.

    Args:
        squares: what `squares_of` returns, one or more of it.
        epigraph: factor before the scalar of a goal that has one: 1 when it is to be small, -1 when large.

    Raises:
        InputError: something else than a list of `Squares`, or a factor that is no number.

    Example:
        >>> Objective((squares_of(formulation.force),)).empty
        False
    """

    squares: tuple[Squares, ...] = ()
    epigraph: float | None = None

    def __post_init__(self) -> None:
        """Judge the values."""
        plain = self.epigraph is None or (type(self.epigraph) is float and abs(self.epigraph) == 1.0)
        if plain and type(self.squares) is tuple and all(type(each) is Squares for each in self.squares):
            return
        judge = Arguments("Objective")
        squares = judge.several("squares", self.squares, Squares, "squares_of(...)")
        if self.epigraph is not None:
            judge.number("epigraph", self.epigraph)
        judge.finish()
        object.__setattr__(self, "squares", squares)

    def squared(self, v: Array) -> float:
        """Return half the sum of the squares at unknowns v (T, n_v)."""
        return sum(float((part.at(v) ** 2).sum()) / 2 for part in self.squares)

    @property
    def empty(self) -> bool:
        """True when nothing is minimised."""
        return not self.squares and self.epigraph is None


class Goal(Complete, ByContent, ABC):
    """What is best among the plans that hold. A goal of one's own is `objective`, and `rows` when it has a scalar.

    Example:
        A goal that squeezes evenly::

            class EvenSqueeze(Goal):
                def objective(self, formulation):
                    normal = np.eye(formulation.response.grasp.n_l)[formulation.response.grasp.normal_rows]
                    apart = normal - normal.mean(axis=0)
                    return Objective((squares_of(formulation.force.after(apart), 1 / formulation.force_unit),))
    """

    _example = "LeastEffort()"

    @property
    def name(self) -> str:
        """Name in messages: that of the class in words, unless it says another."""
        return in_words(type(self).__name__)

    @property
    def watches(self) -> Watches:
        """What it depends on; of all the references unless it says less, so that redundancy is free for it."""
        return "references"

    @property
    def has_scalar(self) -> bool:
        """Whether it minimises (or maximises) a scalar that its rows tie to the plan; else it is a sum of squares."""
        return False

    @property
    def maximises(self) -> bool:
        """Whether a problem file asks for it under `maximise`, and not under `minimise`."""
        return False

    @property
    def in_natural_units(self) -> bool:
        """Whether its squares are near 1 where they matter; those of others are first brought there by their size."""
        return False

    @property
    def settles_forces(self) -> bool:
        """Whether the best plans by it all have the same forces."""
        return False

    @abstractmethod
    def objective(self, formulation: Formulation) -> Objective:
        """Return what is minimised: squares, or the factor before its scalar."""

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the rows that tie the scalar to the plan; none for a goal without one."""
        return ()

    def on(self, grasp: Grasp) -> Goal:
        """Return the goal for one grasp: numbers one for each, and what its hand states filled in.

        Raises:
            InputError: the grasp has not what the goal needs.
        """
        return self

    @property
    def rescaled(self) -> Goal | None:
        """The same goal looked at less closely, for programs that do not verify; None when there is no such way."""
        return None

    def weighed(self) -> Goal:
        """Return the goal as a sum with weights needs it: with the factor that its definition gives it."""
        return self

    def keeps(self, best: float, slack: float) -> Limit | None:
        """Return the limit that keeps a scalar of `best` but for `slack` [N]; None to keep it by its own rows."""
        return None


def in_words(name: str) -> str:
    """Return the name of a class as words: "EvenSqueeze" is "even squeeze"."""
    return "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name).strip()


@naming_arguments
def squares_of(value: Affine, weights: Array | float = 1.0) -> Squares:
    """Return the squares of quantities times weights, at every knot.

    Args:
        value: m quantities, such as ``formulation.force``.
        weights: (m,), or a number for all: 1 over the size at which each quantity matters.

    Raises:
        InputError: no affine quantities, or weights that are none, not as many, or less than 0.

    Example:
        >>> squares_of(formulation.force, 1 / formulation.force_unit).matrix.shape[0]
        9
    """
    plain = type(value) is Affine and are_floats((value.matrix, value.constant))
    if plain and type(weights) is float and 0 <= weights < np.inf:  # as most are
        return weighed(value, np.asarray(weights))
    judge = Arguments("squares_of")
    judge.one("value", value, Affine, "formulation.force.after(matrix)")
    each = judge.numbers("weights", weights, "a number, or one for each quantity")
    judge.finish()
    count = value.constant.shape[1]
    if each is None or each.shape not in ((), (count,)):
        wanted = f"a number, or {count} numbers, one for each quantity"
        raise InputError.at("squares_of.weights", f"expected {wanted}; got {described(weights)}")
    if np.any(each < 0):
        message = f"expected weights of at least 0, got {float(each.min()):g}: squares can only be made small"
        raise InputError.at("squares_of.weights", message)
    return weighed(value, each)


def weighed(value: Affine, weights: Array) -> Squares:
    """Return what `squares_of` does for weights (m,) or () that are known to fit."""
    return Squares(sealed(weights[..., None] * value.matrix), sealed(value.constant * weights))
