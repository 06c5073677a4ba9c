"""What a task comes to with some of the synergies only: whether it has a plan, and how good, in the linear model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.limits.limit import Limit
from synergrip.conic.question import Question
from synergrip.errors import MotionDirectionError, Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import chosen
from synergrip.linalg import Array
from synergrip.planning.accuracy import InDoubtError, refuse_doubtful_response
from synergrip.planning.formulated import formulated
from synergrip.planning.instants import intersample_of
from synergrip.planning.solvers import SOLVERS, Answered, ask
from synergrip.statics.analysis import Analysis, analyse
from synergrip.tasks.scaling import caps, grips
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

GOALS: dict[str, Goal] = {"margin": LargestMargin(), "effort": LeastEffort(), "peak_force": LeastPeak()}
"""What makes one subset better than another, of those with a plan."""
SURE = 1e-5
"""Shortfall of a margin, relative to the unit of force, that is no matter of digits."""
ROUNDING = 1e-8
"""Shortfall, relative to the same, that is none."""
BETTER = 1e-6
"""Share by which a subset must be better to be called so."""


@dataclass(frozen=True, eq=False, repr=False)
class Tried(Value):
    """Some of the synergies of a grasp, and what a task comes to with them."""

    picks: tuple[int, ...]
    """Their places among all, ascending."""
    stage: str
    """What is in the way: "count", "direction" or "magnitude"; "" for nothing, "unknown" when it is not certain."""
    value: float
    """How good it is, more is better: of those with a plan what they are compared by, else how near they are to one:
    the largest margin [N], or minus how far the wanted motion is out of reach [m]."""

    @property
    def place(self) -> tuple[int, float]:
        """Its place among subsets, the best last."""
        kinds = {"": 3, "magnitude": 2, "direction": 1, "count": 0}
        return kinds.get(self.stage, -1), self.value

    @property
    def certain(self) -> bool:
        """Whether it is verified that there is a plan, or that there is none."""
        return self.stage != "unknown"

    def beats(self, other: Tried) -> bool:
        """Return whether it is better than another one, beyond rounding."""
        (kind, value), (other_kind, other_value) = self.place, other.place
        if kind != other_kind:
            return kind > other_kind
        if not (np.isfinite(value) and np.isfinite(other_value)):
            return value > other_value
        return value - other_value > BETTER * max(abs(value), abs(other_value))


@dataclass(frozen=True, eq=False, repr=False)
class Looking(Value):
    """A task on a grasp, to be looked at with some of its synergies."""

    grasp: Grasp
    task: TimedTask
    by: str
    """Of `GOALS`."""

    def at(self, picks: Sequence[int]) -> Tried:
        """Return what the task comes to with some synergies.

        Args:
            picks: their places, ascending.

        Raises:
            NotRestrainedError: the contacts leave the object a free motion, whatever the synergies are.
        """
        task, grasp = self.task.for_synergies(picks), chosen(self.grasp, picks)
        analysis = analyse(grasp, task.wrench)
        try:
            formulation = formulated(analysis, task, redundancy=task.watches_references)
            if formulation.allowed is not None:  # a reserve for contacts that are off would prove nothing
                formulation = replace(formulation, allowed=replace(formulation.allowed, cornered=True))
            refuse_doubtful_response(analysis.response)
        except Refusal as refusal:
            far = refusal.size if isinstance(refusal, MotionDirectionError) else 0.0
            return Tried(tuple(picks), refusal.stage, -far)
        except InDoubtError:
            return Tried(tuple(picks), "unknown", 0.0)
        intersample = intersample_of(task, analysis) if task.between == "hold" else None
        stage, value = self._judged(analysis, task, replace(formulation, intersample=intersample))
        if stage == "magnitude" and intersample is not None and not intersample.exact:
            # the reserve for what is curved between the knots asks for too much to prove anything (planning/holding.py)
            without = self._judged(analysis, task, replace(formulation, intersample=intersample.every()))
            stage, value = without if without[0] == "magnitude" else ("unknown", 0.0)
        if stage == "magnitude" and formulation.allowed is not None and formulation.allowed.samples:
            stage, value = "unknown", 0.0  # all samples are more than the share that is asked
        return Tried(tuple(picks), stage, value)

    def _judged(self, analysis: Analysis, task: TimedTask, formulation: Formulation) -> tuple[str, float]:
        """Return stage and value."""

        def asked(goal: Goal, limits: tuple[Limit, ...]) -> Answered:
            sizes = caps(analysis, task) if isinstance(goal, LargestMargin) else ()
            return ask(Question(formulation, limits, goal), SOLVERS["clarabel"], (*grips(formulation), *sizes))

        widest = asked(LargestMargin(), task.kept)
        decision, unit = widest.decision, widest.question.formulation.force_unit
        if decision.infeasible:
            return "magnitude", -np.inf
        if not (decision.acceptable or decision.unbounded):
            return "unknown", 0.0
        margin = np.inf if decision.unbounded else float(decision.solution.x[-1]) * unit
        short = task.margin - margin
        if short > ROUNDING * unit:
            sure = decision.optimal and short > SURE * unit
            return ("magnitude", margin) if sure else ("unknown", 0.0)
        if self.by == "margin" and not decision.unbounded:
            return "", margin
        best = asked(GOALS[self.by] if self.by != "margin" else LeastEffort(), task.all_limits)
        if not best.decision.acceptable:
            return "unknown", 0.0
        if self.by == "margin":
            return "", np.inf
        forces = best.question.formulation.force.at(best.v)
        grasp, scale = analysis.grasp, analysis.response.scale
        peak = float(forces[:, grasp.normal_rows].max())
        return "", -(peak if self.by == "peak_force" else effort_of(forces * scale.force))


def effort_of(forces: Array) -> float:
    """Return the root of the mean over knots of the squares of contact forces (T, n_l), moments over the length [N]."""
    return float(np.sqrt(np.mean(np.sum(np.asarray(forces) ** 2, axis=1))))
