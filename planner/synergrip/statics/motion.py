"""Forward maps: what synergy references and a wrench profile do to forces, torques and motions, knot by knot."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from synergrip.linalg import Array, Places, frozen, sealed
from synergrip.statics.response import Response
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.statics.each import EachResponse


@dataclass(frozen=True, eq=False, repr=False)
class Motion(Value):
    """Forces and small displacements at T knots, from the start of the task; SI units."""

    times: Array  # (T,) [s]
    dz_r: Array  # (T, n_z) synergy references
    wrench: Array  # (T, 6) external wrench on the object
    forces: Array
    """(T, n_l) lambda: force of the hand on the object at each contact, the whole of it [N, N m]."""
    torques: Array  # (T, n_q) tau = J' lambda (6) [N m]
    efforts: Array  # (T, n_z) sigma = S' tau
    du: Array  # (T, 6) object displacement about B, axes of N: all of it, sag included
    sag: Array  # (T, 6) the part of du that the change of the external wrench causes
    dq: Array  # (T, n_q) joint displacement
    dz: Array  # (T, n_z) synergy displacement

    def first(self, count: int) -> Motion:
        """Return the first knots of it."""
        return self.at(slice(count))

    def at(self, knots: Places | slice) -> Motion:
        """Return some of its knots, in order."""
        return replace(self, **{each.name: frozen(getattr(self, each.name)[knots]) for each in fields(self)})


def forces_at_start(response: Response | EachResponse) -> Array:
    """Return lambda_0 (n_l,), or (T, n_l) at each knot: as given, or the elastic reaction ``-G+ w_0`` to the load."""
    given = response.grasp.lambda_0
    return np.asarray(given) if given is not None else response.dlambda_dw @ response.grasp.w_0


def largest_term(response: Response, dz_r: Array) -> float:
    """Return the largest of the terms [N] that contact forces are sums of, over the synergies (T, n_z).

    Where these cancel to almost nothing, what is left is their rounding.
    """
    return float((np.abs(dz_r) @ response.term_sizes).max(initial=0.0))


def forward(response: Response, times: Array, dz_r: Array, wrench: Array, begun: Array | None = None) -> Motion:
    """Apply the forward maps (26)-(28) and the response to the wrench.

    Args:
        response: of the grasp.
        times: (T,) [s].
        dz_r: (T, n_z) synergy references, from those at the start.
        wrench: (T, 6) external wrench on the object [N, N m].
        begun: (n_l,) contact forces at the start [N, N m]; those of the grasp when None.
    """
    dw = wrench - response.grasp.w_0
    change = sealed(dz_r @ response.of_references + dw @ response.of_load)
    of_object = len(response.dlambda_dw)
    of_joints, of_synergies = of_object + 6, of_object + 6 + len(response.dq_dw)
    forces = (forces_at_start(response) if begun is None else begun) + change[:, :of_object]
    torques = forces @ response.grasp.J
    return Motion(
        frozen(times), frozen(dz_r), frozen(wrench), sealed(forces), sealed(torques),
        sealed(torques @ response.grasp.S), change[:, of_object:of_joints], sealed(dw @ response.du_dw.T),
        change[:, of_joints:of_synergies], change[:, of_synergies:],
    )  # fmt: skip
