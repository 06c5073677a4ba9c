"""The equations of equilibrium at many instants at once, and their derivatives.

Unknown are joints q, object pose (p, R) and contact forces lambda, so that springs without compliance are as good as
any. With tau = J' lambda at the true posture, about the true origin p of the object,

    r_s = C_s (lambda - lambda_0) - d - g                                springs of the contacts
    r_q = q - q_0 - S dz_r + (C_q + S C_z S') (tau - tau_0)              joints and synergies
    r_w = G lambda + w                                                   object

d is the stretch of the contacts since the start, g what they are early by. J and -G' are the derivatives of d, so r_q
and r_w are those of an energy.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.equilibrium.meeting import Meeting, Placed
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.sliding_pads import of_sliding
from synergrip.equilibrium.states import Loads, States
from synergrip.grasps.contact_maps import grasp_matrices, hand_jacobians, moved_points
from synergrip.grasps.contacts.kind import is_moment
from synergrip.linalg import Array, Places, inverse_of
from synergrip.statics.response import Maps
from synergrip.values import Value
from synergrip.vectors import skews

SINGULAR = 1e-3
"""How far the tangent and its inverse may be from each other's, in units of the grasp."""


@dataclass(frozen=True, eq=False, repr=False)
class Balance(Value):
    """The equations at T states, in their order of time."""

    setting: Setting
    states: States
    loads: Loads
    references: Array  # (T, n_z)
    placed: Placed
    """Links and object."""
    meeting: Meeting
    """The contacts."""
    jacobians: Array
    """(T, n_c, 2, 3, n_q) of the points where the forces act: velocity, and turning of the link; palm axes."""
    known_inverse: Array | None = None
    """(T, n, n) of the tangent, when it is known from states very near these."""

    @classmethod
    def of(
        cls, setting: Setting, states: States, loads: Loads, references: Array, near: Balance | None = None
    ) -> Balance:
        """Work out where the contacts are; sooner when the equations at states near these are known."""
        links = setting.held.hand.kinematics.along(states.q, setting.points)
        placed = Placed(links.position, links.rotation @ setting.links.mT, states.position, states.rotation)
        meeting = setting.model.at(placed, None if near is None else near.meeting.centre)
        jacobians = moved_points(links.jacobian, meeting.place - placed.point)
        return cls(setting, states, loads, references, placed, meeting, jacobians)

    def under(self, loads: Loads, references: Array) -> Balance:
        """Return the equations at the same states under other loads and references."""
        return replace(self, loads=loads, references=references, known_inverse=self.inverse)

    def taken(self, places: Places) -> Balance:
        """Return the equations at some of the states."""
        at = self.placed
        placed = Placed(at.point[places], at.link[places], at.position[places], at.rotation[places])
        return Balance(self.setting, self.states.taken(places), self.loads.taken(places), self.references[places],
                       placed, self.meeting.taken(places), self.jacobians[places])  # fmt: skip

    def moved_on(self) -> Setting:
        """Return the setting with the way of these states behind it, for those that follow."""
        return replace(self.setting, model=self.setting.model.after(self.placed, self.meeting))

    @property
    def frames(self) -> Array:
        """(T, n_c, 3, 3) of the contacts, columns n, t, o."""
        return self.meeting.frame

    @cached_property
    def arms(self) -> Array:
        """(T, n_c, 3) from the object's origin to where the forces act [m]."""
        return np.asarray(self.meeting.place - self.states.position[:, None])

    @cached_property
    def G(self) -> Array:
        """(T, 6, n_l) grasp matrix about the origin of B where it is."""
        return grasp_matrices(self.arms, self.frames, self.setting.components)

    @cached_property
    def J(self) -> Array:
        """(T, n_l, n_q) hand Jacobian in the contact frames."""
        return hand_jacobians(self.jacobians, self.frames, self.setting.components)

    @cached_property
    def stretch(self) -> Array:
        """(T, n_l) of the contacts' springs since the start."""
        return np.asarray(self.meeting.stretch.reshape(len(self.arms), -1)[:, self.setting.components])

    @cached_property
    def torques(self) -> Array:
        """(T, n_q) tau = J' lambda."""
        return np.asarray(np.einsum("tij,ti->tj", self.J, self.states.forces))

    @cached_property
    def residuals(self) -> tuple[Array, Array, Array]:
        """r_s (T, n_l), r_q (T, n_q), r_w (T, 6)."""
        grasp, start = self.setting.grasp, self.setting
        springs = (self.states.forces - start.forces) @ grasp.C_s - self.stretch - start.early
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
        of_joints, of_pose, of_arms, of_object = self.geometric
        whole = np.zeros((len(J), n_l + n_q + 6, n_l + n_q + 6))
        q, u = slice(n_l, n_l + n_q), slice(n_l + n_q, None)
        whole[:, :n_l, :n_l], whole[:, :n_l, q], whole[:, :n_l, u] = grasp.C_s, -J, G.mT
        whole[:, q, :n_l], whole[:, q, q], whole[:, q, u] = C @ J.mT, np.eye(n_q) + C @ of_joints, C @ of_pose
        whole[:, u, :n_l], whole[:, u, q], whole[:, u, u] = G, -of_arms.mT, -of_object
        of_springs, of_torques, of_wrench = self.rolling
        for columns, own in ((q, slice(0, n_q)), (slice(n_l + n_q + 3, None), slice(n_q, None))):
            whole[:, :n_l, columns] -= of_springs[:, :, own]
            whole[:, q, columns] += C @ of_torques[:, :, own]
            whole[:, u, columns] += of_wrench[:, :, own]
        if (slid := self.slid) is not None:
            whole[:, q, n_l:] += C @ slid[:, :n_q]
            whole[:, u, n_l:] -= slid[:, n_q:]
        return whole

    @cached_property
    def inverse(self) -> Array:
        """(T, n, n) of the tangent: how (lambda, q, u) answer to (r_s, r_q, r_w); least where it is singular."""
        if self.known_inverse is not None:
            return self.known_inverse
        scale = self._sizes
        scaled = self.tangent * scale
        rows = np.abs(scaled).max(axis=2, initial=0.0)
        rows = np.where(rows > 0, rows, 1.0)
        scaled /= rows[:, :, None]
        return np.asarray(scale[:, None] * inverse_of(scaled) / rows[:, None])

    @property
    def _sizes(self) -> Array:
        """(n,) sizes of (lambda, q, u)."""
        grasp, length = self.setting.grasp, self.setting.length
        force = max(float(np.abs(self.states.forces).max(initial=0.0)), 1e-3)
        moments = [length if is_moment(component) else 1.0 for _, component in grasp.components]
        return np.concatenate([force * np.array(moments), np.ones(grasp.n_q), [length] * 3, np.ones(3)])

    @cached_property
    def regular(self) -> Array:
        """(T,) whether the tangent has an inverse."""
        size = self._sizes
        left = self.inverse @ self.tangent * size / size[:, None] - np.eye(len(size))
        return np.asarray(np.abs(left).max(axis=(1, 2), initial=0.0) < SINGULAR)

    @cached_property
    def maps(self) -> Maps:
        """How forces and motions answer to references and load, (T, ...) at each state, geometric stiffness too."""
        grasp, (of_joints, of_pose, _, _) = self.setting.grasp, self.geometric
        n_l, n_z = grasp.n_l, grasp.n_z
        of_references, of_load = self.inverse[:, :, n_l:-6] @ grasp.S, -self.inverse[:, :, -6:]
        whole = np.concatenate([of_references, of_load], axis=2)
        forces, joints, pose = whole[:, :n_l], whole[:, n_l:-6], whole[:, -6:]
        turns = np.concatenate([joints, pose[:, 3:]], axis=1)
        torques = self.J.mT @ forces + of_joints @ joints + of_pose @ pose + self.rolling[1] @ turns
        if (slid := self.slid) is not None:
            torques = torques + slid[:, : grasp.n_q] @ np.concatenate([joints, pose], axis=1)
        efforts = grasp.S.T @ torques
        synergies = np.eye(n_z, n_z + 6) - grasp.C_z @ efforts
        parts = {"lambda": forces, "u": pose, "tau": torques, "sigma": efforts, "z": synergies, "q": joints}
        own = {f"d{name}_dzr": part[:, :, :n_z] for name, part in parts.items()}
        loads = {f"d{name}_dw": parts[name][:, :, n_z:] for name in ("lambda", "u", "z", "q")}
        return Maps(**own, **loads)

    @cached_property
    def geometric(self) -> tuple[Array, Array, Array, Array]:
        """Return how torques change with q (T, n_q, n_q) and u (T, n_q, 6), and wrenches, less, with q and u.

        Forces and moments turn with B. These are the second derivatives of ``lambda' d`` where there are no moments; a
        moment on the object does not change with q. Left out: how moments turn with the joints that carry them.
        """
        T, n_q = self.states.q.shape
        forces, moments = skews(self.acting[:, :, 0]), skews(self.acting[:, :, 1])
        moving, turning = (self.jacobians[:, :, part].reshape(T, -1, n_q) for part in (0, 1))  # contacts as rows
        turned = (forces @ self.jacobians[:, :, 1]).reshape(T, -1, n_q)
        below = self.setting.above * (turned.mT @ moving)  # f . (w_a x v_b)
        of_joints = below + (below - below * np.eye(n_q)).mT
        of_arms, of_object = np.zeros((T, n_q, 6)), np.zeros((T, 6, 6))
        of_arms[:, :, 3:] = -moving.mT @ forces.reshape(T, -1, 3)
        of_object[:, :3, 3:] = forces.sum(axis=1)
        of_object[:, 3:, :3] = -of_object[:, :3, 3:]
        of_object[:, 3:, 3:] = (skews(self.arms) @ forces + moments).sum(axis=1)
        of_object[:, 3:, 3:] -= self.loads.turning(self.states.rotation)
        of_pose = of_arms.copy()
        of_pose[:, :, 3:] -= turning.mT @ moments.reshape(T, -1, 3)
        return of_joints, of_pose, of_arms, of_object

    @cached_property
    def rolling(self) -> tuple[Array, Array, Array]:
        """How stretch, torques and wrench change as rolling contacts turn and travel: with q and turns of the object.

        (T, n_l, n_q + 3), (T, n_q, n_q + 3), (T, 6, n_q + 3). The way before is taken to turn with its end.
        """
        T, n_q = self.states.q.shape
        frames, arms = self.setting.model.rolled(self.placed, self.meeting)
        turning, contacts = self.jacobians[:, :, 1], len(self.setting.points)
        against = np.concatenate([turning, np.broadcast_to(-np.eye(3), (*turning.shape[:3], 3))], axis=3)
        forces, moments = skews(self.acting[:, :, 0]), skews(self.acting[:, :, 1])
        turned = -forces @ frames
        moment = forces @ skews(self.meeting.place - self.placed.point) @ arms - moments @ frames
        acting = np.stack([turned, moment], axis=2).reshape(T, contacts, 6, 3) @ against  # force and moment of each
        apart = skews((self.frames @ self.meeting.stretch[..., :3, None])[..., 0])
        stretch = np.zeros((T, contacts, 2, 3, n_q + 3))
        stretch[:, :, 0] = self.frames.mT @ apart @ frames @ against
        of_torques = self.jacobians.reshape(T, -1, n_q).mT @ acting.reshape(T, -1, n_q + 3)
        of_wrench = acting.sum(axis=1)
        of_wrench[:, 3:] += (skews(self.arms) @ acting[:, :, :3]).sum(axis=1)
        return stretch.reshape(T, -1, n_q + 3)[:, self.setting.components], of_torques, of_wrench

    @cached_property
    def slid(self) -> Array | None:
        """(T, n_q + 6, n_q + 6) what sliding pads add to torques and, less, wrenches; None where none slide."""
        slid, forces = self.setting.model.slid(self.placed, self.meeting), self.acting[:, :, 0]
        return None if slid is None else of_sliding(self.placed, self.meeting, self.jacobians, forces, slid)

    @cached_property
    def acting(self) -> Array:
        """(T, n_c, 2, 3) forces and moments of the contacts, palm axes."""
        T, n_c = self.arms.shape[:2]
        whole = np.zeros((T, 6 * n_c))
        whole[:, self.setting.components] = self.states.forces
        return np.asarray(whole.reshape(T, n_c, 2, 3) @ self.frames.mT)
