"""A task in the coordinates of the program: everything a limit or goal may speak about, affine in the unknowns.

At knot k the unknown is ``v_k = (alpha_k / force_unit, gamma_k / reference_unit)``; beta_k is known
from the wanted motion. Then ``lambda_k = lambda_0 - G+ dw_k + E_s alpha_k`` and torques, actuator efforts
and synergy references follow (docs/theory.md).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.statics import Coordinates, Response, Subspaces
from synergrip.statics.motion import forces_at_start


@dataclass(frozen=True)
class Affine:
    """``y_k = matrix @ v_k + constant[k]``."""

    matrix: Array  # (m, n_v)
    constant: Array  # (T, m)

    def after(self, linear: Array) -> Affine:
        """Return ``linear @ y`` for linear (p, m)."""
        return Affine(frozen(linear @ self.matrix), frozen(self.constant @ linear.T))


@dataclass(frozen=True)
class Situation:
    """What the program's unknowns mean."""

    response: Response
    coordinates: Coordinates
    times: Array  # (T,) [s]
    wrench: Array  # (T, 6)
    beta: Array  # (T, dim Gamma_ucs) [m]
    force: Affine  # lambda (n_l) [N, N m]
    torque: Affine  # tau (n_q) [N m]
    effort: Affine  # sigma (n_z)
    reference: Affine  # dz_r (n_z)
    force_unit: float  # [N]
    reference_unit: float

    @property
    def knots(self) -> int:
        """Number of knots T."""
        return len(self.times)

    @property
    def n_v(self) -> int:
        """Unknowns at each knot."""
        return int(self.force.matrix.shape[1])

    @property
    def n_alpha(self) -> int:
        """Of these, the coordinates of the internal force."""
        return self.coordinates.dimensions[0]

    def alpha_gamma(self, v: Array) -> tuple[Array, Array]:
        """Return alpha (T, dim E_s) [N] and gamma (T, dim Gamma_zr) of unknowns v (T, n_v).

        gamma is zero, the smallest reference, when nothing in the task asks about it.
        """
        alpha = v[:, : self.n_alpha] * self.force_unit
        gamma = np.zeros((len(v), self.coordinates.dimensions[2]))
        if v.shape[1] > self.n_alpha:
            gamma = v[:, self.n_alpha :] * self.reference_unit
        return alpha, gamma

    def in_units_of(self, force: float) -> Situation:
        """Return the same situation with another force unit [N]: the unknowns become smaller or larger."""
        columns = np.ones(self.n_v)
        columns[: self.n_alpha] = force / self.force_unit

        def scaled(value: Affine) -> Affine:
            return Affine(frozen(value.matrix * columns), value.constant)

        return replace(
            self, force_unit=force, force=scaled(self.force), torque=scaled(self.torque),
            effort=scaled(self.effort), reference=scaled(self.reference),
        )  # fmt: skip

    def references(self, v: Array) -> Array:
        """Return the synergy references dz_r (T, n_z) of unknowns v (T, n_v), by (35)."""
        alpha, gamma = self.alpha_gamma(v)
        return self.coordinates.references(alpha, self.beta, gamma)


@dataclass(frozen=True)
class Units:
    """Sizes that bring the unknowns near 1 before solving."""

    force: float  # [N]
    reference: float


def situate(
    response: Response, spaces: Subspaces, coords: Coordinates, *,
    times: Array, wrench: Array, beta: Array, units: Units, redundancy: bool,
) -> Situation:  # fmt: skip
    """Write a task as affine functions of its unknowns.

    Args:
        response: response maps of the grasp.
        spaces: its subspaces.
        coords: its M (35).
        times: (T,) [s].
        wrench: (T, 6) external wrench on the object.
        beta: (T, dim Gamma_ucs) wanted rigid motion.
        units: sizes of alpha and gamma.
        redundancy: whether gamma is an unknown (some limit looks at the references) or zero.
    """
    n_alpha, n_beta, n_gamma = spaces.dimensions
    free = n_gamma if redundancy else 0
    inverse = coords.inverse
    reference = np.hstack([inverse[:, :n_alpha] * units.force,
                           inverse[:, n_alpha + n_beta : n_alpha + n_beta + free] * units.reference])  # fmt: skip
    base = forces_at_start(response) - (wrench - response.grasp.w_0) @ response.right_inverse.T
    force = Affine(frozen(np.hstack([spaces.E_s * units.force, np.zeros((response.grasp.n_l, free))])), frozen(base))
    torque = force.after(response.grasp.J.T)
    return Situation(
        response, coords, frozen(times), frozen(wrench), frozen(beta),
        force, torque, torque.after(response.grasp.S.T),
        Affine(frozen(reference), frozen(beta @ inverse[:, n_alpha : n_alpha + n_beta].T)),
        units.force, units.reference,
    )  # fmt: skip
