"""What the short form of a no on a hand that moves takes: how many passes, where they begin, what they ask for."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import pytest

import synergrip as sg
import synergrip.changes.least_change as changing
import synergrip.explain.repairs as repairing
from synergrip.changes.asked import Asked, Posed
from synergrip.changes.least_change import LeastChange, least_change
from synergrip.changes.turning import dials
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.explain.repairs import AROUND, ENOUGH, repaired
from synergrip.planning.pace import SHORT, Effort
from synergrip.planning.planning import planned_with
from synergrip.reports.data.json_no import repair_document
from synergrip.reports.text.text_no import more_lines

PASSES, MANY_PASSES = 12, 4


@pytest.fixture(scope="module")
def hold() -> sg.Plan:
    problem = sg.load_problem("barrett-ball-hold", "task.knots=2")
    plan = sg.plan(problem.grasp, problem.task)
    assert isinstance(plan, sg.Plan)
    return plan


@pytest.fixture(scope="module")
def no() -> sg.Infeasible:
    problem = sg.load_problem("barrett-ball-hold", 'limits.normal_force="8 N"')
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Infeasible)
    return answer


@pytest.fixture(scope="module")
def posed(no: sg.Infeasible) -> Posed:
    found = Asked.of(no.grasp, no.asked or no.task, no.task).posed(no.analysis)
    assert found is not None
    return found


@dataclass
class Planning:
    """Stands for planning: what it says of one value after the other."""

    says: list[sg.Plan | sg.Unknown]
    efforts: tuple[Effort, ...] = ()
    values: tuple[float, ...] = ()

    def __call__(self, dial: Any, value: float, effort: Effort) -> sg.Plan | sg.Unknown:
        self.efforts, self.values = (*self.efforts, effort), (*self.values, value)
        return self.says[len(self.efforts) - 1]


def _in_vain(plan: sg.Plan) -> sg.Unknown:
    return sg.Unknown(
        plan.task, plan.analysis, "in vain", plan.decisions, "execution", executed=plan.executed, passes=MANY_PASSES
    )


def _searched(planning: Planning, posed: Posed, no: sg.Infeasible, patch: pytest.MonkeyPatch) -> list[repairing.Repair]:
    asked = Asked.of(no.grasp, no.asked or no.task, no.task)
    numbers = [
        each for each in dials(asked, no.task, posed.analysis) if each.cause in ("force_cap", "load", "friction")
    ]
    patch.setattr(repairing, "outcome_at", planning)
    each = [LeastChange(dial, dial.easier(dial.value, 0.5 * dial.value), proven=True) for dial in numbers]
    return list(repaired(each, posed, prove=False, effort=SHORT, passes=PASSES))


def test_after_twelve_passes_the_others_are_told_as_not_tried(
    hold: sg.Plan, no: sg.Infeasible, posed: Posed, monkeypatch: pytest.MonkeyPatch
) -> None:
    vain, planning = _in_vain(hold), Planning([_in_vain(hold)] * 9)
    found = _searched(planning, posed, no, monkeypatch)
    assert [each.tried for each in found] == [True, False, False]
    assert not any(each.verified for each in found)
    assert len(planning.values) == PASSES // (AROUND + vain.passes) == len(ENOUGH)
    assert [each.passes for each in planning.efforts] == [SHORT.passes, PASSES - 2 * AROUND - MANY_PASSES]
    assert [repair_document(each)["tried"] for each in found] == [True, False, False]
    text = "\n".join(more_lines(replace(no.explanation, repairs=tuple(found)), no.task.times, lambda key: ""))
    assert text.count("not tried") == 3  # two rows, and what is said of them
    assert "--set" not in text


def test_changes_begin_where_the_first_ended_and_from_a_plan_on_where_the_last_one_did(
    hold: sg.Plan, no: sg.Infeasible, posed: Posed, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = replace(hold, passes=0)
    planning = Planning([replace(_in_vain(hold), passes=1), replace(plan, executed=no_execution(hold)), plan, plan])
    found = _searched(planning, posed, no, monkeypatch)
    assert [each.verified for each in found] == [True, True, True]
    first, second, third, last = (each.near for each in planning.efforts)
    assert first is None
    assert second is hold.executed
    assert third is planning.says[1].executed is not second
    assert last is hold.executed


def no_execution(plan: sg.Plan) -> Any:
    assert plan.executed is not None
    return replace(plan.executed, iterations=plan.executed.iterations + 1)


def test_a_first_change_in_vain_leaves_the_larger_value_alone_to_the_others(
    hold: sg.Plan, no: sg.Infeasible, posed: Posed, monkeypatch: pytest.MonkeyPatch
) -> None:
    planning = Planning([replace(_in_vain(hold), passes=0)] * 9)
    first, *others = _searched(planning, posed, no, monkeypatch)
    assert len(planning.values) == len(ENOUGH) + len(others)
    assert first.least is not None
    assert planning.values[:2] == tuple(pytest.approx(first.least * (1 + share), rel=1e-4) for share in ENOUGH)
    for value, other in zip(planning.values[2:], others, strict=True):
        assert abs(value / other.least - 1) == pytest.approx(ENOUGH[-1], rel=1e-3)


def test_a_brief_plan_that_begins_near_by_holds_and_is_found_sooner() -> None:
    problem = sg.load_problem("barrett-ball-hold")
    begun = planned_with(SHORT, problem.grasp, problem.task)
    assert isinstance(begun, sg.Plan)
    again = planned_with(replace(SHORT, near=begun.executed), problem.grasp, problem.task)
    assert isinstance(again, sg.Plan)
    assert all(check.passed for check in again.checks)
    assert again.passes <= begun.passes


def test_a_brief_plan_asks_for_the_first_goal_alone_until_it_is_true() -> None:
    problem = sg.load_problem("robonaut-handle", "contacts.friction_factor=0.477")
    plan = planned_with(SHORT, problem.grasp, problem.task)
    assert isinstance(plan, sg.Plan)
    assert all(check.passed for check in plan.checks)
    assert plan.decisions[-1].goal == LargestMargin().name


def test_a_walk_with_too_small_a_largest_margin_is_given_up_where_it_arrives() -> None:
    problem = sg.load_problem("robonaut-handle", "limits.margin=4.32 N")
    answer = planned_with(SHORT, problem.grasp, problem.task)
    assert isinstance(answer, sg.Unknown)
    assert answer.why.startswith("along the motion the largest slip margin is less than the 4.32 N asked")
    assert 0 < answer.passes <= SHORT.passes


def test_an_end_without_a_plan_settles_a_number_with_one_program(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = sg.load_problem("robonaut-handle-eigengrasps", "limits.synergy_acceleration=0.01")
    no = sg.plan(problem.grasp, problem.task)
    assert isinstance(no, sg.Infeasible)
    asked = Asked.of(no.grasp, no.asked or no.task, no.task)
    posed = asked.posed(no.analysis)
    assert posed is not None
    (dial,) = (each for each in dials(asked, no.task, posed.analysis) if each.cause == "duration")
    values = []

    def decided_at(dial: Any, value: float, posed: Posed) -> Any:
        values.append(value)
        return decided(dial, value, posed)

    decided = changing.decided_at
    monkeypatch.setattr(changing, "decided_at", decided_at)
    found = least_change(dial, posed, posed.program())
    assert (found.value, found.proven) == (None, True)
    assert values == [pytest.approx(dial.end)]
