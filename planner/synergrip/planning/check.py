"""Any plan judged against a problem, without optimising: ours, or references from elsewhere."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.execution import Execution
from synergrip.errors import InputError, MotionDirectionError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import LIMIT, Between, between
from synergrip.planning.claims import Claims, compared
from synergrip.planning.formulated import formulated
from synergrip.planning.fresh_samples import FreshSamples
from synergrip.planning.in_balance import spring_checks
from synergrip.planning.in_case import InCase
from synergrip.planning.in_cases import case_checks, in_cases
from synergrip.planning.outcome import BETWEEN, Check
from synergrip.planning.references import References
from synergrip.planning.sizes import sizes_of
from synergrip.planning.stated import stated
from synergrip.planning.verified import EQUILIBRIUM, between_checks, identities, limit_checks, limit_usages
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.motion import Motion, forward
from synergrip.statics.restraint import NO_LOAD
from synergrip.tasks.marks import SAME_TIME, distinct
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import target_displacement
from synergrip.values import Value

FAILS = "fails"
RIGID = "rigid motion [m]"
LINEAR = "linear model: "
"""How the names of checks begin that are about the linear model where the hand is at no equilibrium."""
TRACKED = 1e-6
"""How far the rigid motion may be from the wanted one when the task states no tolerance [m]."""


@dataclass(frozen=True, eq=False, repr=False)
class Judgement(Value):
    """What becomes of given references in a task."""

    task: TimedTask
    """At the knots of both."""
    analysis: Analysis
    formulation: Formulation
    motion: Motion
    elastic_motion: Array  # (T, 6) what the references move beyond the rigid motion, sag excluded [m, rad]
    margins: Array  # (T, n_c) slip margins [N]
    usages: tuple[Usage, ...]
    checks: tuple[Check, ...]
    between: Between | None = None
    """The references between the knots of both."""
    executed: Execution | None = None
    """Their true states on the hand that moves; None for a grasp given as matrices."""
    fixed: Execution | None = None
    """The same if pads stayed where they are on link and object; None where nothing rolls."""
    cases: tuple[InCase, ...] = ()
    """What they use in every case that the task allows for."""
    fresh: FreshSamples | None = None
    """What became of random samples of the grasp, on a hand, where scenarios are allowed for."""
    claims: Claims = field(default_factory=Claims)
    """What the file says of its references; its checks are among `checks`."""
    off: Array | None = None
    """(T,) how far the rigid motion is from the wanted one [m]; None where the hand is at no equilibrium."""
    lost: str = ""
    """From when on and why a hand is at no equilibrium with these references; "" where it is at one all the time."""
    missed_in_cases: tuple[str, ...] = ()
    """What a hand misses in cases that the task allows for, in words."""

    @property
    def verdict(self) -> str:
        """The verdict: "feasible" when every check passes, else "fails": that there is no other plan is not said."""
        return "feasible" if all(check.passed for check in self.checks) else FAILS

    @property
    def stands_in(self) -> bool:
        """Whether the figures are those of the linear model at the start posture for want of true ones."""
        return bool(self.lost) and self.executed is None

    @property
    def exit_code(self) -> int:
        """0 or 1."""
        return 0 if self.verdict == "feasible" else 1


def judge_references(grasp: Grasp, task: TimedTask, references: References) -> Judgement:
    """Judge references against a task at the knots of both, linear in between, where the load is as it is.

    Between the knots of both what happens is looked at as in a plan; limits there count when the task holds them.

    Raises:
        InputError: the references do not cover the task.
        Refusal: the grasp does not restrain the object, or the task is impossible by count or direction; on a hand, the
            very first step of its motion.
    """
    task = task.on(grasp)
    times = _common_times(task, references)
    analysis = analyse(grasp, NO_LOAD)
    _refuse(analysis, task)
    judged = _judged(analysis, task, references, times)
    claims = _claims(judged, task, references)
    checks = (*spring_checks(grasp, judged.motion.forces), *judged.checks, *claims.checks)
    return replace(judged, checks=checks, claims=claims)


def _refuse(analysis: Analysis, task: TimedTask) -> None:
    """Raise for a task that no references can do."""
    from synergrip.planning.going_on import refused_at_once

    try:
        formulated(analysis, task, redundancy=True)
    except MotionDirectionError:
        if analysis.grasp.held is None or refused_at_once(analysis, task):
            raise


def _claims(judged: Judgement, task: TimedTask, references: References) -> Claims:
    """Return what becomes of the claims of a file, at its own knots."""
    if not references.claimed:
        return Claims()
    analysis = judged.analysis
    whole = len(references.times) == len(task.times)  # then it is at the knots of the task, or claims to be
    chosen = np.ones(len(task.times), dtype=bool) if whole else _inside(references.times, task)
    own = references.times[chosen]
    alone = judged if np.array_equal(own, judged.motion.times) else _judged(analysis, task, references, own)
    expected = stated(alone, references.claimed, alone.verdict, task.times)
    sizes = sizes_of(analysis, alone.motion, alone.usages, alone.between)
    return compared(references.inside(chosen), expected, sizes, references.unchanged)


def _judged(analysis: Analysis, task: TimedTask, references: References, times: Array) -> Judgement:
    """Judge references at some knots and between them; what the file claims is another matter."""
    if analysis.grasp.held is not None and analysis.response.restrained:
        return _judged_along(analysis, *_linear(analysis, task, references, times))
    return judged_at_start(analysis, task, references, times)


def judged_at_start(analysis: Analysis, task: TimedTask, references: References, times: Array) -> Judgement:
    """Judge what references do in the linear model of the start posture, at some knots and between them."""
    there, formulation, motion = _linear(analysis, task, references, times)
    usages = limit_usages(there, formulation, motion)
    reached = analysis.coordinates.coordinates(motion.dz_r)
    off = _off(task, times, reached[1], formulation)
    tracking = Check(RIGID, float(off.max(initial=0.0)), max(task.tolerance, TRACKED))
    checks = (*identities(analysis, motion, reached), tracking, *limit_checks(usages))
    found = between(there, analysis, formulation, motion, usages)
    cases = in_cases(there, analysis, formulation, motion.dz_r)
    checks += (*between_checks(there, found), *case_checks(cases, LIMIT))
    elastic, margins = formulation.elastic_motion(motion), frozen(usages[0].value)
    return Judgement(
        there, analysis, formulation, motion, elastic, margins, usages, checks, found, cases=cases, off=off
    )  # fmt: skip


def _linear(
    analysis: Analysis, task: TimedTask, references: References, times: Array
) -> tuple[TimedTask, Formulation, Motion]:
    """Return the task at some knots, its formulation there, and what references do in the linear model."""
    there = _at(task, times)
    formulation = formulated(analysis, _within_reach(analysis, there), redundancy=True)
    dz_r = interpolated(times, references.times, references.values)
    return there, formulation, forward(analysis.response, times, dz_r, there.wrench)


def _judged_along(analysis: Analysis, task: TimedTask, formulation: Formulation, linear: Motion) -> Judgement:
    """Judge references by what the hand that moves does with them; `linear` is what the start posture would have it."""
    from synergrip.planning.executed_cases import executed_cases
    from synergrip.planning.executed_scenarios import in_scenarios
    from synergrip.planning.executing import Executor
    from synergrip.planning.figures import BALANCED, figures
    from synergrip.planning.known_samples import unseen
    from synergrip.planning.reach import off
    from synergrip.planning.solvers import SOLVERS
    from synergrip.planning.walk import Walker
    from synergrip.tasks.scenarios import LOOKS

    walker = Walker(task, analysis, Executor.of(analysis, task), SOLVERS["clarabel"])
    walk = walker.executed(linear.dz_r, linear.forces, linear)
    if walk.way is None:
        usages = limit_usages(task, formulation, linear)
        executed = walk.executed
        lost = f"from t = {executed.times[len(executed.states)]:.3g} s on ({executed.why})"
        # what the linear model keeps says nothing of a hand that is at no equilibrium: only what it breaks is a check
        broken = (replace(c, name=f"{LINEAR}{c.name}") for c in limit_checks(usages) if not c.passed)
        checks = (Check(EQUILIBRIUM, float("inf"), BALANCED), *broken)
        elastic, margins = formulation.elastic_motion(linear), frozen(usages[0].value)
        return Judgement(task, analysis, formulation, linear, elastic, margins, usages, checks, lost=lost)
    found = figures(walk, walker, formulation, between(task, analysis, formulation, linear))
    far = off(walk, walker)
    followed = Check(RIGID, float(far.max()), walker.allowed)
    between_lost = found.missed if found.between is None else ()  # then there is an end of the way between two knots
    lost = "; ".join(told for told in between_lost if told.startswith(BETWEEN))
    margins = frozen(found.usages[0].value)
    cases = executed_cases(walk, walker, formulation)
    samples = in_scenarios(walk, walker, formulation, unseen(LOOKS))  # others than those that a plan was judged by
    checks = (followed, *found.checks, *cases.checks, *samples.checks)
    return Judgement(
        task, analysis, formulation, found.motion, found.elastic_motion, margins, found.usages, checks, found.between,
        walk.executed, walker.executor.with_fixed_contacts(walk.executed, task.wrench), cases.cases, samples.fresh,
        off=far, lost=lost, missed_in_cases=cases.missed,
    )  # fmt: skip


def _off(task: TimedTask, times: Array, reached: Array, formulation: Formulation) -> Array:
    """Return how far (T,) the rigid motion is from the wanted one [m], as far as that fixes it.

    At the knots of the task it is as wanted. Between them it may go as straight as a plan does, or follow.
    """
    wanted = formulation.beta.constant
    straight = interpolated(times, task.times, interpolated(task.times, times, wanted))
    beyond, free = reached - wanted, formulation.beta_basis
    off = np.linalg.norm(beyond - beyond @ free @ free.T, axis=1) - np.linalg.norm(wanted - straight, axis=1)
    return frozen(np.maximum(off, 0.0))


def _common_times(task: TimedTask, references: References) -> Array:
    first, last = float(references.times[0]), float(references.times[-1])
    start, end = float(task.times[0]), float(task.times[-1])
    slack = SAME_TIME * max(end, 1.0)
    if first > start + slack or last < end - slack:
        raise InputError.at("PLAN", f"the plan covers {first:g} s to {last:g} s, the task {start:g} s to {end:g} s")
    inside = references.times[(references.times >= start) & (references.times <= end)]
    return frozen(distinct(np.concatenate([task.times, inside])))


def _inside(times: Array, task: TimedTask) -> Array:
    """Return which times (T,) of a plan lie in the task."""
    slack = SAME_TIME * max(float(task.times[-1]), 1.0)
    return np.asarray((times >= task.times[0] - slack) & (times <= task.times[-1] + slack))


def _at(task: TimedTask, times: Array) -> TimedTask:
    """Return the task at other knots: loads and wishes as they are there."""
    values, wrench = (interpolated(times, task.times, values) for values in (task.target.values, task.wrench))
    if task.course is not None and not np.array_equal(times, task.times):
        load = task.course.load_at(times)
        values, wrench = task.course.target_at(times), wrench if load is None else load
    return replace(task, times=times, wrench=frozen(wrench), target=replace(task.target, values=frozen(values)))


def _within_reach(analysis: Analysis, task: TimedTask) -> TimedTask:
    """Return the task with a tolerance that refuses no wish: between its own knots it may be whatever it is."""
    if task.tracking == "compliant":
        return task
    wish = analysis.response.scale.twist(target_displacement(analysis, task, task.target.values))
    return replace(task, tolerance=max(task.tolerance, float(np.linalg.norm(wish, axis=1).max(initial=0.0))))
