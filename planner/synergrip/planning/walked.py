"""From a walk to an answer: a plan whose figures are those of the hand that moves, or what keeps it from being one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.along import AtStates
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import Between
from synergrip.planning.executing import Executor, analyses_of, motion_of
from synergrip.planning.instants import intersample_of
from synergrip.planning.outcome import Check, Plan, Reached, Unknown
from synergrip.planning.solvers import SOLVERS, Answerer
from synergrip.planning.verified import LIMIT, limit_usages
from synergrip.planning.walk import Walk, Walker
from synergrip.statics.motion import Motion
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import target_displacement
from synergrip.tasks.tracking_along import steps
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
REACHED = 0.01
"""How far the rigid motion may be behind the wanted one when the task states no tolerance, as a share of the length of
the grasp."""


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
        answers: the solver; the second formulation writes down the start posture only, and Clarabel goes on.
    """
    if plan.grasp.held is None:
        return plan
    solver = SOLVERS["clarabel"] if answers is SOLVERS["cvxpy"] else answers
    walker = Walker(plan.task, plan.analysis, Executor.of(plan.analysis, plan.task), solver)
    return answer_of(walker.walk(plan.motion), walker, plan)


def answer_of(walk: Walk, walker: Walker, linear: Plan) -> Plan | Unknown:
    """Return the plan that a walk ended with, at its true states; unknown when it did not reach or hold.

    Args:
        walk: what the passes ended with.
        walker: who walked.
        linear: the plan for the start posture, where the walk began.
    """
    task, analysis, stage = walker.task, walker.start, walk.stage
    decisions = (*linear.decisions, *walker.decisions)
    if walk.way is None or walk.behind > allowed(walker):
        reached = _reached(walk, walker)
        return Unknown(task, analysis, reached.because, decisions, "reach", reached)
    if not walk.true:
        why = f"after {walk.passes} passes what is promised and what the hand does still differ by {walk.gap:.3g} N"
        return Unknown(task, analysis, why, decisions, "execution")
    found = figures(walk, walker, linear.formulation)
    if short := _short_between(found, task):
        more = replace(walker, reserve=walker.reserve + MORE * short)
        if more.reserve <= MOST_RESERVE * max(task.margin, short):
            return answer_of(more.on(replace(walk, gap=np.inf)), more, linear)
    failed = [check for check in found.checks if not check.passed]
    if failed:
        said = "; ".join(f"{check.name}, by {check.error:.3g}" for check in failed)
        said += "; more knots straighten it" if all(BETWEEN in check.name for check in failed) else ""
        return Unknown(task, analysis, f"at the true equilibrium limits are missed: {said}", decisions, "execution")
    alpha, beta, gamma = analysis.coordinates.coordinates(walk.references)
    last = linear if stage is None else stage
    return replace(
        linear, motion=found.motion, alpha=frozen(alpha), beta=frozen(beta), gamma=frozen(gamma),
        margins=frozen(found.usages[0].value), usages=found.usages, checks=found.checks, decisions=decisions,
        between=found.between, executed=walk.executed, passes=walk.passes, elastic_motion=found.elastic_motion,
        largest_margin=linear.largest_margin if stage is None else walk.largest_margin,
        notes=(*(() if stage is None else stage.notes), *_notes(walk, walker)), interrupted=last.interrupted,
    )  # fmt: skip


def _short_between(found: Figures, task: TimedTask) -> float:
    """Return by how much a slip margin that is to hold between the knots falls short there [N]; 0 when it is kept."""
    if task.between != "hold" or found.between is None or found.between.rooms is None:
        return 0.0
    short = float(found.between.usages[0].excess.max(initial=0.0))
    return short if short > found.between.rooms[0] else 0.0


def figures(walk: Walk, walker: Walker, formulation: Formulation) -> Figures:
    """Return the figures of a walk all of whose knots were reached.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
    """
    task = walker.task
    motion, there = _moved(walk.executed, task.wrench, walker.wanted, walker, formulation)
    usages = limit_usages(task, there, motion)
    between = _between(walk, walker, formulation)
    elastic = frozen(motion.du - motion.sag - there.rigid_motion(motion.dz_r))
    rooms = _rooms(walk.executed, walker)
    checks = (Check("equilibrium", walk.executed.residual, BALANCED), *kept(usages, rooms))
    if task.between == "hold" and between is not None:
        checks = (*checks, *kept(between.usages, rooms, f"{BETWEEN}: "))
    return Figures(replace(motion, du=walk.executed.du), usages, elastic, between, checks)


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


def allowed(walker: Walker) -> float:
    """Return how far the rigid motion may be behind the wanted one [m]."""
    return walker.task.tolerance or REACHED * walker.start.response.scale.length


def _between(walk: Walk, walker: Walker, formulation: Formulation) -> Between | None:
    """Return what the references really do between the knots; None where there is nothing, or they end there."""
    task = walker.task
    if len(task.times) < 2:
        return None
    looks, corners = _looks(walker)
    references = frozen(interpolated(looks.times, task.times, walk.references))
    near = walk.executed.interpolated(looks.times)
    executed = walker.executor.run(looks.times, references, looks.wrench, near)
    if not executed.whole:
        return None
    motion, there = _moved(executed, looks.wrench, looks.target, walker, formulation)
    usages = tuple(limit.usage(there, motion) for limit in task.all_limits if not limit.couples_knots)
    rooms = _rooms(walk.executed, walker)
    return Between(1, 0.0, 0.0, 0.0, usages, corners, tuple(_room(usage, rooms) for usage in usages))


def _looks(walker: Walker) -> tuple[Looks, tuple[float, ...]]:
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
    corners = () if sampled is None else tuple(dict.fromkeys(sampled.corners.times.tolist()))
    return whole.of(np.argsort(whole.times, kind="stable")), corners


def _moved(
    executed: Execution, wrench: Array, target: Array, walker: Walker, formulation: Formulation
) -> tuple[Motion, AtStates]:
    """Return executed references as a motion, with the formulation in which its limits are looked at."""
    start, task = walker.start, walker.task
    left = executed.left(target)
    each = analyses_of(executed, start)
    beside = steps(each, start, task, left).beside
    change = wrench - start.grasp.w_0
    sag = np.array([at.response.du_dw @ dw for at, dw in zip(each, change, strict=True)])
    displacement = frozen(target - left)
    there = AtStates.of(
        formulation.whole, times=executed.times, wrench=wrench, target=target,
        rigid=frozen(displacement + beside),
    )  # fmt: skip
    motion = motion_of(executed, start, wrench, frozen(sag))
    return replace(motion, du=displacement), there


def _not_reached(walk: Walk, walker: Walker) -> str:
    """Return from when on a motion is not reached, and how far it gets."""
    times, executed = walker.task.times, walk.executed
    if walk.way is None:
        k = len(executed.states)
        return f"not reached from t = {times[k]:.3g} s: {executed.why or 'no equilibrium was found there'}"
    k = int(np.argmax(walk.way.behind > allowed(walker)))
    stuck = _stuck(walk, walker, k)
    return (
        f"not reached from t = {times[k]:.3g} s: there the object is {1e3 * walk.way.behind[k]:.3g} mm behind, and by "
        f"{1e3 * walk.behind:.3g} mm at most{stuck}"
    )


def _stuck(walk: Walk, walker: Walker, k: int) -> str:
    """Return what keeps the hand from going on at a knot: joints at the ends of their ranges, or straight fingers."""
    held = walker.start.grasp.held
    if held is None:
        return ""
    q = held.q + walk.executed.joint[k]
    ends = [
        f"joint '{joint.name}' is at its {end} limit"
        for joint, value in zip(held.hand.joints, q, strict=True)
        for end, off in (("lower", value - joint.lower), ("upper", joint.upper - value))
        if off < ANGLE * 10
    ]
    return f", because {', '.join(ends)}" if ends else ", because the fingers are near a straight posture"


def _reached(walk: Walk, walker: Walker) -> Reached:
    """Return until when the motion was followed, and the pose of the object there."""
    k = len(walk.executed.states) if walk.way is None else int(np.argmax(walk.way.behind > allowed(walker)))
    pose = walk.executed.du[max(k - 1, 0)] if len(walk.executed.states) else np.zeros(6)
    return Reached(float(walker.task.times[max(k - 1, 0)]), frozen(pose), _not_reached(walk, walker))


def _notes(walk: Walk, walker: Walker) -> Iterator[str]:
    """Yield how far the plan is from what was wanted, where that is more than elastic motion."""
    if walk.behind > LENGTH:
        yield (
            f"near a singular posture the object stays up to {1e3 * walk.behind:.2g} mm behind the wanted motion, "
            f"within the {1e3 * allowed(walker):.2g} mm that count as followed"
        )
