"""The equilibrium of a grasp as one saddle-point system, and what its arithmetic may have lost.

``C lambda + G' u = J S z_r`` and ``G lambda = -w``, C the sum of the compliances of contacts, joints and synergies.
Neither C nor ``G C^-1 G'`` is inverted by itself: where compliances differ by 1e9 they keep no digit of the small
ones. And the system is only what refines: what is left over is told from the grasp's own matrices, so that rounding
of C costs nothing either.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Generic, TypeVar

import numpy as np

from synergrip.doubled import Doubled, block, solve
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale
from synergrip.linalg import Array, frozen

N = TypeVar("N", Array, Doubled)
ROUNDOFF = 2.0**-53
"""Relative error of the maps when they are rounded to float64."""
APART = 2.0**26
"""How many times a half unit of the last digit float64 changes the data by, to tell what half a unit changes."""
CORRECTIONS = 4
"""The first is the solution, the others refine it."""
CAUTION = 10.0
"""How much larger errors are taken to be than the last correction, and changes than one change of the data makes."""


@dataclass(frozen=True)
class Arithmetic(Generic[N]):
    """The numbers to reckon with."""

    number: Callable[[Array], N]
    rounded: Callable[[N], Array]
    block: Callable[[Sequence[Sequence[Any]]], N]
    solve: Callable[[N, N], N]
    """X of ``A X = B``."""
    other: Callable[[Array], N]
    """Other numbers, `apart` times as far away as those that round to the same float64."""
    apart: float


def _high(number: Doubled) -> Array:
    return number.high


@cache
def _half_units(shape: tuple[int, ...]) -> Array:
    """Return numbers between -1/2 and 1/2: any, but always the same ones."""
    return frozen(np.random.default_rng(sum(shape)).uniform(-0.5, 0.5, shape))


def _between_the_digits(values: Array) -> Doubled:
    """Return numbers that `values` are the roundings of."""
    rest = _half_units(values.shape) * np.spacing(np.abs(values))
    return Doubled(values, np.where(values == 0, 0.0, rest))


def _apart(values: Array) -> Array:
    """Return other numbers that are as much farther away as float64 needs to tell them."""
    return values * (1 + APART * 2.0**-53 * _half_units(values.shape))


def _solve(A: Array, B: Array) -> Array:
    return np.asarray(np.linalg.solve(A, B))


def _block(rows: Sequence[Sequence[Array]]) -> Array:
    """Return what `numpy.block` does, several times as fast."""
    return np.concatenate([np.concatenate(row, axis=1) for row in rows])


FLOAT64: Arithmetic[Array] = Arithmetic(np.asarray, np.asarray, _block, _solve, _apart, APART)
DOUBLED: Arithmetic[Doubled] = Arithmetic(Doubled.of, _high, block, solve, _between_the_digits, 1.0)


@dataclass(frozen=True)
class Answer:
    """What answers to z_r (n_z columns), then to the wrench (6 columns): "lambda", "u", "tau", "sigma", "z", "q".

    SI units; wrenches and motions of the object are taken about the centroid of the contacts.
    """

    maps: Mapping[str, Array]
    errors: Mapping[str, Array]
    """Estimates of what the arithmetic has lost in each entry."""
    changes: Mapping[str, Array]
    """Estimates of what changes with the digits that the data do not have."""
    terms: Mapping[str, Array]
    """Sizes of the terms that each entry is the sum of."""


def answer(grasp: Grasp, scale: Scale, arithmetic: Arithmetic[N]) -> Answer:
    """Solve the equilibrium of a grasp.

    Raises:
        numpy.linalg.LinAlgError: the system is singular, as far as the arithmetic can tell.
    """
    number, rounded, n_l, n_z = arithmetic.number, arithmetic.rounded, grasp.n_l, grasp.n_z
    matrices, turned = _Matrices.of(grasp, number), number(about_centroid(scale))
    inverse = _inverse(matrices, turned, arithmetic, n_l)
    still, load = number(np.eye(n_z, n_z + 6)), number(np.eye(6, n_z + 6, n_z))

    def correction(matrices: _Matrices[N], solution: N) -> N:
        gap, balanced = matrices.left_over(solution[:n_l], turned.T @ solution[n_l:], still)
        return inverse @ arithmetic.block([[gap], [turned @ balanced - load]])

    solution = number(np.zeros((n_l + 6, n_z + 6)))
    for _ in range(CORRECTIONS):
        last = correction(matrices, solution)
        solution = solution + last
    maps = matrices.followed(solution, still)
    values = {name: rounded(each) for name, each in maps.items()}
    lost = matrices.followed(last, number(np.zeros((n_z, n_z + 6))))
    others = _Matrices.of(grasp, arithmetic.other)
    other = others.followed(solution + correction(others, solution), still)
    changes = {name: CAUTION / arithmetic.apart * np.abs(rounded(other[name] - maps[name])) for name in maps}
    errors = {name: CAUTION * np.abs(rounded(lost[name])) + ROUNDOFF * np.abs(values[name]) for name in maps}
    if arithmetic.apart > 1:  # float64: what is left over is rounded as the data are, even where it looks like 0
        changes = errors = {name: np.maximum(changes[name], errors[name]) for name in maps}
    return Answer(values, errors, changes, _terms(grasp, np.abs(rounded(inverse)), values))


def _terms(grasp: Grasp, inverse: Array, values: Mapping[str, Array]) -> dict[str, Array]:
    """Return the sizes of the terms of every map; `inverse` is that of the system, entry by entry its size."""
    sizes, n_z = _Matrices.of(grasp, np.abs), grasp.n_z
    still = np.eye(n_z, n_z + 6)
    result = sizes.followed(inverse @ np.vstack([sizes.J @ sizes.S @ still, np.eye(6, n_z + 6, n_z)]), still)
    for name in ("z", "q"):  # synergies and joints answer to references always, however little: there is no 0 here
        result[name][:, :n_z] = np.abs(values[name][:, :n_z])
    return result


def about_centroid(scale: Scale) -> Array:
    """Return T (6, 6): ``T w`` is the wrench about the centroid of the contacts, ``T' u`` turns its motion into B's."""
    T = np.eye(6)
    T[3:, :3] = scale.motion[:3, 3:]
    return T


@dataclass(frozen=True)
class _Matrices(Generic[N]):
    """The matrices of a grasp in some arithmetic, compliances with the minus of the equations they stand in."""

    G: N
    J: N
    S: N
    C_s: N
    C_q: N
    C_z: N

    @classmethod
    def of(cls, grasp: Grasp, data: Callable[[Array], N]) -> _Matrices[N]:
        compliances = (data(-each) for each in (grasp.C_s, grasp.C_q, grasp.C_z))
        return cls(data(grasp.G), data(grasp.J), data(grasp.S), *compliances)

    def followed(self, solution: N, still: N) -> dict[str, N]:
        """Return all that follows from forces and motions; `still` is z of synergies that do not yield."""
        force, u = solution[:-6], solution[-6:]
        tau = self.J.T @ force
        sigma = self.S.T @ tau
        z = still + self.C_z @ sigma
        return {"lambda": force, "u": u, "tau": tau, "sigma": sigma, "z": z, "q": self.S @ z + self.C_q @ tau}

    def left_over(self, force: N, u: N, still: N) -> tuple[N, N]:
        """Return by what contact motions (10) do not fit, and the wrench (7) that is balanced; about B."""
        tau = self.J.T @ force
        q = self.S @ (still + self.C_z @ (self.S.T @ tau)) + self.C_q @ tau
        return self.J @ q + self.C_s @ force - self.G.T @ u, -(self.G @ force)


def _inverse(matrices: _Matrices[N], turned: N, arithmetic: Arithmetic[N], n_l: int) -> N:
    """Return the inverse of the system, whose rows and columns are brought to about one size first."""
    JS, G = matrices.J @ matrices.S, turned @ matrices.G
    C = -matrices.C_s - matrices.J @ matrices.C_q @ matrices.J.T - JS @ matrices.C_z @ JS.T
    A = arithmetic.block([[C, G.T], [G, arithmetic.number(np.zeros((6, 6)))]])
    sizes = np.abs(arithmetic.rounded(A))
    forces = 1 / np.sqrt(np.diag(sizes)[:n_l])
    motions = 1 / (sizes[n_l:, :n_l] * forces).max(axis=1)
    size = 2.0 ** np.round(np.log2(np.concatenate([forces, motions])))
    found: N = arithmetic.solve(A * np.outer(size, size), arithmetic.number(np.diag(size))) * size[:, None]
    return found
