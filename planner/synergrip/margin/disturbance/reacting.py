"""What limits look at when an extra wrench comes on top of the load of a plan and the internal forces may answer.

References stay those of the plan but for what alpha adds to them; the hand yields. To first order, at every knot,

    lambda = lambda_plan - G+ w + E_s alpha,   dz_r = dz_r,plan + M^-1 (alpha, 0, 0),   u = u_plan + du_dw w + ...

with the maps of the start posture, or of the true equilibrium of the knot where a hand moves. The wrench w acts about B
in the axes of N, as every load does, and is the same at all knots.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.affine import times as product
from synergrip.conic.beside_knots import fields_of
from synergrip.conic.formulation import Formulation
from synergrip.linalg import Array, frozen
from synergrip.planning.executing import analyses_of
from synergrip.planning.outcome import Plan
from synergrip.statics.each import Each


@dataclass(frozen=True, eq=False, repr=False)
class Reacting(Formulation):
    """The formulation of changes of the internal force of a plan under an extra wrench."""

    plan: Plan | None = None
    extra: Array | None = None
    """(6,) about B, axes of N [N, N m]."""

    @classmethod
    def of(cls, plan: Plan, each: Each | None, extra: Array) -> Reacting:
        """Return it.

        Args:
            plan: whose states are known.
            each: (T) the statics at its knots, `statics_of(plan)`.
            extra: (6,) wrench about B, axes of N [N, N m].
        """
        whole = plan.formulation.whole
        count, T = plan.analysis.spaces.dimensions[0], len(plan.time)

        def still(values: Array) -> Affine:
            return Affine(frozen(np.zeros((values.shape[1], count))), frozen(values))

        alpha = Affine(frozen(whole.units.force * np.eye(count)), frozen(np.zeros((T, count))))
        own = {"each": each, "alpha": alpha, "beta": still(plan.beta), "gamma": still(plan.gamma),
               "intersample": None, "free_basis": None, "unreduced": None, "allowed": None}  # fmt: skip
        return cls(**fields_of(whole) | own, plan=plan, extra=frozen(extra))

    @property
    def known(self) -> Plan:
        """The plan."""
        assert self.plan is not None
        return self.plan

    @cached_property
    def force(self) -> Affine:
        """Contact forces lambda (n_l) [N, N m]."""
        return self.alpha.after(self.map_of(lambda at: at.spaces.E_s)).plus(
            self.known.forces + self._of_extra(self.map_of(lambda at: at.response.dlambda_dw))
        )

    @cached_property
    def _change(self) -> Affine:
        """What is added to the references (n_z)."""
        count = self.alpha.matrix.shape[0]
        return self.alpha.after(self.map_of(lambda at: at.coordinates.inverse[..., :count]))

    @cached_property
    def reference(self) -> Affine:
        """Synergy references dz_r (n_z)."""
        return self._change.plus(self.known.dz_r)

    @cached_property
    def joint(self) -> Affine:
        """Joint displacements dq (n_q) from the start [rad or m]."""
        yields = self._of_extra(self.map_of(lambda at: at.response.dq_dw))
        return self._change.after(self.map_of(lambda at: at.response.dq_dzr)).plus(self.known.motion.dq + yields)

    @cached_property
    def displacement(self) -> Affine:
        """Object displacement du (6) from the start [m, rad]."""
        sags = self._of_extra(self.map_of(lambda at: at.response.du_dw))
        return self._change.after(self.map_of(lambda at: at.response.du_dzr)).plus(self.known.motion.du + sags)

    @cached_property
    def rigid(self) -> Affine:
        """Rigid part of the object displacement (6), which no internal force changes [m, rad]."""
        motion = self.known.motion
        constant = motion.du - motion.sag - self.known.elastic_motion
        return Affine(frozen(np.zeros((6, self.n_v))), frozen(constant))

    @cached_property
    def elastic(self) -> Affine:
        """What the references move the object beyond the rigid motion (6) [m, rad]."""
        return self._change.after(self.map_of(lambda at: at.response.du_dzr)).plus(self.known.elastic_motion)

    def _of_extra(self, linear: Array) -> Array:
        """Return what the extra wrench does at every knot (T, m)."""
        assert self.extra is not None
        return product(linear, np.broadcast_to(self.extra, (self.knots, 6)))


def statics_of(plan: Plan) -> Each | None:
    """Return the statics at the true equilibria of a plan's knots; None for those of the start posture."""
    return None if plan.executed is None else analyses_of(plan.executed, plan.analysis)
