"""First passes at some of the knots lead to the same plan as passes over all of them, in fewer of these."""

from __future__ import annotations

import numpy as np
import pytest

from synergrip import Plan, load_problem
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.linalg import Array
from synergrip.planning import beginning, fewer_knots
from synergrip.planning.executing import Executor
from synergrip.planning.fewer_knots import FewerKnots, _cubics
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk

AT_41 = "task.knots=41"


def planned(name: str, *overrides: str) -> Plan:
    problem = load_problem(name, [AT_41, *overrides])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    return answer


def walker(name: str, *overrides: str) -> tuple[Walker, Plan]:
    """Return who walks a task, and the plan of the start posture."""
    problem = load_problem(name, overrides)
    linear = plan_of_start_posture(problem.grasp, problem.task)
    assert isinstance(linear, Plan)
    return Walker(linear.task, linear.analysis, Executor.of(linear.analysis, linear.task), SOLVERS["clarabel"]), linear


@pytest.mark.parametrize("name", ["human-ball-far", "dlr-ball-turn"])
def test_they_lead_to_the_same_plan_in_fewer_passes(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By all goals: forces where these settle them, and what is squeezed at all."""
    ours = planned(name)
    monkeypatch.setattr(fewer_knots, "WORTH", 0.0)
    theirs = planned(name)
    assert theirs.first_passes is None
    assert ours.first_passes is not None
    assert ours.passes <= 2 < theirs.passes + 1
    efforts = [float((each.forces**2).sum()) for each in (ours, theirs)]
    assert efforts[0] == pytest.approx(efforts[1], rel=2e-4)
    assert np.allclose(ours.forces, theirs.forces, rtol=0, atol=2e-3 * np.abs(theirs.forces).max())
    decisions = len(ours.decisions) - len(theirs.decisions)
    assert decisions == 0, "the last pass alone gives the decisions of a plan"


def test_what_leads_nowhere_is_told_and_costs_no_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    theirs = planned("human-ball")
    monkeypatch.setattr(FewerKnots, "at_all_knots", lambda *_: None)
    ours = planned("human-ball")
    assert ours.first_passes == theirs.first_passes
    assert ours.passes > theirs.passes


def test_knots_at_corners_are_among_them() -> None:
    """Of a load that has a corner at every knot all would be, so that there are none."""
    whole, _ = walker("human-ball", "task.knots=401")
    fewer = FewerKnots.of(whole)
    assert fewer is not None
    assert whole.task.course is not None
    inside = whole.task.course.marks.corners
    times = whole.task.times[fewer.knots[fewer.corners]]
    assert all(np.abs(times - corner).min() < 1e-9 for corner in inside[inside <= times[-1]])
    assert {0.0, whole.task.times[-1]} <= set(times)
    assert len(fewer.knots) < 30
    assert FewerKnots.of(walker("human-ball")[0]) is None, "of few knots none is left out"


def test_cubics_are_exact_for_parabolas_and_for_chords() -> None:
    known = np.array([0.0, 0.4, 0.5, 1.3, 2.0])
    times = np.linspace(0.0, 2.0, 41)

    def values(of: Array) -> Array:
        return np.stack([3 * of**2 - of + 1, -(of**2), 7 - of], axis=1)

    assert np.allclose(_cubics(known, values(known), times), values(times), rtol=0, atol=1e-12)
    ends = np.array([0.0, 2.0])
    assert np.allclose(_cubics(ends, values(ends)[:, 2:], times), values(times)[:, 2:], rtol=0, atol=1e-12)


def test_from_knot_to_knot_they_are_cubics_that_turn_at_corners() -> None:
    """What is known at some knots and has a corner at one of them is known at all, though it turns there at once."""
    whole, linear = walker("human-ball-far", AT_41)
    fewer = FewerKnots.of(whole)
    assert fewer is not None
    corner = int(fewer.knots[len(fewer.knots) // 2])
    fewer = FewerKnots(whole, fewer.knots, np.flatnonzero(np.isin(fewer.knots, [0, corner, fewer.knots[-1]])))
    places = np.arange(len(linear.time)) - corner
    kink = 1e-6 * np.outer(np.abs(places), np.ones(linear.dz_r.shape[1]))
    there = fewer.walker.executed((linear.dz_r + kink)[fewer.knots], None, linear.motion.at(fewer.knots))
    begun = fewer.at_all_knots(there, linear.dz_r)
    assert begun is not None
    assert np.allclose(begun.references, linear.dz_r + kink, rtol=0, atol=1e-12)


class Interrupted:
    """A solver that somebody interrupts at the third program along the motion: one pass has been made then."""

    def __init__(self) -> None:
        self.asked = 0

    def __call__(self, question: Question, program: Program, settings: Settings) -> Solution:
        self.asked += question.formulation.along_path
        if self.asked == 3:
            raise KeyboardInterrupt
        return SOLVERS["clarabel"](question, program, settings)


def test_an_interrupt_in_them_tells_how_far_they_had_come(monkeypatch: pytest.MonkeyPatch) -> None:
    problem, solver = load_problem("human-ball-far", [AT_41]), Interrupted()
    begun: list[Walk] = []
    made = beginning._on_from

    def kept(fewer: FewerKnots, there: Walk, smooth: Array) -> Walk | None:
        walk = made(fewer, there, smooth)
        begun.extend([] if walk is None else [walk])
        return walk

    monkeypatch.setattr(beginning, "_on_from", kept)
    with pytest.raises(KeyboardInterrupt, match=r"^after 1 pass along the motion, "):
        plan(problem.grasp, problem.task, solver)
    assert begun[0].interrupted
    assert len(begun[0].references) == 41


def test_an_interrupt_ends_it_where_not_all_knots_are_reached(monkeypatch: pytest.MonkeyPatch) -> None:
    problem, solver = load_problem("human-ball-far", [AT_41]), Interrupted()
    monkeypatch.setattr(FewerKnots, "at_all_knots", lambda *_: None)
    with pytest.raises(KeyboardInterrupt, match="does not get through all knots yet"):
        plan(problem.grasp, problem.task, solver)
    assert solver.asked == 3, "programs were asked for after the interrupt"
