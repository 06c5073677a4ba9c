"""What a limit or a goal adds to the program: rows whose value must lie in a cone, at every knot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.documents.judging import Arguments, are_floats, as_numbers, described, is_number
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen, sealed
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
    return _items(tuple(names), side)


@lru_cache(maxsize=256)
def _items(names: tuple[str, ...], side: str) -> tuple[Item, ...]:
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
    over_time: float | None = None
    """Where it is given, the rows (dim 1) of an item at all instants of `inside` make one cone: their norm over time is
    no more than this. None where there is a cone at each instant."""
    friction: bool = False
    """Whether the cones are friction cones: those alone have pyramids, and what they clash with says that it slips."""

    def __post_init__(self) -> None:
        """Judge what a limit of one's own may get wrong; how many unknowns and knots there are, the program knows.

        Raises:
            InputError: a key, kind, items or arrays that are none, or that do not fit each other.
        """
        if self._fits():
            return
        judge = Arguments("Rows")
        judge.text("limit", self.limit, empty=False)
        judge.one("kind", self.kind, Kind, "Kind.NONNEGATIVE")
        items = judge.several("items", self.items, Item, 'Item("thumb")')
        height = len(items) * self.dim if is_number(self.dim) else 0
        for name, side in (("matrix", -2), ("constant", -1), ("epigraph", -1)):
            given = getattr(self, name)
            found = as_numbers(given)
            if found is None or not found.ndim >= -side or found.shape[side] != height:
                shape = {"matrix": f"({height}, n_v)", "constant": f"(K, {height})", "epigraph": f"({height},)"}[name]
                why = f"{len(items)} items with dim = {self.dim} have {height} rows"
                judge.refuse(name, f"expected shape {shape}, as {why}; got {described(given)}")
            elif found is not given:
                object.__setattr__(self, name, frozen(found))
        judge.finish()
        object.__setattr__(self, "items", items)

    def _fits(self) -> bool:
        """Return whether all is as that of the library is; then nothing is looked at more closely."""
        known = type(self.kind) is Kind and type(self.dim) is int and type(self.limit) is str and self.limit
        arrays = self.matrix, self.constant, self.epigraph
        if not known or type(self.items) is not tuple or not are_floats(arrays):
            return False
        if self.matrix.ndim < 2 or not self.constant.ndim or not self.epigraph.ndim:
            return False
        heights = {self.matrix.shape[-2], self.constant.shape[-1], self.epigraph.shape[-1]}
        return heights == {len(self.items) * self.dim} and {Item}.issuperset(map(type, self.items))


def nonnegative(limit: str, items: tuple[Item, ...], value: Affine, earlier: tuple[Earlier, ...] = ()) -> Rows:
    """Return rows ``value >= 0``, with what earlier knots add to the value."""
    return Rows.of_known(
        limit=limit, kind=Kind.NONNEGATIVE, dim=1, items=items, matrix=value.matrix, constant=value.constant,
        epigraph=sealed(np.zeros(len(items))), earlier=earlier,
    )  # fmt: skip


@naming_arguments
def below_scalar(limit: str, names: Sequence[str], value: Affine, side: str = "") -> Rows:
    """Return rows ``value <= s`` for the scalar s of a goal that is to be small, at every knot.

    Args:
        limit: under which a proof names it: "goal.minimise" for the goals of this package.
        names: (m) one for each quantity, for people: contacts, joints, synergies or any words.
        value: m quantities in the units of the scalar, such as ``formulation.torque.after(np.eye(n_q) / size)``.
        side: tells rows of the same names apart, such as "highest" and "lowest" of a size.

    Raises:
        InputError: names that are none or do not fit the quantities, or no affine quantities.

    Example:
        >>> torques = below_scalar("peak torque", grasp.joints, formulation.torque)
        >>> torques.items[0].name, float(torques.epigraph[0])
        ('finger1_inner', 1.0)
    """
    judge = Arguments("below_scalar")
    judge.text("limit", limit, empty=False)
    judge.text("side", side)
    if not isinstance(value, Affine):
        judge.one("value", value, Affine, "formulation.force.after(matrix)")
        raise InputError(judge.issues)
    judge.named("names", names, value.constant.shape[1], "quantity")
    judge.finish()
    ones = frozen(np.ones(len(names)))
    return Rows(limit, Kind.NONNEGATIVE, 1, items_of(names, side), frozen(-value.matrix), frozen(-value.constant), ones)


@naming_arguments
def norm_within(limit: str, item: str, value: Affine, bound: float) -> Rows:
    """Return the cone ``||value|| <= bound``, divided by the bound: one for each knot.

    Args:
        limit: the limit's `key`, under which a proof names it.
        item: what is bounded, for people: a contact, a joint, any word.
        value: m quantities of one unit, such as ``formulation.force.after(rows)``.
        bound: greater than 0, in the unit of the value.

    Raises:
        InputError: a name that is none, no affine quantities, or a bound that is none.

    Example:
        >>> norm_within("all", "contacts", formulation.force, 30.0).dim
        10
    """
    judge = Arguments("norm_within")
    judge.text("limit", limit, empty=False)
    judge.text("item", item, empty=False)
    judge.one("value", value, Affine, "formulation.force.after(matrix)")
    if not is_number(bound) or not 0 < bound < np.inf:
        judge.refuse("bound", f"expected a finite number greater than 0, got {described(bound)}")
    judge.finish()
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
    if rows.over_time is not None:
        return replace(rows, over_time=rows.over_time + room)
    heads = np.zeros(rows.constant.shape[1])
    heads[:: rows.dim] = room
    return replace(rows, constant=frozen(rows.constant + heads))
