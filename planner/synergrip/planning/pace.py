"""How far a pass along the motion goes, by what became of the one before it, and how many are tried."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from synergrip.equilibrium.execution import Execution
    from synergrip.planning.walk_so_far import Walk

SHORTER, SHORTER_WAY, SHORTEST = 1 / 3, 1 / 9, 1e-3
"""By how much a step is shorter after one in vain, and a way that no program goes; the shortest of both."""
TRIES, VAIN = 2, 2
"""How often a true walk is tried to be brought nearer, and how often a first pass is tried: no way leads from where it
begins then, nor where no program goes it from a walk that is lost."""
AIMED, AFTER_GOOD, SHORTEST_CUT, LONGER = 0.5, 0.9, 0.05, 2.0
"""The difference that a step aims at, as a share of what is allowed, after one in vain and after a good one; the least
and the largest share of itself that a step is cut or made longer to."""
ROUND = 3.0
"""How much longer than the last one a step is where another round of passes begins."""
NEARER = 0.9
"""Factor by which a pass must bring the object nearer for another to be worth it."""


@dataclass(frozen=True)
class FirstPasses:
    """What was done at some of the knots before passes over all of them."""

    passes: int
    """How often the grasp was linearised anew there."""
    knots: int
    """How many knots they were at."""


@dataclass(frozen=True)
class Effort:
    """How much is tried along a motion before it is given up."""

    passes: int
    """At most: in each round of them, or in all."""
    rounds: bool
    """Whether there may be any number of rounds: a motion is followed a little farther at a time where passes over the
    whole of it do not do."""

    harder: int = 3
    """How often more is asked for at the knots than before, for what is missed between them."""
    short: float = np.inf
    """After how many passes in a row that find less than the margin that is asked it is given up."""
    brief: bool = False
    """Whether passes begin at the plan of least effort, whatever the goals, ask for the first of these alone, and end
    where another one or two would make true what is promised, if all limits hold there; no more is told of a walk in
    vain than that it is, and none is begun where the start posture says no."""
    strict: bool = False
    """Whether brief passes go on until what is promised is true."""
    still: bool = False
    """Whether passes leave the rigid motions that a task leaves free as they are on the path: forces hardly change with
    these, and for next to nothing a goal goes as far as a step may, pass after pass."""
    near: Execution | None = None
    """What the same hand went through for nearly the same task: passes begin there, and not at the plan of the start
    posture, where the hand is still in equilibrium at as many instants."""

    def until(self, passes: int) -> int:
        """Return the number of the last pass of a round that begins after some."""
        return passes + self.passes if self.rounds else self.passes


WHOLE, BRIEF = Effort(16, rounds=True), Effort(6, rounds=False, short=2)
SHORT = Effort(6, rounds=False, harder=1, short=2, brief=True)
"""What an answer is worth, what a change that is looked at beside others is, and one of those that go with a no."""


@dataclass(frozen=True)
class Pace:
    """How far the next pass goes."""

    step: float = 1.0
    """Share of the step that joints may make beyond what the way takes."""
    way: float = 1.0
    """How much dearer joint motions may be on the way that is left: a shorter one takes less of them."""
    tries: int = 0
    """Passes in vain since the last good one."""
    stays: bool = False
    """Whether the object would hardly be brought nearer any more."""

    def __str__(self) -> str:
        """Return the shares."""
        return f"step {self.step:.2g}, way {self.way:.2g}"

    @property
    def again(self) -> Pace:
        """For another round of passes, which asks for more: farther than the last one that was good, if not by much."""
        return Pace(min(1.0, ROUND * self.step))

    @property
    def settled(self) -> bool:
        """Whether nothing is to be gained for a walk that is true."""
        return self.tries == TRIES

    def ends(self, best: Walk) -> bool:
        """Return whether no further pass is worth it, from the best walk so far."""
        vain = best.stage is None and (self.tries == VAIN or (best.lost and self.way < 1))
        return min(self.step, self.way) < SHORTEST or vain

    def on(self, before: Walk, now: Walk, allowed: float) -> Pace:
        """Return the pace after a good pass.

        A way that was too long before it goes on being so, except where the object must still be brought nearer.

        Args:
            before: where the pass began.
            now: what it came to.
            allowed: how far the object may be behind [m].
        """
        longer = float(np.clip(_fitting(now, AFTER_GOOD), SHORTER, LONGER)) if self.step < 1 else 1.0
        stays = now.behind > NEARER * before.behind or self.way < 1
        way = LONGER * self.way if now.behind > allowed else self.way
        return Pace(min(1.0, longer * self.step), min(1.0, way), 0, stays)

    def back(self, before: Walk, found: Walk | None) -> Pace:
        """Return the pace after a pass in vain.

        Where no program goes it and nothing of the way is left, it is the step in which what is asked cannot be had:
        the next one is longer.

        Args:
            before: where the pass began.
            found: what it came to, or None when no program goes it.
        """
        again = replace(self, tries=self.tries + 1, stays=False)
        if found is None and before.there and self.step < 1:
            return replace(again, step=min(1.0, ROUND * self.step))
        if found is None:
            return replace(again, way=self.way * SHORTER_WAY)
        shorter = SHORTER if found.way is None else float(np.clip(_fitting(found, AIMED), SHORTEST_CUT, SHORTER))
        way = self.way * (SHORTER_WAY if self.tries else 1.0)  # where a shorter step did not do, the way is long
        return replace(again, step=self.step * shorter, way=way)


def _fitting(found: Walk, aimed: float) -> float:
    """Return the share of a step that would be as true as is aimed at: promise and truth differ by its square."""
    return float(np.sqrt(aimed * found.room / max(found.gap, 1e-300)))
