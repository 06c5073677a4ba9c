"""What references really do on the hand that moves, as planning asks for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion, forces_at_start
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Executed(Value):
    """The true states at those of T instants that were reached, K of them."""

    times: Array  # (T,) [s]
    references: Array  # (T, n_z) dz_r
    wrench: Array  # (T, 6) about the object's origin where it is
    forces: Array  # (K, n_l)
    joint: Array  # (K, n_q) displacement from the start
    position: Array  # (K, 3) displacement of the object [m]
    rotation: Array  # (K, 3, 3) of the object
    grasps: tuple[Grasp, ...]
    """(K,) the grasp at every state: G, J and contacts as they are there, its lambda_0 and w_0 the true ones."""
    contact_model: str
    """How contacts move: "fixed" or "rolling"."""
    residual: float
    """Largest error of the equilibrium, relative to its terms."""
    iterations: int
    stiffness: Array  # (K,) smallest stiffness with which the object is held [N/m]
    why: str = ""
    """Why the instants after K were not reached."""

    @property
    def whole(self) -> bool:
        """Whether all instants were reached."""
        return len(self.forces) == len(self.times)

    @property
    def du(self) -> Array:
        """(K, 6) displacement of the object from the start: translation and rotation vector [m, rad]."""
        from scipy.spatial.transform import Rotation

        return frozen(np.hstack([self.position, Rotation.from_matrix(np.array(self.rotation)).as_rotvec()]))

    def left(self, wanted: Array) -> Array:
        """Return the twist (K, 6) from where the object is to where it is wanted (T, 6) [m, rad]."""
        from scipy.spatial.transform import Rotation

        wanted = np.array(wanted[: len(self.position)])
        turn = Rotation.from_rotvec(wanted[:, 3:]) * Rotation.from_matrix(np.array(self.rotation)).inv()
        return frozen(np.hstack([wanted[:, :3] - self.position, turn.as_rotvec()]))

    def motion(self, start: Analysis, du: Array, sag: Array) -> Motion:
        """Return it as a motion of all instants, which were reached.

        Args:
            start: the grasp at the start.
            du: (T, 6) displacement of the object [m, rad].
            sag: (T, 6) the part of it that the change of the load makes.
        """
        torques = np.array([each.J.T @ force for each, force in zip(self.grasps, self.forces, strict=True)])
        efforts, S = torques @ start.grasp.S, start.grasp.S
        before = forces_at_start(start.response) @ start.grasp.J @ S
        dz = self.references - (efforts - before) @ start.grasp.C_z
        arrays = (self.times, self.references, self.wrench, self.forces, torques, efforts, du, sag, self.joint, dz)
        return Motion(*(frozen(array) for array in arrays))


Executor = Callable[[Array, Array, Array], Executed]
"""Executes references (T, n_z) at some times (T,) under wrenches (T, 6)."""
