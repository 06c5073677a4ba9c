"""Goals one after the other: each chooses among the plans that are best by those before it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.certificate import TIGHT
from synergrip.conic.decide import Decision
from synergrip.conic.formulation import Formulation
from synergrip.conic.free_basis import free_basis
from synergrip.conic.goals.goal import Goal, Squares
from synergrip.conic.goals.kept_scalar import KeptScalar
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.limit import Limit
from synergrip.conic.question import Question
from synergrip.linalg import Array
from synergrip.log import LOG
from synergrip.planning.solvers import Answered, Answerer, ask
from synergrip.tasks.unbounded import unbounded
from synergrip.values import Value

SLACKS = (1e-8, 1e-7)
"""How much of a margin, relative to the largest force, of a peak, relative to the load, or of another scalar, relative
to itself, the next goal may give up: its program needs an interior."""
SLACKS_ALONG = (1e-6,)
"""The same around a path, where promises are kept to less digits than that: the more room, the sooner it is solved."""
MOST = 1e-6
"""How much of them it may give up at most, relative to the load, however hard the best plans squeeze."""
NEXT_TO_NONE = 1e-4
"""Sum of squares, in units in which it is near 1 where it matters, below which nobody minds whether it is the least."""
LOOSE = 1e-7
"""How much limits are loosened, relatively, once earlier goals have fixed a part of the plan: a limit that the fixed
part touches has no room for rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class Stage(Value):
    """What the goals so far have led to."""

    formulation: Formulation
    """In the units in which the last decision was found."""
    limits: tuple[Limit, ...]
    """What every later goal keeps."""
    goal: Goal
    """The goal of the last decision that verified."""
    decisions: tuple[Decision, ...]
    notes: tuple[str, ...] = ()
    seen: tuple[Squares, ...] = ()
    """What the goals before the last one squared, and so fixed; the unknowns of a knot are the same in all of them."""
    interrupted: bool = False
    """Whether somebody stopped it before the goals were through."""

    @property
    def v(self) -> Array:
        """(T, n_v) unknowns of the last decision."""
        return self.decisions[-1].program.unknowns(self.decisions[-1].solution.x)

    @property
    def scalar(self) -> float:
        """The last goal's scalar [N]."""
        return float(self.decisions[-1].solution.x[-1]) * self.formulation.force_unit

    @property
    def largest_margin(self) -> float | None:
        """The largest margin [N], when that is the last goal; 0 when it is no more than the rounding of 0."""
        if not isinstance(self.goal, LargestMargin):
            return None
        return self.scalar if abs(self.scalar) > SLACKS[0] * self.formulation.force_unit else 0.0

    def falls_short_of(self, margin: float) -> bool:
        """Return whether the last goal is the largest margin and does not reach a margin [N]."""
        largest = self.largest_margin
        return largest is not None and largest < margin - SLACKS[0] * self.formulation.force_unit


def begun(answered: Answered, limits: tuple[Limit, ...], goal: Goal) -> Stage:
    """Return the stage of the first goal, with a note where it did not verify that no plan is better."""
    decision = answered.decision
    notes = () if decision.optimal else (not_the_best(decision, goal),)
    return Stage(answered.question.formulation, limits, goal, (decision,), notes)


def through(stage: Stage, goals: Sequence[Goal], unasked: Sequence[Goal], solver: Answerer) -> Stage:
    """Return the stage after further goals.

    Args:
        stage: after the first.
        goals: that are asked for.
        unasked: that settle what those leave open; of no interest where they leave nothing.
        solver: who answers.
    """
    for goal in goals:
        stage = after(stage, goal, solver)
    for goal in unasked:
        stage = after(stage, goal, solver, asked=False)
    return stage


def after(stage: Stage, goal: Goal, solver: Answerer, *, asked: bool = True) -> Stage:
    """Return the stage of the best plans by `goal`; with a note, and else as before, when none verifies.

    An interrupt keeps what the goals before have led to, and no further goal is looked at.

    Raises:
        InputError: nothing bounds the goal.
    """
    if stage.interrupted or (not asked and goal.objective(stage.formulation).empty):
        return stage
    formulation, seen = _reduced(stage)
    if not asked and goal.objective(formulation).empty:
        return stage
    if not formulation.unknowns:
        note = f"the goals before it leave nothing open for '{goal.name}'"
        return replace(stage, notes=(*stage.notes, note)) if asked else stage
    acceptable, tried = stage, list[Decision]()
    for limits in _limits(stage, formulation):
        try:
            answered = ask(Question(formulation, limits, goal, _violation(stage)), solver)
        except KeyboardInterrupt:
            note = f"interrupted while solving for '{goal.name}'; best by the goals before it"
            return replace(stage, notes=(*stage.notes, note), interrupted=True)
        answered = answered.with_all(*tried[-1:])
        decision = answered.decision
        tried.append(decision)
        LOG.info("then '%s': %s", goal.name, "optimal" if decision.optimal else decision.solution.status)
        if decision.unbounded:
            raise unbounded(goal)
        best = replace(
            stage, formulation=answered.question.formulation, limits=limits, goal=goal,
            decisions=(*stage.decisions, decision), seen=seen,
        )  # fmt: skip
        if decision.optimal:
            return best
        if decision.acceptable:
            acceptable = replace(best, notes=(*stage.notes, not_the_best(decision, goal)))
    if acceptable is not stage:
        last = acceptable.decisions[-1]
        told = replace(last, attempts=tried[-1].attempts, seconds=tried[-1].seconds)
        return replace(acceptable, decisions=(*stage.decisions, told))
    note = (
        f"'{goal.name}' among the plans that are best by the goals before it was not verified "
        f"({tried[-1].attempts} attempts); it is one of them"
    )
    return replace(stage, notes=(*stage.notes, note))


def not_the_best(decision: Decision, goal: Goal) -> str:
    """Return the note on a plan that holds, and of which it did not verify that it is the best."""
    value = abs(decision.program.objective(decision.solution.x))
    if goal.in_natural_units and not goal.has_scalar and value < NEXT_TO_NONE:
        return (
            f"what '{decision.goal}' makes small is next to nothing in this plan ({value:.0e}, where 1 would matter): "
            "whether another plan has even less of it is hidden by rounding"
        )
    apart = decision.certificate.gap * max(1.0, value)  # gaps are relative to the value, or to 1
    note = f"that no plan is better by '{decision.goal}' was not verified"
    return (
        f"{note}; by the solver's own bound none is by more than {apart / value:.0e} of it" if apart < value else note
    )


def _reduced(stage: Stage) -> tuple[Formulation, tuple[Squares, ...]]:
    """Return the formulation of the plans that are best by the last goal, and all squares that these agree in.

    The best by a sum of squares agree in everything that is squared, and so differ only in what it does not see.
    """
    formulation, goal = stage.formulation, stage.goal
    if goal.has_scalar:
        if formulation.unreduced is not None:
            return formulation, stage.seen
        return formulation.in_units(replace(formulation.units, force=_carried(stage))), stage.seen
    squares = goal.objective(formulation).squares
    if not squares:
        return formulation, stage.seen
    seen = (*stage.seen, *squares)
    return formulation.around(stage.v, free_basis(seen, formulation.knots, formulation.n_v)), seen


def _limits(stage: Stage, formulation: Formulation) -> Iterator[tuple[Limit, ...]]:
    """Yield the limits of the next goal, the tightest first."""
    if stage.goal.has_scalar:
        unit, most = _unit(stage), MOST * stage.formulation.load_size
        for share in dict.fromkeys(min(share, most / unit) for share in _slacks(stage)):
            yield (_kept(stage, share), *stage.limits)
        return
    fixed = not formulation.frees_alpha
    yield tuple(limit.loosened(LOOSE) for limit in stage.limits if not (fixed and limit.watches == "forces"))


def _kept(stage: Stage, share: float) -> Limit:
    """Return the limit that keeps the scalar of the last goal but for a share of what it is measured against."""
    goal, formulation = stage.goal, stage.formulation
    kept = goal.keeps(stage.scalar, share * _unit(stage))
    if kept is not None:
        return kept
    scalar = stage.scalar / formulation.force_unit
    worse = float(np.sign(goal.objective(formulation).epigraph or 0.0))
    return KeptScalar(goal, scalar + worse * share * max(1.0, abs(scalar)), formulation.units)


def _unit(stage: Stage) -> float:
    """Return what the scalar of the last goal is measured against [N]."""
    return _carried(stage) if isinstance(stage.goal, LargestMargin) else stage.formulation.force_unit


def _violation(stage: Stage) -> float:
    """Return the violation worth another attempt: less than what the next goal may give up of a margin or a peak."""
    return _slacks(stage)[0] if stage.goal.has_scalar else TIGHT


def _slacks(stage: Stage) -> tuple[float, ...]:
    return SLACKS_ALONG if stage.formulation.along_path else SLACKS


def _carried(stage: Stage) -> float:
    """Return the largest force of the plan found [N], or the force unit: the best plans may squeeze hard."""
    formulation = stage.formulation
    return max(formulation.force_unit, formulation.response.scale.largest_force(formulation.force.at(stage.v)))
