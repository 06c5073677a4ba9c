"""Many tasks at once, against one plan after the other."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from held_ball import at, ball, hand
from held_ball import grasp as held
from random_cone_problems import grasp_like, random_wrenches
from random_tasks import hand_like_grasp

import synergrip as sg
from synergrip.batch import plan_many as module
from synergrip.batch.cone_problems import ConeProblems, ConeSolutions, Status, Tolerance
from synergrip.batch.many_plans import ManyPlans
from synergrip.grasps.grasp import grasp_matrix
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Outcome
from synergrip.planning.planning import plan_of_start_posture
from synergrip.tasks.timed_task import TimedTask

LIMITS = (sg.NormalForce(upper=6.0), sg.JointTorque(0.4), sg.SlipMargin(0.2))
MOST = 1e-6
"""[load] by which objectives may differ; forces go by the root of what is left to the least effort."""


def alone(grasp: sg.Grasp, task: sg.Task, wrench: Array, friction: float = 1.0) -> Outcome:
    """The same by the planner of one task."""
    contacts = tuple(replace(each, kind=each.kind.slippery(friction)) for each in grasp.contacts)
    own = grasp if friction == 1.0 else replace(grasp, contacts=contacts)
    return plan_of_start_posture(own, replace(task.timed(own), wrench=frozen(wrench[None]), course=None))


def compare(many: ManyPlans, each: Sequence[Outcome], wrenches: Array) -> None:
    assert many.verdicts.tolist() == [one.verdict for one in each]
    for i, (one, wrench) in enumerate(zip(each, wrenches, strict=True)):
        load = float(np.abs(wrench[:3]).max())
        if isinstance(one, sg.Plan):
            assert abs(one.margins.min() - many.worst_margin[i]) < MOST * load
            if one.largest_margin is not None:
                assert abs(one.largest_margin - many.largest_margin[i]) < MOST * load
            else:
                assert np.abs(one.forces[0] - many.forces[i]).max() < 1e-4 * load
            balance = one.grasp.G @ many.forces[i] + wrench
            assert np.abs(balance[:3]).max() < 1e-9 * np.abs(many.forces[i]).max()
            made = one.analysis.response.dlambda_dzr @ (many.dz_r[i] - one.dz_r[0])
            assert np.allclose(made, many.forces[i] - one.forces[0], atol=1e-9 * np.abs(one.forces).max())
        else:
            assert np.isnan(many.forces[i]).all()
            assert isinstance(one, sg.Infeasible)
            if one.largest_margin is not None:
                assert abs(one.largest_margin - many.largest_margin[i]) < MOST * load


@pytest.mark.parametrize("goal", [sg.LargestMargin(), sg.LeastEffort(), sg.LeastEffort("torque")], ids=str)
@pytest.mark.parametrize("seed", range(4))
def test_one_grasp_with_many_loads_and_frictions_as_one_by_one(seed: int, goal: sg.Goal) -> None:
    rng, N = np.random.default_rng(seed), 10
    grasp = hand_like_grasp(rng, {"hard": 0.5, "soft": 0.3, "patch": 0.1, "soft-elliptic": 0.1})
    limits = [*LIMITS, sg.SynergyReference(0.8)] if seed % 2 else [*LIMITS, sg.ActuatorEffort(1.0)]
    task = sg.Task(knots=1, limits=limits, goals=[goal])
    wrenches = random_wrenches(rng, N) * rng.uniform(0.1, 3.0, (N, 1))
    friction_factors = rng.uniform(0.05, 1.5, N)
    many = sg.plan_many(grasp, task, wrenches=wrenches, friction_factors=friction_factors)
    each = [alone(grasp, task, wrench, friction) for wrench, friction in zip(wrenches, friction_factors, strict=True)]
    compare(many, each, wrenches)
    assert many.verified.all()
    assert not many.one_by_one.any()


@pytest.mark.parametrize("limits", [LIMITS, (*LIMITS, sg.SynergyReference(0.8))], ids=len)
def test_the_least_peak_is_that_of_one_by_one(limits: tuple[sg.Limit, ...]) -> None:
    rng, N = np.random.default_rng(8), 12
    grasps, wrenches = [grasp_like(rng, ["soft"] * 3) for _ in range(N)], random_wrenches(rng, N)
    task = sg.Task(knots=1, limits=limits, goals=[sg.LeastPeak()])
    for whose in (grasps, grasps[0]):
        many = sg.plan_many(whose, task, wrenches=wrenches, friction_factors=np.linspace(0.2, 1.2, N))
        assert many.verified.all()
        assert not many.one_by_one.any()
        assert len(set(many.verdicts)) == 2
        for i, factor in enumerate(np.linspace(0.2, 1.2, N)):
            grasp = whose[i] if isinstance(whose, list) else whose
            one = alone(grasp, task, wrenches[i], factor)
            assert one.verdict == many.verdicts[i]
            if isinstance(one, sg.Plan):
                ours, theirs = (forces[grasp.normal_rows].max() for forces in (many.forces[i], one.forces[0]))
                assert abs(ours - theirs) < MOST * np.abs(wrenches[i, :3]).max()


def test_without_a_load_the_least_effort_is_none_and_verified() -> None:
    wrenches = np.vstack([np.zeros(6), random_wrenches(np.random.default_rng(0), 2)])
    for goal in (sg.LeastEffort(), sg.LeastEffort("torque"), sg.LeastPeak()):
        many = sg.plan_many(GRASP, sg.Task(knots=1, goals=[goal]), wrenches=wrenches)
        assert many.verdicts.tolist() == ["feasible"] * 3
        assert many.verified.all()
        assert not many.one_by_one.any()
        assert np.abs(many.forces[0]).max() < 1e-7


def test_what_nothing_bounds_for_one_task_is_told_of_that_task() -> None:
    task = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0)], goals=[sg.LargestMargin()])
    wrenches = random_wrenches(np.random.default_rng(0), 3)
    many = sg.plan_many(GRASP, task, wrenches=wrenches, friction_factors=[1.0, 1e12, 1.0])
    assert many.verdicts.tolist() == ["feasible", "unknown", "feasible"]
    assert list(many.refusals) == [1]
    assert "nothing bounds the largest margin" in str(many.refusals[1])


@pytest.mark.parametrize("every", [False, True])
def test_a_plan_that_fails_its_own_check_takes_no_answer_from_others(
    monkeypatch: pytest.MonkeyPatch, every: bool
) -> None:
    wrenches = random_wrenches(np.random.default_rng(0), 3)

    def planned(grasp: sg.Grasp, task: TimedTask) -> Outcome:
        if np.array_equal(task.wrench, wrenches[:1]):
            raise sg.SelfCheckError("the plan fails its own check")
        return plan_of_start_posture(grasp, task)

    monkeypatch.setattr(module, "plan_of_start_posture", planned)
    goals = [sg.LargestMargin(), *[sg.LeastEffort()] * every]  # two goals: all are planned one by one
    task = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0)], goals=goals)
    many = sg.plan_many(GRASP, task, wrenches=wrenches, friction_factors=None if every else [1e12, 1.0, 1.0])
    assert many.verdicts.tolist() == ["unknown", "feasible", "feasible"]
    assert {place: str(error) for place, error in many.refusals.items()} == {0: "the plan fails its own check"}


@pytest.mark.parametrize(
    "change",
    [
        {"goals": [sg.LargestMargin(), sg.LeastEffort()]},
        {"limits": [*LIMITS, sg.FrictionReserve(1.1)]},
    ],
)
def test_other_limits_and_goals_are_planned_one_by_one_and_that_is_told(
    change: dict[str, Any], caplog: pytest.LogCaptureFixture
) -> None:
    task = TASK.replace(**change)
    wrenches = random_wrenches(np.random.default_rng(0), 3)
    with caplog.at_level("WARNING", "synergrip"):
        many = sg.plan_many(GRASP, task, wrenches=wrenches)
    assert "3 tasks are planned one by one" in caplog.text
    assert many.one_by_one.all()
    compare(many, [alone(GRASP, task, wrench) for wrench in wrenches], wrenches)


@pytest.mark.parametrize("kinds", [["hard"] * 3, ["soft"] * 4, ["hard", "soft", "soft"]], ids="-".join)
def test_many_grasps_each_with_its_load_as_one_by_one(kinds: list[str]) -> None:
    rng, N = np.random.default_rng(len(kinds)), 12
    grasps = [grasp_like(rng, kinds, n_z=4) for _ in range(N)]
    wrenches, friction_factors = random_wrenches(rng, N), rng.uniform(0.3, 1.2, N)
    for goal in (sg.LargestMargin(), sg.LeastEffort()):
        task = sg.Task(knots=1, limits=[*LIMITS, sg.SynergyReference(0.8)], goals=[goal])
        many = sg.plan_many(grasps, task, wrenches=wrenches, friction_factors=friction_factors)
        compare(
            many, [alone(g, task, w, f) for g, w, f in zip(grasps, wrenches, friction_factors, strict=True)], wrenches
        )
        assert not many.one_by_one.any()
    assert len(set(many.verdicts)) == 2  # both kinds of answers are among them


def test_a_stack_of_one_grasp_with_many_compliances_and_its_own_load_at_the_start() -> None:
    rng = np.random.default_rng(2)
    grasp = grasp_like(rng, ["hard"] * 3)
    w_0 = random_wrenches(rng, 6)
    stack = sg.GraspStack.varied(grasp, C_s=np.linspace(1.0, 3.0, 6)[:, None, None] * grasp.C_s, w_0=w_0)
    task = sg.Task(knots=1, limits=LIMITS)
    compare(sg.plan_many(stack, task), [alone(g, task, w) for g, w in zip(stack, w_0, strict=True)], w_0)


def test_a_hand_holds_the_load_at_the_start_whatever_the_mass() -> None:
    masses = np.linspace(0.05, 2.0, 8)
    whole = sg.make_grasp(hand, ball, posture="ball", synergies="motors", contacts=at, joint_compliance=0.02)
    near = sg.JointRange(lower=whole.held.q - 0.03, upper=whole.held.q + 0.03)  # what stops the squeeze
    limits = [sg.NormalForce(upper=20.0), sg.JointTorque("hand"), near]
    for goal in (sg.LargestMargin(), sg.LeastEffort()):
        task = sg.Task(knots=1, loads=[sg.Gravity((0, 0, -9.81))], limits=limits, goals=[goal], linearise="once")
        grasps = [whole.replace(mass=float(mass)) for mass in masses]
        wrenches = np.array([task.timed(each).wrench[0] for each in grasps])
        each = [plan_of_start_posture(each, task) for each in grasps]
        compare(sg.plan_many(whole, task, masses=masses), each, wrenches)
        compare(sg.plan_many(grasps, task, wrenches=wrenches), each, wrenches)
    assert len({one.verdict for one in each}) == 2


def test_what_a_kernel_gets_wrong_is_planned_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(3)
    grasp, wrenches = grasp_like(rng, ["hard"] * 3), random_wrenches(rng, 4)
    task = sg.Task(knots=1, limits=LIMITS)
    right = sg.plan_many(grasp, task, wrenches=wrenches)

    def lying(problems: ConeProblems, tolerance: Tolerance, enough: Array) -> ConeSolutions:
        N, n = len(problems), problems.q.shape[-1]
        x, z = rng.normal(size=(N, n)), np.abs(rng.normal(size=problems.b.shape))
        return ConeSolutions(x, problems.b, z, np.full(N, Status.SOLVED, dtype=np.int8), np.ones(N, dtype=np.int32))

    monkeypatch.setattr(module, "chosen", lambda count, kernel: lying)
    found = sg.plan_many(grasp, task, wrenches=wrenches)
    assert found.one_by_one.all()
    assert found.verified.all()
    assert not right.one_by_one.any()
    assert found.verdicts.tolist() == right.verdicts.tolist()
    assert np.allclose(found.forces, right.forces, atol=1e-4, equal_nan=True)


def test_rigid_and_unrestrained_grasps_among_others_are_told_by_their_place() -> None:
    rng = np.random.default_rng(4)
    good = grasp_like(rng, ["hard"] * 3)
    rigid = replace(good, C_s=np.zeros((9, 9)), C_q=np.zeros((9, 9)))
    points = tuple(replace(each, point=frozen([0.02, 0.0, 0.01 * i])) for i, each in enumerate(good.contacts))
    free = replace(good, contacts=points, G=grasp_matrix(points))
    task = sg.Task(knots=1, limits=LIMITS)
    wrenches = random_wrenches(rng, 3, 0.5)
    many = sg.plan_many([good, rigid, free], task, wrenches=wrenches)
    assert list(many.refusals) == [1]
    assert "rigid" in str(many.refusals[1])
    assert many.verdicts.tolist() == [alone(good, task, wrenches[0]).verdict, "unknown", "infeasible"]
    assert many.one_by_one.tolist() == [False, True, True]


def test_an_interrupt_keeps_the_rows_that_are_finished(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    grasp, wrenches = grasp_like(rng, ["hard"] * 3), random_wrenches(rng, 20)
    task, shares = sg.Task(knots=1, limits=LIMITS), list[float]()
    monkeypatch.setattr(module, "CHUNK", 8)
    whole = sg.plan_many(grasp, task, wrenches=wrenches, progress=lambda what, share: shares.append(share))
    assert shares == [0.4, 0.8, 1.0]

    def pressed(what: str, share: float) -> None:
        raise KeyboardInterrupt

    found = sg.plan_many(grasp, task, wrenches=wrenches, progress=pressed)
    assert found.interrupted
    assert found.finished.tolist() == [True] * 8 + [False] * 12
    assert np.array_equal(found.forces[:8], whole.forces[:8], equal_nan=True)
    assert set(found.verdicts[8:]) == {"unknown"}
    assert "interrupted after 8" in repr(found)


def test_threads_change_no_digit_and_an_interrupt_keeps_what_is_finished(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(8)
    grasps = [grasp_like(rng, ["hard"] * 3) for _ in range(50)]
    wrenches, task, seen = random_wrenches(rng, 50), sg.Task(knots=1, limits=LIMITS), list[float]()
    monkeypatch.setattr(module, "CHUNK", 8)
    work, used = module._answers, set[str]()

    def watched(*given: Any, **named: Any) -> Any:
        used.add(threading.current_thread().name)
        return work(*given, **named)

    monkeypatch.setattr(module, "_answers", watched)
    one, three = (sg.plan_many(grasps, task, wrenches=wrenches, threads=count) for count in (1, 3))
    assert "MainThread" in used
    assert len(used) > 1
    for name in ("forces", "dz_r", "margins", "largest_margin", "verdicts", "verified", "one_by_one"):
        assert np.array_equal(getattr(one, name), getattr(three, name), equal_nan=name not in ("verdicts",))

    def pressed(what: str, share: float) -> None:
        seen.append(share)
        if len(seen) == 2:
            raise KeyboardInterrupt

    found = sg.plan_many(grasps, task, wrenches=wrenches, threads=3, progress=pressed)
    assert seen == [8 / 50, 16 / 50]
    assert found.finished.tolist() == [True] * 16 + [False] * 34
    assert np.array_equal(found.forces[:16], one.forces[:16], equal_nan=True)
    assert np.isnan(found.forces[16:]).all()


def test_the_compiled_kernel_gives_the_same_plans() -> None:
    pytest.importorskip("numba")
    rng = np.random.default_rng(6)
    for goal in (sg.LargestMargin(), sg.LeastEffort()):
        grasp, wrenches = grasp_like(rng, ["soft"] * 4), random_wrenches(rng, 50, 2.0)
        task = sg.Task(knots=1, limits=LIMITS, goals=[goal])
        ours, theirs = (sg.plan_many(grasp, task, wrenches=wrenches, kernel=each) for each in ("numpy", "numba"))
        assert ours.verdicts.tolist() == theirs.verdicts.tolist()
        assert np.allclose(ours.worst_margin, theirs.worst_margin, atol=1e-6, equal_nan=True)
        assert not theirs.one_by_one.any()


GRASP = grasp_like(np.random.default_rng(7), ["hard"] * 3)
TASK = sg.Task(knots=1, limits=LIMITS)
MISTAKES: dict[str, tuple[dict[str, Any], str]] = {
    "a knot too many": ({"task": sg.Task(knots=2, limits=LIMITS)}, r"Task\.knots: expected 1 knot"),
    "allowances": ({"task": TASK.replace(allow=sg.Allowances(load_box=np.ones(6)))}, r"Task\.allow"),
    "a hand along the motion": ({"grasp": held, "task": sg.Task(knots=1)}, r"linearise='once'"),
    "counts": (
        {"wrenches": np.ones((2, 6)), "friction_factors": np.ones(3)},
        "expected as many of each, got 2 wrenches, 3",
    ),
    "wrenches of five": ({"wrenches": np.ones((2, 5))}, r"wrenches: .*shape \(N, 6\)"),
    "a wrench that is none": ({"wrenches": [[0, 0, np.nan, 0, 0, 0]]}, r"wrenches\[0\]: .*nan"),
    "no friction": ({"friction_factors": [1.0, 0.0]}, r"friction_factors\[1\]: .*greater than 0.*got 0"),
    "a mass of matrices": ({"masses": [1.0]}, "masses: needs one grasp on an object"),
    "no threads": ({"threads": 0}, "threads: expected a whole number of threads from 1 to 1024; got 0"),
    "half a thread": ({"threads": 1.5}, "threads: expected a whole number"),
    "a kernel of another name": ({"kernel": "fortran"}, "kernel: "),
    "nothing bounds it": ({"task": sg.Task(knots=1, goals=[sg.LargestMargin()])}, "nothing bounds the largest margin"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_are_told_by_the_argument(name: str) -> None:
    arguments, message = MISTAKES[name]
    given: dict[str, Any] = {"grasp": GRASP, "task": TASK, **arguments}
    with pytest.raises(sg.InputError, match=message):
        sg.plan_many(given.pop("grasp"), given.pop("task"), **given)


def test_objects_of_their_own_weigh_what_they_weigh() -> None:
    grasp = sg.load_problem("barrett-ball-hold").grasp
    masses = [0.1, 0.2, 0.4, 2.0]
    task = sg.Task(
        knots=1, loads=[sg.Gravity((0, 0, -9.81))], limits=[sg.NormalForce(upper=15.0), sg.SlipMargin(0.2)],
        goals=[sg.LargestMargin()], linearise="once",
    )  # fmt: skip
    many = sg.plan_many([grasp.replace(mass=mass) for mass in masses], task)
    assert many.verdicts.tolist() == ["feasible"] * 3 + ["infeasible"]
    np.testing.assert_allclose(many.largest_margin, sg.plan_many(grasp, task, masses=masses).largest_margin, rtol=1e-6)
