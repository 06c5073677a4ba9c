"""Any plan judged against a problem, without optimising: ours, or references from elsewhere."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.conic.situation import Situation
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen, interpolated
from synergrip.plans.analysis import Analysis, analyse
from synergrip.plans.outcome import Check
from synergrip.plans.reading.knots import distinct
from synergrip.plans.references import References
from synergrip.plans.situated import situated
from synergrip.plans.task import Task
from synergrip.plans.verified import LIMIT, identities, limit_checks, limit_usages
from synergrip.statics.motion import Motion, forward

TRACKED = 1e-6
"""How far the rigid motion may be from the wanted one when the task states no tolerance [m]."""


@dataclass(frozen=True)
class Judgement:
    """What becomes of given references in a task."""

    analysis: Analysis
    motion: Motion
    margins: Array  # (T, n_c) slip margins [N]
    usages: tuple[Usage, ...]
    checks: tuple[Check, ...]

    @property
    def verdict(self) -> str:
        """The verdict: "feasible" when every check passes."""
        return "feasible" if all(check.passed for check in self.checks) else "infeasible"

    @property
    def exit_code(self) -> int:
        """0 or 1."""
        return 0 if self.verdict == "feasible" else 1


def judge_references(grasp: Grasp, task: Task, references: References) -> Judgement:
    """Judge references against a task at the knots of both, linear in between.

    Forces are linear in references and loads and the cones are convex, so what holds at the knots of both
    holds in between.

    Raises:
        InputError: the references do not cover the task.
        Refusal: the grasp does not restrain the object, or the task is impossible by count or direction.
    """
    times = _common_times(task, references)
    task = _at(task, times)
    dz_r = interpolated(times, references.times, references.values)
    analysis = analyse(grasp, task.wrench)
    situation = situated(analysis, task, redundancy=True)
    motion = forward(analysis.response, times, dz_r, task.wrench)
    usages = limit_usages(task, situation, motion)
    reached = analysis.coordinates.coordinates(dz_r)
    checks = (*identities(analysis, motion, reached), _tracking(task, reached[1], situation), *limit_checks(usages))
    checks += _claims(references, motion)
    return Judgement(analysis, motion, frozen(usages[0].value), usages, checks)


def _claims(references: References, motion: Motion) -> tuple[Check, ...]:
    """Compare the forces, torques and motions that a file claims for its references with ours."""
    ours = {"lambda": motion.forces, "tau": motion.torques, "du": motion.du}
    inside = (references.times >= motion.times[0]) & (references.times <= motion.times[-1])
    times = references.times[inside]
    found = []
    for name, claimed in references.claimed.items():
        if claimed.shape[1] != ours[name].shape[1]:
            found.append(Check(f"claimed {name}", np.inf, LIMIT))
            continue
        expected = interpolated(times, motion.times, ours[name])
        size = max(float(np.abs(expected).max(initial=0.0)), 1e-12)
        found.append(Check(f"claimed {name}", float(np.abs(claimed[inside] - expected).max(initial=0.0)) / size, LIMIT))
    return tuple(found)


def _tracking(task: Task, reached: Array, situation: Situation) -> Check:
    """Judge the rigid motion as far as the wanted motion fixes it."""
    beyond, free = reached - situation.beta.constant, situation.beta_basis
    error = float(np.linalg.norm(beyond - beyond @ free @ free.T, axis=1).max(initial=0.0))
    return Check("rigid motion [m]", error, max(task.tolerance, TRACKED))


def _common_times(task: Task, references: References) -> Array:
    first, last = float(references.times[0]), float(references.times[-1])
    start, end = float(task.times[0]), float(task.times[-1])
    slack = 1e-9 * max(end, 1.0)
    if first > start + slack or last < end - slack:
        raise InputError.at("PLAN", f"the plan covers {first:g} s to {last:g} s, the task {start:g} s to {end:g} s")
    inside = references.times[(references.times >= start) & (references.times <= end)]
    return frozen(distinct(np.concatenate([task.times, inside])))


def _at(task: Task, times: Array) -> Task:
    wanted = replace(task.wanted, values=frozen(interpolated(times, task.times, task.wanted.values)))
    wrench = frozen(interpolated(times, task.times, task.wrench))
    return replace(task, times=times, wrench=wrench, wanted=wanted)
