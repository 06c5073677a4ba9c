"""Goals one after the other: each chooses among the plans that are best by those before it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.decide import Decision
from synergrip.conic.goals.after import After, Held
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.limits.limit import Limit
from synergrip.conic.situation import Situation
from synergrip.linalg import Array, split
from synergrip.plans.question import Question
from synergrip.plans.solvers import Answerer, ask

SLACKS = (1e-8, 1e-7)
"""How much of a best value, in force units, the next goal may give up, so that its program has an interior."""
LOOSE = 1e-7
"""How much limits are loosened, relatively, once earlier goals have fixed a part of the plan: a limit that the fixed
part touches has no room for rounding."""


@dataclass(frozen=True)
class Stage:
    """What the goals so far have led to."""

    situation: Situation
    limits: tuple[Limit, ...]
    """What every later goal keeps."""
    goal: Goal
    """The goal of the last decision that verified."""
    decisions: tuple[Decision, ...]
    held: tuple[Held, ...] = ()
    notes: tuple[str, ...] = ()
    interrupted: bool = False
    """Whether somebody stopped it before the goals were through."""

    @property
    def v(self) -> Array:
        """(T, n_v) unknowns of the last decision."""
        return self.decisions[-1].program.unknowns(self.decisions[-1].solution.x)

    @property
    def scalar(self) -> float:
        """The last goal's scalar [N]."""
        return float(self.decisions[-1].solution.x[-1]) * self.situation.force_unit

    @property
    def open_beyond_forces(self) -> bool:
        """Whether anything but the internal force is an unknown."""
        return self.situation.n_v > self.situation.n_alpha


def after(stage: Stage, goal: Goal, solver: Answerer) -> Stage:
    """Return the stage of the best plans by `goal`; with a note, and else as before, when none verifies.

    An interrupt keeps what the goals before have led to, and no further goal is looked at.
    """
    if stage.interrupted:
        return stage
    held = stage.held
    if not isinstance(stage.goal, LargestMargin | LeastPeak):
        held = (*held, *(Held(part, stage.v) for part in stage.goal.objective(stage.situation).squares))
    if held and _are_fixed(stage.situation.n_v, stage.situation, held):
        if isinstance(goal, LeastReconfiguration):
            return stage
        return replace(stage, notes=(*stage.notes, f"the goals before it leave nothing open for '{goal.name}'"))
    situation = stage.situation if held else _in_units_of_its_forces(stage)
    for limits in _limits(stage, held):
        chosen = After(goal, held) if held else goal
        try:
            decision = ask(Question(situation, limits, chosen), solver)
        except KeyboardInterrupt:
            note = f"interrupted while solving for '{goal.name}'; best by the goals before it"
            return replace(stage, notes=(*stage.notes, note), interrupted=True)
        if decision.optimal:
            decisions = (*stage.decisions, decision)
            return replace(stage, situation=situation, limits=limits, goal=goal, decisions=decisions, held=held)
    note = f"'{goal.name}' among the plans that are best by the goals before it was not verified; it is one of them"
    return replace(stage, notes=(*stage.notes, note))


def settled(stage: Stage, solver: Answerer) -> Stage:
    """Return the stage in which what the goals leave open is as small as it can be."""
    return after(stage, LeastReconfiguration(), solver) if stage.open_beyond_forces else stage


def _limits(stage: Stage, held: tuple[Held, ...]) -> Iterator[tuple[Limit, ...]]:
    """Yield the limits of the next goal, the tightest first."""
    if isinstance(stage.goal, LargestMargin | LeastPeak):
        for slack in SLACKS:
            yield (stage.goal.keeps(stage.scalar, slack * stage.situation.force_unit), *stage.limits)
        return
    fixed = _are_fixed(stage.situation.n_alpha, stage.situation, held)
    yield tuple(limit.loosened(LOOSE) for limit in stage.limits if not (fixed and limit.watches == "forces"))


def _are_fixed(count: int, situation: Situation, held: tuple[Held, ...]) -> bool:
    """Return whether what is held leaves none of the first `count` unknowns of a knot open, forces before others."""
    directions = np.hstack([part.determines for part in held])
    space = split(directions.T).row_space
    unknowns = np.eye(situation.n_v)[:count]
    return bool(np.abs(unknowns - unknowns @ space @ space.T).max(initial=0.0) < 1e-9)


def _in_units_of_its_forces(stage: Stage) -> Situation:
    """Return the situation in units of the forces found: the best plans squeeze hard, and tolerances are absolute."""
    situation = stage.situation
    forces = situation.force.at(stage.v)
    return situation.in_units_of(max(situation.force_unit, situation.response.scale.largest_force(forces)))
