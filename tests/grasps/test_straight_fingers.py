"""Fingers in line with what they touch: which they are, and where that is told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import synergrip as sg
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.straight_fingers import IN_LINE, straight_fingers, straight_notes
from synergrip.linalg import frozen
from synergrip.planning.executing import Executor
from synergrip.planning.planning import plan_of_start_posture
from synergrip.planning.reach import hindrances
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk

NAMED = "near a straight posture: finger1/tip (finger1_inner and finger1_outer)"


@pytest.fixture(scope="module")
def straight() -> sg.Problem:
    """A Barrett hand, one finger of which is stretched out along the normal of its contact."""
    return sg.load_problem("table2-hard-joints")


def bent(grasp: Grasp, joint: str, degrees: float) -> np.ndarray:
    assert grasp.held is not None
    q = grasp.held.q.copy()
    q[grasp.joints.index(joint)] += np.radians(degrees)
    return frozen(q)


def test_a_finger_is_named_with_the_joints_that_are_in_line(straight: sg.Problem) -> None:
    (finger,) = straight_fingers(straight.grasp)
    contact = straight.grasp.contacts[0]
    assert finger.contact == contact.name == "finger1/tip"
    assert finger.joints == ("finger1_inner", "finger1_outer")
    assert finger.angle == pytest.approx(0.0, abs=0.01)
    assert finger.pressing
    rows = straight.grasp.J[straight.grasp.rows[0]][:3]  # what the finger cannot do is what its Jacobian lacks
    assert np.abs(contact.frame.T @ finger.along @ rows).max() < 1e-9


@pytest.mark.parametrize(("degrees", "count"), [(3.0, 1), (-3.0, 1), (25.0, 0), (-25.0, 0)])
def test_a_bent_finger_is_not_straight(straight: sg.Problem, degrees: float, count: int) -> None:
    found = straight_fingers(straight.grasp, bent(straight.grasp, "finger1_outer", degrees))
    assert len(found) == count
    assert all(0 < finger.angle < min(abs(degrees), IN_LINE) for finger in found)


def test_joints_that_one_synergy_moves_are_one_way_to_move_anyway(straight: sg.Problem) -> None:
    S = np.array(straight.grasp.S)
    S[[straight.grasp.joints.index(name) for name in ("finger1_inner", "finger1_outer")]] = 1.0
    assert not straight_fingers(replace(straight.grasp, S=frozen(S)))


@pytest.mark.parametrize("name", ["gripper-box", "tripod", "dlr-ball-move"])
def test_other_grasps_have_no_such_note(name: str) -> None:
    assert not list(straight_notes(sg.load_problem(name).grasp))


def test_it_is_said_of_a_problem_and_of_what_comes_of_it(straight: sg.Problem) -> None:
    outcome = sg.plan(straight.grasp, straight.task)
    for notes in (straight.notes, outcome.notes):
        (note,) = (each for each in notes if "straight" in each)
        assert note.startswith(NAMED)
        assert "where finger1/tip would press" in note


def test_a_motion_that_no_short_step_brings_on_names_them(straight: sg.Problem) -> None:
    walk, walker = walked(straight)
    assert hindrances(walk, walker).endswith(f"comes nearer; {NAMED}")
    assert "straight" not in hindrances(*walked(sg.load_problem("gripper-box")))


def walked(problem: sg.Problem) -> tuple[Walk, Walker]:
    """A plan of the start posture, executed."""
    linear = plan_of_start_posture(problem.grasp, problem.task)
    assert isinstance(linear, sg.Plan)
    walker = Walker(linear.task, linear.analysis, Executor.of(linear.analysis, linear.task), SOLVERS["clarabel"])
    return replace(walker.executed(linear.motion.dz_r, None, linear.motion), way=None), walker
