"""How far many tasks are from their end, against the planner and the margins of one task."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from held_ball import grasp as held
from random_cone_problems import grasp_like, random_wrenches

import synergrip as sg
from synergrip.linalg import Array, frozen
from synergrip.planning.planning import plan_of_start_posture

LIMITS = [sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(0.1)]
N = 4


def verdict(grasp: sg.Grasp, task: sg.Task, wrench: Array, friction: float) -> str:
    """The same by the planner of one task, for the least effort."""
    contacts = tuple(replace(each, kind=each.kind.slippery(friction)) for each in grasp.contacts)
    own, goals = replace(grasp, contacts=contacts), (sg.LeastEffort(),)
    return plan_of_start_posture(
        own, replace(task.timed(own), wrench=frozen(wrench[None]), course=None, goals=goals)
    ).verdict


@pytest.mark.parametrize("limits", [LIMITS, [sg.SlipMargin(0.2), sg.SynergyReference(0.4)]], ids=len)
@pytest.mark.parametrize("of", ["load_factor", "critical_friction_scale"])
def test_there_is_a_plan_at_one_end_and_a_proof_at_the_other(of: Any, limits: list[sg.Limit]) -> None:
    rng = np.random.default_rng(3)
    grasps, wrenches = [grasp_like(rng, ["hard", "soft", "hard"]) for _ in range(N)], random_wrenches(rng, N)
    wrenches[0] *= 1e3  # which is not held as it is
    task = sg.Task(knots=1, limits=limits)
    found = sg.margins_many(grasps, task, of=of, wrenches=wrenches, friction_factors=np.full(N, 0.9))
    assert np.isnan(found.value[0])
    assert not found.proven[0]
    assert found.proven[1:].all()
    assert (found.upper - found.lower <= 1e-6 * found.value)[1:].all()
    for i in range(1, N):
        told = []
        for end in (found.lower[i], found.upper[i]):
            load, friction = (end, 0.9) if of == "load_factor" else (1.0, 0.9 * end)
            told.append(verdict(grasps[i], task, load * wrenches[i], friction))
        assert told == (["feasible", "infeasible"] if of == "load_factor" else ["infeasible", "feasible"])


def test_numbers_lie_between_the_ends_that_margins_proves() -> None:
    rng = np.random.default_rng(4)
    grasp, wrenches = grasp_like(rng, ["soft"] * 3), random_wrenches(rng, 2)
    task = sg.Task(knots=1, limits=LIMITS)
    for of in ("load_factor", "critical_friction_scale"):
        found = sg.margins_many(grasp, task, of=of, wrenches=wrenches)
        for i, wrench in enumerate(wrenches):
            one = sg.margins(grasp, replace(task.timed(grasp), wrench=frozen(wrench[None]), course=None), only=(of,))
            number = one.direct[of]
            assert number.proven
            assert number.lower <= found.value[i] <= number.upper


def test_the_heaviest_object_of_a_hand_holds_and_a_heavier_one_does_not() -> None:
    loads = [sg.Gravity((0, 0, -9.81))]
    task = sg.Task(knots=1, loads=loads, limits=[sg.NormalForce(upper=15.0)], linearise="once")
    found = sg.margins_many(held, task, of="heaviest_kg", masses=[0.05, 0.3])
    assert found.proven.all()
    assert abs(found.value[0] / found.value[1] - 1) < 1e-6  # wherever one begins
    many = sg.plan_many(held, task, masses=[found.lower[0], found.upper[0]])
    assert many.verdicts.tolist() == ["feasible", "infeasible"]


def test_an_end_that_is_none_is_not_told() -> None:
    grasp = grasp_like(np.random.default_rng(5), ["hard"] * 3)
    found = sg.margins_many(grasp, sg.Task(knots=1), of="load_factor", wrenches=np.zeros((2, 6)))
    assert np.isnan(found.value).all()
    assert not found.proven.any()


def test_mistakes_are_told_by_the_argument() -> None:
    grasp = grasp_like(np.random.default_rng(5), ["hard"] * 3)
    for of in ("heaviest_kg", "largest"):
        with pytest.raises(sg.InputError, match="of: "):
            sg.margins_many(grasp, sg.Task(knots=1), of=of)  # type: ignore[arg-type]
