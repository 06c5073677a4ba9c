"""Least effort among the best plans, on grasps that leave it hardly any room."""

from __future__ import annotations

import pytest

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import load_problem

STEEP = (
    'hand.posture={spread="45 deg", finger1="62 deg", finger2="71 deg", finger3="73 deg"}',
    'object.mass="0.35 kg"',
    "contacts.friction=0.8",
    'contacts.stiffness="5 N/mm"',
    "task.knots=21",
    'task.between="report"',
    "task.gravity=[0, -9.81, 0]",
    'task.palm={axis="z", turn="90 deg"}',
)
"""A ball gripped far below its middle: forces are 10 to 25 times the load, and the torque limits bind."""


def planned(radius: str, goal: str, margin: str, more: str = "") -> Plan:
    limits = f'limits={{{more}margin="{margin}", joint_torque="hand"}}'
    overrides = [*STEEP, f'object.shape.sphere.radius="{radius}"', f"goal={goal}", limits]
    problem = load_problem("barrett-ball-hold", overrides)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return outcome


def effort(outcome: Plan) -> float:
    return float((outcome.motion.forces**2).sum())


@pytest.mark.parametrize("radius", ["46 mm", "50 mm", "52 mm", "54 mm"])
def test_the_largest_margin_comes_with_the_least_effort(radius: str) -> None:
    best = planned(radius, '{maximise="margin"}', "0 N")
    assert not [note for note in best.notes if "not verified" in note]
    assert best.largest_margin is not None
    assert best.margins.min() == pytest.approx(best.largest_margin, abs=1e-6)
    nearly = planned(radius, '{minimise="effort"}', f"{best.largest_margin - 1e-5:.9f} N")
    assert effort(best) <= effort(nearly) * (1 + 1e-3)


@pytest.mark.parametrize("radius", ["46 mm", "52 mm", "54 mm", "55 mm"])
def test_the_least_peak_comes_with_the_least_effort(radius: str) -> None:
    best = planned(radius, '{minimise="peak_force"}', "0.5 N")
    assert not [note for note in best.notes if "not verified" in note]
    assert [decision.goal for decision in best.decisions] == ["least peak normal force", "least contact effort"]
    normals = best.motion.forces[:, [rows.start for rows in best.analysis.grasp.rows]]
    nearly = planned(radius, '{minimise="effort"}', "0.5 N", f'normal_force="{normals.max() * (1 + 1e-6):.9f} N", ')
    assert effort(best) <= effort(nearly) * (1 + 1e-3)
