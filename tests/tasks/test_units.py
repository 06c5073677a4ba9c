"""Limits that do not bind, loads that are rounding and units that differ change no answer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from driven_grasp import driven, nose_cone, touch
from judged_motion_goals import judged as judged_motion_goal
from judged_units import judged
from named_goals import goals

from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.check import judge_references
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan as plan_that_moves
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.references import References
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_plan import verdict_lines
from synergrip.tasks.timed_task import TimedTask, still


def asked(goal: str, *limits: Limit, load: float = 1.0, margin: float = 0.0) -> TimedTask:
    """Hold a weight [N] at one instant."""
    times = frozen([0.0])
    return TimedTask(times, frozen([[0, 0, -load, 0, 0, 0]]), still(times), margin, limits, goals(goal))


def tripod() -> Grasp:
    """Three fingers of friction 0.8 around a disc."""
    angles = 2 * np.pi * np.arange(3) / 3
    ring = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    return driven([touch(f"C{i + 1}", "hard", 0.03 * ring[i], -ring[i], 0.8) for i in range(3)])


@pytest.mark.parametrize("upper", [np.inf, 0.7, 10.0, 1e4, 1e7, 1e10])
def test_the_largest_margin_of_the_nose_cone_needs_no_limit(upper: float) -> None:
    limits = () if np.isinf(upper) else (NormalForce(0.0, upper),)
    outcome = plan(nose_cone(), asked("margin", *limits))
    assert isinstance(outcome, Plan)
    assert outcome.largest_margin == pytest.approx(0.0247526, abs=1e-7)
    assert outcome.margins.min() == pytest.approx(0.0247526, abs=2e-7)


@pytest.mark.parametrize("load", [1e-12, 1e-6, 1.0, 1e4, 1e8])
def test_the_nose_cone_scales_with_its_load(load: float) -> None:
    peak, effort = (plan(nose_cone(), asked(goal, load=load)) for goal in ("peak_force", "effort"))
    assert isinstance(peak, Plan)
    assert isinstance(effort, Plan)
    assert peak.motion.forces[:, ::3].max() / load == pytest.approx(0.491089, abs=2e-6)
    assert (effort.motion.forces**2).sum() / load**2 == pytest.approx(0.658885, abs=2e-6)


@pytest.mark.parametrize("cap", [2.0, 1e3, 1e6, 1e9, 1e12])
@pytest.mark.parametrize("goal", ["margin", "effort", "peak_force"])
def test_a_cap_meant_as_no_limit_is_none(goal: str, cap: float) -> None:
    torque = JointTorque(frozen(np.full(9, 1.5)))  # N m; each joint carries one force component over 1 m
    outcome = plan(tripod(), asked(goal, NormalForce(0.0, cap), torque, margin=0.5))
    assert isinstance(outcome, Plan)
    weight = 1 / 3
    best = 0.8 * 1.5 - weight if goal == "margin" else 0.5
    assert outcome.margins.min() == pytest.approx(best, abs=1e-6)
    references = References(outcome.task.times, outcome.motion.dz_r, {})
    assert judge_references(tripod(), outcome.task, references).verdict == "feasible"


def test_what_slips_is_seen_whatever_the_cap() -> None:
    """References with a tenth of the squeeze that the margin takes, judged under a cap of 1e9 N."""
    task = asked("effort", NormalForce(0.0, 1e9), margin=0.5)
    outcome = plan(tripod(), task)
    assert isinstance(outcome, Plan)
    loose = References(task.times, frozen(0.1 * outcome.motion.dz_r), {})
    judgement = judge_references(tripod(), task, loose)
    assert judgement.margins.min() < 0.4
    assert judgement.verdict == "fails"


@pytest.mark.parametrize("load", [0.0, 1e-30, 1e-17, 1e-9, 1e-4, 0.1])
def test_a_load_of_rounding_size_is_as_none(load: float) -> None:
    outcome = plan(tripod(), asked("effort", NormalForce(1.0, 20.0), load=load))
    assert isinstance(outcome, Plan)
    assert outcome.motion.forces[:, ::3] == pytest.approx(1.0, abs=1e-6)


def test_a_motion_under_a_load_of_rounding_size_is_feasible() -> None:
    light = ["task.gravity=[0,0,-1e-12]", "task.push=[]", "limits.margin='0 N'"]
    for overrides in (light, [*light, "task.gravity=[0,0,0]"]):
        problem = load_problem("gripper-peg", overrides)
        assert isinstance(plan(problem.grasp, problem.task), Plan)
        assert isinstance(plan_that_moves(problem.grasp, problem.task), Plan)


def test_a_margin_that_is_just_out_of_reach_is_told_as_zero() -> None:
    """mu n_max is the weight each finger bears: 0 N of margin are left, and 0.2 N are asked for."""
    weight, mu = 2 * 0.981, 0.981 / 20
    fingers = [touch(name, "soft", [x, 0, 0], [-x, 0, 0], mu) for name, x in (("left", -0.02), ("right", 0.02))]
    task = asked("peak_force", NormalForce(0.0, 20.0), load=weight, margin=0.2)
    outcome = plan(driven(fingers), task)
    assert isinstance(outcome, Infeasible)
    assert outcome.largest_margin == 0.0
    assert "a slip margin of 0 N at most, the task asks for 0.2 N" in outcome.why
    assert isinstance(plan(driven(fingers), replace(task, margin=0.0)), Plan)  # the repair


def test_what_nothing_bounds_is_bad_input_and_what_geometry_bounds_is_not() -> None:
    with pytest.raises(InputError, match="nothing bounds the largest margin"):
        plan(tripod(), asked("margin"))
    assert isinstance(plan(nose_cone(), asked("margin")), Plan)


@pytest.mark.parametrize("name", ["tripod", "table2-hard-motors", "barrett-ball-hold", "robonaut-handle"])
def test_text_table_and_document_state_the_same_worst_margin(name: str) -> None:
    problem = load_problem(name)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    document = outcome_document("", problem.grasp, outcome)["margin"]
    lines = [*"\n".join(verdict_lines(problem, outcome)).splitlines()]
    headline = next(line for line in lines if line.startswith("feasible"))
    row = next(line for line in lines if line.startswith("slip margin "))
    shown = headline.split("smallest slip margin ")[1].split(" N")[0]
    assert row.split()[2] == shown
    assert float(shown) == pytest.approx(document["worst_N"], rel=1e-3)
    assert document["worst_N"] == np.min(document["per_contact_N"])
    assert document["contact"] in headline
    assert document["contact"] in row
    assert f"t = {document['time_s']:.2f} s" in headline


@pytest.mark.parametrize("start", [0, 6, 12])
def test_the_same_question_in_other_units_has_the_same_answer(start: int) -> None:
    assert [judged(seed) for seed in range(start, start + 6)] == [[]] * 6


@pytest.mark.parametrize("start", [0, 8])
def test_goals_of_motion_reach_their_optimum_in_any_units(start: int) -> None:
    found = [judged_motion_goal(seed) for seed in range(start, start + 8)]
    assert {*found} <= {"same", "infeasible"}, found
    assert "same" in found
