"""What happens between the knots: loads and wishes that leave the straight line.

Some instants there are corners: lines of a table, starts, ends, peaks, and both sides of a jump. From one corner to the
next a load is a straight line, and then nothing else can happen, or a smooth curve, which is looked at here and there.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from synergrip.linalg import Array, frozen, interpolated
from synergrip.values import Value

if TYPE_CHECKING:
    from scipy import sparse

MOST_SAMPLES, LEAST_SAMPLES, SAMPLES_IN_ALL = 16, 4, 4_000
"""Instants looked at in each piece that is curved: fewer in a task of many pieces, which bend less."""


@dataclass(frozen=True, eq=False, repr=False)
class Looks(Value):
    """Load and wish at some instants."""

    times: Array  # (J,) [s]
    wrench: Array  # (J, 6) external wrench
    target: Array  # (J, 6) target displacement of the object

    def of(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Looks:
        """Return some of them."""
        return Looks(*(frozen(values[chosen]) for values in _arrays(self)))

    def and_then(self, others: Looks) -> Looks:
        """Return these, and others behind them."""
        return Looks(*(np.concatenate(pair) for pair in zip(_arrays(self), _arrays(others), strict=True)))


@dataclass(frozen=True, eq=False, repr=False)
class Intersample(Value):
    """Loads and wishes at and between the knots."""

    grid: Looks
    """(G,) The knots and the corners between them, in order; a jump has an instant just before and one just after."""
    corner: NDArray[np.bool_]  # (G,) which of them are corners
    pieces: NDArray[np.intp]
    """(P,) which pieces of the grid are curved: piece i goes from instant i to instant i + 1."""
    samples: int
    """Evenly spaced instants looked at in each of these."""
    curved: Looks  # (P * samples,) there

    @classmethod
    def of_knots(cls, knots: Looks) -> Intersample:
        """Return that there is nothing but the knots, with straight lines between them."""
        nothing = np.zeros(0, dtype=np.intp)
        return cls(knots, np.zeros(len(knots.times), dtype=bool), nothing, samples_for(0), knots.of(nothing))

    @property
    def exact(self) -> bool:
        """True when all is straight from one instant of the grid to the next, so that they say everything."""
        return not len(self.pieces)

    @property
    def corners(self) -> Looks:
        """The corners (C,) between the knots."""
        return self.grid.of(self.corner)

    @property
    def only_knots(self) -> bool:
        """True when there is nothing to look at but the knots."""
        return self.exact and not self.corner.any()

    @cached_property
    def all(self) -> Looks:
        """Every instant that is looked at, the knots too, in order."""
        return self.every().grid

    @property
    def chords(self) -> Looks:
        """The instants (P * samples,) in the curved pieces, as if these were straight."""
        share = np.tile(shares(self.samples), len(self.pieces))[:, None]
        first = np.repeat(self.pieces, self.samples)
        wrench, target = (
            values[first] * (1 - share) + values[first + 1] * share for values in (self.grid.wrench, self.grid.target)
        )
        return Looks(self.curved.times, frozen(wrench), frozen(target))

    @property
    def allowance(self) -> float:
        """Factor by which a curve that is a parabola in each piece exceeds its samples there at most."""
        return 1.0 + 8.0 / self.samples**2

    def needed(self, values: Array) -> Array:
        """Return for every instant of the grid (G, ...) the most that values >= 0 can be in the two pieces beside it.

        Args:
            values: (P * samples, ...) in the curved pieces; they are 0 in the others and on the grid.
        """
        if self.exact:
            return np.zeros((len(self.corner), *values.shape[1:]))
        of_piece = np.zeros((len(self.corner) - 1, *values.shape[1:]))
        sampled = values.reshape(len(self.pieces), self.samples, *values.shape[1:])
        of_piece[self.pieces] = self.allowance * sampled.max(axis=1, initial=0.0)
        end = np.zeros((1, *values.shape[1:]))
        return np.asarray(np.maximum(np.concatenate([end, of_piece]), np.concatenate([of_piece, end])))

    def every(self) -> Intersample:
        """Return the same instants, all of them in the grid: what happens at them is asked, and nothing between."""
        if self.exact:
            return self
        whole = self.grid.and_then(self.curved)
        order = np.argsort(whole.times, kind="stable")
        corner = np.concatenate([self.corner, np.ones(len(self.curved.times), dtype=bool)])[order]
        nothing = np.zeros(0, dtype=np.intp)
        return Intersample(whole.of(order), corner, nothing, 0, whole.of(nothing))

    def at_corners(self) -> Intersample:
        """Return the knots and the corners alone: nothing is asked of what is curved between them."""
        nothing = np.zeros(0, dtype=np.intp)
        return Intersample(self.grid, self.corner, nothing, 0, self.grid.of(nothing))

    def departures(self, times: Array, wrench: Array, target: Array) -> tuple[Array, Array]:
        """Return what `all` wrenches and wishes depart by from straight lines between their values at knots `times`."""
        looks = self.all
        if self.only_knots:
            return np.zeros_like(wrench), np.zeros_like(target)
        return (
            looks.wrench - interpolated(looks.times, times, wrench),
            looks.target - interpolated(looks.times, times, target),
        )


def shares(samples: int) -> Array:
    """Return where in a piece (samples,) the evenly spaced instants lie, from 0 to 1, its ends left out."""
    return np.arange(1, samples + 1) / (samples + 1)


def samples_for(pieces: int) -> int:
    """Return how many instants are looked at in each of a number of curved pieces."""
    return int(np.clip(SAMPLES_IN_ALL // pieces, LEAST_SAMPLES, MOST_SAMPLES)) if pieces else 0


def knots_in(times: Array, knots: Array) -> sparse.csr_matrix:
    """Return the matrix (C, T) that makes values at instants (C,) of those at knots (T,), straight between them."""
    from scipy import sparse

    last = np.clip(np.searchsorted(knots, times, side="right"), 1, len(knots) - 1)
    share = np.clip((times - knots[last - 1]) / (knots[last] - knots[last - 1]), 0.0, 1.0)
    rows = np.arange(len(times))
    entries = np.concatenate([1 - share, share]), (np.tile(rows, 2), np.concatenate([last - 1, last]))
    found = sparse.csr_matrix(entries, shape=(len(times), len(knots)))
    found.eliminate_zeros()
    return found


def _arrays(looks: Looks) -> tuple[Array, Array, Array]:
    return looks.times, looks.wrench, looks.target
