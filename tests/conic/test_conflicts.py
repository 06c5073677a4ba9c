"""What conflicts, read from proofs whose cause is known."""

from __future__ import annotations

import numpy as np
import pytest

from synergrip.documents.quantities import apart
from synergrip.planning.outcome import Infeasible
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import load_problem


def refused(name: str, *overrides: str) -> Infeasible:
    problem = load_problem(name, overrides)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Infeasible)
    assert outcome.stage == "magnitude"
    return outcome


def test_a_margin_beyond_the_normal_force_limit_clashes_with_that_limit_only() -> None:
    outcome = refused("pinch-soft", "limits.margin=12 N", "limits.joint_torque=1000")
    assert {conflict.key for conflict in outcome.conflicts} == {"limits.margin", "limits.normal_force"}
    assert sum(conflict.share for conflict in outcome.conflicts) == pytest.approx(1.0, abs=1e-3)
    # n = (12 + sqrt(1 + 0.2^2)) / 0.5
    assert f"{(12 + np.sqrt(1.04)) / 0.5:.4g} N of normal force would do" in outcome.why


def test_a_torque_limit_that_bites_is_named_with_its_joint() -> None:
    torques = "limits.joint_torque=[1000,1000,1000,1000,2,1000,1000,1000]"
    outcome = refused("pinch-soft", "limits.margin=3 N", torques)
    found = {conflict.key: conflict for conflict in outcome.conflicts}
    assert found["limits.joint_torque"].items == ("q5",)
    assert found["limits.joint_torque"].share > 3 * found["limits.normal_force"].share  # far from its own bound


def test_a_hopeless_geometry_is_told_from_a_limit() -> None:
    outcome = refused("barrett-ball-hold", "contacts.friction=0.3")
    assert "no squeeze however hard would do" in outcome.why
    assert "is missed by" in outcome.why


@pytest.mark.parametrize(
    ("name", "limit"),
    [
        ("robonaut-handle", "limits.normal_force=0.1 N"),
        ("robonaut-handle", "limits.joint_torque=0.001"),
        ("human-glass", "limits.joint_torque=0.001"),
        ("gripper-peg", "limits.synergy_reference=0.0001"),
    ],
)
def test_the_reason_names_the_limit_that_clashes_most_and_not_friction_alone(name: str, limit: str) -> None:
    outcome = refused(name, limit)
    chief = outcome.conflicts[0]
    assert chief.key != "limits.margin"
    assert f"{chief.key} ({chief.items[0]})" in outcome.why


def test_the_reason_names_no_limit_where_friction_clashes_most() -> None:
    outcome = refused("barrett-ball-hold", "contacts.friction=0.3")
    assert outcome.conflicts[0].key == "limits.margin"
    assert outcome.why.startswith("within these limits some contact slips")


@pytest.mark.parametrize(
    ("one", "other", "texts"),
    [
        (12.2963, 12.3, ("12.296", "12.3")),
        (1.0, 2.0, ("1", "2")),
        (0.5, 0.5, ("0.5", "0.5")),
        (1 + 1e-9, 1, ("1.000000001", "1")),
    ],
)
def test_numbers_are_printed_apart(one: float, other: float, texts: tuple[str, str]) -> None:
    assert apart(one, other) == texts
