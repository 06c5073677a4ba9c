"""What is asked for beyond the limits at the knots, so that they hold between them, where true forces bend."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.friction_cone import FrictionCone, friction_rows
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.rows import Rows
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import Between
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

MORE = 1.2
"""What is asked for at the knots for each newton of margin, or share of another limit, that is missing between them."""
ENOUGH = 0.5
"""Share of what a margin may miss and still counts as kept that what bends may be without more being asked for."""
ROUNDS, MOST_SHARE = 3, 0.5
"""How often this is done, and up to what share of limits other than the margin."""


@dataclass(frozen=True, eq=False, repr=False)
class MoreAtKnots(Value):
    """How much tighter limits are asked for at the knots than the task has them."""

    margin: Array  # (T, n_c) [N]
    shares: tuple[float, ...]
    """Of each limit but the friction cones."""
    rounds: int = 0
    """How often more was asked for than before."""

    @classmethod
    def none(cls, task: TimedTask, n_c: int) -> MoreAtKnots:
        """Return that limits are asked for as they are."""
        return cls(frozen(np.zeros((len(task.times), n_c))), (0.0,) * len(task.kept))

    def for_what_is_missing(
        self, between: Between, task: TimedTask, limits: Sequence[Limit] | None = None
    ) -> MoreAtKnots | None:
        """Return more than this, by what is missing between the knots; None where nothing is, or it is asked in vain.

        Args:
            between: what limits of the task use at the true states.
            task: whose knots they are.
            limits: which of its limits these are, friction cones first; those that speak of an instant when None.
        """
        rooms = between.rooms or (np.zeros(1),) * len(between.usages)
        short = [bool(np.any(usage.excess > room)) for usage, room in zip(between.usages, rooms, strict=True)]
        if not any(short):
            return None
        cones, *others = between.usages
        margin = self.margin + MORE * _beside(task.times, cones.times, cones.excess) * short[0]
        shares = np.array(self.shares)
        looked_at = task.of_instants if limits is None else limits
        places = [i for i, limit in enumerate(task.kept) if any(limit is each for each in looked_at)]
        for i, usage, over in zip(places, others, short[1:], strict=True):
            shares[i] += MORE * over * float((usage.excess / task.kept[i].whole(usage)).max(initial=0.0))
        if self.rounds == ROUNDS or shares.max(initial=0.0) > MOST_SHARE:
            return None
        return MoreAtKnots(frozen(margin), tuple(shares.tolist()), self.rounds + 1)

    def for_what_bends(self, executed: Execution, looks: Looks, room: float) -> MoreAtKnots:
        """Return more than this, by what margins near a plan will be less between the knots than straight lines say.

        Args:
            executed: references near those that are looked for, at the knots of the task.
            looks: instants that count, the knots among them.
            room: how far below what is asked a margin counts as kept [N].
        """
        straight = interpolated(looks.times, executed.times, executed.margins)
        bend = _beside(executed.times, looks.times, straight - margins_at(executed, looks))
        if bend.max(initial=0.0) <= ENOUGH * room:
            return self
        return replace(self, margin=frozen(self.margin + bend))

    def asked(self, limits: Sequence[Limit]) -> tuple[Limit, ...]:
        """Return the limits of a task, with or without its friction cones, as they are asked for at the knots."""
        cones = [limit for limit in limits if isinstance(limit, SlipMargin)]
        others = [limit for limit in limits if not isinstance(limit, SlipMargin)]
        return (
            *(_MarginAtKnots(limit.margin, at_knots=frozen(limit.margin + self.margin)) for limit in cones),
            *(each.loosened(-share) if share else each for each, share in zip(others, self.shares, strict=True)),
        )


@dataclass(frozen=True, eq=False)
class _MarginAtKnots(FrictionCone):
    """Friction cones with a margin of their own for each knot and contact, and the usage of the one that is asked."""

    at_knots: Array = field(kw_only=True)  # (T, n_c) [N]

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        return friction_rows(formulation, self.at_knots[: formulation.knots], 0.0, self.key)

    def loosened(self, share: float) -> _MarginAtKnots:
        return replace(self, at_knots=frozen(self.at_knots - share * np.abs(self.at_knots)))


def margins_at(executed: Execution, looks: Looks) -> Array:
    """Return the slip margins (M, n_c) that a hand has about at some instants (M) of an execution [N]."""
    there = executed.interpolated(looks.times, looks.wrench)
    return executed.setting.grasp.slip_margins(there.forces[-len(looks.times) :])


def _beside(knots: Array, times: Array, missing: Array) -> Array:
    """Return for each knot (T, m) how much at most is missing beside it, of what is missing at some times (M, m)."""
    missing, found = np.maximum(missing, 0.0), np.zeros((len(knots), missing.shape[1]))
    after = np.clip(np.searchsorted(knots, times, side="left"), 1, len(knots) - 1)  # t in (before, after]
    for beside in (after - 1, after):
        np.maximum.at(found, beside, missing)
    return found
