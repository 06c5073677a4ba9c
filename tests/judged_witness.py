"""No task with a known plan is called infeasible: plans first, and then limits with little room around them.

    python tests/judged_witness.py 5000 [seed]

References are drawn, the forces follow from an elastic system of its own (`elastic_grasp.py`), and friction, margin and
all limits are set 1e-6 to 10 % wider than what they bring. "False" counts tasks that are called infeasible, "unknown"
those without an answer.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from elastic_grasp import AXES, Course, course, motion_at_centroid, normal_forces, sizes_on
from least_changes import rigid_motions
from made_kinds import spin_of
from named_goals import goals
from random_tasks import RADIUS, hand_like_grasp

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import Target, TimedTask

ROOM = (-6.0, -1.0)
"""Powers of ten between which the room is, as a share of what a plan brings."""
MOST_FRICTION = 3.0


def with_witness(rng: np.random.Generator) -> tuple[Grasp, TimedTask, Array] | None:
    """Return a task and references (T, n_z) that are a plan of it; None where fingers pull or rub too much."""
    grasp = hand_like_grasp(rng)
    times = frozen(np.cumsum(rng.uniform(0.1, 0.4, int(rng.integers(1, 6)))))
    load = rng.uniform(0.5, 5.0)
    wrench = load * (rng.normal(size=6) + 0.3 * rng.normal(size=(len(times), 6))) * ([1.0] * 3 + [0.2 * RADIUS] * 3)
    closing = np.zeros(grasp.n_z)
    closing[:2] = 1.0
    dz_r = closing + 0.3 * rng.normal(size=grasp.n_z) + 0.1 * rng.normal(size=(len(times), grasp.n_z))
    unit = course(grasp, times, dz_r, np.tile(grasp.w_0, (len(times), 1)))
    dz_r *= load * rng.uniform(2.0, 6.0) / float(np.abs(normal_forces(grasp, unit.forces)).max())
    found = course(grasp, times, dz_r, grasp.w_0 + wrench)
    if normal_forces(grasp, found.forces).min() <= 0.02 * load:
        return None
    room = float(10 ** rng.uniform(*ROOM))
    margin = float(load * rng.uniform(0.0, 0.2)) if rng.uniform() < 0.5 else 0.0
    rubbing = _rubbing(grasp, found, margin) * (1 + room)
    if rubbing.max() > MOST_FRICTION:
        return None
    slippery = {c.name: c.kind.slippery(mu / c.friction) for c, mu in zip(grasp.contacts, rubbing, strict=True)}
    grasp, basis = grasp.replace(contact=slippery), rigid_motions(grasp)
    motion = motion_at_centroid(grasp, found.du - found.sag) @ basis @ basis.T
    wish = motion @ np.linalg.inv(motion_at_centroid(grasp, np.eye(6)).T).T
    limits = _around(rng, grasp, found, wish, room)
    goal = str(rng.choice(["margin", "effort", "torque", "peak_force"]))
    task = TimedTask(times, frozen(grasp.w_0 + wrench), Target("motion", frozen(wish)), margin, limits, goals(goal))
    return grasp, task, dz_r


def _rubbing(grasp: Grasp, found: Course, margin: float) -> Array:
    """Return the friction (n_c,) with which the forces of each contact keep a margin, mu n - ||(t, o, mu m / nu)||."""
    least = []
    for contact, part in zip(grasp.contacts, grasp.rows, strict=True):
        force, spin = np.array(found.forces[:, part]), spin_of(contact)
        if spin:
            force[:, 3] *= contact.friction / spin
        least.append(float(((np.linalg.norm(force[:, 1:], axis=1) + margin) / force[:, 0]).max()))
    return np.maximum(least, 0.05)


def _around(rng: np.random.Generator, grasp: Grasp, found: Course, wish: Array, room: float) -> tuple[Limit, ...]:
    """Return some of the limits, wider than the plan by a share; one that bounds the largest margin always."""

    def most(values: Array) -> Array:
        largest = np.abs(values).max(axis=0)
        return frozen(np.maximum(largest, 1e-3 * largest.max()) * (1 + room))

    h, normal = np.diff(found.times), normal_forces(grasp, found.forces)
    limits: list[Limit] = [
        NormalForce(float(rng.integers(2)) * float(normal.min()) * (1 - room), float(normal.max()) * (1 + room)),
        JointTorque(most(found.torques)), ActuatorEffort(most(found.efforts)), SynergyReference(most(found.dz_r)),
        JointRange(start=0.0, lower=-most(found.dq), upper=most(found.dq)),
        ObjectError(float(sizes_on(grasp, AXES, found.du - wish).max()) * (1 + room)),
        ElasticMotion(float(np.linalg.norm(motion_at_centroid(grasp, found.du - found.sag - wish), axis=1).max())
                      * (1 + room)),
    ]  # fmt: skip
    if len(h):
        rates = np.diff(found.dz_r, axis=0) / h[:, None]
        limits.append(SynergyRate(most(rates)))
        if len(h) > 1:
            limits.append(SynergyAcceleration(most(2 * np.diff(rates, axis=0) / (h[1:] + h[:-1])[:, None])))
    return tuple(limit for index, limit in enumerate(limits) if index == 0 or rng.uniform() < 0.5)


def main(wanted: int, seed: int) -> None:
    """Print how many tasks were called what."""
    counts: Counter[str] = Counter()
    draw = -1
    while counts.total() < wanted:
        draw += 1
        made = with_witness(np.random.default_rng([seed, draw]))
        if made is None:
            continue
        verdict = plan(made[0], replace(made[1], linearise="once")).verdict
        counts[verdict] += 1
        if verdict != "feasible":
            print(f"  draw {draw}: {verdict}", file=sys.stderr, flush=True)
    print(f"{wanted} tasks with a plan: {counts['infeasible']} false, {counts['unknown']} unknown")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
