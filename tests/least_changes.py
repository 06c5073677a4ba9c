"""The least change of every number of a task, by a model of its own: equilibria of an elastic system, and cvxpy.

Nothing here is shared with the planner but the values that state a grasp and a task. The references of every knot are
the unknowns; forces, torques and motions follow from `elastic_grasp.course`, which is affine in references and load.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from typing import Any

import cvxpy as cp
import numpy as np
from altered_numbers import BOUNDS, DOWN
from elastic_grasp import course, length_of, motion_at_centroid
from made_kinds import spin_of
from scipy.linalg import null_space
from scipy.optimize import brentq

from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.tasks.timed_task import TimedTask

FAR = 100.0
"""How many times as large as it is a number is looked for."""


@dataclass(frozen=True)
class Affine:
    """What references (T, n_z) and the factor of the load make of a quantity (T, m)."""

    by_references: Array  # (m, n_z)
    without: Array  # (T, m) of references 0 and no load
    by_load: Array  # (T, m)

    def at(self, z: Any, load: Any) -> Any:
        """Return the quantity."""
        return z @ self.by_references.T + self.without + load * self.by_load


def affine(grasp: Grasp, task: TimedTask) -> dict[str, Affine]:
    """Return forces, torques, efforts, motion of object and joints, and the elastic part of the motion (scaled)."""

    def seen(dz_r: Array, load: float) -> dict[str, Array]:
        wrench = load * task.wrench
        begun = grasp if grasp.held is None else replace(grasp, w_0=frozen(wrench[0]), lambda_0=None)
        found = course(begun, np.arange(len(dz_r)), dz_r, wrench[: len(dz_r)])
        return {"force": found.forces, "torque": found.torques, "effort": found.efforts, "du": found.du, "dq": found.dq}

    T, n_z = len(task.times), grasp.n_z
    still = seen(np.zeros((T, n_z)), 0.0)
    loaded = seen(np.zeros((T, n_z)), 1.0)
    first = {name: value[0] for name, value in still.items()}
    columns = [seen(row[None], 0.0) for row in np.eye(n_z)]
    return {
        name: Affine(
            np.column_stack([column[name][0] - first[name] for column in columns]).reshape(-1, n_z), still[name],
            loaded[name] - still[name],
        )
        for name in still
    }  # fmt: skip


def rigid_motions(grasp: Grasp) -> Array:
    """Return an orthonormal basis (6, dim) of the motions that synergies and object make together without any force.

    Of motions of the contacts' centroid, rotations times length [m].
    """
    to_scaled = motion_at_centroid(grasp, np.eye(6)).T
    spin = np.array([1.0 if part != "m" else length_of(grasp)[0] for _, part in grasp.components])
    moved = spin[:, None] * grasp.J @ grasp.S
    synergies = moved / max(float(np.linalg.norm(moved, 2)), 1e-300)
    both = null_space(np.hstack([synergies, -spin[:, None] * grasp.G.T @ np.linalg.inv(to_scaled)]), rcond=1e-9)
    left, sizes, _ = np.linalg.svd(both[grasp.n_z :], full_matrices=False)
    return np.asarray(left[:, sizes > 1e-9])  # what is left moves synergies alone


class LeastChanges:
    """A task of which single numbers are changed by factors, as little as possible."""

    def __init__(self, grasp: Grasp, task: TimedTask) -> None:
        """Build both programs: the least turn of a number, and the least widening of all rows."""
        self.grasp, self.task, self.maps = grasp, task.on(grasp), affine(grasp, task)
        self.force = max(float(np.abs(self.maps["force"].without + self.maps["force"].by_load).max()), 1e-6)
        largest = float(np.linalg.norm(self.maps["force"].by_references, 2))
        self.unit = self.force / largest if largest else 1.0  # of the references
        self.names = tuple(self._numbers())
        self.friction = cp.Parameter(nonneg=True, value=1.0)
        self.chosen = cp.Parameter(len(self.names), value=np.zeros(len(self.names)))
        self.factors = cp.Parameter(len(self.names), value=np.ones(len(self.names)))
        self.most = cp.Parameter(nonneg=True, value=FAR)
        self.turn, self.wider = cp.Variable(), cp.Variable()
        self.y = z = cp.Variable((len(task.times), grasp.n_z))  # references in `unit`
        self.force_at = self.maps["force"].at(self.unit * z, 1.0)
        self.asked = self._rows(z, np.ones(len(self.names)), 0.0)
        by, times = cp.Variable(len(self.names)), cp.Variable(len(self.names))  # of both programs: the factors
        rows = [*self._rows(z, by, 0.0), by == 1 + self.chosen * self.turn, self.turn >= 0, self.turn <= self.most]
        self.least = cp.Problem(cp.Minimize(self.turn), rows)
        rows = [*self._rows(z, times, self.wider), times == self.factors, self.wider >= -0.1]
        self.widening = cp.Problem(cp.Minimize(self.wider), rows)

    def _numbers(self) -> list[str]:
        task = self.task
        found = ["load"] if np.any(task.wrench) else []
        found += ["margin"] if task.margin > 0 else []
        found += ["amplitude"] if np.any(task.target.values) else []
        found += ["tolerance"] if task.tracking == "compliant" else []
        for limit in task.limits:
            if isinstance(limit, NormalForce):
                found += ["force_cap"] * bool(np.isfinite(limit.upper)) + ["floor"] * (limit.lower > 0)
            elif isinstance(limit, JointRange):
                found += ["joint_range"] * (not limit.lets_go)
            else:
                found += [name for name, kind in BOUNDS.items() if isinstance(limit, kind)]
        return found

    def _rows(self, y: Any, factor: Any, wider: Any) -> list[Any]:
        """Return everything that is asked, each number times its factor and wider by a share of it."""
        z = self.unit * y
        task, grasp, known = self.task, self.grasp, {name: factor[k] for k, name in enumerate(self.names)}
        load = known.get("load", 1.0)
        force = self.maps["force"].at(z, load)
        rows: list[Any] = []
        for contact, part in zip(grasp.contacts, grasp.rows, strict=True):
            spin = spin_of(contact)
            weights = [1.0, 1.0, contact.friction / spin if spin else 0.0][: part.stop - part.start - 1]
            normal = force[:, part.start]
            least = known.get("margin", 0.0) * task.margin - wider * self.force
            if weights:
                sideways = force[:, part.start + 1 : part.stop] @ np.diag(weights)
                rows.append(cp.norm(sideways, axis=1) + least <= self.friction * contact.friction * normal)
            rows.append(normal >= -wider * self.force)
        for limit in task.limits:
            rows += self._of(limit, z, known, wider, force)
        return rows + self._followed(z, known, wider)

    def _of(self, limit: Limit, z: Any, known: dict[str, Any], wider: Any, force: Any) -> list[Any]:
        load = known.get("load", 1.0)
        if isinstance(limit, NormalForce):
            normal = force[:, [part.start for part in self.grasp.rows]]
            above = [normal <= limit.upper * (known["force_cap"] + wider)] if "force_cap" in known else []
            return above + ([normal >= limit.lower * (known["floor"] - wider)] if "floor" in known else [])
        if isinstance(limit, JointRange) and limit.lets_go:
            return []
        if isinstance(limit, JointRange):
            lower, upper, start = (np.asarray(each) for each in (limit.lower, limit.upper, limit.start))
            half, bound = (upper - lower) / 2, np.isfinite(lower) & np.isfinite(upper)
            more = cp.multiply(half[bound], known["joint_range"] - 1 + wider)
            at = (self.maps["dq"].at(z, load) + start)[:, bound]
            return [at[k] <= upper[bound] + more for k in range(at.shape[0])] + [
                at[k] >= lower[bound] - more for k in range(at.shape[0])
            ]
        name = next(name for name, kind in BOUNDS.items() if isinstance(limit, kind))
        room, value = known[name] + wider, self._value(name, z, load)
        if name == "drift":
            weights = np.array([1.0] * 3 + [length_of(self.grasp)[0]] * 3)
            apart = (value - known.get("amplitude", 1.0) * self._wish()) @ np.diag(weights)
            return [cp.norm(apart, axis=1) <= room * limit.limit]
        if name == "elastic":
            rigid = known.get("amplitude", 1.0) * self._rigid_wish()
            return [cp.norm(value - rigid, axis=1) <= room * limit.limit]
        bound = np.broadcast_to(np.asarray(limit.limit, dtype=float), value.shape[1:])
        some = np.isfinite(bound)
        return [cp.abs(value[k, some]) <= room * bound[some] for k in range(value.shape[0])] if np.any(some) else []

    def _value(self, name: str, z: Any, load: Any) -> Any:
        h = np.diff(self.task.times)
        if name in ("torque", "effort"):
            return self.maps[name].at(z, load)
        if name == "synergy_range":
            return z
        if name == "rate":
            return np.diag(1 / h) @ (z[1:] - z[:-1])
        if name == "acceleration":
            rates = np.diag(1 / h) @ (z[1:] - z[:-1])
            return np.diag(2 / (h[1:] + h[:-1])) @ (rates[1:] - rates[:-1])
        if name == "drift":
            return self.maps["du"].at(z, load)
        return z @ motion_at_centroid(self.grasp, self.maps["du"].by_references.T)  # without the sag

    def _wish(self) -> Array:
        values = self.task.target.values
        return values if values.size else np.zeros((len(self.task.times), 6))

    def _rigid_wish(self) -> Array:
        basis = rigid_motions(self.grasp)
        return motion_at_centroid(self.grasp, self._wish()) @ basis @ basis.T

    def _followed(self, z: Any, known: dict[str, Any], wider: Any) -> list[Any]:
        """Return what the wanted motion asks: rigid motions as they are wanted, or the object within its tolerance."""
        amplitude = known.get("amplitude", 1.0)
        if self.task.tracking == "compliant":
            weights = np.diag([1.0] * 3 + [length_of(self.grasp)[0]] * 3)
            apart = (self.maps["du"].at(z, known.get("load", 1.0)) - amplitude * self._wish()) @ weights
            return [cp.norm(apart, axis=1) <= (known["tolerance"] + wider) * self.task.tolerance]
        basis = rigid_motions(self.grasp)
        if not basis.shape[1]:
            return []
        moved = z @ motion_at_centroid(self.grasp, self.maps["du"].by_references.T) @ basis
        small = max(float(np.abs(self.maps["du"].by_references).max()) * self.unit, 1e-300)
        return [moved / small == amplitude * (motion_at_centroid(self.grasp, self._wish()) @ basis) / small]

    def shortfall(self, number: str = "", factor: float = 1.0) -> float:
        """Return the least share by which all rows must be wider; no plan where it is above 0, infinity for no way."""
        self.friction.value = factor if number == "friction" else 1.0
        self.factors.value = np.array([factor if name == number else 1.0 for name in self.names])
        return float(self._solved(self.widening))

    def factor(self, number: str) -> float:
        """Return the factor nearest to 1 with which there is a plan; infinity (0 for what goes down) for none.

        NaN where the solver does not say.
        """
        if number == "friction":
            ends = np.array([self.shortfall(number), self.shortfall(number, FAR)])
            if np.any(np.isnan(ends)) or ends[0] <= 0 or ends[1] > 0:
                return np.inf if ends[0] > 0 and ends[1] > 0 else np.nan
            try:
                least = brentq(lambda x: self.shortfall(number, float(np.exp(x))), 0.0, np.log(FAR), xtol=1e-7)
            except ValueError:  # it did not say on the way
                return np.nan
            return float(np.exp(least))
        down, self.friction.value = number in DOWN, 1.0
        self.chosen.value = np.array([(-1.0 if down else 1.0) * (name == number) for name in self.names])
        self.most.value = 1.0 if down else FAR
        turn = self._solved(self.least)
        return (0.0 if turn >= 1 else 1 - turn) if down else 1 + turn

    def all_factors(self) -> dict[str, float]:
        """Return the factors of all numbers, friction among them."""
        return {name: self.factor(name) for name in (*self.names, "friction")}

    @staticmethod
    def _solved(program: cp.Problem) -> float:
        """Return the value, infinity where there is none, and no number where the solver gives up."""
        for tolerance in (1e-10, 1e-8):
            try:
                with warnings.catch_warnings(action="ignore"):
                    program.solve(solver=cp.CLARABEL, tol_gap_abs=tolerance, tol_gap_rel=tolerance, tol_feas=tolerance)
            except cp.SolverError:
                continue
            if program.status == "optimal":
                return float(program.value)
            if program.status == "infeasible":
                return np.inf
        return np.nan
