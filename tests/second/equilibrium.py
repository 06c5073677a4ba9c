"""The equilibrium of hand and object as equations in contact forces, joints and the pose of the object.

Nothing is derived on paper: the equations are written as they are said in words (springs, forces and moments in
balance, joint torques as moments about the axes), and their derivatives are differences.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.linalg import block_diag
from scipy.spatial.transform import Rotation
from second.touching import ROWS, Stretched, Touching, touching
from second.tree import Poses, Tree

Array = np.ndarray


@dataclass(frozen=True)
class State:
    """Where hand and object have come to rest."""

    forces: Array  # (n_l,)
    q: Array  # (n_q,)
    p: Array  # (3,)
    R: Array  # (3, 3)
    settled: tuple[Any, ...]
    """What each contact remembers."""


@dataclass(frozen=True)
class Load:
    """What pulls at the object, in the axes of the palm."""

    wrench: Array  # (6,) about the origin of the object as it moves [N, N m]
    at: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """(m, 3) points of the object, its axes at the start, from its origin [m]."""
    forces: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """(m, 3) at these points [N]; their moment about the origin, had the object not turned, is part of the wrench."""

    def toward(self, other: Load, share: float) -> Load:
        """Return the load on the way to another."""
        wrench, forces = ((1 - share) * a + share * b for a, b in
                          ((self.wrench, other.wrench), (self.forces, other.forces)))  # fmt: skip
        return Load(wrench, other.at, forces)

    def acting(self, R: Array) -> Array:
        """Return the wrench (B, 6) on the object turned by R (B, 3, 3)."""
        found = np.tile(self.wrench, (len(R), 1))
        for at, force in zip(self.at, self.forces, strict=True):
            found[:, 3:] += np.cross(R @ at - at, force)
        return found


class Equilibrium:
    """Hand, object and contacts of one plan.json: the residual of a state, and the state at the start."""

    def __init__(self, block: dict[str, Any], tree: Tree, model: str) -> None:
        """Take everything from the `execution` of plan.json."""
        self.tree, self.contacts = tree, block["contacts"]
        self.S, self.C_q, self.C_z = (np.array(block[key], dtype=float) for key in ("S", "C_q", "C_z"))
        self.C_s = block_diag(*(np.array(contact["compliance"], dtype=float) for contact in self.contacts))
        self.q_0, self.p_0 = np.array(block["q_0"]), np.array(block["object"]["position_m"])
        self.forces_0 = np.array(block["lambda_0"], dtype=float)
        self.early = np.array(block.get("early_m", np.zeros(len(self.forces_0))), dtype=float)  # beyond what is seen
        self.n_q, self.n_l = len(self.q_0), len(self.forces_0)
        links = tree.poses(self.q_0[None]).links
        self.touching: list[Touching] = [
            touching(contact, block["object"], links[contact["link"]][0], model) for contact in self.contacts
        ]
        self.rows = [np.array(ROWS[contact["kind"]]) for contact in self.contacts]
        ends = np.cumsum([0, *map(len, self.rows)])
        self.slices = [slice(a, b) for a, b in pairwise(ends)]
        self.moved = [tree.moved_by(contact["link"]) for contact in self.contacts]
        settled = tuple(each.start() for each in self.touching)
        self.start = State(self.forces_0, self.q_0, self.p_0, np.eye(3), settled)
        held, self.tau_0 = self.held(self.start)
        self.load_0 = Load(-held)

    def unknowns(self, state: State) -> Array:
        """Return the unknowns (n,) of a state: forces, joints, place, and a turn from where it is."""
        return np.concatenate([state.forces, state.q, state.p, np.zeros(3)])

    def residual(self, x: Array, before: State, dz_r: Array, load: Load) -> Array:
        """Return what is out of balance (B, n) at unknowns (B, n) after a state: joints, wrench, contact springs."""
        forces, q, p, R = self._taken(x, before)
        poses = self.tree.poses(q)
        seen = self._stretched(poses, p, R, before)
        wrench, tau = self._exchanged(forces, seen, poses, p)
        wrench += load.acting(R)
        more = tau - self.tau_0
        commanded = dz_r - more @ self.S @ self.C_z.T
        joints = q - self.q_0 - commanded @ self.S.T + more @ self.C_q.T
        stretch = np.hstack([each.stretch[:, rows] for each, rows in zip(seen, self.rows, strict=True)])
        return np.hstack([joints, wrench, (forces - self.forces_0) @ self.C_s.T - stretch - self.early])

    def settle(self, x: Array, before: State) -> State:
        """Return the state of unknowns (n,), with what the contacts then remember."""
        forces, q, p, R = self._taken(x[None], before)
        seen = self._stretched(self.tree.poses(q), p, R, before)
        return State(forces[0], q[0], p[0], R[0], tuple(each.settled for each in seen))

    def off_its_face(self, state: State) -> str | None:
        """Return the name of a contact that has run over an edge."""
        pairs = zip(self.touching, state.settled, self.contacts, strict=True)
        return next((contact["name"] for each, settled, contact in pairs if each.beyond(settled) > 0), None)

    def _taken(self, x: Array, before: State) -> tuple[Array, Array, Array, Array]:
        forces, q, p, turn = np.split(x, np.cumsum([self.n_l, self.n_q, 3]), axis=1)
        return forces, q, p, Rotation.from_rotvec(turn).as_matrix() @ before.R

    def _stretched(self, poses: Poses, p: Array, R: Array, before: State) -> list[Stretched]:
        each = zip(self.touching, self.contacts, before.settled, strict=True)
        return [touch.stretched(poses.links[contact["link"]], p, R, settled) for touch, contact, settled in each]

    def _exchanged(self, forces: Array, seen: list[Stretched], poses: Poses, p: Array) -> tuple[Array, Array]:
        """Return the wrench (B, 6) of the contacts on the object about p, and what the joints carry (B, n_q)."""
        wrench, tau = np.zeros((len(p), 6)), np.zeros((len(p), self.n_q))
        for each, rows, part, moved in zip(seen, self.rows, self.slices, self.moved, strict=True):
            along = np.zeros((len(p), 6))
            along[:, rows] = forces[:, part]
            force, moment = ((each.frame @ along[:, half, None])[..., 0] for half in (slice(3), slice(3, 6)))
            wrench[:, :3] += force
            wrench[:, 3:] += np.cross(each.point - p, force) + moment
            arms = each.point[:, None, :] - poses.places
            turning = np.cross(arms, force[:, None, :]) + moment[:, None, :]  # about a point of each axis
            pushing = np.where(self.tree.slides[:, None], np.broadcast_to(force[:, None, :], arms.shape), turning)
            tau += np.where(moved, np.sum(poses.axes * pushing, axis=-1), 0.0)
        return wrench, tau

    def held(self, state: State) -> tuple[Array, Array]:
        """Return the wrench (6,) of the contacts on the object and the joint torques (n_q,)."""
        poses, p, R = self.tree.poses(state.q[None]), state.p[None], state.R[None]
        wrench, tau = self._exchanged(state.forces[None], self._stretched(poses, p, R, state), poses, p)
        return wrench[0], tau[0]
