"""With axes left free, a goal chooses among plans, and not whether there is one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from synergrip import LargestMargin, LeastEffort, LeastMotion, Plan, load_problem, plan
from synergrip.planning import runaway
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Unknown
from synergrip.planning.pace import SHORT
from synergrip.planning.reached import Reached
from synergrip.planning.runaway import STILL, TAME, answered
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.problems.problem import Problem

AWAY = (
    'task.move=[{axis="x", lift="8 mm"}, {axis="y", lift="6 mm"}]', 'task.axes=["x", "y", "z"]', "task.knots=11",
)  # fmt: skip


@cache
def problem() -> Problem:
    return load_problem("human-ball", AWAY)


@cache
def tame() -> Plan:
    found = plan(problem().grasp, problem().task.replace(goals=[LeastMotion()]))
    assert isinstance(found, Plan)
    return found


def effort(found: Plan) -> float:
    return float(np.sum((found.forces * found.analysis.response.scale.force) ** 2))


def test_a_goal_that_runs_away_with_a_free_motion_has_a_plan_where_another_goal_has(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Passes turn the ball by 28 degrees at the start for next to no effort; where they do not, there is a plan."""
    task = problem().task.replace(goals=[LeastEffort()])
    found = plan(problem().grasp, task)
    assert isinstance(found, Plan)
    assert found.executed is not None
    assert STILL in found.notes
    assert effort(found) < 0.9 * effort(tame())
    assert np.abs(found.executed.du[0, 3:]).max() < 0.01
    assert all(check.passed for check in found.checks)
    assert found.margins.min() > found.task.margin - 1e-3 * np.abs(found.forces).max()
    monkeypatch.setattr(runaway, "runs_free", lambda _: False)
    assert plan(problem().grasp, task).verdict == "unknown"


def judging(good: Callable[[Walker], bool], until: Callable[[Walker], float] = lambda _: 0.0) -> Plan | Unknown:
    """Return the answer where some walkers have the plan of least motion, and others get somewhere only."""
    task = replace(tame().task, goals=(LargestMargin(),))
    walker = Walker(task, tame().analysis, Executor.of(tame().analysis, task), SOLVERS["clarabel"])
    assert tame().executed is not None

    def begin(walker: Walker) -> Walk:
        asked.append((walker.task.goals[0].name, walker.effort.still))
        return walker.executed(tame().dz_r, None, tame().executed)  # type: ignore[arg-type]

    def judge(walk: Walk, walker: Walker) -> Plan | Unknown:
        if good(walker):
            return replace(tame(), largest_margin=1.0)
        reached = Reached(until(walker), np.zeros(6), "", None)
        return Unknown(walker.task, walker.start, "", (), "reach", reached=reached)

    asked.clear()
    return answered(walker, begin, judge)


asked = list[tuple[str, bool]]()


def test_where_no_pass_of_the_goal_leads_the_plan_of_least_motion_is_had_and_told() -> None:
    found = judging(lambda walker: walker.task.goals[0] == TAME)
    assert isinstance(found, Plan)
    assert found.largest_margin is None
    assert found.notes[0] == (
        "'largest margin' came to no plan along the motion, nor any goal after it; this is the plan of least motion"
    )
    assert asked == [("largest margin", False), ("largest margin", True), ("least motion", False)]


def test_nothing_else_is_tried_where_passes_lead_to_a_plan_at_once() -> None:
    assert isinstance(judging(lambda _: True), Plan)
    assert asked == [("largest margin", False)]


def test_of_walks_in_vain_the_one_that_got_farthest_is_told() -> None:
    found = judging(lambda _: False, lambda walker: 0.7 if walker.effort.still else 0.3)
    assert isinstance(found, Unknown)
    assert found.reached is not None
    assert found.reached.until_s == 0.7


def test_changes_that_are_looked_at_beside_others_take_no_more_passes() -> None:
    walker = Walker(tame().task, tame().analysis, Executor.of(tame().analysis, tame().task), SOLVERS["clarabel"])
    no = Unknown(walker.task, walker.start, "", ())
    assert tame().executed is not None
    begun = walker.executed(tame().dz_r, None, tame().executed)  # type: ignore[arg-type]
    assert answered(replace(walker, effort=SHORT), lambda _: begun, lambda *_: no) is no
