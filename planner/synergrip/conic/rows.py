"""What a limit or a goal adds to the program: rows whose value must lie in a cone, at every knot."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.arguments import is_number
from synergrip.documents.judging import described
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.values import Value

if TYPE_CHECKING:
    from scipy import sparse


class Kind(StrEnum):
    """The cones used."""

    ZERO = "zero"
    NONNEGATIVE = "nonnegative"
    SECOND_ORDER = "second-order"


class Item(NamedTuple):
    """What one cone is about. Names are the user's and may hold anything; nothing is ever read out of them."""

    name: str
    """A contact, joint or synergy, or "object"."""
    side: str = ""
    """"lowest" or "highest" of a range, "falling" or "rising" of a change, "norm" of a size, "facet 3" of a pyramid;
    empty for a cone that is all there is."""

    def __str__(self) -> str:
        """Return both for people."""
        return f"{self.name} ({self.side})" if self.side else self.name


LOWER_SIDES = frozenset({"lowest", "falling"})
"""Sides whose multipliers push a value up; those of the opposite side push it down."""


def items_of(names: Iterable[str], side: str = "") -> tuple[Item, ...]:
    """Return the items of cones on one side of each name."""
    return tuple(Item(name, side) for name in names)


@dataclass(frozen=True, eq=False, repr=False)
class Earlier(Value):
    """What an earlier knot adds to a row: ``weights[k] matrix v_(k-lag)``."""

    lag: int
    matrix: Array
    """(len(items) * dim, n_v), or (T, len(items) * dim, n_v): the k-th is what knot k adds to the rows of k + lag."""
    weights: Array
    """(K,) one for each of the K knots that have rows."""


@dataclass(frozen=True, eq=False, repr=False)
class Rows(Value):
    """``matrix v_k + epigraph s + constant[k]``, and what earlier knots add, lies in a cone, for each item and knot."""

    limit: str
    """Key in the problem file of what asks for it."""
    kind: Kind
    dim: int
    """Rows of each cone."""
    items: tuple[Item, ...]
    """What the cones of one knot are about."""
    matrix: Array  # (len(items) * dim, n_v), or (T, len(items) * dim, n_v) with one for each knot
    constant: Array
    """(K, len(items) * dim); K = T, or T - lag for rows that couple a knot to one that is `lag` earlier."""
    epigraph: Array  # (len(items) * dim,) coefficient of the goal's scalar s
    earlier: tuple[Earlier, ...] = ()
    inside: sparse.csr_matrix | None = None
    """(K, T) what each knot has of each instant, for rows at instants between the knots; None for rows at the knots.
    The value is then ``matrix (inside v)_k + ...``, or, with one matrix for each knot, the knots' ``matrix v`` in their
    shares."""
    friction: bool = False
    """Whether the cones are friction cones: those alone have pyramids, and what they clash with says that it slips."""


def nonnegative(limit: str, items: tuple[Item, ...], value: Affine, earlier: tuple[Earlier, ...] = ()) -> Rows:
    """Return rows ``value >= 0``, with what earlier knots add to the value."""
    return Rows(limit, Kind.NONNEGATIVE, 1, items, value.matrix, value.constant, frozen(np.zeros(len(items))), earlier)


def norm_within(limit: str, item: str, value: Affine, bound: float) -> Rows:
    """Return the cone ``||value|| <= bound``, divided by the bound: one for each knot.

    Args:
        limit: key in the problem file.
        item: its name.
        value: m affine quantities of one unit.
        bound: greater than 0.

    Raises:
        InputError: no affine quantities, or a bound that is none.
    """
    if not isinstance(value, Affine):
        raise InputError.at("norm_within.value", f"expected affine quantities of a formulation, got {described(value)}")
    if not is_number(bound) or not 0 < bound < np.inf:
        raise InputError.at("norm_within.bound", f"expected a finite number greater than 0, got {described(bound)}")
    matrix = np.concatenate([np.zeros_like(value.matrix[..., :1, :]), value.matrix / bound], axis=-2)
    constant = np.hstack([np.ones((len(value.constant), 1)), value.constant / bound])
    zero = frozen(np.zeros(constant.shape[1]))
    return Rows(
        limit, Kind.SECOND_ORDER, constant.shape[1], (Item(item, "norm"),), frozen(matrix), frozen(constant), zero
    )


def with_room(rows: Rows, room: float) -> Rows:
    """Return rows whose cones are all kept but for `room`; equations stay."""
    if rows.kind is Kind.ZERO:
        return rows
    heads = np.zeros(rows.constant.shape[1])
    heads[:: rows.dim] = room
    return replace(rows, constant=frozen(rows.constant + heads))


def within(limit: str, names: tuple[str, ...], value: Affine, lower: Array, upper: Array, unit: Array) -> list[Rows]:
    """Return rows ``lower <= value <= upper``, divided by `unit`; infinite bounds add nothing.

    Args:
        limit: key in the problem file.
        names: (m) of contacts, joints or synergies.
        value: m affine quantities.
        lower: (m,) or (T, m).
        upper: (m,) or (T, m).
        unit: (m,) size of each quantity.

    Raises:
        InputError: bounds or units that are none, do not fit the names, or contradict each other.
    """
    lower, upper, unit = _bounds(names, value, lower, upper, unit)
    result = []
    for side, bound, sign in (("lowest", lower, 1.0), ("highest", upper, -1.0)):
        keep = np.all(np.isfinite(np.atleast_2d(bound)), axis=0)
        if not np.any(keep):
            continue
        slack = sign * (value.constant - bound) / unit
        rows = Affine(frozen((sign * value.matrix / unit[:, None])[..., keep, :]), frozen(slack[:, keep]))
        items = items_of((name for name, kept in zip(names, keep, strict=True) if kept), side)
        result.append(nonnegative(limit, items, rows))
    return result


def _bounds(names: tuple[str, ...], value: Affine, *given: Array) -> tuple[Array, ...]:
    """Return lower bounds, upper bounds and units as arrays, one for each name (and knot), or refuse them."""
    if not isinstance(value, Affine):
        raise InputError.at("within.value", f"expected affine quantities of a formulation, got {described(value)}")
    count = value.constant.shape[1]
    if len(names) != count:
        raise InputError.at("within.names", f"expected {count} names, one for each quantity, got {len(names)}")
    found: list[Array] = []
    for name, each in zip(("lower", "upper", "unit"), given, strict=True):
        try:
            array = np.asarray(each, dtype=np.float64)
            np.broadcast_to(array, value.constant.shape)
        except (TypeError, ValueError):
            wanted = f"{count} numbers, one for each quantity"
            raise InputError.at(f"within.{name}", f"expected {wanted}, got {described(each)}") from None
        found.append(array if array.ndim else np.full(count, float(array)))
    lower, upper, unit = found
    free = "numbers; infinity stands for no bound"
    for name, array, bad, wanted in (
        ("lower", lower, np.isnan(lower), free), ("upper", upper, np.isnan(upper), free),
        ("unit", unit, ~(unit > 0) | np.isinf(unit), "sizes greater than 0"),
    ):  # fmt: skip
        if np.any(bad):
            raise InputError.at(f"within.{name}", f"expected {wanted}, got {array[bad][0]:g}")
    if np.any(lower > upper):
        raise InputError.at("within.lower", "some lower bounds are above the upper ones; swap them")
    return lower, upper, unit
