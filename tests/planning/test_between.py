"""Between the knots: what is reported is what happens, and what is held holds at every instant."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from named_goals import goals
from random_cone_problems import grasp_like, random_wrenches
from random_tasks import random_task_on_grasp
from scipy.interpolate import CubicSpline

from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import between
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem
from synergrip.statics.motion import forward
from synergrip.tasks.marks import Marks
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask, still
from synergrip.tasks.wrenches import WrenchTable


@dataclass(frozen=True)
class Swinging:
    """A load along a spline through random values."""

    spline: CubicSpline

    def load_at(self, times: Array) -> Array:
        return np.asarray(self.spline(times))

    def target_at(self, times: Array) -> Array:
        return np.zeros((len(times), 0))

    @property
    def marks(self) -> Marks:
        return Marks(curved=((float(self.spline.x[0]), float(self.spline.x[-1])),))


def swinging(seed: int, goal: str) -> tuple[Grasp, TimedTask]:
    rng = np.random.default_rng(seed)
    grasp, task = random_task_on_grasp(rng)
    times = frozen(np.cumsum(rng.uniform(0.1, 0.4, 6)))
    values = task.wrench[0] + 0.3 * rng.normal(size=(6, 6)) * [1, 1, 1, 0.01, 0.01, 0.01]
    limits = (*task.limits, ObjectError(0.05))
    course = Swinging(CubicSpline(times, values))
    return grasp, replace(
        task, times=times, wrench=frozen(values), target=still(times), limits=limits, course=course,
        goals=goals(goal), margin=0.02,
    )  # type: ignore[arg-type]  # fmt: skip


def worst_between(outcome: Plan, per_interval: int = 200) -> float:
    """Return the worst excess over any limit at many instants, in units of the limits, by the physical formulas."""
    task, response = outcome.task, outcome.analysis.response
    assert task.course is not None
    times = np.linspace(task.times[0], task.times[-1], per_interval * (len(task.times) - 1) + 1)
    wrench = task.course.load_at(times)
    assert wrench is not None
    motion = forward(response, times, interpolated(times, task.times, outcome.motion.dz_r), wrench)
    there = replace(outcome.formulation, times=times, wrench=wrench, target=np.zeros((len(times), 6)))
    limits = [limit for limit in (FrictionCone(task.margin), *task.kept) if not limit.couples_knots]
    usages = [limit.usage(there, motion) for limit in limits]
    return max(usage.violation for usage in usages)


@pytest.mark.parametrize("goal", ["margin", "effort", "peak_force"])
def test_limits_that_are_held_between_the_knots_hold_at_every_instant(goal: str) -> None:
    held = missed = 0
    for seed in range(12):
        grasp, task = swinging(seed, goal)
        loose, tight = plan(grasp, task), plan(grasp, replace(task, between="hold"))
        if isinstance(loose, Plan):
            assert loose.between is not None
            assert loose.between.excess == pytest.approx(worst_between(loose), rel=0.02, abs=2e-3)
            missed += worst_between(loose) > 1e-6
        if isinstance(tight, Plan):
            held += 1
            assert worst_between(tight) <= 1e-6, seed
            assert tight.between is not None
            assert tight.between.excess <= 1e-6
            if goal == "margin":
                assert tight.largest_margin is not None
                assert isinstance(loose, Plan)
                assert tight.largest_margin <= loose.largest_margin + 1e-6
    assert held >= 3
    assert missed >= 2  # without the reserve limits are passed, so the test can fail


def test_a_straight_load_needs_no_reserve() -> None:
    for name in ("tripod", "barrett-ball-roll"):
        problem = load_problem(name)
        report, hold = (plan(problem.grasp, replace(problem.timed, between=way)) for way in ("report", "hold"))
        assert isinstance(report, Plan)
        assert isinstance(hold, Plan)
        assert report.between is not None
        assert report.between.load_departure == 0.0
        np.testing.assert_allclose(hold.alpha, report.alpha, atol=1e-6 * np.abs(report.alpha).max())


def test_the_departure_of_a_turning_weight_is_known() -> None:
    """The weight turns at constant speed: a chord of the circle is R (1 - cos(half the angle)) away from it."""
    turn = 'task.palm={axis="x", turn="90 deg", profile="linear"}'
    problem = load_problem("barrett-ball-hold", [turn, "task.knots=7"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.between is not None
    middle = np.pi / 2 * (np.arange(6) + 0.5) / 6  # in the middle of each interval the departure is along the weight
    weight = 0.2 * 9.81 * np.column_stack([0 * middle, -np.sin(middle), -np.cos(middle), *np.zeros((3, 6))])
    size = np.linalg.norm(outcome.analysis.response.scale.wrench(weight), axis=1).max()
    assert outcome.between.load_departure == pytest.approx(size * (1 - np.cos(np.pi / 24)), rel=0.01)


@pytest.mark.parametrize("bend", [0.5, 0.6])
def test_where_only_knots_are_looked_at_looking_again_sees_the_same(bend: float) -> None:
    """A load that bends at a knot alone is straight between them; one that bends elsewhere is looked at there."""
    rng = np.random.default_rng(1)
    table = WrenchTable([0.0, bend, 1.0], random_wrenches(rng, 3, 0.3))
    task = Task(knots=5, loads=[table], limits=[NormalForce(upper=10.0), SynergyRate(100.0)])
    outcome = plan(grasp_like(rng, ["hard"] * 3), task)
    assert isinstance(outcome, Plan)
    found, again = outcome.between, between(outcome.task, outcome.analysis, outcome.formulation, outcome.motion)
    assert found is not None
    assert again is not None
    assert found.corners == again.corners == (() if bend == 0.5 else (bend,))
    assert [usage.title for usage in found.usages] == ["slip margin", "normal force"]
    for one, other in zip(found.usages, again.usages, strict=True):
        np.testing.assert_allclose(one.value, other.value, atol=1e-12)
        assert len(one.times) == (5 if bend == 0.5 else 6)
    assert (found.load_departure > 0.0) == (bend == 0.6)


@pytest.mark.parametrize("goal", ["margin", "effort", "peak_force"])
def test_the_second_formulation_keeps_the_same_reserve(goal: str) -> None:
    compared = 0
    for seed in range(4):
        grasp, task = swinging(seed, goal)
        held = replace(task, between="hold")
        one, two = plan(grasp, held), plan(grasp, held, SOLVERS["cvxpy"])
        assert one.verdict == two.verdict
        if isinstance(one, Plan) and isinstance(two, Plan):
            compared += 1
            size = np.abs(one.motion.forces).max()
            np.testing.assert_allclose(two.motion.forces, one.motion.forces, atol=1e-5 * size)
    assert compared
