"""How far numbers may go: closed forms, plans on one side and proofs on the other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_grasps import pinch
from too_much import with_plan

import synergrip as sg
from synergrip.changes.asked import Asked
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.linalg import frozen
from synergrip.margin.direct import wanted
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.margins import margins
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import TimedTask, still

MU, LOAD, CAP = 0.4, 3.0, 6.0
TIME = frozen([0.0])
CARRY = TimedTask(
    TIME, frozen([[0.0, 0.0, -LOAD, 0.0, 0.0, 0.0]]), still(TIME), 0.0, (NormalForce(upper=CAP),), (LeastEffort(),)
)
"""Two fingers carry a load between them, half of it each."""
NAMES = (
    "critical_friction_scale", "heaviest_kg", "load_factor", "least_peak_N", "least_effort", "shortest_duration_s",
    "largest_amplitude",
)  # fmt: skip
CLOSED = {
    "critical_friction_scale": LOAD / (2 * CAP) / MU, "load_factor": 2 * MU * CAP / LOAD,
    "least_peak_N": LOAD / (2 * MU), "least_effort": LOAD / MU,
}  # fmt: skip


def found(grasp: sg.Grasp, task: TimedTask, **options: object) -> Margins:
    answer = margins(grasp, task, **{"only": list(NAMES), **options})  # type: ignore[arg-type]
    assert isinstance(answer, Margins)
    return answer


@pytest.mark.parametrize("name", CLOSED)
def test_a_pinch_goes_as_far_as_its_closed_form(name: str) -> None:
    number = found(pinch(MU), CARRY, only=[name]).direct[name]
    assert number.value == pytest.approx(CLOSED[name], rel=1e-4)
    assert number.lower is not None
    assert number.upper is not None
    assert number.lower <= CLOSED[name] <= number.upper
    assert number.upper / number.lower < 1.0021
    assert number.proven


def test_what_there_is_not_says_why() -> None:
    direct = found(pinch(MU), replace(CARRY, limits=())).direct
    assert list(direct) == [each.name for each in wanted(Asked(pinch(MU), CARRY), some_plan())]
    for name in ("heaviest_kg", "shortest_duration_s", "largest_amplitude", "load_factor"):
        assert (direct[name].value, direct[name].proven) == (None, False)
        assert direct[name].why


def some_plan() -> Plan:
    made = plan(pinch(MU), CARRY)
    assert isinstance(made, Plan)
    return made


def both_sides(asked: Asked, made: Plan, number: DirectNumber) -> tuple[object, object]:
    """What planning says of the attained value, and of the end that is proven."""
    of = next(each for each in wanted(asked, made) if each.name == number.name)
    assert of.dial is not None
    assert number.value is not None
    end = number.upper if number.value == number.lower else number.lower
    assert end is not None
    return of.dial.turned(number.value * of.per).outcome(), of.dial.turned(end * of.per).outcome()


def number_plan(number: DirectNumber) -> Plan:
    assert number.plan is not None
    return number.plan


@pytest.mark.parametrize("seed", range(6))
def test_there_is_a_plan_at_the_value_and_none_at_the_proven_end(seed: int) -> None:
    rng = np.random.default_rng([5, seed])
    question = next(each for each in (with_plan(rng, "force_cap") for _ in range(20)) if each is not None)
    answer = found(*question)
    asked = Asked.of(answer.plan.grasp, question[1], answer.plan.task)
    numbers = [each for each in answer.direct.values() if each.proven]
    assert len(numbers) >= 3
    for number in numbers:
        yes, no = both_sides(asked, answer.plan, number)
        assert isinstance(yes, Plan), number.name
        assert isinstance(no, Infeasible), number.name


def test_a_hand_says_what_it_attains_at_its_true_equilibria() -> None:
    problem = sg.load_problem("gripper-peg")
    answer = margins(problem.grasp, problem.task, only=["heaviest_kg", "largest_amplitude"])
    assert isinstance(answer, Margins)
    assert answer.linear is not None
    for number in answer.direct.values():
        again = sg.load_problem("gripper-peg", [number.setting])
        assert isinstance(sg.plan(again.grasp, again.task), Plan)
        assert number_plan(number).executed is not None
        assert number.value == number.lower
    assert answer.measures["slip margin"].worst.value == pytest.approx(answer.plan.margins.min())


def test_where_there_is_no_plan_the_answer_is_that() -> None:
    answer = margins(pinch(MU), replace(CARRY, limits=(NormalForce(upper=1.0),)))
    assert isinstance(answer, Infeasible)


def test_an_interrupt_keeps_the_finished_numbers() -> None:
    def stop(number: DirectNumber) -> None:
        if number.name == "load_factor":
            raise KeyboardInterrupt

    answer = found(pinch(MU), CARRY, heard=stop)
    assert answer.interrupted
    assert list(answer.direct) == ["critical_friction_scale", "heaviest_kg", "load_factor"]


def test_a_number_that_is_none_is_refused_by_name() -> None:
    with pytest.raises(sg.InputError, match="heaviest_kg"):
        margins(pinch(MU), CARRY, only=["heaviest"])


@pytest.mark.parametrize(
    "overrides",
    [
        ("limits.margin=1.103 N", "task.load_factor=0.961", "task.motion_factor=0.5"),
        ('task.palm={axis="x",turn="90 deg",shift=["0 mm","0 mm","200 mm"],inertia=true}',),
    ],
)
def test_what_a_hand_attains_can_be_typed_in(overrides: tuple[str, ...]) -> None:
    """Also a bound on forces that the plan without it uses wholly."""
    problem = sg.load_problem("gripper-box", overrides)
    answer = margins(problem.grasp, problem.task, only=["least_peak_N", "least_effort"])
    assert isinstance(answer, Margins)
    for number in answer.direct.values():
        assert number.value is not None
        again = sg.load_problem("gripper-box", [*overrides, number.setting])
        assert isinstance(sg.plan(again.grasp, again.task), Plan), number.setting


def test_a_least_force_that_binds_is_where_a_cap_ends() -> None:
    grasp, task = pinch(MU), replace(CARRY, limits=(NormalForce(lower=5.0, upper=8.0),))
    number = found(grasp, task, only=["least_peak_N"]).direct["least_peak_N"]
    assert number.value == pytest.approx(5.0, rel=1e-4)


def test_factors_are_those_of_what_is_asked() -> None:
    half = sg.load_problem("tripod", ["task.load_factor=0.5", "grasp.friction_factor=0.5"])
    direct = found(half.grasp, half.task, only=["load_factor", "critical_friction_scale"]).direct  # type: ignore[arg-type]
    assert direct["load_factor"].value == pytest.approx(8.0, rel=1e-3)
    assert direct["load_factor"].setting == "task.load_factor=3.9999"
    assert direct["critical_friction_scale"].value == pytest.approx(0.125, rel=1e-3)


def test_a_plan_that_was_interrupted_stops_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    made = some_plan()
    monkeypatch.setattr("synergrip.changes.asked.planned_with", lambda *rest: replace(made, interrupted=True))
    answer = found(pinch(MU), CARRY)
    assert answer.interrupted
    assert answer.direct == {}
