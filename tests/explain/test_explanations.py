"""Why there is no plan: answers whose causes, instants and repairs are known in closed form."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import synergrip as sg
import synergrip.explain.refused as refusing
from synergrip.changes.asked import Asked
from synergrip.changes.least_change import least_change
from synergrip.changes.turning import dials
from synergrip.explain.clashing import clashing
from synergrip.explain.compromise import compromise
from synergrip.explain.pairs import GIVEN
from synergrip.explain.when import when
from synergrip.planning.planning import plan_of_start_posture
from synergrip.reports.data.json_no import no_document
from synergrip.reports.text.text_no import more_lines

PROBLEMS = Path(__file__).parents[2] / "problems"


def refused(name: str, *overrides: str) -> sg.Infeasible:
    problem = sg.load_problem(name, overrides)
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Infeasible)
    return answer


def by_cause(repairs: tuple[sg.Repair, ...]) -> dict[str, sg.Repair]:
    return {repair.cause: repair for repair in repairs}


def test_three_fingers_that_carry_a_newton_each_want_a_quarter_more_of_anything() -> None:
    """mu n = 1 N at n = 1 N and mu = 0.8: the cap, the friction or the load is off by 1.25, a tie in |ln|."""
    found = refused("tripod", 'limits.normal_force="1 N"').explain()
    repairs = by_cause(found.repairs)
    assert repairs["force_cap"].to == pytest.approx(1.25, rel=2e-4)
    assert repairs["friction"].to == pytest.approx(1.0, rel=4e-4)
    assert repairs["load"].to == pytest.approx(0.8, rel=2e-4)
    assert all(repair.verified and repair.proven for repair in found.repairs)
    assert found.cause == found.repairs[0].cause == "force_cap"  # of a tie the user's limit
    assert found.conflicts[0].key == "limits.normal_force"
    assert found.clashing == ("limits.normal_force",)


def test_the_weight_comes_on_within_a_fifth_of_a_second_and_with_it_the_no() -> None:
    late = refused("tripod", 'limits.normal_force="1 N"').when
    assert late.alone
    assert late.first_s == pytest.approx(0.2)
    assert np.allclose(late.intervals_s, [(0.2, 1.0)])


def test_rates_clash_with_steps_and_with_no_instant() -> None:
    answer = refused("tripod", "limits.synergy_rate=0.001", 'task.linearise="once"')
    assert answer.explanation.cause == "rate"
    assert not answer.when.alone
    assert answer.when.intervals_s == ()
    assert answer.when.first_s is not None


def test_what_is_told_can_be_typed_in_and_holds() -> None:
    changes = ["limits.margin=12 N"]
    for repair in refused("pinch-soft", *changes).repairs:
        problem = sg.load_problem("pinch-soft", [*changes, repair.set])
        assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


def test_no_load_helps_a_grasp_that_cannot_press_hard_enough_for_its_margin() -> None:
    found = refused("pinch-soft", "limits.margin=12 N").explanation
    assert found.cannot_help == ("load",)


def test_a_friction_cone_without_a_margin_is_called_one() -> None:
    keys = [conflict.key for conflict in refused("tripod", 'limits.normal_force="1 N"').conflicts]
    assert "friction cone" in keys
    assert "limits.margin" not in keys


def test_where_no_single_change_helps_pairs_do() -> None:
    """Weak joints and a low cap: each alone keeps the pinch from its margin."""
    overrides = ("limits.margin=8 N", 'limits.normal_force="2 N"', "limits.joint_torque=0.05")
    found = refused("pinch-soft", *overrides).explain()
    assert not any(repair.verified for repair in found.repairs)
    assert found.pairs
    for one, two in found.pairs:
        problem = sg.load_problem("pinch-soft", [*overrides, one.set, two.set])
        assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


@pytest.mark.parametrize(
    "given", ["grasp.friction_factor=0.5", 'grasp.friction_factor={"C1"=0.4,"C2"=0.5}', "grasp.friction_factor=0.7"]
)
def test_a_factor_that_is_there_already_is_in_the_one_that_is_told(given: str) -> None:
    """The factor of a file is replaced by the one that is typed in, and is not multiplied by it."""
    overrides = ('limits.normal_force="1 N"', given)
    found = [each for each in refused("tripod", *overrides).repairs if each.cause == "friction"]
    assert [each.verified for each in found] == [True]
    problem = sg.load_problem("tripod", [*overrides, found[0].set])
    assert sg.plan(problem.grasp, problem.task).verdict == "feasible"
    assert min(contact.friction for contact in problem.grasp.contacts) == pytest.approx(found[0].to, rel=1e-6)


def test_ranges_that_are_wider_already_are_in_what_is_told() -> None:
    far, wide = "task.motion_factor=2", "limits.joint_range={wider=0.5}"
    (dial,) = (
        sg.load_problem("gripper-box-draw", [far, wide])
        .task.limits[-1]
        .dials(sg.load_problem("gripper-box-draw", [far]).grasp)
    )
    assert (dial.value, dial.set(2.0)) == (pytest.approx(1.5), "limits.joint_range={ wider = 1 }")
    of_hand, again = (sg.load_problem("gripper-box-draw", [f"limits.joint_range={{wider={w}}}"]) for w in (1, 0.5))
    ends = [each.task.limits[-1] for each in (of_hand, again)]
    assert np.allclose(ends[0].upper, ends[1].dials(again.grasp)[0].turned(2.0).upper)


def test_ranges_of_the_hand_are_among_what_clashes() -> None:
    """They bind without being asked for; left out of a set of limits they must be let go."""
    problem = sg.load_problem("gripper-box-draw", ["task.motion_factor=3"])
    task = problem.task.timed(problem.grasp)
    asked = Asked.of(problem.grasp, problem.task, task)
    assert clashing(asked) == ("limits.joint_range",)


def test_a_tolerance_that_leaves_the_motion_undone_says_so() -> None:
    no = refused("barrett-ball-lift")
    text = "\n".join(more_lines(no.explanation, no.task.times, lambda key: ""))
    assert "99% of the motion undone" in text
    problem = sg.load_problem("barrett-ball-lift", [no.repairs[0].set])
    plan = sg.plan(problem.grasp, problem.task)
    assert isinstance(plan, sg.Plan)
    assert any("left undone" in note for note in plan.notes)


def test_two_limits_are_told_where_else_only_friction_helps() -> None:
    """A low cap and weak joints: friction helps alone, and so do both limits together."""
    overrides = ("limits.margin=1 N", 'limits.normal_force="1.2 N"', "limits.joint_torque=0.02")
    found = refused("pinch-soft", *overrides).explain()
    assert {each.cause for each in found.repairs if each.verified} <= set(GIVEN)
    one, two = found.pairs[0]
    assert {one.cause, two.cause} == {"force_cap", "torque"}
    problem = sg.load_problem("pinch-soft", [*overrides, one.set, two.set])
    assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


def test_a_motion_that_only_the_moving_hand_cannot_do_is_told_what_would_help() -> None:
    """The ball is to roll three times as far, farther than the fingers follow; what is typed in is planned."""
    far = "task.motion_factor=3"
    problem = sg.load_problem("barrett-ball-roll", [far])
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Unknown)
    found = answer.explanation
    assert [(each.cause, each.verified) for each in found.others] == [("tolerance", True), ("amplitude", True)]
    for each in found.others:
        problem = sg.load_problem("barrett-ball-roll", [far, each.set])
        assert sg.plan(problem.grasp, problem.task).verdict == "feasible"
    known, tolerance = answer.reached, found.others[0]
    assert known is not None
    assert known.off_m is not None
    assert tolerance.set == f'task.tolerance="{1e3 * tolerance.to:.2g} mm"'
    assert known.off_m <= tolerance.to <= 1.1 * known.off_m
    text = "\n".join(more_lines(found, answer.task.times, lambda key: ""))
    assert text.startswith("\nWhat would help, tried and planned, and not the least there is\n")  # nothing is before it


def test_where_the_hand_that_moves_needs_more_than_its_start_posture_a_second_number_is_told() -> None:
    """The margin keeps the start posture from a plan, the way the hand that moves."""
    overrides = ("task.motion_factor=3", "limits.margin=3 N", "task.knots=5")
    found = refused("barrett-ball-roll", *overrides).explain()
    assert not any(repair.verified for repair in found.repairs)
    assert {two.cause for _, two in found.pairs} == {"amplitude"}
    one, two = found.pairs[0]
    problem = sg.load_problem("barrett-ball-roll", [*overrides, one.set, two.set])
    assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


def test_a_motion_out_of_reach_says_which_tolerance_and_how_many_synergies_would_do() -> None:
    answer = refused("barrett-ball-lift", 'task.linearise="once"')
    found = answer.explanation
    assert (found.cause, found.missing_synergies is not None) == ("direction", True)
    assert answer.missing_synergies is not None
    assert answer.missing_synergies.count == 1
    assert found.when.alone


def test_a_motion_out_of_reach_is_told_as_that_also_where_nothing_bounds_the_margin() -> None:
    unbounded = ("limits={}", 'goal={maximise="margin"}', "task={move=[{axis='x',lift='1 mm'}],wrench=[0,0,-3,0,0,0]}")
    found = refused("tripod", *unbounded).explanation
    assert (found.cause, found.repairs) == ("direction", ())


def test_no_tolerance_is_tried_where_too_much_control_is_asked_for() -> None:
    compliant = ('task={tracking="compliant",tolerance="1 mm",control={forces=9},wrench=[0,0,-2,0,0,0]}',)
    found = refused("tripod", *compliant).explanation
    assert (found.cause, [each.key for each in found.repairs]) == ("count", ["task.control"])


@pytest.mark.parametrize("name", ["tripod", "barrett-ball-lift"])
def test_the_document_has_all_keys_and_is_json(name: str) -> None:
    answer = refused(name, *(['limits.normal_force="1 N"'] if name == "tripod" else []))
    document: dict[str, Any] = no_document(answer.explanation, answer.task.times)
    keys = {"why", "conflicts", "repairs", "cannot_help", "when", "missing_synergies", "others", "pairs", "clashing"}
    assert set(document) == keys | {"interrupted"}
    assert document["when"]["scope"] == "start"
    json.dumps(document, allow_nan=False)
    assert set(document["why"]) == {"text", "cause"}


def test_the_compromise_misses_what_is_told_and_nothing_where_there_is_a_plan() -> None:
    answer = refused("tripod", 'limits.normal_force="1 N"')
    posed = answer.explanation.posed
    assert posed is not None
    least = compromise(posed)
    assert least is not None
    late = least.times >= 0.2 - 1e-9
    assert np.all(least.missing[late] > 0.01)
    assert np.all(least.missing[~late] < 1e-6)


def test_an_interrupt_keeps_what_is_found() -> None:
    heard: list[sg.Repair] = []

    def stop(repair: sg.Repair) -> None:
        heard.append(repair)
        if len(heard) == 2:
            raise KeyboardInterrupt

    found = refused("tripod", 'limits.normal_force="1 N"').explain(heard=stop)
    assert found.interrupted
    assert [repair.cause for repair in found.repairs] == [heard[0].cause]


@pytest.mark.parametrize("during", ["least_change", "when"])
def test_an_interrupt_while_it_is_searched_keeps_what_was_said(during: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    answer = refused("tripod", 'limits.normal_force="1 N"')
    monkeypatch.setattr(f"synergrip.explain.explained.{during}", stop)
    found = answer.explain()
    assert found.interrupted
    assert found.conflicts
    assert found.when.first_s is None
    assert bool(found.repairs) == (during == "when")
    assert json.dumps(no_document(found, answer.task.times), allow_nan=False)


def test_a_name_with_a_backslash_can_be_typed_in(tmp_path: Path) -> None:
    grasp = json.loads((PROBLEMS / "pinch-soft.json").read_text(encoding="utf-8"))
    grasp["contacts"][1] |= {"name": "it's [a].b \\ ü", "friction": 0.05}
    (tmp_path / "pinch-soft.json").write_text(json.dumps(grasp), encoding="utf-8")
    (tmp_path / "odd.toml").write_text((PROBLEMS / "pinch-soft.toml").read_text(encoding="utf-8"), encoding="utf-8")
    odd = str(tmp_path / "odd.toml")
    others = [each for each in refused(odd).explain().others if each.cause == "friction"]
    assert others
    for repair in others:
        problem = sg.load_problem(odd, [repair.set])
        assert sg.plan(problem.grasp, problem.task).verdict == "feasible"


def test_an_explanation_survives_a_pickle() -> None:
    answer = refused("tripod", 'limits.normal_force="1 N"')
    assert answer.explanation.cause == "force_cap"
    again = pickle.loads(pickle.dumps(answer))
    assert again.explanation.cause == "force_cap"


def test_an_interrupt_of_a_refusal_keeps_what_plan_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(refusing, "missing_briefly", stop)
    answer = refused("barrett-ball-lift", 'task.linearise="once"')
    assert answer.explanation.interrupted
    assert answer.explanation.cause == "direction"


def test_a_reserve_between_the_knots_proves_nothing_and_every_instant_does() -> None:
    """It asks for more than is needed: what has no plan with it may have one without."""
    answer = refused("barrett-ball-hold", 'limits.normal_force="8 N"')
    found = answer.explanation
    assert found.posed is not None
    assert not found.posed.strict
    assert found.cannot_help == ()  # joint torque and ranges do not help, but with the reserve that is no proof
    assert found.when.alone
    first, last = found.when.intervals_s[0]
    for seconds, verdict in ((first, "infeasible"), (last, "infeasible"), (1.6, "feasible")):
        k = int(np.argmin(np.abs(answer.task.times - seconds)))
        alone = sg.Task(knots=1, loads=[sg.Wrench(tuple(answer.task.wrench[k]))], limits=answer.task.limits)
        task = alone.replace(limits=[sg.SlipMargin(0.5), *answer.task.limits], linearise="once")
        assert plan_of_start_posture(answer.grasp, task).verdict == verdict


def test_the_margin_of_a_task_at_knots_is_among_what_clashes() -> None:
    problem = sg.load_problem("pinch-soft", "limits.margin=12 N")
    answer = sg.plan(problem.grasp, problem.timed)
    assert isinstance(answer, sg.Infeasible)
    assert answer.explain().clashing == ("limits.margin", "limits.normal_force")


def test_of_a_task_with_inertia_no_duration_is_proven_not_to_help() -> None:
    """It may have a plan where it takes a little longer, none where it takes longer still, and one again."""
    problem = sg.load_problem("barrett-ball-carry", 'limits.normal_force="1 N"')
    answer = plan_of_start_posture(problem.grasp, problem.task)
    assert isinstance(answer, sg.Infeasible)
    asked = Asked.of(answer.grasp, problem.task, problem.timed)
    assert answer.analysis is not None
    (duration,) = (each for each in dials(asked, problem.timed, answer.analysis) if each.cause == "duration")
    assert not duration.nested
    posed = asked.posed(answer.analysis)
    assert posed is not None
    assert not least_change(duration, posed, posed.program()).proven


def test_steps_are_blamed_only_where_every_instant_is_known_to_have_a_plan() -> None:
    posed = refused("tripod", "limits.synergy_rate=0.001", 'task.linearise="once"').explanation.posed
    assert posed is not None
    assert when(posed).alone is False
    held = refused("tripod", 'limits.normal_force="1 N"').explanation.posed
    assert held is not None
    assert when(held).alone is True
