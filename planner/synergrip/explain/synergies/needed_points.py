"""The figures of a task with some of the synergies: margin, effort, peak force, tracking error, each of a plan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.errors import InputError, MotionDirectionError
from synergrip.explain.synergies.subset_values import effort_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import chosen
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import target_displacement
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class NeededPoint(Value):
    """What a task comes to with some synergies; figures are None where there is no plan."""

    synergies: tuple[str, ...]
    verdict: str
    """"feasible", "infeasible" or "unknown"."""
    stage: str
    """Of a verdict that is not feasible: what is in the way; else empty."""
    certified: bool
    """Whether the verdict is verified: a plan, or the certificate that there is none."""
    largest_margin: float | None
    """[N] The largest slip margin that the other limits allow, less than asked for where that is what falls short;
    infinity where nothing bounds it."""
    effort: float | None
    """[N] Of the plan of least effort: root of the mean over knots of the sum of squared contact forces."""
    peak: float | None
    """[N] Of the plan of least peak force: the largest normal force."""
    outside: float
    """[m] How far the wanted motion leaves the rigid motions of these synergies, where that is too far; else 0."""
    tracking_error: float | None
    """[m] Of the plan of least effort: how far the object is from where it is wanted at most, deformation and sag
    included, rotations times the length of the grasp."""
    every: bool = True
    """Of the best k: whether all subsets of k were looked at."""


@dataclass(frozen=True, eq=False, repr=False)
class Pointed(Value):
    """A task on a grasp with many synergies, to be planned with some of them."""

    grasp: Grasp
    task: TimedTask
    along: bool
    """Whether by the hand that moves, or by the linear model of the start posture."""

    def at(self, picks: Sequence[int], *, every: bool = True) -> NeededPoint:
        """Return what planning with some synergies comes to.

        Args:
            picks: their places.
            every: what the point is to say of the search for them.
        """
        grasp, task = chosen(self.grasp, picks), self.task.for_synergies(picks)
        least = self._planned(grasp, task, LeastEffort())
        if not isinstance(least, Plan):
            return _without(grasp.synergies, least, every)
        peaked = self._planned(grasp, task, LeastPeak())
        peak = float(peaked.forces[:, grasp.normal_rows].max()) if isinstance(peaked, Plan) else None
        return NeededPoint(
            grasp.synergies, "feasible", "", True, self._margin(grasp, task),
            effort_of(least.forces * least.analysis.response.scale.force), peak, 0.0, _tracking_error(least), every,
        )  # fmt: skip

    def _margin(self, grasp: Grasp, task: TimedTask) -> float | None:
        try:
            widest = self._planned(grasp, task, LargestMargin())
        except InputError:  # squeezing harder always helps, and nothing bounds it
            return float(np.inf)
        return widest.largest_margin if isinstance(widest, Plan | Infeasible) else None

    def _planned(self, grasp: Grasp, task: TimedTask, goal: Goal) -> Outcome:
        judge = plan if self.along else plan_of_start_posture
        outcome = judge(grasp, replace(task, goals=(goal,)))
        if isinstance(outcome, Plan) and outcome.interrupted:
            raise KeyboardInterrupt
        return outcome


def _without(names: tuple[str, ...], outcome: Outcome, every: bool) -> NeededPoint:
    """Return the point of synergies with which there is no plan, or none that is certain."""
    if not isinstance(outcome, Infeasible):
        stage = getattr(outcome, "stage", "")
        return NeededPoint(names, outcome.verdict, stage, False, None, None, None, 0.0, None, every)
    outside = outcome.refusal.size if isinstance(outcome.refusal, MotionDirectionError) else 0.0
    verified = outcome.certificate.verified
    return NeededPoint(
        names, outcome.verdict, outcome.stage, verified, outcome.largest_margin, None, None, outside, None, every
    )


def _tracking_error(found: Plan) -> float:
    """Return how far [m] the object is from where it is wanted at most."""
    target = target_displacement(found.analysis, found.task, found.task.target.values)
    apart = found.analysis.response.scale.twist(target - found.motion.du)
    return float(np.linalg.norm(apart, axis=1).max())
