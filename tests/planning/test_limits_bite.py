"""Every limit bites: a little tighter and there is no plan, and the proof names it; a little looser and there is one.

The values are 1% to either side of where bundled problems turn, found by bisection; those of `pinch-soft` by formula.
"""

from __future__ import annotations

import numpy as np
import pytest

from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem

FEW = ("task.knots=11", "task.between=report")
LOAD = np.hypot(1.0, 0.2)
"""Of one finger of `pinch-soft`: half the weight, and its spin moment as a force [N]."""
BITES = {
    "margin": ("pinch-soft", ("limits.normal_force=20 N",), "limits.margin={} N", 0.5 * 20 - LOAD, "higher"),
    "margin_angle": ("pinch-soft", ("limits.margin=0 N",), "limits.margin_angle={} deg",
                     np.degrees(np.arctan(0.5) - np.arctan(LOAD / 20)), "higher"),
    "safety_factor": ("pinch-soft", ("limits.margin=0 N",), "limits.safety_factor={}", 0.5 * 20 / LOAD, "higher"),
    "normal_force": ("pinch-soft", (), "limits.normal_force={} N", (0.5 + LOAD) / 0.5, "lower"),
    "joint_torque": ("barrett-ball-hold", FEW, "limits.joint_torque={}", 1.2232, "lower"),
    "actuator_effort": ("barrett-ball-hold", FEW, "limits.actuator_effort={}", 1.3429, "lower"),
    "sustained_torque": ("gripper-box", FEW, "limits.sustained_torque={}", 0.25976, "lower"),
    "sustained_effort": ("gripper-box", FEW, "limits.sustained_effort={}", 0.51950, "lower"),
    "synergy_reference": ("barrett-ball-hold", FEW, "limits.synergy_reference={}", 0.047397, "lower"),
    "synergy_rate": ("gripper-box", FEW, "limits.synergy_rate={}", 0.11628, "lower"),
    "synergy_acceleration": ("gripper-box", FEW, "limits.synergy_acceleration={}", 0.17771, "lower"),
    "elastic_motion": ("barrett-ball-hold", FEW, "limits.elastic_motion={} mm", 0.9107, "lower"),
    "drift": ("barrett-ball-hold", FEW, "limits.drift={} mm", 0.84045, "lower"),
    # each contact carries half the load of 2 N with a stiffness of 1 N/mm
    "task.tolerance": ("pinch-soft", (), 'task={{wrench=[0,0,-2,0,0,0],tracking="compliant",tolerance="{} mm"}}',
                       1.0, "lower"),
    "task.drift": ("dlr-ball-lift-free", (), "task.drift={} mm", 0.75428, "lower"),
}  # fmt: skip


BITTEN_ELSEWHERE = {"joint_range"}
"""By `test_joint_ranges_turn_the_answer_and_the_joint_is_named`, since no number states them."""


def outcome_of(name: str, *overrides: str) -> Outcome:
    problem = load_problem(name, overrides)
    return plan(problem.grasp, problem.task)


def refused(outcome: Outcome, key: str) -> None:
    """Assert a verified proof in which the limit counts."""
    assert isinstance(outcome, Infeasible)
    assert (outcome.stage, outcome.certificate.verified) == ("magnitude", True)
    shares = {conflict.key: conflict.share for conflict in outcome.conflicts}
    assert shares.get(key, 0.0) > 0.05, shares


@pytest.mark.parametrize("limit", BITES)
def test_a_limit_turns_the_answer_and_is_named(limit: str) -> None:
    name, overrides, text, turns, tighter = BITES[limit]
    tight, loose = (1.01, 0.99) if tighter == "higher" else (0.99, 1.01)
    refused(outcome_of(name, *overrides, text.format(tight * turns)), limit if "." in limit else f"limits.{limit}")
    assert isinstance(outcome_of(name, *overrides, text.format(loose * turns)), Plan)


def test_joint_ranges_turn_the_answer_unless_they_are_let_go_and_the_joint_is_named() -> None:
    """A roll of 12 degrees takes a joint of the DLR hand out of its range, and 12 actuators have no redundancy."""
    move = 'task.move=[{axis="y", roll="12 deg"}]'
    outcome = outcome_of("dlr-ball-move", "task.knots=11", move, "task.linearise=once")
    refused(outcome, "limits.joint_range")
    left = outcome_of("dlr-ball-move", "task.knots=11", move, "limits.joint_range=none")
    assert isinstance(left, Plan)
    (note,) = (note for note in left.notes if "range" in note)
    assert isinstance(outcome, Infeasible)
    items = next(conflict.items for conflict in outcome.conflicts if conflict.key == "limits.joint_range")
    assert f"'{items[0]}'" in note
    near = [move.replace("12", "2"), "task.knots=11"]
    for ranges in ([], ["limits.joint_range=hand"]):
        kept = outcome_of("dlr-ball-move", *near, *ranges)
        assert isinstance(kept, Plan)
        assert not [note for note in kept.notes if "range" in note]


@pytest.mark.parametrize("limit", [name for name, (problem, *_) in BITES.items() if problem == "pinch-soft"])
def test_the_second_formulation_turns_at_the_same_value(limit: str) -> None:
    name, overrides, text, turns, tighter = BITES[limit]
    tight, loose = (1.01, 0.99) if tighter == "higher" else (0.99, 1.01)
    for factor, verdict in ((tight, "infeasible"), (loose, "feasible")):
        problem = load_problem(name, [*overrides, text.format(factor * turns)])
        assert plan(problem.grasp, problem.task, SOLVERS["cvxpy"]).verdict == verdict
