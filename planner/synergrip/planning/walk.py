"""Re-linearised planning: all knots at once, around the path that the references really take, until promises are true.

A pass takes the true states of the path so far, linearises the statics at every knot, asks the goals of the task again
around them, and executes what comes out. What a pass promises and what the hand then does differ by the square of the
step it took; a step that was too long is taken back and tried again shorter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.conic.along import AlongPath, Path
from synergrip.conic.decide import Decision
from synergrip.conic.formulation import Formulation, formulate
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.question import Question
from synergrip.conic.rows import Rows, norm_within
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.states import States
from synergrip.linalg import Array, frozen
from synergrip.log import LOG
from synergrip.planning.executing import Executor, analyses_of, sag_of
from synergrip.planning.solvers import Answered, Answerer, ask
from synergrip.planning.stages import Stage, begun, through
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion
from synergrip.tasks.goals import unasked_goals
from synergrip.tasks.scaling import expected_units, units_of
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import target_displacement
from synergrip.tasks.tracking_along import Steps, steps
from synergrip.values import Value

TRUE, OF_FORCES = 1e-3, 1e-4
"""A promise is true when it is to this many newtons, or to this share of the largest force where that is more."""
MOST_PASSES = 16
STEP, DAMPING = 0.3, 2e-3
"""How far joints may move in one pass beyond what the way takes [rad, or m over the length]; `steps` has the other."""
SHORTER, SHORTEST, TRIES = 1 / 3, 1e-3, 2
AIMED, SHORTEST_CUT = 0.5, 0.05
"""What a shorter step aims at, as a share of the difference that is allowed; the least share that a step is cut to."""
BETTER = 0.5
"""Share of the last difference between promise and truth that a step must get below."""
FOLLOWED, NEARER = 1e-5, 0.9
"""[m] How near the object is brought to where it is wanted, as long as a pass brings it nearer by this factor."""


@dataclass(frozen=True, eq=False, repr=False)
class Walk(Value):
    """References, what they really do, and what led to them."""

    references: Array  # (T, n_z)
    executed: Execution
    gap: float
    """[N] largest difference between the contact forces promised and the true ones."""
    way: Steps | None
    """What is left of the way; None when some knots were not reached."""
    stage: Stage | None = None
    """What the goals of the last pass came to; None before the first."""
    passes: int = 0
    largest_margin: float | None = None
    """The largest margin [N] in the program of the last pass, when it was asked for."""
    tried: tuple[Decision, ...] = ()
    """On the first goal, of every pass; of those taken back, too."""

    @property
    def true(self) -> bool:
        """Whether what was promised is what happens."""
        return self.way is not None and self.gap <= self.allowed

    @property
    def allowed(self) -> float:
        """[N] difference up to which a promise counts as what happens."""
        return max(TRUE, OF_FORCES * float(np.abs(self.executed.states.forces).max(initial=0.0)))

    @property
    def behind(self) -> float:
        """How far the rigid motion is behind the wanted one [m], at most."""
        return np.inf if self.way is None else float(self.way.behind.max(initial=0.0))

    def better_than(self, other: Walk) -> bool:
        """Tell whether a pass was worth it: nearer to what was promised, or, once that is true, to what is wanted."""
        if self.way is None:
            return False
        if other.true:
            return self.true and self.behind < NEARER * other.behind
        return self.true or self.gap < BETTER * other.gap


@dataclass(frozen=True, eq=False)
class ShortStep(Limit):
    """Joints move little in one pass, beyond what the way that is left takes: the maps hold near the path only."""

    room: Array
    """(T,) [rad, or m over the length]."""
    key = "step"
    watches = "references"

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return one second-order cone per knot."""
        assert isinstance(formulation, AlongPath)
        moved = formulation.map_of(lambda at: at.response.dq_dzr) / self.room[:, None, None]
        return [norm_within(self.key, "joints", formulation.change.after(moved).shortened, 1.0)]

    def loosened(self, share: float) -> ShortStep:
        """Return it with more room."""
        return replace(self, room=frozen(self.room * (1 + share)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Raise: it is a limit of a step, not of a plan."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Walker:
    """Who walks: a task on a hand, how its references are executed, and who answers."""

    task: TimedTask
    start: Analysis
    executor: Executor
    solver: Answerer
    reserve: float = 0.0
    """[N] how much more than the task asks contacts are to keep at the knots, so that they keep that between them."""

    def walk(self, linear: Motion) -> Walk:
        """Return the walk that the passes end with, from a plan for the start posture.

        Args:
            linear: the motion that the plan promises.
        """
        return self.on(self.executed(linear.dz_r, linear.forces, linear))

    def on(self, best: Walk) -> Walk:
        """Return the walk that the passes end with, from another one."""
        share, tries = 1.0, 0
        for count in range(best.passes + 1, best.passes + MOST_PASSES + 1):
            done = best.true and (best.behind < FOLLOWED or tries == TRIES)
            if best.way is None or done or share < SHORTEST:
                break
            answered, limits = self._first(best.way, best, share)
            found = self._after(answered, limits, best) if answered.decision.acceptable else None
            good = found is not None and found.better_than(best)
            LOG.info("pass %d, step %.2g: %s", count, share, _told(found, good))
            tried = (*best.tried, answered.decision)
            best = replace(found if good and found is not None else best, passes=count, tried=tried)
            share, tries = (min(1.0, 2 * share), 0) if good else (share * _shorter(found), tries + 1)
        return best

    def _after(self, answered: Answered, limits: tuple[Limit, ...], best: Walk) -> Walk:
        """Return what the goals after the first come to, executed."""
        first, *others = self.task.goals
        stage = begun(answered, limits, first)
        largest = stage.largest_margin
        stage = through(stage, others, unasked_goals(self.task), self.solver)
        references, promised = (part.at(stage.v) for part in (stage.formulation.reference, stage.formulation.force))
        found = self.executed(references, promised, best.executed)
        return replace(found, stage=stage, largest_margin=largest)

    def executed(self, references: Array, promised: Array, near: Motion | States | Execution) -> Walk:
        """Return references (T, n_z) executed, beside the contact forces (T, n_l) [N] that were promised.

        Args:
            references: at the knots of the task.
            promised: forces.
            near: states, a motion or an execution that are not far from what they do.
        """
        executed = self.executor.run(self.task.times, frozen(references), self.task.wrench, near)
        forces = executed.states.forces
        gap = float(np.abs(forces - promised[: len(forces)]).max(initial=0.0))
        if not executed.whole:
            return Walk(frozen(references), executed, gap, None)
        each = analyses_of(executed, self.start)
        return Walk(frozen(references), executed, gap, steps(each, self.start, self.task, executed.left(self.wanted)))

    def _first(self, way: Steps, walk: Walk, share: float) -> tuple[Answered, tuple[Limit, ...]]:
        """Return what the first goal comes to around a path, and the limits that it keeps."""
        beta, moved = way.damped(DAMPING / share)
        first, asked = self.task.goal, replace(self.task, margin=self.task.margin + self.reserve)
        limits = asked.kept if isinstance(first, LargestMargin) else asked.all_limits
        limits = (*limits, ShortStep(frozen(STEP * share + 1.5 * moved)))
        return ask(Question(self.around(way, walk, beta), limits, first), self.solver), limits

    @cached_property
    def wanted(self) -> Array:
        """(T, 6) where the object is wanted, from where it starts [m, rad]."""
        return frozen(target_displacement(self.start, self.task, self.task.target.values))

    def around(self, way: Steps, walk: Walk, beta: Array) -> AlongPath:
        """Return the task around a path, with a rigid motion (T, dim Gamma_ucs) that follows what is wanted."""
        task, start = self.task, self.start
        displacement = frozen(self.wanted - walk.executed.left(self.wanted))
        path = Path(
            walk.references, walk.executed.joint, displacement, frozen(displacement + way.beside),
            sag_of(way.each, task.wrench, start),
        )  # fmt: skip
        sizes = expected_units(start, task, np.zeros_like(beta), self.wanted)
        formulation = formulate(
            start.response, start.spaces, start.coordinates, times=task.times, wrench=task.wrench, beta=beta,
            beta_basis=way.basis, target=self.wanted, units=sizes, redundancy=True, stated=units_of(start, task),
            each=way.each,
        )  # fmt: skip
        return AlongPath.around_path(formulation, path)


def _shorter(found: Walk | None) -> float:
    """Return by how much a step is made shorter that was too long: its gap is as the square of it."""
    if found is None or found.way is None:
        return SHORTER
    return float(np.clip(np.sqrt(AIMED * found.allowed / max(found.gap, 1e-300)), SHORTEST_CUT, SHORTER))


def _told(found: Walk | None, good: bool) -> str:
    if found is None:
        return "no answer"
    if found.way is None:
        return f"ends at instant {len(found.executed.states)}: {found.executed.why}"
    told = f"promise and truth differ by {found.gap:.3g} N, {1e3 * found.behind:.3g} mm behind"
    return told if good else f"{told}, taken back"
