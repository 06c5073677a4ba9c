"""A task around a path that is known: at every knot the grasp as it is there, and changes of the path as unknowns.

At knot k the hand is in equilibrium with references z, joint values q and an object pose that are known; alpha, beta
and gamma say what is added to z. With the maps of that state

    lambda = lambda_k + F_k dz,   q = q_k + Q_k dz,   u = u_k + U_k dz,   dz = M_k^-1 (alpha, beta, gamma),

so that everything is affine again, and a fixed point is exact: where dz = 0 the forces are the true ones. F_k counts
the motions of Gamma_ucs, too, which cost a little force away from the start, and not the redundancy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.beside_knots import fields_of
from synergrip.conic.each_knot import Statics
from synergrip.conic.formulation import Formulation
from synergrip.linalg import Array
from synergrip.statics.motion import forces_at_start
from synergrip.values import Value

BEYOND = 1.01
"""How much farther than a pass may go joints are taken to get: limits are loosened by rounding between two goals."""


@dataclass(frozen=True, eq=False, repr=False)
class Path(Value):
    """What is known at T knots, from the start of the task."""

    reference: Array  # (T, n_z) dz_r
    joint: Array  # (T, n_q) joint displacement
    displacement: Array
    """(T, 6) of the object, such that its distance from the target is the twist that is left to go [m, rad]."""
    rigid: Array
    """(T, 6) the same, but for what the rigid motions of the knot cannot reach: elastic motion and sag are left out."""
    sag: Array
    """(T, 6) the part of the displacement that the change of the load makes, by the maps of the knot."""
    room: Array
    """(T,) how far the joints together may move from the path in one pass [rad or m]."""


@dataclass(frozen=True, eq=False, repr=False)
class AlongPath(Formulation):
    """A formulation around a path; it has `each` grasp, with the forces and the load of the path as those at start."""

    path: Path | None = None
    along_path: ClassVar[bool] = True

    @classmethod
    def around_path(cls, formulation: Formulation, path: Path) -> AlongPath:
        """Return the formulation of changes of a path, from one whose `each` are the grasps along it."""
        return cls(**fields_of(formulation), path=path)

    @property
    def known(self) -> Path:
        """The path."""
        assert self.path is not None
        return self.path

    @cached_property
    def change(self) -> Affine:
        """What is added to the references (n_z), by (35) at every knot."""
        return self._whole.after(self.map_of(lambda at: at.coordinates.inverse))

    @cached_property
    def _whole(self) -> Affine:
        """What is added to (alpha, beta, gamma)."""
        matrices = [_each(part.matrix, self.knots) for part in self._parts]
        return Affine(np.concatenate(matrices, axis=-2), np.hstack([part.constant for part in self._parts]))

    @cached_property
    def force(self) -> Affine:
        """Contact forces lambda (n_l) [N, N m]."""
        there = self.map_of(lambda at: forces_at_start(at.response))
        moved = self._whole.after(self._but_for_gamma(lambda at: at.response.dlambda_dzr))
        return self.departed("force", moved.plus(there))

    @cached_property
    def torque(self) -> Affine:
        """Joint torques tau (n_q), which change with the forces and as these act at other places [N m]."""
        there = self.map_of(lambda at: (forces_at_start(at.response)[..., None, :] @ at.response.grasp.J)[..., 0, :])
        moved = self._whole.after(self._but_for_gamma(lambda at: at.response.dtau_dzr))
        return self.departed("torque", moved.plus(there))

    def _but_for_gamma(self, of: Callable[[Statics], Array]) -> Array:
        """Return a map of references as one of (alpha, beta, gamma), without what gamma adds to it.

        The redundancy moves no contact; what it does to forces is of the second order, as levers turn. A goal would go
        as far for that as a step may, pass after pass.
        """
        n_alpha, n_beta, _ = self.coordinates.dimensions
        moved = self.map_of(lambda at: of(at) @ at.coordinates.inverse)
        return np.asarray(moved * (np.arange(moved.shape[-1]) < n_alpha + n_beta))

    @cached_property
    def reference(self) -> Affine:
        """Synergy references dz_r (n_z)."""
        return self.change.plus(self.known.reference)

    @cached_property
    def joint(self) -> Affine:
        """Joint displacements dq (n_q) from the start [rad or m]."""
        moved = self.change.after(self.map_of(lambda at: at.response.dq_dzr))
        return self.departed("joint", moved.plus(self.known.joint))

    @cached_property
    def joint_span(self) -> tuple[Array, Array]:
        """The least and the largest displacement of each joint (n_q,) that this pass can come to [rad or m]."""
        reach = BEYOND * self.known.room[:, None]
        return (self.known.joint - reach).min(axis=0), (self.known.joint + reach).max(axis=0)

    @cached_property
    def displacement(self) -> Affine:
        """Object displacement du (6) from the start, sag under load included [m, rad]."""
        moved = self.change.after(self.map_of(lambda at: at.response.du_dzr))
        return self.departed("displacement", moved.plus(self.known.displacement))

    @cached_property
    def rigid(self) -> Affine:
        """Rigid part of the object displacement (6): that of the path, and Gamma_ucs beta of the knot [m, rad]."""
        return self.beta.after(self.map_of(lambda at: at.spaces.Gamma_ucs)).plus(self.known.rigid)

    @cached_property
    def elastic(self) -> Affine:
        """What the references move the object beyond the rigid motion (6) [m, rad]."""
        known = self.known.displacement - self.known.rigid - self.known.sag
        n_alpha = self.coordinates.dimensions[0]
        of_alpha = self.map_of(lambda at: at.response.du_dzr @ at.coordinates.inverse[..., :n_alpha])
        return self.alpha.after(of_alpha).plus(known)


@dataclass(frozen=True, eq=False, repr=False)
class AtStates(Formulation):
    """A formulation at states that are known, for what a motion uses of limits: its rigid part is known, too."""

    known_rigid: Callable[[], Array] | None = None

    @classmethod
    def of(
        cls, formulation: Formulation, *, times: Array, wrench: Array, target: Array, rigid: Callable[[], Array]
    ) -> AtStates:
        """Return it at some instants (T,).

        Args:
            formulation: of the task at its knots.
            times: the instants [s].
            wrench: (T, 6) on the object.
            target: (T, 6) where it is wanted [m, rad].
            rigid: returns the rigid part (T, 6) of the motion, which few limits look at [m, rad].
        """
        return cls(
            **fields_of(formulation) | {"times": times, "wrench": wrench, "target": target, "each": None},
            known_rigid=rigid,
        )

    def rigid_motion(self, dz_r: Array) -> Array:
        """Return the rigid part (T, 6) of the motion [m, rad]."""
        return self._rigid_part

    @cached_property
    def _rigid_part(self) -> Array:
        assert self.known_rigid is not None
        return self.known_rigid()


def _each(matrix: Array, knots: int) -> Array:
    return matrix if matrix.ndim == 3 else np.broadcast_to(matrix, (knots, *matrix.shape))
