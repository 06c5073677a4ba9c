"""Limits as cones of what a grasp does, before any program: of forces, torques, efforts, references and motions.

A limit writes its rows for whatever formulation it is given. Given one whose unknowns are the quantities themselves it
says which number of which quantity counts how much, and that is all that a proof needs that anybody can redo.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.beside_knots import fields_of
from synergrip.conic.formulation import Formulation
from synergrip.conic.rows import Kind, Rows
from synergrip.linalg import Array, frozen
from synergrip.values import Value

DIGITS = 15
"""What a number of a problem has: more are the rounding of a unit that it was divided by."""
SAME = 1e-8
"""How closely both ways to the value of a row must agree, beside its largest value."""
ROUNDED = 1e-15
"""Relative difference that such rounding makes."""


@dataclass(frozen=True, eq=False, repr=False)
class BareFormulation(Formulation):
    """A formulation whose unknowns at a knot are the quantities, one after the other."""

    @classmethod
    def of(cls, formulation: Formulation) -> BareFormulation:
        """Return that of a task."""
        T, count = formulation.knots, sum(_sizes(formulation).values())
        nothing = {
            name: Affine(np.zeros((len(getattr(formulation, name).matrix), count)), np.zeros((T, size)))
            for name in ("alpha", "beta", "gamma")
            for size in [len(getattr(formulation, name).matrix)]
        }
        return cls(**fields_of(formulation) | nothing | {"intersample": None})

    def _part(self, name: str) -> Affine:
        sizes = _sizes(self)
        start = sum(size for each, size in sizes.items() if list(sizes).index(each) < list(sizes).index(name))
        rows = np.eye(sizes[name], sum(sizes.values()), start)
        return Affine(frozen(rows), frozen(np.zeros((self.knots, sizes[name]))))

    @cached_property
    def force(self) -> Affine:
        """Contact forces lambda (n_l) [N, N m]."""
        return self._part("force")

    @cached_property
    def torque(self) -> Affine:
        """Joint torques tau (n_q) [N m]."""
        return self._part("torque")

    @cached_property
    def effort(self) -> Affine:
        """Actuator efforts sigma (n_z)."""
        return self._part("effort")

    @cached_property
    def reference(self) -> Affine:
        """Synergy references dz_r (n_z)."""
        return self._part("reference")

    @cached_property
    def joint(self) -> Affine:
        """Joint displacements dq (n_q) [rad or m]."""
        return self._part("joint")

    @cached_property
    def displacement(self) -> Affine:
        """Object displacement du (6), sag included [m, rad]."""
        return self._part("displacement")

    @cached_property
    def motion(self) -> Affine:
        """Object displacement (6) that the references make, sag excluded [m, rad]."""
        return self._part("motion")

    @cached_property
    def rigid(self) -> Affine:
        """Its part in Gamma_ucs."""
        return self.motion.after(self.spaces.Gamma_ucs @ seen_of_motion(self))

    @cached_property
    def elastic(self) -> Affine:
        """The rest of it."""
        return self.motion.after(np.eye(6) - self.spaces.Gamma_ucs @ seen_of_motion(self))


def _sizes(formulation: Formulation) -> dict[str, int]:
    grasp = formulation.response.grasp
    return {
        "force": grasp.n_l, "torque": grasp.n_q, "effort": grasp.n_z, "reference": grasp.n_z, "joint": grasp.n_q,
        "motion": 6, "displacement": 6,
    }  # fmt: skip


def seen_of_motion(formulation: Formulation) -> Array:
    """Return Gamma_ucs^+ (dim, 6), in the scaled metric: what of a motion is beta."""
    metric = formulation.response.scale.motion
    return np.asarray((metric @ formulation.spaces.Gamma_ucs).T @ metric)


def quantities(formulation: Formulation) -> Affine:
    """Return all quantities of a formulation, in the order of the unknowns of the bare one."""
    moved = [formulation.elastic, formulation.rigid]
    motion = Affine(moved[0].matrix + moved[1].matrix, moved[0].constant + moved[1].constant)
    parts = [getattr(formulation, name) if name != "motion" else motion for name in _sizes(formulation)]
    return Affine(np.concatenate([part.matrix for part in parts]), np.hstack([part.constant for part in parts]))


@dataclass(frozen=True, eq=False, repr=False)
class Cone(Value):
    """One cone at some knots: its first row is no less than the norm of the others; of a single row, than 0."""

    limit: str
    item: str
    side: str
    first_knot: int
    terms: tuple[tuple[int, str, int, float], ...]
    """Row, quantity, its index, factor."""
    plus: Array
    """(K, rows) what is added at each of the knots."""
    earlier: tuple[tuple[int, Array], ...]
    """Lag, and (K,) how much the terms of that earlier knot count."""
    unit: float
    """By which its rows, and so the multipliers of the program, were multiplied the other way."""

    def document(self) -> dict[str, Any]:
        """Return it for a file; what is the same at all knots stands there once."""
        same = bool(np.all(self.plus == self.plus[0]))
        return {
            "limit": self.limit, "item": self.item, "side": self.side, "first_knot": self.first_knot,
            "knots": len(self.plus), "terms": [list(term) for term in self.terms],
            "plus": (self.plus[:1] if same else self.plus).tolist(),
            "earlier": [[lag, weights.tolist()] for lag, weights in self.earlier],
        }  # fmt: skip


def cones_of(part: Rows, formulation: BareFormulation) -> Iterator[Cone]:
    """Yield the cones of rows of the bare formulation; of equations two for each row, one for each side.

    Raises:
        ValueError: the rows are of a kind that no file holds.
    """
    if part.inside is not None or np.ndim(part.matrix) != 2 or np.any(part.epigraph):
        raise ValueError("rows of another kind")
    if any(not np.array_equal(each.matrix, part.matrix) for each in part.earlier):
        raise ValueError("rows that say other things of an earlier knot")
    for i, item in enumerate(part.items):
        rows = slice(i * part.dim, (i + 1) * part.dim)
        matrix, constant = part.matrix[rows], part.constant[:, rows]
        if part.kind is not Kind.ZERO:
            yield _cone(part, str(item.name), item.side, matrix, constant, formulation)
            continue
        for row in range(part.dim):
            for sign, side in ((1.0, "lowest"), (-1.0, "highest")):
                one = slice(row, row + 1)
                yield _cone(part, str(item.name), side, sign * matrix[one], sign * constant[:, one], formulation)


def _cone(part: Rows, item: str, side: str, matrix: Array, constant: Array, formulation: BareFormulation) -> Cone:
    size = float(np.abs(matrix[min(1, len(matrix) - 1)]).max(initial=0.0)) or 1.0
    places = [(name, i) for name, count in _sizes(formulation).items() for i in range(count)]
    terms = tuple(
        (int(row), *places[column], plain_number(matrix[row, column] / size)) for row, column in np.argwhere(matrix)
    )
    plus = np.vectorize(plain_number, otypes=[float])(constant / size)
    earlier = tuple((each.lag, each.weights) for each in part.earlier)
    first = formulation.knots - len(constant)
    return Cone(part.limit, item, side, first, terms, frozen(plus), earlier, size)


def plain_number(value: float) -> float:
    """Return a number without the last digits, where these are the rounding of a division."""
    short = float(f"{value:.{DIGITS}g}")
    return short if abs(short - value) <= ROUNDED * abs(value) else float(value)


def values_of(rows: Rows, v: Array) -> Array:
    """Return the values (K, rows) of rows at unknowns v (T, n_v)."""
    count = len(rows.constant)
    first = len(v) - count
    total = rows.constant + v[first:] @ rows.matrix.T
    for each in rows.earlier:
        total = total + each.weights[:, None] * (v[first - each.lag : first - each.lag + count] @ each.matrix.T)
    return np.asarray(total)


def is_of_quantities(rows: Sequence[Rows], bare: Sequence[Rows], known: Affine) -> bool:
    """Return whether the rows of a limit are those of the bare formulation: whether it looks at quantities alone."""
    if len(rows) != len(bare) or any(part.inside is not None for part in rows):
        return False
    T, n_v = len(known.constant), known.matrix.shape[1]
    v = np.random.default_rng(0).normal(size=(T, n_v))
    for one, other in zip(rows, bare, strict=True):
        if (one.kind, one.items, one.constant.shape) != (other.kind, other.items, other.constant.shape):
            return False
        found, wanted = values_of(one, v), values_of(other, known.at(v))
        if np.any(np.abs(found - wanted) > SAME * np.maximum(1.0, np.abs(found).max(axis=0, initial=0.0))):
            return False
    return True
