"""The best k of a set of synergies: all subsets where they are few, else one by one and by exchange."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from math import comb

from synergrip.explain.synergies.subset_values import Looking, Tried
from synergrip.values import Value

Told = Callable[[int, int, int], None]
"""Hears how many synergies are being chosen, how many subsets were looked at, and of how many."""


@dataclass(frozen=True, eq=False, repr=False)
class Best(Value):
    """The best subset of a size that was found, and what is certain of the others."""

    tried: Tried
    every: bool
    """Whether all subsets of that size were looked at; else it was found by adding and exchanging one by one."""
    looked_at: int
    """How many of that size were."""
    with_plan: tuple[tuple[int, ...], ...]
    """Those with a plan, of those looked at."""
    refuted: int
    """How many of them are verified to have none."""

    @property
    def none_has_a_plan(self) -> bool:
        """Whether it is certain that no subset of that size has one."""
        return self.every and self.refuted == self.looked_at


@dataclass
class Search:
    """What was looked at so far; each subset is looked at once."""

    looking: Looking
    most: int
    """Subsets of a size up to which all are looked at."""
    told: Told
    known: dict[tuple[int, ...], Tried] = field(default_factory=dict)

    def at(self, picks: Iterable[int]) -> Tried:
        """Return what a subset comes to."""
        places = tuple(sorted(picks))
        if places not in self.known:
            self.known[places] = self.looking.at(places)
        return self.known[places]

    def best(self, size: int, smaller: Tried | None) -> Best:
        """Return the best subset of a size.

        Args:
            size: how many synergies.
            smaller: the best of one synergy less, to which one is added where not all subsets are looked at.
        """
        n = self.looking.grasp.n_z
        every = comb(n, size) <= self.most
        best = self._of_all(size) if every else self._step_by_step(size, smaller)
        own = [tried for picks, tried in self.known.items() if len(picks) == size]
        with_plan = tuple(sorted(tried.picks for tried in own if tried.stage == ""))
        refuted = sum(tried.certain and tried.stage != "" for tried in own)
        return Best(best, every, len(own), with_plan, refuted)

    def _of_all(self, size: int) -> Tried:
        n = self.looking.grasp.n_z
        return self._best_of(combinations(range(n), size), size, comb(n, size))

    def _step_by_step(self, size: int, smaller: Tried | None) -> Tried:
        """Return the best that adding one to the best of one less, and then exchanging one by one, leads to."""
        n = self.looking.grasp.n_z
        begun = () if smaller is None else smaller.picks
        starts = [tuple(range(size)), *((*begun, i) for i in range(n) if i not in begun and len(begun) == size - 1)]
        best = self._best_of(starts, size, len(starts))
        while True:
            others = [tuple(set(best.picks) - {out} | {new}) for out in best.picks for new in _rest(best.picks, n)]
            better = self._best_of([best.picks, *others], size, len(others) + 1)
            if not better.beats(best):
                return best
            best = better

    def _best_of(self, subsets: Iterable[Sequence[int]], size: int, count: int) -> Tried:
        """Return the best of subsets; of those as good as it the first."""
        best: Tried | None = None
        for done, picks in enumerate(subsets, 1):
            tried = self.at(picks)
            best = tried if best is None or tried.beats(best) else best
            self.told(size, done, count)
        assert best is not None  # sizes are from 1 to n
        return best

    def reduced(self, best: Tried) -> Tried:
        """Return a subset with a plan from which none can be left out without losing it."""
        while len(best.picks) > 1:
            fewer = self._best_of(combinations(best.picks, len(best.picks) - 1), len(best.picks) - 1, len(best.picks))
            if fewer.stage != "":
                break
            best = fewer
        return best


def _rest(picks: Sequence[int], n: int) -> Iterator[int]:
    return (i for i in range(n) if i not in picks)
