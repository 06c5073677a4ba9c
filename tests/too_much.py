"""Tasks that have a plan until one of their numbers is altered, on random matrices and on bundled hands."""

from __future__ import annotations

from dataclasses import replace

import cvxpy as cp
import numpy as np
from altered_numbers import DOWN, turned
from elastic_grasp import Course, course, motion_at_centroid, normal_forces, sizes_on
from least_changes import LeastChanges, rigid_motions
from named_goals import goals
from random_tasks import RADIUS, hand_like_grasp

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import AXES, ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.problems.problem import load_problem
from synergrip.tasks.timed_task import Target, TimedTask, still

HANDS = ("barrett-ball-hold", "barrett-ball-lift", "gripper-box", "brown-asada-ball", "table2-soft-motors")
HARD = 20.0
"""How much tighter a number is made to find where plans end."""
KNOTS = {"rate": (2, 3, 5), "acceleration": (3, 4, 5)}
ALWAYS = 0.5
"""How often a limit other than the one in question is there."""
Question = tuple[Grasp, TimedTask]


def altered(rng: np.random.Generator, number: str, hand: str | None = None) -> Question | None:
    """Return a task without a plan that had one before a number was altered; None where this one cannot be at fault."""
    found = with_plan(rng, number, hand)
    if found is None:
        return None
    tight = HARD if number in DOWN else 1 / HARD
    factor = LeastChanges(*turned(*found, number, tight)).factor(number)
    if not 0 < factor < np.inf or abs(factor - 1) < 1e-6:
        return None
    beyond = 1 + 10 ** rng.uniform(-2.5, -0.3)
    return turned(*found, number, tight * factor * (beyond if number in DOWN else 1 / beyond))


def with_plan(rng: np.random.Generator, number: str, hand: str | None = None) -> Question | None:
    """Return a task whose limits leave some room around a plan; that of a number is among them."""
    grasp, task = _on_matrices(rng, number) if hand is None else _on_hand(rng, number, hand)
    if len(task.times) < min(KNOTS.get(number, (1,))):
        return None
    plan = some_plan(rng, grasp, task)
    if plan is None:
        return None
    if task.tracking == "compliant":
        task = replace(task, tolerance=_apart(grasp, task, plan) * float(rng.uniform(1.02, 1.6)))
    return grasp, replace(task, limits=_around(rng, number, grasp, task, plan))


def _on_matrices(rng: np.random.Generator, number: str) -> Question:
    grasp = hand_like_grasp(rng)
    knots = int(rng.choice(KNOTS.get(number, (1, 2, 3))))
    times, load = frozen(np.cumsum(rng.uniform(0.1, 0.4, knots))), rng.uniform(0.5, 5.0)
    part = [1.0] * 3 + [0.2 * RADIUS] * 3
    wrench = frozen(grasp.w_0 + load * (rng.normal(size=6) + 0.4 * rng.normal(size=(knots, 6))) * part)
    margin = float(load * rng.uniform(0.02, 0.2)) if number == "margin" or rng.uniform() < 0.5 else 0.0
    basis, target = rigid_motions(grasp), still(times)
    if basis.shape[1] and (number in ("rate", "acceleration", "amplitude", "tolerance") or rng.uniform() < 0.5):
        scaled = np.linalg.inv(motion_at_centroid(grasp, np.eye(6)).T)
        course_of = 0.002 * np.cumsum(rng.normal(size=(knots, basis.shape[1])), axis=0)
        target = Target("motion", frozen(course_of @ basis.T @ scaled.T))
    task = TimedTask(times, wrench, target, margin, (), goals("effort"), linearise="once")
    return grasp, replace(task, tracking="compliant", tolerance=1.0) if number == "tolerance" else task


def _on_hand(rng: np.random.Generator, number: str, hand: str) -> Question:
    """Return a bundled problem at a few of its knots, without limits, its load and friction a little different."""
    problem = load_problem(hand)
    grasp = problem.grasp
    timed = problem.task.timed(grasp)
    some = np.unique(np.linspace(0, len(timed.times) - 1, max(KNOTS.get(number, (3,)))).astype(int))
    values = timed.target.values[some]
    target = still(timed.times[some]) if not np.any(values) else replace(timed.target, values=frozen(values))
    wrench = frozen(rng.uniform(0.5, 1.5) * timed.wrench[some])
    margin = float(rng.uniform(0.02, 0.3)) if number == "margin" or rng.uniform() < 0.5 else 0.0
    task = TimedTask(
        timed.times[some], wrench, target, margin, (JointRange(lower=-np.inf, upper=np.inf),), goals("effort"),
        timed.tolerance, linearise="once",
    )  # fmt: skip
    return turned(grasp, task, "friction", rng.uniform(0.8, 1.3))


def some_plan(rng: np.random.Generator, grasp: Grasp, task: TimedTask) -> Course | None:
    """Return a plan that keeps friction cones and follows the motion, not the best one by anything."""
    model = LeastChanges(grasp, replace(task, limits=()))
    near = cp.sum_squares(model.y - rng.normal(size=model.y.shape))
    program = cp.Problem(cp.Minimize(cp.sum_squares(model.force_at / model.force) + 0.1 * near), model.asked)
    try:
        program.solve(solver=cp.CLARABEL)
    except cp.SolverError:  # another one is drawn
        return None
    if program.status != "optimal":
        return None
    held = grasp if grasp.held is None else replace(grasp, w_0=frozen(task.wrench[0]), lambda_0=None)
    return course(held, task.times, model.unit * model.y.value, task.wrench)


def _around(rng: np.random.Generator, number: str, grasp: Grasp, task: TimedTask, plan: Course) -> tuple[Limit, ...]:
    """Return limits that leave 2 to 60 % more than a plan needs."""

    def most(values: Array) -> Array:
        largest = np.abs(values).max(axis=0)
        return frozen(np.maximum(largest, 1e-3 * largest.max() + 1e-12) * rng.uniform(1.02, 1.6, largest.shape))

    h, normal = np.diff(task.times), normal_forces(grasp, plan.forces)
    rates = np.diff(plan.dz_r, axis=0) / h[:, None]
    wish = _wish(task)
    apart = _apart(grasp, task, plan)
    elastic = float(np.linalg.norm(motion_at_centroid(grasp, plan.du - plan.sag - wish), axis=1).max())
    room = float(rng.uniform(1.02, 1.6))
    floor = float(normal.min()) / room if number != "force_cap" and rng.uniform() < 0.3 else 0.0
    makers = {
        "force_cap": lambda: NormalForce(floor, float(normal.max()) * room),
        "torque": lambda: JointTorque(most(plan.torques)), "effort": lambda: ActuatorEffort(most(plan.efforts)),
        "synergy_range": lambda: SynergyReference(most(plan.dz_r)), "rate": lambda: SynergyRate(most(rates)),
        "acceleration": lambda: SynergyAcceleration(most(2 * np.diff(rates, axis=0) / (h[1:] + h[:-1])[:, None])),
        "joint_range": lambda: _ranges(grasp, most(plan.dq)), "drift": lambda: ObjectError(apart * room),
        "elastic": lambda: ElasticMotion(elastic * room),
    }  # fmt: skip
    left_out = {
        *(["rate"] * (len(h) < 1)), *(["acceleration"] * (len(h) < 2)),
        *(["elastic"] * (task.tracking == "compliant" or elastic < 1e-9)),
    }  # fmt: skip
    limits = [make() for name, make in makers.items()
              if name == number or (name not in left_out and rng.uniform() < ALWAYS)]  # fmt: skip
    if grasp.held is not None and not any(isinstance(limit, JointRange) for limit in limits):
        limits.append(JointRange(lower=-np.inf, upper=np.inf))
    return tuple(limits)


def _wish(task: TimedTask) -> Array:
    return task.target.values if task.target.values.size else np.zeros((len(task.times), 6))


def _apart(grasp: Grasp, task: TimedTask, plan: Course) -> float:
    """Return how far the object is from where it is wanted at most [m]."""
    return float(sizes_on(grasp, AXES, plan.du - _wish(task)).max())


def _ranges(grasp: Grasp, reach: Array) -> JointRange:
    start = np.zeros(grasp.n_q) if grasp.held is None else grasp.held.q
    return JointRange(start=start, lower=frozen(start - reach), upper=frozen(start + reach))
