"""What a hand could be given beside its synergies: more of the same set, those of other sets, joints by themselves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice
from math import comb

import numpy as np
from numpy.typing import NDArray

from synergrip.explain.irreducible import irreducible
from synergrip.explain.synergies.lacking import Lack
from synergrip.grasps.grasp import Grasp
from synergrip.hands.hand import SynergySet
from synergrip.hands.synergies.matrix import JOINTS
from synergrip.linalg import Array, frozen
from synergrip.values import Value

MOST_SUBSETS = 20_000
"""Subsets of a set of columns that are looked at."""
AT_ONCE = 1000
Subset = tuple[int, ...]
"""Places of some of further columns."""


@dataclass(frozen=True, eq=False, repr=False)
class Further(Value):
    """Columns of one kind that are not among the synergies of a grasp."""

    set: str
    """Name of a synergy set, or "joints"."""
    names: tuple[str, ...]
    columns: Array
    """(n_q, m)"""
    ours: bool
    """Whether it is the rest of the set that the grasp's synergies are of."""


@dataclass(frozen=True, eq=False, repr=False)
class Subsets(Value):
    """Subsets of some columns that repair a lack, all of one size."""

    picks: tuple[Subset, ...]
    """Places of the columns of each; empty when not even all columns together do."""
    smallest: bool
    """Whether no smaller subset does; else there were too many to look at, and no column of it can be left out."""


def further_columns(grasp: Grasp, more: Sequence[SynergySet] = ()) -> tuple[Further, ...]:
    """Return what could be added to the synergies of a grasp, the rest of their own set first, joints last.

    Args:
        grasp: the grasp.
        more: synergy sets that its hand does not name, such as those of files.
    """
    sets = [*(() if grasp.held is None else grasp.held.hand.synergy_sets.values()), *more]
    found = [_rest(grasp, each) for each in sets if each.name != JOINTS and len(each.S) == grasp.n_q]
    joints = Further(JOINTS, grasp.joints, frozen(np.eye(grasp.n_q)), ours=False)
    moving = [i for i in range(grasp.n_q) if np.any(grasp.J[:, i])]
    joints = Further(JOINTS, tuple(joints.names[i] for i in moving), frozen(joints.columns[:, moving]), ours=False)
    return tuple(each for each in (*sorted(found, key=lambda each: not each.ours), joints) if each.names)


def _rest(grasp: Grasp, synergies: SynergySet) -> Further:
    """Return the columns of a set that the grasp has not; those that are 0 are of no use to anybody."""
    own = {column.tobytes() for column in np.asarray(grasp.S.T)}
    rest = [i for i, column in enumerate(synergies.S.T) if column.tobytes() not in own and np.any(column)]
    names = tuple(synergies.synergies[i] for i in rest)
    ours = len(rest) + grasp.n_z == len(synergies.synergies)
    return Further(synergies.name, names, frozen(synergies.S[:, rest]), ours)


def repairing(further: Further, lacks: Sequence[Lack]) -> Subsets:
    """Return the smallest subsets of some columns that repair all lacks.

    Args:
        further: the columns.
        lacks: what is lacking.
    """
    columns, m = further.columns, len(further.names)
    every = np.arange(m)
    if not _covering(columns, every[None], lacks)[0]:
        return Subsets((), smallest=True)
    looked_at = 0
    for size in range(max(sum(lack.count for lack in lacks), 1), m + 1):
        looked_at += comb(m, size)
        if looked_at > MOST_SUBSETS:
            break
        found = [tuple(pick.tolist()) for pick in _of_size(columns, size, lacks)]
        if found:
            return Subsets(tuple(found), smallest=True)
    return Subsets((_without_the_idle(columns, lacks),), smallest=False)


def _of_size(columns: Array, size: int, lacks: Sequence[Lack]) -> Iterator[NDArray[np.intp]]:
    """Yield the subsets of a size that repair all lacks."""
    every = combinations(range(columns.shape[1]), size)
    while some := list(islice(every, AT_ONCE)):
        picks = np.array(some, dtype=np.intp)
        yield from picks[_covering(columns, picks, lacks)]


def _covering(columns: Array, picks: NDArray[np.intp], lacks: Sequence[Lack]) -> NDArray[np.bool_]:
    """Return which of the subsets (N, size) repair all lacks."""
    parts = np.moveaxis(columns[:, picks], 0, 1)  # (N, n_q, size)
    covered = np.ones(len(picks), dtype=bool)
    for lack in lacks:
        covered &= lack.covered(parts)
    return covered


def _without_the_idle(columns: Array, lacks: Sequence[Lack]) -> Subset:
    """Return columns that repair all lacks, none of which can be left out."""

    def repair(picks: Sequence[int]) -> bool:
        return bool(picks) and bool(_covering(columns, np.array([picks], dtype=np.intp), lacks)[0])

    return irreducible(range(columns.shape[1]), repair)
