"""Random samples of a grasp on a hand: a plan is made with some, and judged by others that it has never seen.

That convex programs generalise says nothing of a hand that moves. So some samples are executed with the references of a
walk, and what they miss is asked for as more at the knots. Then samples of another part of the seed are executed: of N
of these as few miss a limit as the binomial distribution asks for, or nothing is promised. How many there are, and how
many of them may miss, is decided before any of them is drawn. Where more miss, the walk asks for more, and is judged by
others again: each look has its part of the doubt.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.allowed import Scenarios
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.setting import Setting
from synergrip.errors import SynergripError
from synergrip.linalg import frozen
from synergrip.log import LOG, LONG
from synergrip.planning.between import Between
from synergrip.planning.fresh_samples import FreshSamples
from synergrip.planning.in_cases import ALL_CASES
from synergrip.planning.kept_between import MoreAtKnots
from synergrip.planning.known_samples import Known, Number, first
from synergrip.planning.otherwise import Otherwise, walked_harder, worst_of_all
from synergrip.planning.outcome import Check
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.tasks.scenarios import MOST_FRESH
from synergrip.values import Value

NEAREST = 25
"""How many samples that a plan is made with are looked at again: those that came nearest to a limit."""
BEYOND = 1.0
"""How much more of slip margins than the worst sample misses is asked for, in standard deviations among samples."""
ROUNDS = 4
"""How often more is asked for by what samples miss that a plan is made with."""
LIKELY = 0.01
"""Share of samples that is taken to miss where nothing is known."""
SHORT = 2
"""Samples that are named with what they miss."""


@dataclass(frozen=True, eq=False, repr=False)
class Executed(Value):
    """One sample, executed."""

    number: Number
    missed: tuple[str, ...]
    """What it misses, in words."""
    usages: tuple[Usage, ...] | None = None
    """Of the limits; None where it does not reach its end."""

    @property
    def near(self) -> float:
        """How near it comes to a limit, or how far beyond it is."""
        return 0.0 if self.usages is None else max(usage.violation for usage in self.usages)


@dataclass(frozen=True, eq=False, repr=False)
class Judged(Value):
    """What became of samples, and a walk that asks for more where that is worth a try."""

    fresh: FreshSamples | None = None
    said: str = ""
    """Why nothing is promised; empty where something is, or where nothing was asked."""
    harder: tuple[Walk, Walker] | None = None

    @property
    def checks(self) -> tuple[Check, ...]:
        """That no larger share misses than may."""
        if self.fresh is None:
            return ()
        return (Check(f"{ALL_CASES}: share of scenarios", self.fresh.share, self.fresh.asked),)


def in_scenarios(walk: Walk, walker: Walker, formulation: Formulation, unseen: Known | None = None) -> Judged:
    """Return what becomes of random samples of a grasp with the references of a walk all of whose knots were reached.

    Args:
        walk: references and their execution, which hold as the grasp is stated.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
        unseen: that the walk is what it is: no samples to make it with, and one look at others.

    Raises:
        KeyboardInterrupt: somebody interrupted: nothing is promised then.
    """
    allowed = walker.task.allowed
    if allowed is None or allowed.scenarios is None:
        return Judged()
    samples = Samples(Otherwise.of(walk, walker, formulation, allowed), allowed.scenarios)
    known = unseen or walker.scenarios or first(allowed.scenarios.fresh())
    tried = samples.executed(known.numbers, "to make the plan with")
    missing = [each for each in tried if each.missed]
    if missing and (harder := _harder(samples, replace(known, rounds=known.rounds + 1), tried)):
        return Judged(harder=harder)
    if (sizes := samples.sizes(LIKELY if unseen else len(missing) / known.among)) is None:
        told = f"of {known.among} scenarios executed at the true equilibrium {len(missing)} miss a limit"
        told = f"{told}, and no plan was found that keeps more"
        return Judged(said=f"{told}: {_shortly(missing)}")
    fresh, tried = samples.fresh(known, *sizes)
    if not fresh.said or unseen or fresh.looks >= allowed.scenarios.looks:
        return Judged(fresh, fresh.said)
    known = replace(known, among=len(tried), rounds=0, looks=fresh.looks, made_with=known.made_with + len(tried))
    return Judged(fresh, fresh.said, _harder(samples, known, tried))


@dataclass(frozen=True, eq=False, repr=False)
class Samples(Value):
    """The references of a walk in random samples of its grasp."""

    there: Otherwise
    scenarios: Scenarios

    def executed(self, numbers: Sequence[Number], why: str) -> list[Executed]:
        """Return what becomes of some samples, and why they are looked at for who interrupts."""
        LONG.info("executing %d scenarios %s", len(numbers), why)
        found = list[Executed]()
        try:
            found.extend(self._executed(number) for number in numbers)
        except KeyboardInterrupt:
            told = f"after {len(found)} of {len(numbers)} scenarios {why}; nothing is known of their share yet"
            raise KeyboardInterrupt(told) from None
        return found

    def sizes(self, missing: float) -> tuple[int, int] | None:
        """Return how many fresh samples are looked at, and how many of them may miss, so that a plan is likely to pass.

        Args:
            missing: share of samples that misses, as far as is known.
        """
        allowed = 0
        while (count := self.scenarios.fresh(allowed)) <= MOST_FRESH:
            if allowed >= missing * count:
                return count, allowed
            allowed += 1
        return None

    def fresh(self, known: Known, count: int, allowed: int) -> tuple[FreshSamples, list[Executed]]:
        """Return what becomes of samples that nobody has looked at, and these."""
        part = known.looks + 1
        tried = self.executed([(part, number) for number in range(count)], "to judge the plan by")
        missing = [each for each in tried if each.missed]
        share = self.scenarios.share_at_most(len(missing), count)
        found = FreshSamples(
            count, len(missing), allowed, share, self.scenarios.share, part, len(self.there.looks.times),
            known.made_with, _shortly(missing),
        )  # fmt: skip
        LOG.info("%d of %d fresh scenarios miss a limit", len(missing), count)
        return found, tried

    def _executed(self, number: Number) -> Executed:
        there = self.there
        try:
            own: Setting = self.scenarios.on_hand(there.walker.start.grasp, *number)
        except SynergripError as error:
            return Executed(number, (str(error),))
        executed = there.run(there.looks, there.begun, own, roughly=True)
        if not executed.whole:
            return Executed(number, (executed.why,))
        motion, states = there.moved(there.looks, executed)
        usages = there.usages(states, motion)
        return Executed(number, tuple(there.missed(executed, usages)), usages)


def _harder(samples: Samples, known: Known, tried: Sequence[Executed]) -> tuple[Walk, Walker] | None:
    """Return a walk that asks for more by what samples miss, and its walker; None when no such one helps.

    Beyond the worst sample it asks for what others may be worse; where that is in vain, for the worst sample alone.

    Args:
        samples: of the walk so far.
        known: of them.
        tried: those that were executed now.
    """
    walker, usages = samples.there.walker, [each.usages for each in tried if each.usages is not None]
    if known.rounds > ROUNDS or not usages:
        return None
    nearest = [each.number for each in sorted(tried, key=lambda each: -each.near)[:NEAREST]]
    before = () if set(nearest) <= set(known.numbers) else known.numbers[:NEAREST]
    known = replace(known, numbers=(*nearest, *before))
    margins, *others = worst_of_all(usages)
    spread = np.std([usage.value for usage, *_ in usages], axis=0)
    for beyond in (BEYOND, 0.0):
        worst = (replace(margins, value=frozen(margins.value - beyond * spread)), *others)
        more = _more(samples, worst)
        if more is None:
            return None
        if found := walked_harder(samples.there.walk, replace(walker, more=more, scenarios=known)):
            return found
    return None


def _more(samples: Samples, worst: tuple[Usage, ...]) -> MoreAtKnots | None:
    """Return what is asked for at the knots by what the worst of samples use of the limits; None where that is vain."""
    walker, rooms = samples.there.walker, samples.there.rooms(worst)
    more = walker.more or MoreAtKnots.none(walker.task, walker.start.grasp.n_c)
    missing = Between(0, 0.0, 0.0, 0.0, worst, (), rooms)
    still = replace(more, rounds=0).for_what_is_missing(missing, walker.task, samples.there.limits)
    in_vain = still is None or (isinstance(walker.task.goal, LargestMargin) and still.shares == more.shares)
    return None if still is None or in_vain else replace(still, rounds=more.rounds)


def _shortly(missing: Sequence[Executed]) -> str:
    """Return what some samples miss, each by its part of the seed and its place in it."""
    told = [f"scenario {part}.{number}: {each.missed[0]}" for each in missing[:SHORT] for part, number in [each.number]]
    more = [f"and {len(missing) - SHORT} more"] if len(missing) > SHORT else []
    return "; ".join([*told, *more])
