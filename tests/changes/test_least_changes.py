"""The least change of every number is what a model of its own finds, and what closed forms say."""

from __future__ import annotations

import numpy as np
import pytest
from judged_explanations import Count, judge, judge_refused, least_of
from named_goals import goals
from refused_tasks import REFUSED
from small_grasps import pinch
from too_much import altered

import synergrip as sg
from synergrip.changes.asked import Asked
from synergrip.changes.least_change import decided_at, least_change, row_ratios, turning_column
from synergrip.changes.turning import dials
from synergrip.conic.decide import Decision
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import TimedTask, still

MU, CAP, MARGIN, WEIGHT = 0.5, 6.0, 1.0, 5.0


def held_up(**changes: float) -> Infeasible:
    """A pinch that holds a weight W: each finger carries W / 2, and keeps mu n - W / 2 >= margin with n <= cap."""
    given = {"mu": MU, "cap": CAP, "margin": MARGIN, "weight": WEIGHT, **changes}
    times = frozen([0.0])
    wrench = frozen([[0.0, 0.0, -given["weight"], 0.0, 0.0, 0.0]])
    task = TimedTask(
        times, wrench, still(times), given["margin"], (NormalForce(upper=given["cap"]),), goals("effort")
    )  # fmt: skip
    no = plan(pinch(given["mu"]), task)
    assert isinstance(no, Infeasible)
    return no


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("margin", MU * CAP - WEIGHT / 2), ("force_cap", (MARGIN + WEIGHT / 2) / MU),
        ("load", 2 * (MU * CAP - MARGIN) / WEIGHT), ("friction", (MARGIN + WEIGHT / 2) / CAP),
    ],
)  # fmt: skip
def test_a_pinch_in_closed_form(name: str, expected: float) -> None:
    change = dict(least_of(held_up()))[name]
    assert change.value == pytest.approx(expected, rel=5e-5 if name == "friction" else 1e-7)
    assert change.proven


def test_the_smallest_change_is_named_first() -> None:
    """Friction 0.5 -> 0.5833 and the cap 6 -> 7 N are as large as each other: what the user states comes first."""
    no = held_up()
    assert [repair.cause for repair in no.explain().repairs] == ["force_cap", "friction", "load", "margin"]
    assert no.explanation.cause == "force_cap"
    assert [repair.to for repair in no.explain().repairs[:2]] == pytest.approx([7.0, 3.5 / 6], rel=1e-4)


@pytest.mark.parametrize(
    ("number", "draw"), [("torque", 0), ("rate", 3), ("joint_range", 2), ("drift", 6), ("load", 2)]
)
def test_a_second_model_finds_the_same(number: str, draw: int) -> None:
    """Of tasks in which the altered number is the one that must change least."""
    count, question = Count(), altered(np.random.default_rng([11, draw]), number)
    assert question is not None
    assert list(judge(question, number, count)) == []
    assert count.smallest == count.first == 1
    assert count.compared >= 1


@pytest.mark.parametrize("cause", list(REFUSED))
def test_what_is_refused_before_any_program(cause: str) -> None:
    count = Count()
    for draw in range(3):
        assert list(judge_refused(cause, np.random.default_rng([5, draw]), count)) == []
    assert count.first == count.tasks > 0


@pytest.mark.parametrize("number", ["torque", "rate", "load", "margin", "joint_range"])
def test_rows_turn_with_a_number_as_far_as_it_goes(number: str) -> None:
    """What is added to b for each turn is what the program with another value has, at other values than were tried."""
    question = next(q for q in (altered(np.random.default_rng([3, draw]), number) for draw in range(20)) if q)
    no = plan(*question)
    assert isinstance(no, Infeasible)
    asked = Asked.of(no.grasp, no.task, no.task)
    posed = asked.posed(no.analysis)
    assert posed is not None
    program = posed.program()
    dial = next(each for each in dials(asked, no.task, posed.analysis) if each.cause == number)
    column = turning_column(dial, posed, program)
    assert column is not None
    sign = 1.0 if dial.eased == "up" else -1.0
    for turn in (0.1, 0.6):
        other = dial.turned(dial.value + sign * turn * dial.value).posed(posed.analysis, posed.formulation.units)
        assert other is not None
        ratios = row_ratios(program, other.program())
        assert ratios is not None
        np.testing.assert_allclose(other.program().b / ratios, program.b + turn * column, atol=1e-9)
    assert least_change(dial, posed, program).value is not None


def test_the_margin_stays_while_a_cap_is_turned() -> None:
    """Of a task at knots, where the margin is an argument of its own and none of the limits."""
    no = held_up()
    asked = Asked.of(no.grasp, no.task, no.task)
    assert no.analysis is not None
    cap = next(each for each in dials(asked, no.task, no.analysis) if each.cause == "force_cap")
    assert cap.turned(7.5).timed.margin == MARGIN


def of_problem(name: str, cause: str, *overrides: str) -> tuple[float | None, Decision | None]:
    """The least change of a number, and what the program says a little beyond it."""
    problem = sg.load_problem(name, overrides)
    no = sg.plan(problem.grasp, problem.task)
    assert isinstance(no, Infeasible)
    asked = Asked.of(no.grasp, problem.task, no.task)
    posed = asked.posed(no.analysis)
    assert posed is not None
    dial = next(each for each in dials(asked, no.task, posed.analysis) if each.cause == cause)
    found = least_change(dial, posed, posed.program())
    assert found.value is not None
    return found.value, decided_at(dial, found.value * (1 + 1e-4 if dial.eased == "up" else 1 - 1e-4), posed)


def test_rows_that_rounding_alone_ties_to_unknowns_are_no_measure_of_others() -> None:
    """One weak actuator: a third of the load is what it carries."""
    value, beyond = of_problem("tripod", "load", "limits.actuator_effort=[10,1,10,10]", 'goal={minimise="effort"}')
    assert value == pytest.approx(1 / 3, rel=1e-6)
    assert beyond is not None
    assert beyond.acceptable


def test_rows_that_see_no_unknown_and_have_the_number_as_their_unit_are_not_affine_in_it() -> None:
    """The sag of the pinch under its load is 1 mm, whatever is done."""
    value, beyond = of_problem("pinch-soft", "drift", 'limits.drift="0.05 mm"', 'limits.margin_angle="15 deg"')
    assert value == pytest.approx(1e-3, rel=1e-4)
    assert beyond is not None
    assert beyond.acceptable
