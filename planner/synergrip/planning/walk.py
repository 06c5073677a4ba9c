"""Re-linearised planning: all knots at once, around the path that the references really take, until promises are true.

A pass takes the true states of the path so far, linearises the statics at every knot, asks the goals of the task again
around them, and executes what comes out. What a pass promises and what the hand then does differ by the square of the
step it took; a step that was too long is taken back and tried again shorter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from synergrip.conic.along import AlongPath, Path
from synergrip.conic.formulate import formulate
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.intersample import Intersample, Looks
from synergrip.conic.limits.limit import Limit
from synergrip.conic.question import Question
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.states import States
from synergrip.linalg import Array, frozen
from synergrip.log import LOG
from synergrip.planning.executing import Executor, analyses_of, sag_of
from synergrip.planning.hindrances import Hindrance
from synergrip.planning.instants import intersample_of
from synergrip.planning.kept_between import MoreAtKnots, margins_at
from synergrip.planning.known_samples import Known
from synergrip.planning.looks import looks_between, samples_of
from synergrip.planning.near_rows import left_out, near_rows
from synergrip.planning.pace import WHOLE, Effort, Pace
from synergrip.planning.short_step import ShortStep
from synergrip.planning.solvers import Answered, Answerer, ask
from synergrip.planning.stages import Stage, begun, through
from synergrip.planning.walk_so_far import FOLLOWED, Walk, differs, gap_to, what_came
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion
from synergrip.tasks.goals import unasked_goals
from synergrip.tasks.scaling import expected_and_stated
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import target_displacement
from synergrip.tasks.tracking_along import Steps, steps

STEP, DAMPING = 0.3, 2e-3
"""How far joints may move in one pass beyond what the way takes [rad, or m over the length]; `steps` has the other."""
NEAR_BY = 1e-3
"""[m] How near the object is where it may be brought nearer at as large a joint motion as one that is far: what is as
dear as joint motions goes with what is left of the way, so that this falls as its square."""
OF_PATH = 1e-3
"""Share of the largest force on a path that the unit of force in a program around it is at least."""
REACHED = 0.01
"""How far the rigid motion may be behind the wanted one without a tolerance, as a share of the length of the grasp."""


@dataclass(frozen=True, eq=False)
class Walker:
    """Who walks: a task on a hand, how its references are executed, and who answers."""

    task: TimedTask
    start: Analysis
    executor: Executor
    solver: Answerer
    more: MoreAtKnots | None = None
    """How much tighter limits are asked for at the knots than the task has them, so that they hold between them."""
    aim: Array | None = None
    """(T, 6) where the object is wanted instead of where the task says [m, rad]."""
    effort: Effort = WHOLE
    scenarios: Known | None = None
    """What is known of random samples of the grasp; None before any of them was executed."""
    leads: bool = False
    """Whether it only leads to where passes over more knots begin: these end sooner, and do the rest."""

    def kept_between(self, walk: Walk) -> Walk:
        """Return a walk whose margins hold between the knots, too; the same where they do, or none such is found."""
        if not self._holds_between:
            return walk
        if self.task.margin - margins_at(walk.executed, self.looks(walk)).min() <= walk.kept_to:
            return walk
        again = self.on(replace(walk, gap=np.inf))
        kept = self.arrived(again) or again.interrupted
        return again if kept else replace(walk, passes=again.passes, tried=again.tried)

    def near(self, walk: Walk) -> bool:
        """Return whether a walk is as far as wanted, and promise and truth are near each other."""
        return walk.behind <= self.allowed and walk.rough

    def arrived(self, walk: Walk) -> bool:
        """Tell whether a walk, be it of the first knots only, does what it promises, and is where it is wanted."""
        return self.good(walk) and walk.way is not None and float(walk.way.behind.max(initial=0.0)) <= self.allowed

    def good(self, walk: Walk) -> bool:
        """Return whether promise and truth are as near each other as is wanted."""
        return walk.close and not walk.left_out if self._ends_sooner else walk.true

    @property
    def _ends_sooner(self) -> bool:
        return self.leads or (self.effort.brief and not self.effort.strict)

    @property
    def allowed(self) -> float:
        """How far the rigid motion may be behind the wanted one [m]."""
        return self.task.tolerance or REACHED * self.start.response.scale.length

    def on(self, best: Walk, *, roughly: bool = False) -> Walk:
        """Return the walk that the passes end with, from another one; an interrupt keeps the best so far.

        Args:
            best: where they begin.
            roughly: whether they end where promise and truth are near each other, or with the first that is no better.
        """
        pace = best.pace if best.stage is None else best.pace.again
        for count in range(best.passes + 1, self.effort.until(best.passes) + 1):
            there = best.behind < FOLLOWED or pace.settled or (pace.stays and best.behind <= self.allowed)
            done = best.true and not best.left_out and there
            done = done or best.interrupted or (self._ends_sooner and self.arrived(best))
            done = done or (roughly and (pace.tries > 0 or self.near(best)))
            if best.way is None or done or pace.ends(best) or best.short >= self.effort.short:
                break
            try:
                answered, found = self._passed(best, pace)
            except KeyboardInterrupt:
                return replace(best, stopped=True)
            good = found is not None and found.better_than(best)
            LOG.info("pass %d, %s: %s", count, pace, what_came(found, good=good))
            tried = (*best.tried, answered.decision)
            met = best.hindered  # a shorter step is hindered by being short, too
            met = None if good else met or Hindrance.of(answered.decision, None if found is None else found.executed)
            now = found if good and found is not None else best
            pace = pace.on(best, found, self.allowed) if good and found is not None else pace.back(best, found)
            short = best.short + 1 if self._falls_short(answered, best) else 0
            best = replace(now, passes=count, tried=tried, hindered=met, pace=pace, short=short)
        return best

    def _passed(self, best: Walk, pace: Pace) -> tuple[Answered, Walk | None]:
        """Return what the first goal comes to around a path, and what all goals do, executed; None without an answer.

        Bounds that are far from binding on the path are asked for only where the answer then misses them.
        """
        limits, wait = self._limits(best, pace), not self.effort.brief and self._wait(best)
        entries = len(self.task.times) * sum(self.start.spaces.dimensions[::2]) * self.start.grasp.n_q
        near = limits if self.task.allowed else near_rows(limits, self.task.goals, entries)
        answered, stage = self._asked(best, pace, near, wait=wait)
        known = answered.decision.infeasible and (best.hindered is not None or best.lost)  # told of all limits, once
        unsure = not known if stage is None else left_out(near, stage)
        if unsure and near is not limits:
            answered, stage = self._asked(best, pace, limits, wait=wait)
        if stage is None:
            return answered, None
        references, promised = (part.at(stage.v) for part in (stage.formulation.reference, stage.formulation.force))
        found = self.executed(references, promised, best.executed, fewer=True)
        return answered, replace(found, stage=stage, left_out=wait)

    def _falls_short(self, answered: Answered, best: Walk) -> bool:
        """Return whether the largest margin around a walk is less than is asked, by more than counts as kept."""
        known = isinstance(answered.question.goal, LargestMargin) and answered.decision.optimal
        return known and answered.largest_margin < self.task.margin - best.kept_to

    def _wait(self, best: Walk) -> bool:
        """Return whether goals after the first wait until promises are near what happens."""
        return len(self.task.goals) > 1 and not best.rough and (best.stage is None or best.left_out)

    def _asked(self, walk: Walk, pace: Pace, limits: tuple[Limit, ...], *, wait: bool) -> tuple[Answered, Stage | None]:
        """Return what the first goal comes to around a path, and all that do not wait; None without an answer."""
        first, *others = self.task.goals
        assert walk.way is not None
        answered = ask(Question(self.around(walk.way, walk, pace), limits, first), self.solver)
        if not answered.decision.acceptable:
            return answered, None
        stage = begun(answered, limits, first)
        if wait:
            names = ", ".join(f"'{goal.name}'" for goal in others)
            left = f"along the motion there was no plan yet to ask {names} around"
            stage = replace(stage, notes=(*stage.notes, left))
        if self.effort.brief:  # that there is a plan is what is asked, and not which is best by all goals
            return answered, stage
        return answered, through(stage, () if wait else others, unasked_goals(self.task), self.solver)

    def executed(
        self, references: Array, promised: Array | None, near: Motion | States | Execution, *, fewer: bool = False
    ) -> Walk:
        """Return references (T, n_z) executed, beside the contact forces (T, n_l) [N] that were promised.

        None stand for no promise; `near` is not far from what comes; `fewer` digits do where promises do not hold.
        """
        wrong = partial(differs, promised) if fewer else None
        executed = self.executor.run(self.task.times, frozen(references), self.task.wrench, near, wrong)
        gap = gap_to(promised, executed.states.forces)
        if not executed.whole:
            return Walk(frozen(references), executed, gap, None)
        each = analyses_of(executed, self.start)
        return Walk(frozen(references), executed, gap, steps(each, self.start, self.task, executed.left(self.wanted)))

    def to_all_digits(self, walk: Walk) -> Walk:
        """Return a walk executed to all digits, where fewer did as long as promises did not hold."""
        if walk.true:
            return walk
        again = self.executed(walk.references, None, walk.executed)
        return walk if again.way is None else replace(walk, executed=again.executed, way=again.way)

    def _limits(self, walk: Walk, pace: Pace) -> tuple[Limit, ...]:
        """Return the limits that a pass around a path keeps.

        What bends is no longer asked for after a pass in vain, which may have been so because of it: what is missing
        between the knots in the end is asked for then.
        """
        limits = self.task.kept if isinstance(self.task.goal, LargestMargin) else self.task.all_limits
        more = self.more if pace.tries else self._more_at_knots(walk)
        return (*(limits if more is None else more.asked(limits)), ShortStep())

    def _more_at_knots(self, walk: Walk) -> MoreAtKnots | None:
        """Return how much more is asked for at the knots than the task does, for what true forces do between them."""
        if not (self._holds_between and walk.alike):
            return self.more
        more = self.more or MoreAtKnots.none(self.task, self.start.grasp.n_c)
        return more.for_what_bends(walk.executed, self.looks(walk), walk.kept_to)

    def looks(self, walk: Walk) -> Looks:
        """Return the instants at and between the knots at which limits count."""
        return looks_between(self.task, self.start, self.wanted, self._sampled, walk.kept_to)

    @property
    def samples(self) -> int:
        """How many evenly spaced instants are looked at in each piece between knots and corners, at least."""
        return samples_of(self.task.times if self._sampled is None else self._sampled.grid.times)

    @property
    def _holds_between(self) -> bool:
        """Whether a margin that is asked for is to hold between the knots, too."""
        task = self.task
        return task.between != "report" and len(task.times) > 1 and not isinstance(task.goal, LargestMargin)

    @cached_property
    def _sampled(self) -> Intersample | None:
        return intersample_of(self.task, self.start)

    @cached_property
    def wanted(self) -> Array:
        """(T, 6) where the object is wanted, from where it starts [m, rad]."""
        if self.aim is not None:
            return self.aim
        return frozen(target_displacement(self.start, self.task, self.task.target.values))

    def around(self, way: Steps, walk: Walk, pace: Pace) -> AlongPath:
        """Return the task around a path, with a rigid motion that follows what is wanted as far as is cheap."""
        task, start = self.task, self.start
        near = min(1.0, walk.behind / NEAR_BY) if pace.way == 1.0 else 1.0
        beta, moved = way.damped(DAMPING / pace.way * near)
        displacement = frozen(self.wanted - walk.executed.left(self.wanted))
        path = Path(
            walk.references, walk.executed.joint, displacement, frozen(displacement + way.beside),
            sag_of(way.each.response, task.wrench, start), frozen(STEP * pace.step + 1.5 * moved),
        )  # fmt: skip
        sizes, stated = expected_and_stated(start, task, np.zeros_like(beta), self.wanted, OF_PATH * walk.largest)
        formulation = formulate(
            start.response, start.spaces, start.coordinates, times=task.times, wrench=task.wrench, beta=beta,
            beta_basis=way.basis[:, :0] if self.effort.still else way.basis, target=self.wanted, units=sizes,
            redundancy=True, stated=stated, each=way.each,
        )  # fmt: skip
        return AlongPath.around_path(replace(formulation, allowed=task.allowed), path)
