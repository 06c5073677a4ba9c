"""A task on a grasp that is not quite the one it is planned on: the same references, other maps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from synergrip.conic.affine import Affine
from synergrip.conic.beside_knots import fields_of
from synergrip.conic.formulation import Formulation
from synergrip.linalg import Array, frozen
from synergrip.statics import Response


@dataclass(frozen=True, eq=False, repr=False)
class Sampled(Formulation):
    """A formulation in the unknowns of the stated grasp, with forces and motions of another one."""

    own: Response | None = None

    @classmethod
    def of(cls, formulation: Formulation, own: Response) -> Sampled:
        """Return a formulation of the same references on another grasp."""
        return cls(**fields_of(formulation), own=own)

    @property
    def other(self) -> Response:
        """The maps of the other grasp."""
        assert self.own is not None
        return self.own

    @cached_property
    def force(self) -> Affine:
        """Contact forces lambda (n_l) [N, N m]."""
        return self._of("dlambda_dzr", "dlambda_dw").plus(started(self.other))

    @cached_property
    def torque(self) -> Affine:
        """Joint torques tau = J' lambda (n_q) [N m]."""
        return self.force.after(self.other.grasp.J.T)

    @cached_property
    def joint(self) -> Affine:
        """Joint displacements dq (n_q) from the start [rad or m]."""
        return self._of("dq_dzr", "dq_dw")

    @cached_property
    def displacement(self) -> Affine:
        """Object displacement du (6) from the start [m, rad]."""
        return self._of("du_dzr", "du_dw")

    def _of(self, references: str, load: str) -> Affine:
        change = self.wrench - self.other.grasp.w_0
        return self.reference.after(getattr(self.other, references)).plus(change @ getattr(self.other, load).T)


def started(response: Response, squeezed: Array | None = None) -> Array:
    """Return forces (n_l) at the start of another grasp: the elastic reaction to w_0, and what was squeezed in.

    Args:
        response: of the other grasp.
        squeezed: (n_l,) the forces that were squeezed in; those that it states itself when None.
    """
    grasp = response.grasp
    passive, own = response.dlambda_dw @ grasp.w_0, grasp.lambda_0 if squeezed is None else squeezed
    if own is None:
        return frozen(passive)
    return frozen(passive + own + response.dlambda_dw @ (grasp.G @ own))
