"""What a plan withstands, a second time: from the matrices of the grasp, in NumPy and cvxpy, sharing no formula.

Forces answer an extra wrench w by the springs ``lambda = lambda_plan - K G' (G K G')^-1 w`` with K the inverse of
``C_s + J C_q J' + J S C_z S' J'``; hard and soft fingers slip by their formulas; caps of normal forces, torques and
efforts are plain bounds.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import cvxpy as cp
import numpy as np
from too_much import with_plan

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.grasps.grasp import Grasp
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan

KNOWN = (NormalForce, JointTorque, ActuatorEffort)
"""The limits that are known here."""
Cone = tuple[np.ndarray, np.ndarray]
"""Value (d,) in the plan and its change (d, 6) with the extra wrench in scaled coordinates."""


def some_question(seed: int) -> Plan | None:
    """Return a plan on random matrices with half of the largest margin, and room in limits that are known here."""
    found = with_plan(np.random.default_rng([41, seed]), "force_cap")
    if found is None:
        return None
    grasp, task = found
    task = replace(task, limits=tuple(limit for limit in task.limits if isinstance(limit, KNOWN)))
    best = plan(grasp, replace(task, goals=(LargestMargin(), LeastEffort())))
    if not isinstance(best, Plan) or best.largest_margin is None or best.margins.min() < 1e-2:
        return None
    made = plan(grasp, replace(task, margin=0.5 * float(best.margins.min())))
    if not isinstance(made, Plan) or max((usage.violation for usage in made.usages[1:]), default=-1.0) > -1e-3:
        return None  # where a limit is used up, nothing is left
    return made


class SecondModel:
    """The cones of a plan, as they answer to an extra wrench."""

    def __init__(self, plan: Plan, *, cones_alone: bool = False) -> None:
        grasp = plan.grasp
        self.plan, self.grasp = plan, grasp
        JS = grasp.J @ grasp.S
        self.K = np.linalg.inv(grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T + JS @ grasp.C_z @ JS.T)
        G = grasp.G
        self.answer = -self.K @ G.T @ np.linalg.inv(G @ self.K @ G.T)
        self.unscale = unscaled(grasp)
        rows = [*friction(grasp), *([] if cones_alone else bounds(plan))]
        self.cones: list[Cone] = [
            (matrix @ forces + constant, matrix @ self.answer @ self.unscale)
            for forces in plan.forces
            for matrix, constant in rows
        ]
        self.rows = rows

    def radius(self) -> float:
        """The largest ball: of each cone by a semidefinite program, linear in its square and one more number."""
        return min((_radius(value, change) for value, change in self.cones), default=np.inf)

    def factor(self, widths: np.ndarray) -> float:
        """The largest factor of a box, all of its corners at once."""
        corners = np.array(list(product((-1.0, 1.0), repeat=6))) * widths
        scaled = np.linalg.solve(self.unscale, corners.T).T
        moving = [(value, scaled @ change.T) for value, change in self.cones if np.any(change)]
        near = [-outside(value[None])[0] / np.abs(moved).sum(axis=1).max() for value, moved in moving]
        unit, factor = max(min(near), 1e-9), cp.Variable()  # a box that is inside for certain
        constraints = []
        for value, moved in moving:
            scale = float(np.abs(value).max())
            heads = value[0] / scale + factor * (unit / scale * moved[:, 0])
            tails = value[1:, None] / scale * np.ones((1, len(moved))) + factor * (unit / scale * moved[:, 1:].T)
            constraints.append(heads >= 0 if len(value) == 1 else cp.SOC(heads, tails, axis=0))
        cp.Problem(cp.Maximize(factor), constraints).solve(solver=cp.CLARABEL)
        return unit * float(factor.value)

    def worst(self, scaled: np.ndarray) -> float:
        """How far the cone that is left by most is left at extra wrenches (n, 6) in scaled coordinates; 0 in none."""
        return max(float(outside(value + scaled @ change.T).max()) for value, change in self.cones)

    def has_answer(self, scaled: np.ndarray, room: float = 0.0) -> bool:
        """Whether internal forces of E_s answer an extra wrench at every knot, with cones wider by some room."""
        E_s = self.plan.analysis.spaces.E_s
        for forces in self.plan.forces:
            x = cp.Variable(E_s.shape[1])
            there = forces + self.answer @ self.unscale @ scaled
            constraints = [inside(matrix @ (there + E_s @ x) + constant, room) for matrix, constant in self.rows]
            problem = cp.Problem(cp.Minimize(0), constraints)
            problem.solve(solver=cp.CLARABEL)
            if problem.status not in ("optimal", "optimal_inaccurate"):
                return False
        return True


def _radius(value: np.ndarray, change: np.ndarray) -> float:
    sizes = np.linalg.norm(change)
    if sizes == 0:
        return np.inf
    if len(value) == 1:
        return max(float(value[0]), 0.0) / float(sizes)
    unit = max(float(value[0] - np.linalg.norm(value[1:])) / float(sizes), 1e-9)  # a ball that is inside for certain
    J = np.diag([1.0] + [-1.0] * (len(value) - 1))
    scale = float(np.abs(value).max())
    value, change = value / scale, change * unit / scale
    square = cp.Variable()
    M, m, c = change.T @ J @ change, change.T @ J @ value, value @ J @ value
    sigma = cp.Variable(nonneg=True)
    side = cp.reshape(sigma * m, (6, 1), order="C")
    whole = cp.bmat([[np.eye(6) + sigma * M, side], [side.T, cp.reshape(sigma * c - square, (1, 1), order="C")]])
    cp.Problem(cp.Maximize(square), [(whole + whole.T) / 2 >> 0]).solve(solver=cp.CLARABEL)
    return unit * float(np.sqrt(max(square.value, 0.0)))


def inside(value: cp.Expression, room: float = 0.0) -> cp.Constraint:
    return value[0] + room >= 0 if value.shape[0] == 1 else cp.norm(value[1:]) <= value[0] + room


def outside(values: np.ndarray) -> np.ndarray:
    return np.linalg.norm(values[:, 1:], axis=1) - values[:, 0]


def unscaled(grasp: Grasp) -> np.ndarray:
    """Wrenches about B of unit forces, and of moments about the centroid of the contacts of their mean distance."""
    points = np.array([contact.point for contact in grasp.contacts])
    middle = points.mean(axis=0)
    length = np.linalg.norm(points - middle, axis=1).mean()
    columns = [np.concatenate([axis, np.cross(middle, axis)]) for axis in np.eye(3)]
    return np.column_stack([*columns, *(np.concatenate([np.zeros(3), length * axis]) for axis in np.eye(3))])


def friction(grasp: Grasp) -> list[tuple[np.ndarray, np.ndarray]]:
    found, at = [], 0
    for contact in grasp.contacts:
        kind, size = contact.kind, contact.n_rows
        mu = kind.friction  # type: ignore[attr-defined]
        own = np.zeros((size, grasp.n_l))
        own[:, at : at + size] = np.diag([1.0, 1 / mu, 1 / mu] + ([1 / kind.spin_friction] if size == 4 else []))  # type: ignore[attr-defined]
        found.append((own, np.zeros(size)))
        at += size
    return found


def bounds(plan: Plan) -> list[tuple[np.ndarray, np.ndarray]]:
    grasp, found = plan.grasp, []
    normals = np.eye(grasp.n_l)[grasp.normal_rows]
    for limit in plan.task.limits:
        assert isinstance(limit, KNOWN)
        if isinstance(limit, NormalForce):
            matrix, lower, upper = normals, limit.lower, limit.upper
        else:
            matrix = grasp.J.T if isinstance(limit, JointTorque) else grasp.S.T @ grasp.J.T
            lower, upper = -np.asarray(limit.limit, dtype=float), np.asarray(limit.limit, dtype=float)
        for row, low, high in zip(matrix, *np.broadcast_arrays(lower, upper, np.zeros(len(matrix)))[:2], strict=True):
            found += [(row[None], np.array([-low])), (-row[None], np.array([high]))]
    return found
