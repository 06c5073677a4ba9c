"""Values inside what a task allows for, at random, and what they make of references; for tests and judging."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.tasks.allowances import Allowances


@dataclass(frozen=True)
class Sample:
    """One of the values that are allowed."""

    friction: Array  # (n_c,) coefficients
    spin_share: float
    mass: float | None  # [kg]
    load: Array  # (6,)
    gaps: Array  # (n_c,) [m], early above 0


def sample(rng: np.random.Generator, allow: Allowances, grasp: Grasp) -> Sample:
    """Return values inside what is allowed; at its ends half of the time, where plans fail first."""

    def inside(low: float, high: float) -> float:
        return float(rng.choice([low, high]) if rng.random() < 0.5 else rng.uniform(low, high))

    share = inside(1 - allow.friction_share, 1 + allow.friction_share)
    friction = []
    for contact in grasp.contacts:
        given: Any = allow.friction.get(contact.name) if isinstance(allow.friction, dict) else allow.friction
        low, high = given or (contact.friction, contact.friction)
        friction.append(share * inside(low, high) if given is None else inside(low, high))
    own = None if grasp.held is None else grasp.held.body.mass
    mass = own if allow.mass is None or own is None else inside(min(allow.mass[0], own), max(allow.mass[1], own))
    load = np.array([inside(-each, each) for each in np.asarray(allow.load_box).tolist()])
    if len(allow.load):
        corner = np.eye(len(allow.load) + 1)[rng.integers(len(allow.load) + 1)]
        weights = rng.dirichlet(np.ones(len(allow.load) + 1)) if rng.random() < 0.5 else corner
        load = load + weights[:-1] @ np.asarray(allow.load)
    gap: Any = allow.contact_gap
    gaps = [gap.get(c.name, 0.0) if isinstance(gap, dict) else gap for c in grasp.contacts]
    return Sample(np.array(friction), share, mass, load, np.array([inside(-each, each) for each in gaps]))


def slip_margins(grasp: Grasp, forces: Array, drawn: Sample) -> Array:
    """Return ``mu n - ||(t, o, mu m / nu)||`` (T, n_c) [N] with the friction of a sample."""
    found = []
    for contact, rows, mu in zip(grasp.contacts, grasp.rows, drawn.friction, strict=True):
        part = np.array(forces[:, rows])
        if part.shape[1] == 4:
            part[:, 3] *= mu / (getattr(contact.kind, "spin_friction", 1.0) * drawn.spin_share)
        found.append(mu * part[:, 0] - np.linalg.norm(part[:, 1:], axis=1))
    return np.column_stack(found)


def elastic_forces(grasp: Grasp, dz_r: Array, wrench: Array, gaps: Array) -> Array:
    """Return contact forces (T, n_l) of one elastic system whose contacts are off, written down anew.

    ``C dlambda + G' du = J S dz_r + g``, ``G dlambda = -dw``.
    """
    J, S, G = grasp.J, grasp.S, grasp.G
    C = grasp.C_s + J @ (grasp.C_q + S @ grasp.C_z @ S.T) @ J.T
    stiffness, n_l = 1e3, len(C)
    system = np.block([[stiffness * C, stiffness * G.T], [G, np.zeros((6, 6))]])
    off = np.zeros(n_l)
    off[[rows.start for rows in grasp.rows]] = gaps
    still = np.concatenate([np.zeros(n_l), -grasp.w_0])
    start = grasp.lambda_0 if grasp.lambda_0 is not None else np.linalg.solve(system, still)[:n_l]
    change = np.broadcast_to(wrench - grasp.w_0, (len(dz_r), 6))
    right = np.hstack([stiffness * (dz_r @ (J @ S).T + off), -change]).T
    return np.asarray(start + np.linalg.solve(system, right)[:n_l].T)


def with_mass(task_wrench: Array, weight: Array, mass: float | None, own: float | None, load: Array) -> Array:
    """Return the wrench (T, 6) with another mass and a load beside it."""
    share = 0.0 if mass is None or not own else mass / own - 1.0
    return frozen(task_wrench + share * weight + load)
