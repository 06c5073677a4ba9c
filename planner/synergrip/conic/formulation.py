"""A task in the coordinates of the program: everything a limit or goal may speak about, affine in the unknowns.

At knot k the unknown is ``v_k = (alpha_k / force_unit, gamma_k / reference_unit, beta_k / motion_unit)``. The units
are the solver's: they bring the unknowns near 1 and change no answer. gamma is left out (zero) when no limit looks at
more than forces, beta as far as the wanted motion fixes it. Then
``lambda_k = lambda_0 - G+ dw_k + E_s alpha_k``, the references follow by (35), the rest from these (docs/theory.md).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from synergrip.conic.affine import Affine as Affine
from synergrip.conic.affine import times as product
from synergrip.conic.basis import longest, moves
from synergrip.conic.each_knot import Statics, to_beta
from synergrip.conic.intersample import Intersample
from synergrip.conic.units import Units as Units
from synergrip.linalg import Array, frozen
from synergrip.statics import Coordinates, Response, Subspaces
from synergrip.statics.each import Each
from synergrip.statics.motion import Motion, forces_at_start
from synergrip.values import Value

if TYPE_CHECKING:
    from scipy import sparse

    from synergrip.conic.allowed import Allowed
    from synergrip.conic.departure import Departure


@dataclass(frozen=True, eq=False, repr=False)
class Formulation(Value):
    """What the program's unknowns mean."""

    response: Response
    spaces: Subspaces
    coordinates: Coordinates
    times: Array  # (T,) [s]
    wrench: Array  # (T, 6)
    alpha: Affine  # (dim E_s) [N]
    beta: Affine  # (dim Gamma_ucs) [m]
    gamma: Affine  # (dim Gamma_zr)
    target: Array  # (T, 6) wanted displacement of the object about B [m, rad]
    units: Units
    """Of the program's unknowns and rows; they change no answer."""
    stated: Units
    """Those in which weights are stated, and change the answer."""
    load_size: float
    """[N] what the task asks of the contacts: a violation is measured against this, or against what a contact carries
    when that is more."""
    intersample: Intersample | None = None
    """What happens between the knots, when the program is to allow for it."""
    free_basis: sparse.csc_matrix | None = None
    """(T n_v, m) orthogonal columns that the knots' unknowns, stacked, are made of; None when they are any."""
    each: Each | None = None
    """(T) the statics at every knot, where those above tell names and lengths only; None when they tell all."""
    unreduced: Formulation | None = None
    """What it was before goals determined a part of the plan; None when none has."""
    departure: Departure | None = None
    """What forces and motions are beside what references and load make them."""
    allowed: Allowed | None = None
    """What else the plan is to hold for."""

    along_path: ClassVar[bool] = False
    """Whether it is around a path that is known (`conic/along.py`): promises are kept to less digits there."""

    @property
    def knots(self) -> int:
        """Number of knots T."""
        return len(self.times)

    @property
    def n_v(self) -> int:
        """Unknowns at each knot."""
        return int(self.alpha.matrix.shape[-1])

    @property
    def unknowns(self) -> int:
        """Unknowns of all knots."""
        return self.knots * self.n_v if self.free_basis is None else int(self.free_basis.shape[1])

    @cached_property
    def frees_alpha(self) -> bool:
        """Whether the internal force is an unknown, or a part of it."""
        return self._frees(self.alpha)

    @cached_property
    def frees_beta(self) -> bool:
        """Whether the rigid motion is an unknown, or a part of it."""
        return self._frees(self.beta)

    @cached_property
    def frees_gamma(self) -> bool:
        """Whether the redundancy is an unknown, or a part of it."""
        return self._frees(self.gamma)

    def _frees(self, part: Affine) -> bool:
        return bool(part.matrix.any()) and (self.free_basis is None or moves(self.free_basis, part.matrix))

    @property
    def whole(self) -> Formulation:
        """The formulation in which no goal has determined anything yet."""
        return self.unreduced or self

    @cached_property
    def beta_basis(self) -> Array:
        """(dim Gamma_ucs, m) orthonormal directions in which the rigid motion was an unknown at first."""
        matrix = self.whole.beta.matrix
        return frozen(matrix[:, np.any(matrix, axis=0)] / self.whole.units.motion)

    @cached_property
    def divisor(self) -> float:
        """What sums of squares over the knots are divided by when one unknown speaks of many of them.

        As sums they would drown the limits, as averages the limits them; the root between the two was found by trying.
        """
        return 1.0 if self.free_basis is None else float(np.cbrt(longest(self.free_basis, self.n_v)))

    @property
    def force_unit(self) -> float:
        """[N]."""
        return self.units.force

    def map_of(self, of: Callable[[Statics], Array]) -> Array:
        """Return a map of the statics, (...) when it is the same at all knots and (T, ...) when each has its own."""
        return of(self if self.each is None else self.each)

    @cached_property
    def load_change(self) -> Array:
        """(T, 6) wrench on the object beyond the one at the start."""
        return frozen(self.wrench - self.map_of(lambda at: at.response.grasp.w_0))

    @cached_property
    def force(self) -> Affine:
        """Contact forces lambda (n_l) [N, N m]."""
        of_load = self.map_of(lambda at: at.response.dlambda_dw)
        known = self.map_of(lambda at: forces_at_start(at.response)) + product(of_load, self.load_change)
        return self.departed("force", self.alpha.mapped(self.map_of(lambda at: at.spaces.E_s)).plus(known))

    @cached_property
    def torque(self) -> Affine:
        """Joint torques tau = J' lambda (n_q) (6) [N m]."""
        return self.force.mapped(self.map_of(lambda at: at.response.grasp.J.mT))

    @cached_property
    def effort(self) -> Affine:
        """Actuator efforts sigma = S' tau (n_z)."""
        return self.torque.mapped(self.map_of(lambda at: at.response.grasp.S.mT))

    @cached_property
    def reference(self) -> Affine:
        """Synergy references dz_r (n_z) by (35)."""
        matrices, constants = zip(*((part.matrix, part.constant) for part in self._parts), strict=True)
        return Affine(np.vstack(matrices), np.hstack(constants)).mapped(self.map_of(lambda at: at.coordinates.inverse))

    @cached_property
    def joint(self) -> Affine:
        """Joint displacements dq (n_q) from the start [rad or m]."""
        of_load = self.map_of(lambda at: at.response.dq_dw)
        moved = self.reference.mapped(self.map_of(lambda at: at.response.dq_dzr))
        return self.departed("joint", moved.plus(product(of_load, self.load_change)))

    @cached_property
    def joint_span(self) -> tuple[Array, Array]:
        """The least and the largest displacement of each joint (n_q,) that it can come to; infinite, it may be any."""
        far = frozen(np.full(self.response.grasp.n_q, np.inf))
        return frozen(-far), far

    @cached_property
    def displacement(self) -> Affine:
        """Object displacement du (6) from the start, sag under load included [m, rad]."""
        sag, rigid = product(self.map_of(lambda at: at.response.du_dw), self.load_change), self.rigid
        whole = Affine(frozen(self.elastic.matrix + rigid.matrix), frozen(self.elastic.constant + rigid.constant + sag))
        return self.departed("displacement", whole)

    def departed(self, name: str, value: Affine) -> Affine:
        """Return a quantity with what it is beside what references and load make it."""
        return value if self.departure is None else value.plus(getattr(self.departure, name) + 0.0 * value.constant)

    @cached_property
    def rigid(self) -> Affine:
        """Rigid part Gamma_ucs beta of the object displacement (6) [m, rad]."""
        return self.beta.mapped(self.map_of(lambda at: at.spaces.Gamma_ucs))

    @cached_property
    def elastic(self) -> Affine:
        """What the references move the object beyond the rigid motion Gamma_ucs beta (6) [m, rad].

        By (35) that comes from alpha alone; taken from it, no rounding makes it depend on gamma.
        """
        n_alpha = self.coordinates.dimensions[0]
        return self.alpha.mapped(self.map_of(lambda at: at.response.du_dzr @ at.coordinates.inverse[..., :n_alpha]))

    def rigid_motion(self, dz_r: Array) -> Array:
        """Return the rigid motion Gamma_ucs beta (T, 6) [m, rad] of the object under references (T, n_z)."""
        return product(self.map_of(lambda at: at.spaces.Gamma_ucs), product(self.map_of(to_beta), dz_r))

    def elastic_motion(self, motion: Motion) -> Array:
        """Return what references move the object (T, 6) beyond its rigid motion, sag excluded [m, rad]."""
        return frozen(motion.du - motion.sag - self.rigid_motion(motion.dz_r))

    def in_units(self, units: Units) -> Formulation:
        """Return the same formulation, of which nothing is determined, with its unknowns in other units."""
        old = self.units
        return replace(
            self, units=units, alpha=self.alpha.in_units(units.force / old.force),
            gamma=self.gamma.in_units(units.reference / old.reference),
            beta=self.beta.in_units(units.motion / old.motion),
        )  # fmt: skip

    def column_units(self, units: Units) -> Array:
        """Return (n_v,) what each unknown is a multiple of in some units, when nothing of the plan is determined."""
        n_alpha, n_gamma = self.alpha.matrix.shape[0], int(self.frees_gamma) * self.gamma.matrix.shape[0]
        sizes = [units.force] * n_alpha + [units.reference] * n_gamma
        return np.array(sizes + [units.motion] * (self.n_v - len(sizes)))

    def around(self, v: Array, free_basis: sparse.csc_matrix) -> Formulation:
        """Return what is left of it when all plans are alike but for multiples of some changes of the whole plan.

        The knots' unknowns are then what is added to v, and they are made of the columns of the basis.

        Args:
            v: (T, n_v) one of the plans.
            free_basis: (T n_v, m) orthogonal columns, each a change of the stacked unknowns.
        """
        alpha, beta, gamma = (replace(part, constant=frozen(part.at(v))) for part in self._parts)
        return replace(self, alpha=alpha, beta=beta, gamma=gamma, free_basis=free_basis, unreduced=self.whole)

    def parts(self, v: Array) -> tuple[Array, Array, Array]:
        """Return alpha (T, dim E_s) [N], beta (T, dim Gamma_ucs) [m] and gamma (T, dim Gamma_zr) of v (T, n_v)."""
        return self.alpha.at(v), self.beta.at(v), self.gamma.at(v)

    @property
    def _parts(self) -> tuple[Affine, Affine, Affine]:
        return self.alpha, self.beta, self.gamma
