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
    assert found.verdicts.tolist() == ["infeasible", *["feasible"] * (N - 1)]
    assert found.proven[1:].all()
    assert (found.proven == (found.ends == "found")).all()
    assert (found.upper - found.lower <= 1e-6 * found.value)[found.proven].all()
    for i in np.flatnonzero(found.proven):
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
    masses = [0.05, 0.3, 50.0]
    found = sg.margins_many(held, task, of="heaviest_kg", masses=masses)
    assert found.proven.all()
    assert found.verdicts.tolist() == ["feasible", "feasible", "infeasible"]
    assert np.ptp(found.value) < 1e-6 * found.value[0]  # wherever one begins
    many = sg.plan_many(held, task, masses=[found.lower[0], found.upper[0]])
    assert many.verdicts.tolist() == ["feasible", "infeasible"]
    each = sg.margins_many([held.replace(mass=mass) for mass in masses], task, of="heaviest_kg")
    np.testing.assert_allclose(each.value, found.value, rtol=1e-6)


def test_what_a_friction_that_does_not_do_would_have_to_be_is_told() -> None:
    rng = np.random.default_rng(4)
    grasp, wrench = grasp_like(rng, ["soft"] * 3), random_wrenches(rng, 1)
    task = sg.Task(knots=1, limits=LIMITS)
    least = sg.margins_many(grasp, task, of="critical_friction_scale", wrenches=wrench).value[0]
    factors = np.array([0.5, 2.0]) * least
    found = sg.margins_many(
        grasp, task, of="critical_friction_scale", wrenches=np.tile(wrench, (2, 1)), friction_factors=factors
    )
    assert found.verdicts.tolist() == ["infeasible", "feasible"]
    np.testing.assert_allclose(found.value * factors, least, rtol=2e-6)


def test_it_is_told_why_there_is_no_number() -> None:
    rng = np.random.default_rng(5)
    grasp = grasp_like(rng, ["hard"] * 3)
    wrenches = np.vstack([np.zeros(6), random_wrenches(rng, 1)])
    found = sg.margins_many(grasp, sg.Task(knots=1), of="load_factor", wrenches=wrenches)
    assert found.ends.tolist() == ["endless", "endless"]  # nothing bounds the forces
    nowhere = sg.Task(knots=1, limits=[sg.NormalForce(lower=5.0), sg.JointTorque(1e-3)])
    none = sg.margins_many(grasp, nowhere, of="load_factor", wrenches=wrenches)
    assert none.ends.tolist() == ["none", "none"]
    for each in (found, none):
        assert np.isnan(each.value).all()
        assert not each.proven.any()
        assert not each.interrupted


def test_an_interrupt_is_told_and_keeps_what_is_found() -> None:
    rng = np.random.default_rng(6)
    grasp, wrenches = grasp_like(rng, ["hard"] * 3), np.vstack([np.zeros(6), random_wrenches(rng, 3)])
    task, shares = sg.Task(knots=1, limits=LIMITS[:1]), list[float]()

    def heard(what: str, share: float) -> None:
        assert what == "finding load_factor"
        shares.append(share)

    def pressed(what: str, share: float) -> None:
        if share > 0.3:
            raise KeyboardInterrupt

    whole = sg.margins_many(grasp, task, of="load_factor", wrenches=wrenches, progress=heard)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert not whole.interrupted
    found = sg.margins_many(grasp, task, of="load_factor", wrenches=wrenches, progress=pressed)
    assert found.interrupted
    assert set(found.ends[~found.finished]) == {"unfinished"}
    assert "unfinished" in repr(found)


def test_the_logger_is_told_of_the_numbers_and_not_of_every_value_tried(caplog: pytest.LogCaptureFixture) -> None:
    rng = np.random.default_rng(7)
    with caplog.at_level("INFO", "synergrip"):
        sg.margins_many(
            grasp_like(rng, ["hard"] * 3), sg.Task(knots=1, limits=LIMITS), of="load_factor",
            wrenches=random_wrenches(rng, 2),
        )  # fmt: skip
    assert [record.getMessage().split()[0] for record in caplog.records] == ["finding", "ManyMargins(load_factor"]


def test_mistakes_are_told_by_the_argument() -> None:
    grasp = grasp_like(np.random.default_rng(5), ["hard"] * 3)
    for of in ("heaviest_kg", "largest"):
        with pytest.raises(sg.InputError, match="of: "):
            sg.margins_many(grasp, sg.Task(knots=1), of=of)  # type: ignore[arg-type]
