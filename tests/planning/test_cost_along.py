"""What makes plans along the motion cheap changes none of them: rows left out, what bends, how far a pass goes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from synergrip import Plan, Push, load_problem
from synergrip.conic.question import Question
from synergrip.linalg import interpolated
from synergrip.planning import kept_between, near_rows, walk, walked
from synergrip.planning.executing import Executor
from synergrip.planning.kept_between import MoreAtKnots
from synergrip.planning.near_rows import NearRows
from synergrip.planning.pace import Pace
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk

MOST = {"human-ball": 3, "human-ball-5": 3, "human-ball-far": 5, "human-ball-near": 2, "human-graspit-ball": 2,
        "dlr-ball-lift-free": 3, "robonaut-handle-knock": 3, "barrett-ball-far": 4}  # fmt: skip


def started(name: str, *overrides: str) -> tuple[Walker, Walk, Plan]:
    """Return who walks a task, the plan of the start posture executed, and that plan."""
    problem = load_problem(name, list(overrides))
    linear = plan_of_start_posture(problem.grasp, problem.task)
    assert isinstance(linear, Plan)
    walker = Walker(linear.task, linear.analysis, Executor.of(linear.analysis, linear.task), SOLVERS["clarabel"])
    return walker, walker.executed(linear.dz_r, linear.forces, linear.motion), linear


def planned(name: str) -> Any:
    problem = load_problem(name)
    return plan(problem.grasp, problem.task)


@pytest.mark.parametrize("name", MOST)
def test_few_passes_do(name: str) -> None:
    assert planned(name).passes <= MOST[name]


@pytest.mark.parametrize("share", [0.0, 1e9])
@pytest.mark.parametrize("name", ["human-ball", "human-glass", "robonaut-handle-knock"])
def test_rows_that_are_left_out_change_no_plan(name: str, share: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Be it that all simple bounds are left out and asked for where they are missed, or that none is."""
    first = planned(name)
    monkeypatch.setattr(near_rows, "NEAR", share)
    second = planned(name)
    assert second.passes == first.passes
    size = float(np.abs(first.forces).max())
    assert np.allclose(second.executed.states.forces, first.executed.states.forces, rtol=0, atol=2e-4 * size)


def test_a_bound_that_is_left_out_and_missed_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """The best without bounds on torques misses them: so they are asked for, and kept."""
    loose = planned("dlr-ball-move")
    tight = 0.98 * float(np.abs(loose.executed.balance.torques).max())
    problem = load_problem("dlr-ball-move", [f"limits.joint_torque={tight}"])
    monkeypatch.setattr(near_rows, "NEAR", 0.0)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    assert np.abs(answer.executed.balance.torques).max() <= tight * (1 + 1e-3)
    walker, begun, _ = started("dlr-ball-move", f"limits.joint_torque={tight}")
    limits = walker._limits(begun, Pace())
    assert begun.way is not None
    around = walker.around(begun.way, begun, Pace())
    free = ask(Question(around, tuple(NearRows(limit) for limit in limits), walker.task.goal), SOLVERS["clarabel"])
    assert any(NearRows(limit).misses(around, free.v) for limit in limits)
    kept = ask(Question(around, limits, walker.task.goal), SOLVERS["clarabel"])
    assert not any(NearRows(limit).misses(around, kept.v) for limit in limits)


def test_goals_without_an_end_and_small_programs_have_all_rows() -> None:
    walker, begun, _ = started("human-ball")
    goals, limits = walker.task.goals, walker._limits(begun, Pace())
    near = near_rows.near_rows(limits, goals, near_rows.MANY)
    assert len(near) == len(limits)
    assert all(isinstance(limit, NearRows) for limit in near)
    assert near_rows.near_rows(limits, goals, near_rows.MANY - 1) is limits
    largest = started("gripper-bar")[0].task.goals
    assert near_rows.near_rows(limits, largest, near_rows.MANY) is limits


@pytest.mark.parametrize("name", ["human-ball-near", "human-graspit-ball"])
def test_what_bends_is_asked_for_before_it_is_missed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One look between the knots does; without it there are two, and a pass more."""
    looks: list[object] = []
    figures = walked.figures
    monkeypatch.setattr(walked, "figures", lambda *of: looks.append(of) or figures(*of))
    first = planned(name)
    assert len(looks) == 1
    monkeypatch.setattr(MoreAtKnots, "for_what_bends", lambda self, *_: self)
    monkeypatch.setattr(Walker, "kept_between", lambda _, walk: walk)
    second = planned(name)
    assert len(looks) == 3
    assert second.passes > first.passes
    for answer in (first, second):
        assert answer.between.usages[0].value.min() >= answer.task.margin - max(
            1e-3, 1e-3 * np.abs(answer.forces).max()
        )


def test_margins_between_the_knots_are_known_without_an_execution() -> None:
    answer = planned("human-ball")
    walker, begun, _ = started("human-ball")
    there = walker.looks(replace(begun, executed=answer.executed))
    known = kept_between.margins_at(answer.executed, there)
    assert np.array_equal(there.times, answer.between.usages[0].times)
    true = answer.between.usages[0].value
    bend = np.abs(interpolated(there.times, answer.task.times, answer.executed.margins) - true).max()
    assert bend > 1e-3
    assert np.allclose(known, true, rtol=0, atol=0.02 * bend)


def test_no_more_is_asked_for_where_the_task_counts_its_knots_only() -> None:
    walker, begun, _ = started("human-ball", "task.between=report")
    assert walker._more_at_knots(replace(begun, gap=0.0)) is None
    walker, begun, _ = started("human-ball")
    more = walker._more_at_knots(replace(begun, gap=0.0))
    assert more is not None
    assert more.margin.max() > 1e-3
    assert walker._more_at_knots(replace(begun, gap=begun.largest)) is None  # so far off they may bend otherwise


def test_a_way_that_no_program_goes_shortens_the_way_alone() -> None:
    _, begun, _ = started("dlr-ball-move", "task.knots=9")
    assert not begun.there
    pace = Pace(step=0.1).back(begun, None)
    assert pace.step == 0.1
    assert pace.way < 1
    assert not pace.ends(begun)
    assert pace.back(begun, None).ends(begun)
    assert pace.ends(replace(begun, gap=begun.largest))  # what it promised is nothing like what happens
    assert not Pace().ends(replace(begun, gap=begun.largest))
    far = replace(begun, gap=4 * begun.room)
    after = Pace().back(begun, far)
    assert after.way == 1
    assert after.step < 1
    assert Pace(step=0.1).on(begun, replace(begun, gap=0.1 * begun.room), 1.0).step > 0.1
    assert Pace(step=0.1).on(begun, far, 1.0).step < 0.1  # a step as long would be as far off again


def test_what_no_program_has_where_nothing_of_the_way_is_left_takes_a_longer_step() -> None:
    _, begun, _ = started("utah-mit-ball", "task.knots=9")
    assert begun.there
    pace = Pace(step=0.1).back(begun, None)
    assert pace.step > 0.1
    assert pace.way == 1
    assert Pace().back(begun, None).way < 1  # a step as long as there is does not do


def test_what_is_left_of_the_way_falls_as_its_square() -> None:
    """Joint motions are as dear as what is left is long; the middle of three passes nearer leaves far less."""
    walker, begun, _ = started("human-ball-far")
    found: list[float] = []
    best = begun
    for _ in range(4):
        _, after = walker._passed(best, Pace())
        assert after is not None
        best = after
        found.append(best.behind)
    assert found[3] < 0.1 * found[2]
    assert found[2] < walk.NEAR_BY


def test_what_forces_do_between_the_knots_is_not_asked_for_in_vain() -> None:
    """A push that begins and ends with a step: asked for from the start, what bends led to no plan at all."""
    problem = load_problem("human-ball-5")
    share = problem.task.duration / 10
    push = Push(
        force=0.5, direction=(0.3, 1, -0.5), point=(0, 0.005, 0.01), profile="step", start=3 * share, end=5 * share
    )
    outcome = plan(problem.grasp, problem.task.replace(loads=[*problem.task.loads, push]))
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    assert outcome.between.excess <= 0
    assert outcome.passes <= 12  # with a full step at the beginning of each round it took 38


def test_another_round_of_passes_begins_with_a_step_like_the_last() -> None:
    _, begun, _ = started("dlr-ball-move", "task.knots=9")
    assert begun.pace.again == Pace()
    again = Pace(step=0.1, way=0.1, tries=1, stays=True).again
    assert 0.1 < again.step < 1
    assert (again.way, again.tries, again.stays) == (1.0, 0, False)
