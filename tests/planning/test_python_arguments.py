"""Grasps and tasks made in Python: what a file may not say, no argument may say, and nothing goes on silently."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from random_tasks import hand_like_grasp
from small_grasps import pinch, tripod

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.errors import InputError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import Target, TimedTask, still

TIMES = np.linspace(0.0, 1.0, 3)
WEIGHT = [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]


def task(**changes: Any) -> TimedTask:
    given: dict[str, Any] = {
        "times": TIMES, "wrench": np.tile(WEIGHT, (3, 1)), "target": still(TIMES), "margin": 0.1,
        "limits": (NormalForce(upper=50.0),), "goals": (LeastEffort(),),
    }  # fmt: skip
    return TimedTask(**(given | changes))


def refusal(call: Any, **changes: Any) -> tuple[str, str]:
    with pytest.raises(InputError) as caught:
        call(**changes)
    issue = caught.value.issues[0]
    return issue.key, issue.message


# grasps


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("number", [0.000125, 1, np.float64(2e-3), np.array(1e-3)])
def test_a_number_stands_for_that_times_the_identity(number: Any, seed: int) -> None:
    """As in a file. Added to every entry of a matrix it would couple all contacts with each other."""
    grasp = hand_like_grasp(np.random.default_rng(seed))
    made = replace(grasp, C_s=number, C_q=0, C_z=0.0)
    assert np.array_equal(made.C_s, float(number) * np.eye(grasp.n_l))
    assert np.array_equal(made.C_q, np.zeros((grasp.n_q, grasp.n_q)))
    assert np.array_equal(made.C_z, np.zeros((grasp.n_z, grasp.n_z)))


def test_plans_by_number_and_by_matrix_are_the_same() -> None:
    by_number, by_matrix = (replace(tripod(), C_s=C_s) for C_s in (0.000125, frozen(0.000125 * np.eye(9))))
    one, other = (plan(grasp, task()) for grasp in (by_number, by_matrix))
    assert isinstance(one, Plan)
    assert isinstance(other, Plan)
    assert np.array_equal(one.motion.dz_r, other.motion.dz_r)
    assert np.abs(one.motion.dz_r).max() > 0


@pytest.mark.parametrize(
    ("changes", "key", "fragment"),
    [
        ({"C_s": -1.0}, "C_s", "must not be negative, got -1"),
        ({"C_s": np.ones(8)}, "C_s", "expected a number, or shape (8, 8), got (8,); np.diag makes a matrix"),
        ({"C_s": np.eye(7)}, "C_s", "expected a number, or shape (8, 8), got (7, 7)"),
        ({"C_s": "soft"}, "C_s", "expected a number or a matrix of shape (8, 8), got 'soft'"),
        ({"C_s": True}, "C_s", "got true"),
        ({"C_s": None}, "C_s", "got null"),
        ({"C_s": np.nan}, "C_s", "of finite numbers, got nan"),
        ({"C_s": np.inf}, "C_s", "of finite numbers, got inf"),
        ({"C_q": np.diag([-1.0] + [1.0] * 7)}, "C_q", "not positive semidefinite: its smallest eigenvalue is -1"),
        ({"C_q": np.eye(8) + np.eye(8, k=1)}, "C_q", "is not symmetric"),
        ({"C_z": np.zeros((2, 2))}, "C_z", "expected a number, or shape (1, 1), got (2, 2)"),
        ({"G": np.zeros((6, 7))}, "G", "expected shape (6, 8): a column for each force component"),
        ({"G": np.zeros((8, 6))}, "G", "expected shape (6, 8)"),
        ({"J": np.zeros((3, 8))}, "J", "it fits when transposed"),
        ({"J": np.zeros(8)}, "J", "makes one column of it"),
        ({"S": np.full((8, 1), np.nan)}, "S", "finite numbers, got nan"),
        ({"w_0": np.zeros(3)}, "w_0", "expected shape (6,), got (3,)"),
        ({"lambda_0": np.zeros(2)}, "lambda_0", "expected shape (8,), got (2,)"),
        ({"joints": ("q",) * 8}, "joints[1]", "'q' is the name of two"),
        ({"synergies": ("",)}, "synergies[0]", "expected a name, got ''"),
    ],
)
def test_matrices_that_are_none_are_refused_by_name(changes: dict[str, Any], key: str, fragment: str) -> None:
    found = refusal(lambda **each: replace(pinch(), **each), **changes)
    assert found[0] == f"Grasp.{key}"
    assert fragment in found[1]


def test_lists_are_taken_as_arrays_and_arrays_are_kept() -> None:
    grasp = pinch()
    made = replace(grasp, G=grasp.G.tolist(), w_0=[0, 0, 1, 0, 0, 0])
    assert np.array_equal(made.G, grasp.G)
    assert made.w_0.dtype == np.float64
    assert made.J is grasp.J


# tasks


def test_one_wrench_is_the_same_at_all_knots() -> None:
    for wrench in (WEIGHT, np.array(WEIGHT), tuple(WEIGHT)):
        assert np.array_equal(task(wrench=wrench).wrench, task().wrench)
    six = np.linspace(0, 1, 6)
    assert np.array_equal(task(times=six, target=still(six), wrench=WEIGHT).wrench, np.tile(WEIGHT, (6, 1)))
    assert isinstance(plan(pinch(), task(wrench=WEIGHT)), Plan)


@pytest.mark.parametrize(
    ("changes", "key", "fragment"),
    [
        ({"wrench": np.zeros((3, 3))}, "wrench", "expected shape (3, 6) (3 forces [N] and 3 moments [N m] about B"),
        ({"wrench": np.zeros((2, 6))}, "wrench", "got (2, 6)"),
        ({"wrench": np.zeros((6, 3))}, "wrench", "got (6, 3)"),
        ({"wrench": np.zeros(3)}, "wrench", "got (3,)"),
        ({"wrench": 1.0}, "wrench", "got ()"),
        ({"wrench": None}, "wrench", "got null"),
        ({"wrench": np.full((3, 6), np.nan)}, "wrench", "of finite numbers, got nan"),
        ({"times": [0.0, 1.0, 0.5]}, "times", "times must increase: 0.5 s comes after 1 s"),
        ({"times": [1.0, 0.5, 0.0]}, "times", "times must increase: 0.5 s comes after 1 s"),
        ({"times": [0.0, 0.0, 1.0]}, "times", "times must increase: 0 s is repeated"),
        ({"times": [0.0, np.nan, 1.0]}, "times", "of finite numbers, got nan"),
        ({"times": []}, "times", "expected one or more instants in seconds, got none"),
        ({"times": np.zeros((3, 1))}, "times", "expected shape (3,)"),
        ({"times": "0 s"}, "times", "got '0 s'"),
        ({"times": np.linspace(0, 1, 4), "wrench": WEIGHT}, "target", "expected a row at each of 4 knots, got (3, 0)"),
        ({"target": Target("motion", np.zeros(3))}, "target", "got (3,)"),
        ({"goals": ()}, "goals", "expected one or more goals, got none; write for example goals=(LeastEffort(),)"),
        ({"goals": None}, "goals", "expected one or more goals, got null"),
        ({"goals": "effort"}, "goals", "expected one or more goals, got 'effort'"),
        ({"goals": LeastEffort()}, "goals", "expected one or more goals, got LeastEffort(of='contact')"),
        ({"goals": ("effort",)}, "goals[0]", "expected a goal, got 'effort'; write for example"),
        ({"goals": (LeastEffort,)}, "goals[0]", "expected a goal, got <class"),
        ({"goals": (LeastEffort(), LeastEffort())}, "goals[1]", "'least contact effort' is listed twice"),
        ({"margin": -1}, "margin", "expected a slip margin in newtons of at least 0"),
        ({"margin": -1e-12}, "margin", "got -1e-12"),
        ({"margin": float("nan")}, "margin", "got nan"),
        ({"margin": float("inf")}, "margin", "got inf"),
        ({"margin": "0.5 N"}, "margin", "got '0.5 N'"),
        ({"margin": True}, "margin", "got true"),
        ({"tracking": "complaint"}, "tracking", "did you mean 'compliant'?"),
        ({"tracking": "compliant"}, "tolerance", "expected a length in metres greater than 0"),
        ({"tolerance": -1.0}, "tolerance", "expected a length in metres of at least 0, got -1"),
        ({"drift": 0.0}, "drift", "greater than 0, or None"),
        ({"axes": ("x", "w")}, "axes", "'w' is not one of 'x', 'y', 'z', 'rx', 'ry' or 'rz'"),
        ({"between": "hodl"}, "between", "did you mean 'hold'?"),
        ({"limits": (5,)}, "limits[0]", "expected a limit, got 5; write for example limits=(SlipMargin(0.5), Normal"),
        ({"limits": NormalForce(upper=2.0)}, "limits", "expected limits, got NormalForce(lower=0.0, upper=2.0)"),
        ({"limits": None}, "limits", "expected limits, got null"),
    ],
)
def test_tasks_that_are_none_are_refused_by_name(changes: dict[str, Any], key: str, fragment: str) -> None:
    found = refusal(task, **changes)
    assert found[0] == f"Task.{key}"
    assert fragment in found[1]


def test_everything_that_is_wrong_is_told_at_once() -> None:
    with pytest.raises(InputError) as caught:
        task(margin=-1, goals=("efort",), tracking="rigd")
    assert {issue.key for issue in caught.value.issues} == {"Task.margin", "Task.goals[0]", "Task.tracking"}
