"""The equations of equilibrium at many instants at once, and their derivatives.

Unknown are joints q, object pose (p, R) and contact forces lambda, so that springs without compliance are as good as
any. With tau = J' lambda at the true posture, about the true origin p of the object,

    r_s = C_s (lambda - lambda_0) - d                                    springs of the contacts
    r_q = q - q_0 - S dz_r + (C_q + S C_z S') (tau - tau_0)              joints and synergies
    r_w = G lambda + w                                                   object

d is the stretch of the contacts since the start. J and -G' are its derivatives, so r_q and r_w are those of an energy.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.equilibrium.meeting import Meeting, Placed
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array, Places
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Balance(Value):
    """The equations at T states, in their order of time."""

    setting: Setting
    states: States
    loads: Loads
    references: Array  # (T, n_z)
    placed: tuple[Placed, ...]
    """Links and object, for each contact."""
    meetings: tuple[Meeting, ...]
    jacobians: Array
    """(T, n_c, 6, n_q) of the points where the forces act: velocity, and turning of the link; palm axes."""

    @classmethod
    def of(cls, setting: Setting, states: States, loads: Loads, references: Array) -> Balance:
        """Work out where the contacts are."""
        found = [setting.held.hand.kinematics.at(q, setting.points) for q in states.q]
        placed = tuple(
            Placed(np.array([motions[i].position for motions in found]),
                   np.array([motions[i].rotation for motions in found]) @ links.T, states.position, states.rotation)
            for i, links in enumerate(setting.links)
        )  # fmt: skip
        meetings = tuple(model.at(each) for model, each in zip(setting.models, placed, strict=True))
        jacobians = np.array([[each.jacobian for each in motions] for motions in found])
        arms = np.stack([meeting.place - each.point for meeting, each in zip(meetings, placed, strict=True)], axis=1)
        jacobians[:, :, :3] += np.cross(jacobians[:, :, 3:], arms[..., None], axis=2)
        return cls(setting, states, loads, references, placed, meetings, jacobians)

    def taken(self, places: Places) -> Balance:
        """Return the equations at some of the states."""
        placed = tuple(each.taken(places) for each in self.placed)
        meetings = tuple(each.taken(places) for each in self.meetings)
        return Balance(self.setting, self.states.taken(places), self.loads.taken(places), self.references[places],
                       placed, meetings, self.jacobians[places])  # fmt: skip

    def moved_on(self) -> Setting:
        """Return the setting with the way of these states behind it, for those that follow."""
        pairs = zip(self.setting.models, self.placed, strict=True)
        return replace(self.setting, models=tuple(model.after(placed) for model, placed in pairs))

    @cached_property
    def frames(self) -> Array:
        """(T, n_c, 3, 3) of the contacts, columns n, t, o."""
        return np.stack([meeting.frame for meeting in self.meetings], axis=1)

    @cached_property
    def arms(self) -> Array:
        """(T, n_c, 3) from the object's origin to where the forces act [m]."""
        return np.stack([meeting.place for meeting in self.meetings], axis=1) - self.states.position[:, None]

    @cached_property
    def G(self) -> Array:
        """(T, 6, n_l) grasp matrix about the origin of B where it is."""
        parts = []
        for i, contact in enumerate(self.setting.grasp.contacts):
            frame, arm = self.frames[:, i], self.arms[:, i]
            forces = np.concatenate([frame, np.cross(arm[:, :, None], frame, axis=1)], axis=1)
            moments = np.concatenate([np.zeros_like(frame), frame], axis=1)
            parts.append(np.concatenate([forces, moments], axis=2) @ contact.kind.selection.T)
        return np.concatenate(parts, axis=2)

    @cached_property
    def J(self) -> Array:
        """(T, n_l, n_q) hand Jacobian in the contact frames."""
        parts = []
        for i, contact in enumerate(self.setting.grasp.contacts):
            inverse = self.frames[:, i].mT
            both = [inverse @ self.jacobians[:, i, :3], inverse @ self.jacobians[:, i, 3:]]
            parts.append(contact.kind.selection @ np.concatenate(both, axis=1))
        return np.concatenate(parts, axis=1)

    @cached_property
    def stretch(self) -> Array:
        """(T, n_l) of the contacts' springs since the start."""
        pairs = zip(self.meetings, self.setting.grasp.contacts, strict=True)
        return np.concatenate([meeting.stretch @ contact.kind.selection.T for meeting, contact in pairs], axis=1)

    @cached_property
    def torques(self) -> Array:
        """(T, n_q) tau = J' lambda."""
        return np.asarray(np.einsum("tij,ti->tj", self.J, self.states.forces))

    @cached_property
    def residuals(self) -> tuple[Array, Array, Array]:
        """r_s (T, n_l), r_q (T, n_q), r_w (T, 6)."""
        grasp, start = self.setting.grasp, self.setting
        springs = (self.states.forces - start.forces) @ grasp.C_s - self.stretch
        driven = start.held.q + self.references @ grasp.S.T - (self.torques - start.torques) @ start.compliance
        balance = np.einsum("tij,tj->ti", self.G, self.states.forces) + self.loads.acting(self.states.rotation)
        return springs, self.states.q - driven, balance

    @cached_property
    def error(self) -> Array:
        """(T,) how far each state is from equilibrium: lengths over the grasp's length, forces over the largest."""
        springs, joints, balance = self.residuals
        length = self.setting.length
        moments = np.array([1.0, 1.0, 1.0, *[1 / length] * 3])
        size = np.abs(self.states.forces).max(axis=1, initial=0.0) + np.abs(self.loads.wrench * moments).max(axis=1)
        parts = (np.abs(springs) / length, np.abs(joints), np.abs(balance * moments) / np.maximum(size, 1e-9)[:, None])
        return np.asarray(np.concatenate(parts, axis=1).max(axis=1))

    @cached_property
    def tangent(self) -> Array:
        """(T, n, n) derivatives of (r_s, r_q, r_w) by (lambda, q, u), geometric stiffness too; n = n_l + n_q + 6."""
        grasp, C = self.setting.grasp, self.setting.compliance
        n_l, n_q = grasp.n_l, grasp.n_q
        J, G = self.J, self.G
        of_joints, mixed, of_object = self._geometric()
        whole = np.zeros((len(J), n_l + n_q + 6, n_l + n_q + 6))
        q, u = slice(n_l, n_l + n_q), slice(n_l + n_q, None)
        whole[:, :n_l, :n_l], whole[:, :n_l, q], whole[:, :n_l, u] = grasp.C_s, -J, G.mT
        whole[:, q, :n_l], whole[:, q, q], whole[:, q, u] = C @ J.mT, np.eye(n_q) + C @ of_joints, C @ mixed
        whole[:, u, :n_l], whole[:, u, q], whole[:, u, u] = G, -mixed.mT, -of_object
        return whole

    def _geometric(self) -> tuple[Array, Array, Array]:
        """Return the second derivatives of ``lambda' d`` by q and q, q and u, u and u, with forces that turn with B."""
        T, n_q = self.states.q.shape
        of_joints, mixed, of_object = np.zeros((T, n_q, n_q)), np.zeros((T, n_q, 6)), np.zeros((T, 6, 6))
        for i, rows in enumerate(self.setting.grasp.rows):
            count = min(3, rows.stop - rows.start)
            force = np.einsum("tij,tj->ti", self.frames[:, i, :, :count], self.states.forces[:, rows][:, :count])
            moving, turning, skew = self.jacobians[:, i, :3], self.jacobians[:, i, 3:], skews(force)
            whole = np.cross(force[:, :, None], turning, axis=1).mT @ moving  # f . (w_a x v_b)
            below = self.setting.above * whole
            of_joints += below + (below - below * np.eye(n_q)).mT
            moment = self._moment(i)
            mixed[:, :, 3:] -= moving.mT @ skew + turning.mT @ moment
            of_object[:, :3, 3:] += skew
            of_object[:, 3:, :3] -= skew
            of_object[:, 3:, 3:] += skews(self.arms[:, i]) @ skew + moment
        of_object[:, 3:, 3:] -= self.loads.turning(self.states.rotation)
        return of_joints, mixed, of_object

    def _moment(self, i: int) -> Array:
        """Return the skew matrices (T, 3, 3) of the moments that a contact transmits, palm axes."""
        rows, selection = self.setting.grasp.rows[i], self.setting.grasp.contacts[i].kind.selection
        moments = self.states.forces[:, rows] @ selection[:, 3:]
        return skews(np.einsum("tij,tj->ti", self.frames[:, i], moments))


def skews(vectors: Array) -> Array:
    """Return the matrices (T, 3, 3) of the cross products with vectors (T, 3)."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    return np.asarray(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1))
