"""Random hand-like problems for tests: fingers that can squeeze, realistic units, about half of them feasible."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from made_kinds import made_kind
from named_goals import goals

from synergrip.conic.formulate import formulate
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.conic.question import Question
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.contacts.kind import is_moment
from synergrip.grasps.contacts.kinds import KINDS
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, block_diagonal, frozen
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.statics.analysis import analyse
from synergrip.tasks.scaling import units_of
from synergrip.tasks.timed_task import Target, TimedTask, still
from synergrip.tasks.tracking import rigid_coordinates

RADIUS = 0.02  # [m] of the object
LEVER = 0.05  # [m] from a joint to its contact
Shares = Mapping[str, float]
"""Name of a kind of contact -> how often there is one."""
USUAL: Shares = {"hard": 0.75, "soft": 0.25}


def random_task_on_grasp(rng: np.random.Generator, kinds: Shares = USUAL) -> tuple[Grasp, TimedTask]:
    """A grasp that can squeeze and a task on it; a third asks for 0.99 to 1.01 times the largest margin there is."""
    grasp = hand_like_grasp(rng, kinds)
    task = _task(rng, grasp)
    draw = rng.uniform()
    if draw < 0.4:
        return grasp, replace(task, margin=float(rng.choice([0.0, rng.uniform(0.0, 0.5)])))
    largest = _largest_margin(grasp, task)
    if largest is None or largest <= 0:
        return grasp, task
    factor = rng.uniform(0.99, 1.01) if draw < 0.7 else rng.uniform(0.2, 1.8)
    return grasp, replace(task, margin=float(factor * largest))


def hand_like_grasp(rng: np.random.Generator, kinds: Shares = USUAL) -> Grasp:
    """A thumb against two or three fingers around a 40 mm object, each with two or three joints of its own."""
    contacts = _contacts(rng, int(rng.integers(3, 5)), kinds)
    fingers = [_finger(rng, contact) for contact in contacts]
    idle = rng.uniform() < 0.25  # a joint that moves no contact
    J = np.hstack([block_diagonal(fingers), np.zeros((sum(c.n_rows for c in contacts), int(idle)))])
    G = grasp_matrix(contacts)
    n_q, n_z = J.shape[1], int(rng.choice([2, 3, 4, 5, 6], p=[0.1, 0.15, 0.25, 0.25, 0.25]))
    S = 0.5 * rng.normal(size=(n_q, n_z))
    start = 0
    for finger in fingers:  # the first two synergies close all fingers, each with its own weights
        S[start, :2] = rng.uniform(0.5, 1.5, 2)
        S[start + 1, :2] = rng.uniform(0.2, 0.8, 2)
        start += finger.shape[1]
    if idle:
        S[:, -1] = np.eye(n_q)[-1]
        S = S @ (np.eye(n_z) + 0.7 * rng.normal(size=(n_z, n_z)))
    soft = np.array([1e4 if is_moment(component) else 1.0 for c in contacts for component in c.kind.components])
    C_s = 10 ** rng.uniform(-4, -3) * np.diag(soft * rng.uniform(0.7, 1.4, len(soft)))
    C_q = rng.choice([0.0, 0.02]) * np.diag(rng.uniform(0.5, 2.0, n_q))
    C_z = rng.choice([0.0, 0.05]) * np.diag(rng.uniform(0.5, 2.0, n_z))
    names = tuple(f"q{i + 1}" for i in range(n_q)), tuple(f"z{i + 1}" for i in range(n_z))
    grasp = Grasp(
        title="hand-like", contacts=contacts, G=G, J=J, S=S, C_s=C_s, C_q=C_q, C_z=C_z, joints=names[0],
        synergies=names[1],
    )  # fmt: skip
    return _preloaded(rng, grasp) if rng.uniform() < 0.2 else grasp


def _contacts(rng: np.random.Generator, count: int, kinds: Shares) -> tuple[Contact, ...]:
    """The thumb at angle pi, the fingers spread about angle 0 and in height."""
    contacts = []
    for i in range(count):
        angle = np.pi if i == 0 else np.linspace(-0.7, 0.7, count - 1)[i - 1]
        angle += 0.15 * rng.normal()
        height = 0.3 * rng.normal()
        point = RADIUS * np.array([np.cos(angle), np.sin(angle), height])
        normal = -np.array([np.cos(angle), np.sin(angle), 0.3 * height]) + 0.1 * rng.normal(size=3)
        name = str(rng.choice(list(kinds), p=list(kinds.values())))
        spin = float(rng.uniform(0.002, 0.01)) if name not in ("hard", "frictionless") else 0.0
        mu = float(rng.uniform(0.5, 1.2))
        more = {each.name: rng.uniform(0.003, 0.02) if each.length else mu * rng.uniform(0.5, 2.0)
                for each in KINDS[name].parameters if each.name not in ("friction", "spin_friction")}  # fmt: skip
        kind = made_kind(name, mu, spin, **more)
        contacts.append(Contact(name=f"C{i + 1}", kind=kind, point=frozen(point), frame=contact_frame(normal)))
    return tuple(contacts)


def _finger(rng: np.random.Generator, contact: Contact) -> Array:
    """Jacobian (rows, 2 or 3) of one finger: two joints that close it, and perhaps one that swings it sideways."""
    joints = int(rng.integers(2, 4))
    block = 0.25 * rng.normal(size=(contact.n_rows, joints))
    block[0, :2] += [1.0, 0.6]
    block[1:3, 1] += 0.8 * rng.normal(size=2)
    if joints == 3:
        block[1:3, 2] += rng.normal(size=2)
    block[:3] *= LEVER
    return block


def _preloaded(rng: np.random.Generator, grasp: Grasp) -> Grasp:
    """The same grasp, loaded and squeezed at the start."""
    w_0 = _wrench(rng, 0.5)
    squeeze = grasp.S[:, 0] @ grasp.J.T  # forces along the closing motion, balanced below
    squeeze *= 2.0 / np.linalg.norm(squeeze)
    balance = np.linalg.pinv(grasp.G)
    lambda_0 = -balance @ w_0 + squeeze - balance @ (grasp.G @ squeeze)
    return replace(grasp, w_0=frozen(w_0), lambda_0=frozen(lambda_0))


def _wrench(rng: np.random.Generator, size: float) -> Array:
    force = rng.normal(size=3)
    return np.r_[size * force / np.linalg.norm(force), 0.2 * RADIUS * size * rng.normal(size=3)]


def _task(rng: np.random.Generator, grasp: Grasp) -> TimedTask:
    knots = int(rng.choice([1, 2, 3, 5], p=[0.4, 0.3, 0.2, 0.1]))
    times = frozen(np.cumsum(rng.uniform(0.1, 0.4, knots)))
    load = rng.uniform(0.5, 5.0)
    wrench = frozen(grasp.w_0 + _wrench(rng, load) + np.array([_wrench(rng, 0.3 * load) for _ in times]))
    goal = ("margin", "effort", "torque", "peak_force")[int(rng.integers(4))]
    wanted = still(times)
    dimension = analyse(grasp).spaces.Gamma_ucs.shape[1]
    if dimension and rng.uniform() < 0.6:
        wanted = Target("modes", frozen(0.002 * np.cumsum(rng.normal(size=(knots, dimension)), axis=0)))
    return TimedTask(times, wrench, wanted, 0.1, _limits(rng, grasp, load), goals(goal))


def _limits(rng: np.random.Generator, grasp: Grasp, load: float) -> tuple[Limit, ...]:
    """Joint torques always; one joint in ten is free when the normal force is bounded, so that every margin is."""
    upper = float(load * rng.uniform(2.0, 8.0)) if rng.uniform() < 0.8 else np.inf
    lower = float(rng.choice([0.0, 0.0, 0.1]))
    torque = load * LEVER * rng.uniform(2.0, 8.0) * rng.uniform(0.7, 1.3, grasp.n_q)
    if np.isfinite(upper):
        torque[rng.uniform(size=grasp.n_q) < 0.1] = np.inf
    limits: list[Limit] = [NormalForce(lower, upper), JointTorque(frozen(torque))]
    if rng.uniform() < 0.3:
        effort = load * LEVER * rng.uniform(2.0, 10.0, grasp.n_z)
        effort[rng.uniform(size=grasp.n_z) < 0.2] = np.inf
        limits.append(ActuatorEffort(frozen(effort)))
    redundant = analyse(grasp).spaces.Gamma_zr.shape[1] > 0
    if rng.uniform() < (0.9 if redundant else 0.4):  # uneven bounds, so that redundancy is of use
        reference = 10 ** rng.uniform(-1.3, -0.3) * 10 ** rng.uniform(-0.5, 0.5, grasp.n_z)
        limits.append(SynergyReference(frozen(reference)))
    if rng.uniform() < 0.4:
        rate = 10 ** rng.uniform(-1.0, 0.5) * rng.uniform(0.5, 1.5, grasp.n_z)
        rate[rng.uniform(size=grasp.n_z) < 0.2] = np.inf
        limits.append(SynergyRate(frozen(rate)))
    return tuple(limits)


def _largest_margin(grasp: Grasp, task: TimedTask) -> float | None:
    """The largest margin [N] of a task, by the direct path; None when the other limits cannot be kept."""
    analysis = analyse(grasp)
    formulation = formulate(
        analysis.response, analysis.spaces, analysis.coordinates, times=task.times, wrench=task.wrench,
        beta=rigid_coordinates(analysis, task), units=units_of(analysis, task), redundancy=task.watches_references,
    )  # fmt: skip
    answered = ask(Question(formulation, task.limits, LargestMargin()), SOLVERS["clarabel"])
    unit = answered.question.formulation.force_unit
    return float(answered.decision.solution.x[-1]) * unit if answered.decision.optimal else None


def moving_random_task(rng: np.random.Generator) -> tuple[Grasp, TimedTask]:
    """A random task on a grasp over five uneven knots, its load and its modes changing all the time."""
    grasp, task = random_task_on_grasp(rng)
    times = frozen(np.cumsum(rng.uniform(0.1, 0.4, 5)))
    wrench = np.linspace(task.wrench[0], task.wrench[-1], 5) + 0.1 * rng.normal(size=(5, 6)) * [1, 1, 1, 0, 0, 0]
    dimension = analyse(grasp).spaces.Gamma_ucs.shape[1]
    wanted = Target("modes", frozen(1e-3 * np.outer(np.linspace(0, 1, 5), rng.normal(size=dimension))))
    return grasp, replace(task, times=times, wrench=frozen(wrench), target=wanted)
