"""Random trajectories for tests: smooth loads and motions over many uneven knots, every limit, goal and tracking.

Limits are drawn around what the least effort without them would use, so that most of them bind and some cannot be kept.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from named_goals import goals, names_of
from random_tasks import LEVER, hand_like_grasp

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import AXES, AxisName, ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.statics.analysis import Analysis, analyse
from synergrip.tasks.timed_task import Target, TimedTask, still

ORDERS: tuple[tuple[str, ...], ...] = (
    ("effort",), ("torque",), ("actuator",), ("margin",), ("peak_force",), ("references",), ("travel",), ("smooth",),
    ("centred",), ("weighted",), ("margin", "effort", "smooth"), ("effort", "travel"), ("travel", "effort"),
    ("peak_force", "torque", "references"), ("smooth", "actuator"), ("weighted", "centred"),
)  # fmt: skip
WEIGHTS: tuple[dict[str, float], ...] = (
    {"effort": 1.0, "travel": 0.1},
    {"torque": 1.0, "smooth": 1e-3},
    {"actuator": 1.0, "references": 0.3, "centred": 0.1},
)
MOTION = 1e-3
"""Size of the wanted motions [m]."""


def random_trajectory(seed: int, knots: int) -> tuple[Grasp, TimedTask]:
    """A hand-like grasp and a task over `knots` instants; goals take turns with the seed."""
    rng = np.random.default_rng(seed)
    for _ in range(3):  # most are to fail, if at all, by what limits ask for
        grasp, task, ranges = _wish(rng, seed, knots)
        easy = plan(grasp, replace(task, goals=goals("effort")))
        if isinstance(easy, Plan):
            return grasp, replace(task, limits=_limits(rng, task, easy, ranges))
    return grasp, task


def _wish(rng: np.random.Generator, seed: int, knots: int) -> tuple[Grasp, TimedTask, JointRange]:
    """A grasp, its load, the motion wanted of it and the goal, with little to limit them, and ranges of its joints."""
    grasp = _grasp(rng)
    duration = rng.uniform(0.5, 4.0)
    steps = rng.uniform(0.6, 1.4, knots - 1) if seed % 2 else np.ones(knots - 1)
    times = frozen(duration * np.r_[0.0, np.cumsum(steps) / steps.sum()])
    load = rng.uniform(0.5, 5.0)
    wrench = grasp.w_0 + _wrench(rng, times, load)
    if grasp.lambda_0 is None and rng.uniform() < 0.5:
        grasp = replace(grasp, w_0=frozen(wrench[0]))  # the grasp carries its load when the task begins
    order = ORDERS[seed % len(ORDERS)]
    start = rng.uniform(-0.5, 0.5, grasp.n_q)
    room = rng.uniform(0.3, 1.5, (2, grasp.n_q))
    ranges = JointRange(frozen(start), frozen(start - room[0]), frozen(start + room[1]))
    task = TimedTask(
        times, frozen(wrench), still(times), float(rng.choice([0.0, 0.05, 0.2])) * load,
        (NormalForce(0.0, 30 * load), JointTorque(frozen(np.full(grasp.n_q, 10 * LEVER * load)))),
        goals(*order, weights=WEIGHTS[seed % len(WEIGHTS)], ranges=ranges),
    )  # fmt: skip
    return grasp, _tracked(rng, analyse(grasp), task), ranges


def _grasp(rng: np.random.Generator) -> Grasp:
    """A hand with a few synergies, or (one in three) with as many as joints, which move the object about."""
    grasp = hand_like_grasp(rng)
    if rng.uniform() < 0.67:
        return grasp
    n = grasp.n_q
    S = 0.5 * np.hstack([grasp.S[:, :2], rng.normal(size=(n, n - 2))])
    C_z = rng.choice([0.0, 0.05]) * np.diag(rng.uniform(0.5, 2.0, n))
    return replace(grasp, S=frozen(S), C_z=frozen(C_z), synergies=tuple(f"z{i + 1}" for i in range(n)))


def smooth(rng: np.random.Generator, times: Array, columns: int) -> Array:
    """Smooth signals (T, columns) of size about 1: three waves, the slowest the largest."""
    share = (times - times[0]) / (times[-1] - times[0])
    waves = [np.sin(2 * np.pi * (0.5 * k * share[:, None] + rng.uniform(size=columns))) / k for k in (1, 2, 3)]
    return np.asarray(sum(rng.uniform(0.3, 1.0, columns) * wave for wave in waves))


def _wrench(rng: np.random.Generator, times: Array, load: float) -> Array:
    constant = rng.normal(size=3)
    force = load * (constant / np.linalg.norm(constant) + 0.3 * smooth(rng, times, 3))
    return np.hstack([force, 0.1 * LEVER * load * smooth(rng, times, 3)])


def _tracked(rng: np.random.Generator, analysis: Analysis, task: TimedTask) -> TimedTask:
    """The task with a wanted motion: rigid along modes or a motion, on some axes only, or of the whole object."""
    times, basis = task.times, analysis.spaces.Gamma_ucs
    course = smooth(rng, times, basis.shape[1])
    modes = MOTION * (course - course[0])
    draw, outside = rng.uniform(), rng.uniform() < 0.1
    if draw < 0.2:
        return task
    if draw < 0.4:
        return replace(task, target=Target("modes", frozen(modes)))
    values = modes @ basis.T
    axes: tuple[AxisName, ...] = tuple(axis for axis in AXES if rng.uniform() < 0.5) or AXES
    drift = float(MOTION * rng.uniform(1, 5)) if rng.uniform() < 0.6 and len(axes) < 6 else None
    if draw < 0.7:
        if outside:
            values = values + MOTION * (smooth(rng, times, 6) - 0.5) * [1, 1, 1, 20, 20, 20]
        task = replace(task, target=Target("motion", frozen(values)))
        return task if draw < 0.55 else replace(task, axes=axes, drift=drift)
    other = 0.2 * MOTION * smooth(rng, times, 6) * [1, 1, 1, 20, 20, 20]
    return replace(
        task, target=Target("motion", frozen(values + other - other[0])), tracking="compliant",
        tolerance=float(MOTION * 10 ** rng.uniform(-1, 0.7)),
        axes=axes if rng.uniform() < 0.5 else AXES, drift=drift if len(axes) < 6 else None,
    )  # fmt: skip


def _limits(rng: np.random.Generator, task: TimedTask, easy: Plan, ranges: JointRange) -> tuple[Limit, ...]:
    """Some of all limits, each around what the least effort uses of it."""
    grasp = easy.analysis.grasp
    motion, h = easy.motion, np.diff(task.times)[:, None]
    rates = np.diff(motion.dz_r, axis=0) / h
    bends = 2 * np.diff(rates, axis=0) / (h[1:] + h[:-1])
    scale = easy.analysis.response.scale
    elastic = np.linalg.norm(scale.twist(easy.elastic_motion), axis=1).max()
    error = np.linalg.norm((motion.du - easy.formulation.target) * ([1.0] * 3 + [scale.length] * 3), axis=1).max()
    normal = float(motion.forces[:, grasp.normal_rows].max())
    limits: list[Limit] = [
        NormalForce(float(rng.choice([0.0, 0.02])) * easy.formulation.force_unit, normal * _more(rng)),
        JointTorque(_around(rng, motion.torques)),
        ActuatorEffort(_around(rng, motion.efforts)),
        SynergyReference(_around(rng, motion.dz_r)),
        SynergyRate(_around(rng, rates)),
        SynergyAcceleration(_around(rng, bends)),
        _range(rng, ranges, motion.dq),
        ElasticMotion(max(elastic, 1e-5) * _more(rng)),
        ObjectError(max(error, 1e-5) * _more(rng)),
        FrictionReserve(ratios=frozen(rng.uniform(0.75, 1.0, grasp.n_c))),
    ]
    needed = 1 if "margin" in names_of(task.goals) else 0  # something must bound a largest margin
    return tuple(limit for k, limit in enumerate(limits) if k < needed or rng.uniform() < 0.35)


def _more(rng: np.random.Generator) -> float:
    return float(10 ** rng.uniform(-0.06, 0.1))


def _around(rng: np.random.Generator, used: Array) -> Array:
    """Bounds around the peaks of used (T, m), each its own way; one in six is free."""
    peaks = np.abs(used).max(axis=0)
    bounds = np.maximum(peaks, max(0.1 * peaks.max(), 1e-6)) * _more(rng) * rng.uniform(1.0, 1.1, len(peaks))
    bounds[rng.uniform(size=len(peaks)) < 1 / 6] = np.inf
    return frozen(bounds)


def _range(rng: np.random.Generator, ranges: JointRange, dq: Array) -> JointRange:
    """The ranges of the hand, drawn close around what the joints do."""
    start, more = ranges.start, 1.1 * _more(rng)
    low, high = (np.maximum(sign * dq, 0.02).max(axis=0) * more for sign in (-1, 1))
    return replace(ranges, lower=frozen(start - low), upper=frozen(start + high))
