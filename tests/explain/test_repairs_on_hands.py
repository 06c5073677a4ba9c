"""Repairs that can be typed in: on a hand that moves, of synergies as a whole set, of control, of knots, of samples."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

import synergrip as sg
import synergrip.explain.explained as explaining
import synergrip.explain.repairs as repairing
from synergrip.changes.asked import Asked
from synergrip.changes.least_change import least_change
from synergrip.changes.turning import dials, knots_dial
from synergrip.explain.along import more_knots
from synergrip.explain.explanation import Explanation
from synergrip.explain.repairs import MORE, NEAR, Repair, repaired
from synergrip.explain.synergies.brief_judge import briefly
from synergrip.explain.synergies.missing_synergies import missing_synergies
from synergrip.explain.words import nearer
from synergrip.planning.planning import plan_of_start_posture
from synergrip.reports.text.screen import Screen, shown_on
from synergrip.reports.text.text_no import more_lines
from synergrip.reports.text.text_plan import verdict_lines

TIGHT = 'limits.normal_force="8 N"'


def refused(name: str, *overrides: str) -> sg.Infeasible:
    problem = sg.load_problem(name, overrides)
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Infeasible)
    return answer


@dataclass
class Tries:
    """Stands for planning: a plan at and beyond a value, none short of it."""

    needed: float
    plan: sg.Plan
    stop_at: int = 10**6
    values: tuple[float, ...] = ()

    def __call__(self, dial: Any, value: float, effort: Any) -> sg.Plan | None:
        self.values = (*self.values, value)
        if len(self.values) == self.stop_at:
            raise KeyboardInterrupt
        return self.plan if value >= self.needed else None


@pytest.fixture(scope="module")
def capped() -> Callable[..., tuple[list[Repair], Tries, float]]:
    """Return what a search says of a cap of which planning needs some share more than the start posture does."""
    answer = refused("barrett-ball-hold", TIGHT)
    asked = Asked.of(answer.grasp, answer.asked or answer.task, answer.task)
    posed = asked.posed(answer.analysis)
    assert posed is not None
    (dial, *_) = (each for each in dials(asked, answer.task, posed.analysis) if each.cause == "force_cap")
    change = least_change(dial, posed, posed.program())
    assert change.value is not None
    least, plan = change.value, sg.plan(*_hold())
    assert isinstance(plan, sg.Plan)

    def search(share: float, *, prove: bool = True, stop_at: int = 10**6) -> tuple[list[Repair], Tries, float]:
        tries, found = Tries(least * (1 + share), plan, stop_at), list[Repair]()
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(repairing, "outcome_at", tries)
            patch.setattr(repairing, "short_of", lambda *_: False)
            with suppress(KeyboardInterrupt):
                repaired_one_by_one = repaired([change], posed, prove=prove)
                while (repair := next(repaired_one_by_one, None)) is not None:
                    found.append(repair)
        return found, tries, least

    return search


def _hold() -> tuple[sg.Grasp, sg.Task]:
    problem = sg.load_problem("barrett-ball-hold", "task.knots=2")
    return problem.grasp, problem.task


@pytest.mark.parametrize("share", [0.001, 0.03, 0.13, 0.4, 0.9])
def test_on_a_hand_a_value_is_told_with_one_in_vain_near_it(capped: Any, share: float) -> None:
    (repair,), tries, least = capped(share)
    assert repair.verified
    assert repair.to >= tries.needed > repair.in_vain
    assert repair.to / repair.in_vain - 1 < NEAR * 1.03
    assert repair.least == pytest.approx(least)
    assert repair.in_vain in tries.values
    assert len(tries.values) <= len(MORE) + 5


@pytest.mark.parametrize("share", [0.001, 0.015, 0.05, 0.09])
def test_the_long_form_tells_no_more_than_the_short_one(capped: Any, share: float) -> None:
    (short,), (long,) = capped(share, prove=False)[0], capped(share)[0]
    assert short.verified
    assert long.to <= short.to
    assert "none was found" in nearer(long)


def test_what_the_start_posture_takes_is_told_alone_where_it_does(capped: Any) -> None:
    (repair,), _, _ = capped(0.0)
    assert repair.in_vain is None
    assert nearer(repair) == ""


def test_an_interrupt_while_values_are_narrowed_keeps_the_one_with_a_plan(capped: Any) -> None:
    before, after = capped(0.4, stop_at=5)[0], capped(0.4, stop_at=7)[0]
    assert before == []
    assert [each.verified for each in after] == [True]


def test_what_plan_says_of_a_hand_names_the_start_posture_and_where_more_is_looked_for() -> None:
    no = refused("barrett-ball-hold", TIGHT)
    text = " ".join("\n".join(more_lines(no.explanation, no.task.times, lambda key: "")).split())
    assert "the linear model of the start posture takes friction 0.66" in text
    assert "synergrip explain tries values between" in text


def told_of(no: sg.Infeasible | sg.Unknown, found: Explanation | None = None) -> str:
    """Return the text where every row and sentence has a line."""
    with shown_on(Screen(250)):
        return "\n".join(more_lines(found or no.explanation, no.task.times, lambda key: ""))


def test_where_no_change_has_a_plan_the_head_does_not_promise_help_and_gives_the_command() -> None:
    """Keys on the command line are told as such, as they can be pasted."""
    problem = sg.load_problem("pinch-soft", ["limits.margin=12 N", "task.knots=3"])
    no = sg.plan(problem.grasp, problem.task)
    assert isinstance(no, sg.Infeasible)
    found = no.explanation
    vain = replace(found, repairs=tuple(replace(each, verified=False, outcome=None) for each in found.repairs))
    with shown_on(Screen(250)):
        told = "\n".join(verdict_lines(problem, no, known=vain))
        helped = "\n".join(verdict_lines(problem, no))
    command = "synergrip explain pinch-soft --set 'limits.margin=12 N' --set task.knots=3"
    assert f"\nNo change that was tried has a plan yet; more are tried by\n  {command}\n" in told
    assert "What would help" not in told
    assert "What would help" in helped
    assert command not in helped
    wider = replace(found.repairs[0], cause="joint_range", key="limits.joint_range")
    with shown_on(Screen(250)):
        ranges = "\n".join(verdict_lines(problem, no, known=replace(found, others=(wider,))))
    assert ranges.count("mechanical stops do not widen") == 1
    assert "mechanical stops" not in helped
    assert re.search(r"limits.margin .* --set 'limits.margin=12 N' on the command line\n", told)


def test_what_is_known_of_the_start_posture_alone_says_so_where_the_hand_moves() -> None:
    """Two fingers draw a box in farther than they bend: with 0.8 of the way there is a plan, also after t = 1 s."""
    far = 'task.move=[{axis="z",lift="-35 mm"}]'
    problem = sg.load_problem("gripper-box-draw", [far, "task.knots=21"])
    no = sg.plan(problem.grasp, problem.task)
    assert isinstance(no, sg.Unknown)
    assert no.reached is not None
    assert no.reached.off_m is None  # ranges of joints are in the way, and no tolerance is tried
    found, text = no.explanation, told_of(no)
    assert "tolerance" not in {each.cause for each in (*found.repairs, *found.others)}
    assert (found.when.alone, found.when.scope) == (True, "start")
    where = next(line for line in text.splitlines() if line.startswith("Where"))
    assert ": in the linear model of the start posture none of these instants has a plan" in where
    head = next(line for line in text.splitlines() if line.startswith("No help"))
    assert (
        head
        == "No help in the linear model of the start posture, whatever the value (proven; not of the hand that moves)"
    )
    assert "margin" in found.cannot_help
    matrices = told_of(refused("tripod", 'limits.normal_force="1 N"'))
    assert ": none of these instants has a plan even by itself" in matrices
    assert "\nNo help  proven of the linear model" in matrices


def test_what_a_plan_was_found_with_is_not_among_what_cannot_help(monkeypatch: pytest.MonkeyPatch) -> None:
    """Be it of the hand that moves, and proven not to help at its start posture."""
    problem = sg.load_problem("gripper-box-draw", ['task.move=[{axis="z",lift="-35 mm"}]', "task.knots=5"])
    no = sg.plan(problem.grasp, problem.task)
    assert isinstance(no, sg.Unknown)
    plain = no.explanation
    assert "load" in plain.cannot_help
    other = replace(plain.repairs[0], cause="load", key="object.mass", verified=True)
    monkeypatch.setattr(explaining, "_tried", lambda *_, **__: ([other], False))
    found = explaining.explained(no, short=True)
    assert [each.cause for each in found.others] == ["load"]
    assert found.cannot_help == tuple(cause for cause in plain.cannot_help if cause != "load")


def test_a_tolerance_is_told_without_a_share_that_is_none() -> None:
    far = sg.load_problem("barrett-ball-roll", "task.motion_factor=3")
    no = sg.plan(far.grasp, far.task)
    assert isinstance(no, sg.Unknown)
    row = next(line for line in told_of(no).splitlines() if line.startswith("task.tolerance"))
    assert re.split(r"  +", row) == [
        "task.tolerance",
        "0 mm",
        "0.77 mm",
        "a plan",
        "--set 'task.tolerance=\"0.77 mm\"'",
    ]


def test_a_set_of_the_hand_is_told_where_no_columns_can_be_typed_in() -> None:
    few = ('hand.synergies="eigengrasps"', "limits.actuator_effort=10", "task.knots=3")
    missing = missing_synergies(refused("dlr-ball-move", *few), most=1, judge=plan_of_start_posture)
    told = [each for each in missing.candidates if each.whole]
    assert [(each.set, each.verdict, each.setting) for each in told] == [
        ("actuators", "feasible", 'hand.synergies="actuators"')
    ]
    problem = sg.load_problem("dlr-ball-move", [*few, told[0].setting])
    assert plan_of_start_posture(problem.grasp, problem.task).verdict == "feasible"


def test_a_set_of_the_hand_is_told_where_more_is_to_be_controlled() -> None:
    few = ("hand.synergies=4", "task.control={forces=5}", "task.knots=3")
    missing = refused("human-glass", *few).explain().missing_synergies
    assert missing is not None
    (told,) = missing.candidates
    assert (told.whole, told.setting) == (True, 'hand.synergies="santello"')
    problem = sg.load_problem("human-glass", [*few, told.setting])
    assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


def test_the_first_entry_is_what_is_blamed_and_what_has_no_plan_has_no_set(capped: Any) -> None:
    no = refused("pinch-soft", "limits.margin=12 N")
    first, *others = no.explanation.repairs
    (unplanned,) = capped(5.0)[0]
    found = replace(no.explanation, repairs=(replace(first, verified=False, outcome=None), *others))
    rows = told_of(no, found).split("What would help")[1].splitlines()[2:]
    assert rows[0].startswith(first.key)
    assert "--set" not in rows[0]
    assert "--set" in rows[1]
    assert not unplanned.verified


@pytest.mark.parametrize(
    ("asked", "less"),
    [
        ("{forces=9}", "{ forces = 2 }"),
        ('{forces=1,motions=["z","rx"],reconfiguration=1}', '{ forces = 1, motions = ["z"] }'),
    ],
)
def test_what_the_synergies_control_of_what_is_asked_for_is_a_repair(asked: str, less: str) -> None:
    found = refused("tripod", f"task.control={asked}").explanation
    assert [(each.set, each.verified) for each in found.repairs] == [(f"task.control={less}", True)]
    assert found.repairs[0].cause == found.cause
    problem = sg.load_problem("tripod", found.repairs[0].set)
    assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


def test_more_knots_are_among_those_that_there_are_and_can_be_typed_in() -> None:
    problem = sg.load_problem("barrett-ball-hold", "task.knots=3")
    asked = Asked(problem.grasp, problem.task)
    (repair,) = more_knots(asked, lambda each: None)
    assert (repair.set, repair.was, repair.verified) == ("task.knots=5", 3.0, True)
    more = sg.load_problem("barrett-ball-hold", repair.set).timed
    assert set(np.round(problem.timed.times, 12)) <= set(np.round(more.times, 12))
    assert knots_dial(Asked(problem.grasp, problem.timed)) is None


def test_what_clashes_most_is_the_cause_where_nothing_helps_alone() -> None:
    found = refused("pinch-soft", 'limits.normal_force="0.5 N"', "limits.joint_torque=0.01").explanation
    assert (found.repairs, found.cause) == ((), "force_cap")


def test_sizes_of_samples_are_numbers_that_can_be_smaller_on_a_hand() -> None:
    sizes = 'allow.scenarios={position="1 mm",normal="3 deg"}'
    problem = sg.load_problem("gripper-box", sizes)
    asked = Asked.of(problem.grasp, problem.task, problem.timed, scenarios=True)
    analysis = sg.analyse(problem.grasp)
    found = {each.key: each for each in dials(asked, problem.timed, analysis)}
    dial = found["allow.scenarios.position"]
    assert "allow.scenarios.normal" in found
    assert "allow.scenarios.compliance" not in found
    half = sg.load_problem("gripper-box", [sizes, dial.set(5e-4)]).task.allow
    assert half is not None
    assert half.scenarios == dial.turned(5e-4).task.allow.scenarios  # type: ignore[union-attr]
    assert not dial.nested


@pytest.mark.parametrize(
    "overrides", [(), ('hand.synergies="all"',), ('hand.synergies="all"', 'limits.margin="0.1 N"')]
)
def test_the_brief_judge_says_what_planning_at_the_start_posture_says(overrides: tuple[str, ...]) -> None:
    problem = sg.load_problem("barrett-ball-lift", [*overrides, 'task.linearise="once"'])
    timed = replace(problem.timed, linearise="once")
    assert briefly(problem.grasp, timed).verdict == plan_of_start_posture(problem.grasp, timed).verdict
