"""From a walk to an answer: a plan whose figures are those of the hand that moves, or what keeps it from being one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.along import AtStates
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import Between
from synergrip.planning.executing import Executor, analyses_of, motion_of, sag_of
from synergrip.planning.instants import intersample_of
from synergrip.planning.outcome import Check, Plan, Unknown
from synergrip.planning.reach import allowed, notes, reached_by
from synergrip.planning.solvers import Answerer
from synergrip.planning.verified import LIMIT, limit_usages
from synergrip.planning.walk import Walk, Walker
from synergrip.statics.motion import Motion
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import target_displacement
from synergrip.tasks.tracking_along import Steps, steps
from synergrip.values import Value

FORCE, OF_FORCES = 1e-3, 1e-3
"""A limit on forces is kept to this many newtons, or to this share of the largest force where that is more."""
LENGTH, ANGLE = 1e-5, 1e-4
"""[m], [rad] to which limits on motions are kept."""
MORE, MOST_RESERVE = 1.2, 1.0
"""What is asked for at the knots for each newton of margin that is missing between them, and up to what share of the
margin."""
BETWEEN = "between the knots"
BALANCED = 1e-8
"""Relative error of the equilibrium."""


@dataclass(frozen=True, eq=False, repr=False)
class Figures(Value):
    """What executed references are and use, at the knots of a task and between them."""

    motion: Motion
    usages: tuple[Usage, ...]
    elastic_motion: Array  # (T, 6)
    between: Between | None
    checks: tuple[Check, ...]


def along(plan: Plan, answers: Answerer) -> Plan | Unknown:
    """Return the answer around the true equilibria of the hand; a grasp given as matrices has none to speak of.

    Args:
        plan: for the start posture.
        answers: the solver.
    """
    if plan.grasp.held is None:
        return plan
    walker = Walker(plan.task, plan.analysis, Executor.of(plan.analysis, plan.task), answers)
    return answer_of(walker.walk(plan.motion), walker, plan)


def answer_of(walk: Walk, walker: Walker, linear: Plan) -> Plan | Unknown:
    """Return the plan that a walk ended with, at its true states; unknown when it did not reach or hold.

    Args:
        walk: what the passes ended with.
        walker: who walked.
        linear: the plan for the start posture, where the walk began.
    """
    task, analysis, stage = walker.task, walker.start, walk.stage
    decisions = (*linear.decisions, *walk.tried)
    if walk.way is None or walk.behind > allowed(walker):
        reached = reached_by(walk, walker)
        return Unknown(task, analysis, reached.because, decisions, "reach", reached)
    if not walk.true:
        why = f"after {walk.passes} passes what is promised and what the hand does still differ by {walk.gap:.3g} N"
        return Unknown(task, analysis, why, decisions, "execution")
    found = figures(walk, walker, linear.formulation, linear.between)
    if short := _short_between(found, task):
        more = replace(walker, reserve=walker.reserve + MORE * short)
        if more.reserve <= MOST_RESERVE * max(task.margin, short):
            return answer_of(more.on(replace(walk, gap=np.inf)), more, linear)
    if said := _missed(found.checks):
        return Unknown(task, analysis, said, decisions, "execution")
    alpha, beta, gamma = analysis.coordinates.coordinates(walk.references)
    last = linear if stage is None else stage
    return replace(
        linear, motion=found.motion, alpha=frozen(alpha), beta=frozen(beta), gamma=frozen(gamma),
        margins=frozen(found.usages[0].value), usages=found.usages, checks=found.checks,
        decisions=linear.decisions if stage is None else (*linear.decisions, *stage.decisions),
        between=found.between, executed=walk.executed, passes=walk.passes, elastic_motion=found.elastic_motion,
        largest_margin=linear.largest_margin if stage is None else walk.largest_margin,
        notes=(*(() if stage is None else stage.notes), *notes(walk, walker)), interrupted=last.interrupted,
    )  # fmt: skip


def _short_between(found: Figures, task: TimedTask) -> float:
    """Return by how much a slip margin that is to hold between the knots falls short there [N]; 0 when it is kept."""
    if task.between != "hold" or found.between is None or found.between.rooms is None:
        return 0.0
    short = float(found.between.usages[0].excess.max(initial=0.0))
    return short if short > found.between.rooms[0] else 0.0


def _missed(checks: Sequence[Check]) -> str:
    """Return which checks fail, by how much, and what helps; nothing when none does."""
    failed = [check for check in checks if not check.passed]
    told = [check.name if np.isinf(check.error) else f"{check.name}, by {check.error:.3g}" for check in failed]
    advice = "; more knots straighten it" if all(BETWEEN in check.name for check in failed) else ""
    return f"at the true equilibrium limits are missed: {'; '.join(told)}{advice}" if failed else ""


def figures(walk: Walk, walker: Walker, formulation: Formulation, linear: Between | None) -> Figures:
    """Return the figures of a walk all of whose knots were reached.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
        linear: what load and wish do between the knots; None when no more is known.
    """
    task, executed, way = walker.task, walk.executed, walk.way
    motion, there = _moved(executed, Looks(task.times, task.wrench, walker.wanted), walker, formulation, way)
    usages, rooms = limit_usages(task, there, motion), _rooms(executed, walker)
    elastic = frozen(motion.du - motion.sag - there.rigid_motion(motion.dz_r))
    checks = (Check("equilibrium", executed.residual, BALANCED), stable(executed), *kept(usages, rooms))
    between, inside = _between(walk, walker, formulation, linear, rooms)
    checks = (*checks, *inside)
    return Figures(replace(motion, du=executed.du), usages, elastic, between, checks)


def _between(
    walk: Walk, walker: Walker, formulation: Formulation, linear: Between | None, rooms: Mapping[str, float]
) -> tuple[Between | None, tuple[Check, ...]]:
    """Return what the references really do between the knots, and the checks of that."""
    task = walker.task
    if len(task.times) < 2:
        return None, ()
    looks = _looks(walker)
    references = frozen(interpolated(looks.times, task.times, walk.references))
    executed = walker.executor.run(looks.times, references, looks.wrench, walk.executed.interpolated(looks.times))
    if not executed.whole:
        return None, (Check(f"{BETWEEN}: {executed.why}", np.inf, 0.0),)
    motion, there = _moved(executed, looks, walker, formulation)
    usages = tuple(limit.usage(there, motion) for limit in task.all_limits if not limit.couples_knots)
    found = replace(
        linear or Between(1, 0.0, 0.0, 0.0, usages), samples=1, usages=usages,
        rooms=tuple(_room(usage, rooms) for usage in usages),
    )  # fmt: skip
    holds = kept(usages, rooms, f"{BETWEEN}: ") if task.between == "hold" else ()
    return found, (stable(executed, f"{BETWEEN}: "), *holds)


def stable(executed: Execution, where: str = "") -> Check:
    """Return the check that the hand stays at its equilibria: in [N/m], how far the least stiffness is below 0."""
    return Check(f"{where}stability", max(-float(executed.stiffness.min()), 0.0), 0.0)


def kept(usages: Sequence[Usage], rooms: Mapping[str, float], where: str = "") -> tuple[Check, ...]:
    """Return a check for every limit, in its own unit, to the digits that a true state is promised to.

    Args:
        usages: of the limits.
        rooms: by unit, how far beyond a limit counts as kept.
        where: said before the title.
    """
    return tuple(
        Check(f"{where}{usage.title}", max(float(usage.excess.max(initial=0.0)), 0.0), _room(usage, rooms))
        for usage in usages
    )


def _rooms(executed: Execution, walker: Walker) -> dict[str, float]:
    force = max(FORCE, OF_FORCES * float(np.abs(executed.states.forces).max(initial=0.0)))
    return {"N": force, "N m": force * walker.start.response.scale.length, "m": LENGTH, "rad": ANGLE}


def _room(usage: Usage, rooms: Mapping[str, float]) -> float:
    return rooms.get(usage.unit) or LIMIT * float(np.max(usage.scale, initial=0.0))


def _looks(walker: Walker) -> Looks:
    """Return the instants that are looked at: knots, corners, and the middle of every piece between them."""
    task = walker.task
    sampled = intersample_of(task, walker.start)
    known = Looks(task.times, task.wrench, walker.wanted) if sampled is None else sampled.grid
    middles = frozen((known.times[:-1] + known.times[1:]) / 2)
    middles = middles[np.diff(known.times) > 0]
    wrench = None if task.course is None else task.course.load_at(middles)
    wrench = interpolated(middles, known.times, known.wrench) if wrench is None else wrench
    target = interpolated(middles, known.times, known.target)
    if task.course is not None:
        target = target_displacement(walker.start, task, task.course.target_at(middles))
    pairs = ((known.times, middles), (known.wrench, wrench), (known.target, target))
    whole = Looks(*(np.concatenate(pair) for pair in pairs))
    return whole.of(np.argsort(whole.times, kind="stable"))


def _moved(
    executed: Execution, looks: Looks, walker: Walker, formulation: Formulation, way: Steps | None = None
) -> tuple[Motion, AtStates]:
    """Return executed references as a motion, with the formulation in which its limits are looked at."""
    start, left = walker.start, executed.left(looks.target)
    way = way or steps(analyses_of(executed, start), start, walker.task, left)
    displacement = frozen(looks.target - left)
    there = AtStates.of(
        formulation.whole, times=executed.times, wrench=looks.wrench, target=looks.target,
        rigid=frozen(displacement + way.beside),
    )  # fmt: skip
    motion = motion_of(executed, start, looks.wrench, sag_of(way.each, looks.wrench, start))
    return replace(motion, du=displacement), there
