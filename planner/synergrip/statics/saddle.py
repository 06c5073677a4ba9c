"""The equilibrium of a grasp as one saddle-point system, and what its arithmetic may have lost.

``C lambda + G' u = J S z_r`` and ``G lambda = -w``, C the sum of the compliances of contacts, joints and synergies.
Of one grasp neither C nor ``G C^-1 G'`` is inverted by itself: where compliances differ by 1e9 they keep no digit of
the small ones. Of a stack they are, which is quick; `errors` tell where that was too much. And the system is only what
refines: what is left over is told from the grasp's own matrices, so that rounding of C costs nothing either.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any, Generic, TypeVar

import numpy as np

from synergrip.doubled import Doubled, block, solve
from synergrip.grasps.scale import Metric
from synergrip.grasps.stack import Matrices
from synergrip.linalg import Array, frozen
from synergrip.statics.factors import inverse_by_factors

N = TypeVar("N", Array, Doubled)
ROUNDOFF = 2.0**-53
"""Relative error of the maps when they are rounded to float64."""
APART = 2.0**26
"""How many times a half unit of the last digit float64 changes the data by, to tell what half a unit changes."""
CAUTION = 10.0
"""How much larger errors are taken to be than the last correction, and changes than one change of the data makes."""


@dataclass(frozen=True)
class Arithmetic(Generic[N]):
    """The numbers to reckon with."""

    number: Callable[[Array], N]
    rounded: Callable[[N], Array]
    block: Callable[[Sequence[Sequence[Any]]], N]
    inverse: Callable[[N, N], N]
    """Of ``[[C, G'], [G, 0]]``."""
    other: Callable[[Array], N]
    """Other numbers, `apart` times as far away as those that round to the same float64."""
    apart: float
    corrections: int = 2
    """How many times a solution is refined; the last time tells what it had lost."""


def _high(number: Doubled) -> Array:
    return number.high


@cache
def _half_units(shape: tuple[int, ...]) -> Array:
    """Return numbers between -1/2 and 1/2: any, but always the same ones, for every matrix of a stack too."""
    return frozen(np.random.default_rng(sum(shape)).uniform(-0.5, 0.5, shape))


def _between_the_digits(values: Array) -> Doubled:
    """Return numbers that `values` are the roundings of."""
    rest = _half_units(values.shape[-2:]) * np.spacing(np.abs(values))
    return Doubled(values, np.where(values == 0, 0.0, rest))


def other_numbers(values: Array) -> Array:
    """Return other numbers that are as much farther away as float64 needs to tell them."""
    return values * (1 + APART * 2.0**-53 * _half_units(values.shape[-2:]))


def _block(rows: Sequence[Sequence[Array]]) -> Array:
    """Return what `numpy.block` does, several times as fast."""
    joined = [np.concatenate(row, axis=-1) if len(row) > 1 else row[0] for row in rows]
    return np.concatenate(joined, axis=-2) if len(joined) > 1 else joined[0]


def _inverse(C: Array, G: Array) -> Array:
    both = _one_size(C, G)
    corner = np.zeros((*G.shape[:-1], G.shape[-2]))
    return np.asarray(np.linalg.inv(_block([[C, G.mT], [G, corner]]) * both) * both)


def _inverse_of_doubled(C: Doubled, G: Doubled) -> Doubled:
    both = _one_size(C.high, G.high)
    corner = Doubled.of(np.zeros((len(G.high), len(G.high))))
    return solve(block([[C, G.mT], [G, corner]]) * both, Doubled.of(np.eye(len(both)))) * both


def _one_size(C: Array, G: Array) -> Array:
    """Return the powers of two that bring the entries of ``[[C, G'], [G, 0]]`` to about one size."""
    forces = 1 / np.sqrt(np.abs(np.diagonal(C, axis1=-2, axis2=-1)))
    motions = 1 / (np.abs(G) * forces[..., None, :]).max(axis=-1)
    size = (2.0 ** np.round(np.log2(np.concatenate([forces, motions], axis=-1))))[..., None]
    return np.asarray(size * size.mT)


FLOAT64: Arithmetic[Array] = Arithmetic(np.asarray, np.asarray, _block, _inverse, other_numbers, APART)
STACKED: Arithmetic[Array] = replace(FLOAT64, inverse=inverse_by_factors)
"""Float64 for a stack of grasps, many times as fast; where compliances differ much its inverse keeps fewer digits."""
DOUBLED: Arithmetic[Doubled] = Arithmetic(Doubled.of, _high, block, _inverse_of_doubled, _between_the_digits, 1.0)


NAMES = ("lambda", "u", "tau", "sigma", "z", "q")
"""What answers, in the order of the rows of an `Answer`."""


@dataclass(frozen=True)
class Answer:
    """What answers to z_r (n_z columns), then to the wrench (6 columns): the rows of all `NAMES` (..., n, n_z + 6).

    SI units; wrenches and motions of the object are taken about the centroid of the contacts. Of one grasp, or of
    each of many (leading axes).
    """

    rows: Mapping[str, slice]
    """Where each name has its rows."""
    maps: Array
    errors: Array
    """Estimates of what the arithmetic has lost in each entry."""
    changes: Array
    """Estimates of what changes with the digits that the data do not have."""
    matrices: Matrices
    """Of the grasp, or grasps."""
    inverse: Array
    """Of the system."""

    def terms(self, of: Any) -> Array:
        """Return sizes (..., n, n_z + 6) of the terms that each entry is the sum of, of some grasps of the stack."""
        J, S = np.abs(self.matrices.J[of]), np.abs(self.matrices.S[of])
        inverse, n_z = np.abs(self.inverse[of]), S.shape[-1]
        less = (-np.abs(self.matrices.C_q[of]), -np.abs(self.matrices.C_z[of]))
        added = _System(self.matrices.G[of], J, S, self.matrices.C_s[of], *less, FLOAT64)
        answers = _block([[inverse[..., :-6] @ (J @ S), inverse[..., -6:]]])
        result: Array = added.followed(answers, np.eye(n_z, n_z + 6))
        for name in ("z", "q"):  # synergies and joints answer to references always, however little: no 0 here
            result[..., self.rows[name], :n_z] = np.abs(self.maps[of][..., self.rows[name], :n_z])
        return result


def answer(matrices: Matrices, metric: Metric, arithmetic: Arithmetic[N]) -> Answer:
    """Solve the equilibrium of a grasp, or of each of many (leading axes; in float64 only).

    Raises:
        numpy.linalg.LinAlgError: the system is singular, as far as the arithmetic can tell.
    """
    number, rounded, n_l, n_z = arithmetic.number, arithmetic.rounded, matrices.G.shape[-1], matrices.S.shape[-1]
    system, turned = _System.of(matrices, arithmetic, number), number(about_centroid(metric))
    JS = system.J @ system.S
    C: N = system.J @ (system.C_q + system.S @ system.C_z @ system.S.mT) @ system.J.mT
    C += system.C_s
    inverse = arithmetic.inverse(C, turned @ system.G)
    still, load = number(np.eye(n_z, n_z + 6)), number(np.eye(6, n_z + 6, n_z))

    def left_over(system: _System[N], solution: N) -> N:
        gap, balanced = system.left_over(solution[..., :n_l, :], turned.mT @ solution[..., n_l:, :], still)
        return arithmetic.block([[gap], [turned @ balanced - load]])

    solution = arithmetic.block([[inverse[..., :n_l] @ JS, -inverse[..., n_l:]]])
    for _ in range(arithmetic.corrections - 1):
        solution += inverse @ left_over(system, solution)
    others = _System.of(matrices, arithmetic, arithmetic.other)
    both = inverse @ arithmetic.block([[left_over(system, solution), left_over(others, solution)]])
    last, of_others = both[..., : n_z + 6], both[..., n_z + 6 :]
    other = others.followed(solution + of_others, still)
    solution += last
    maps = system.followed(solution, still)
    values, lost = rounded(maps), rounded(system.followed(last, number(np.zeros((n_z, n_z + 6)))))
    other -= maps
    changes = _to_sizes(rounded(other), CAUTION / arithmetic.apart)
    errors = _to_sizes(lost, CAUTION)
    errors += ROUNDOFF * np.abs(values)
    if arithmetic.apart > 1:  # float64: what is left over is rounded as the data are, even where it looks like 0
        changes = errors = np.maximum(changes, errors, out=errors)
    return Answer(_rows(matrices), values, errors, changes, matrices, rounded(inverse))


def _to_sizes(values: Array, times: float) -> Array:
    """Turn entries into their sizes, `times` as large: new arrays of a whole stack cost more than the arithmetic."""
    np.abs(values, out=values)
    values *= times
    return values


def _rows(matrices: Matrices) -> dict[str, slice]:
    n_l, n_q, n_z = matrices.G.shape[-1], *matrices.S.shape[-2:]
    ends = np.cumsum([n_l, 6, n_q, n_z, n_z, n_q]).tolist()
    return {name: slice(start, end) for name, start, end in zip(NAMES, [0, *ends], ends, strict=False)}


def about_centroid(metric: Metric) -> Array:
    """Return T (..., 6, 6): ``T w`` is the wrench about the centroid of the contacts, ``T' u`` its motion about B."""
    T = np.zeros_like(metric.motion)
    T[..., range(6), range(6)] = 1.0
    T[..., 3:, :3] = metric.motion[..., :3, 3:]
    return T


@dataclass(frozen=True)
class _System(Generic[N]):
    """The matrices of a grasp in some arithmetic."""

    G: N
    J: N
    S: N
    C_s: N
    C_q: N
    C_z: N
    arithmetic: Arithmetic[N]

    @classmethod
    def of(cls, matrices: Matrices, arithmetic: Arithmetic[N], data: Callable[[Array], N]) -> _System[N]:
        return cls(
            **{field.name: data(getattr(matrices, field.name)) for field in fields(matrices)}, arithmetic=arithmetic
        )

    def followed(self, solution: N, still: N) -> N:
        """Return the rows of all that follows from forces and motions; `still` is z of synergies that do not yield."""
        tau = self.J.mT @ solution[..., :-6, :]
        sigma = self.S.mT @ tau
        z = still - self.C_z @ sigma
        return self.arithmetic.block([[solution], [tau], [sigma], [z], [self.S @ z - self.C_q @ tau]])

    def left_over(self, force: N, u: N, still: N) -> tuple[N, N]:
        """Return by what contact motions (10) do not fit, and the wrench (7) that is balanced; about B."""
        tau = self.J.mT @ force
        q = self.S @ (still - self.C_z @ (self.S.mT @ tau)) - self.C_q @ tau
        return self.J @ q - self.C_s @ force - self.G.mT @ u, -(self.G @ force)
