"""What the limits on changes over time share: first or second differences over knots of any distance."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.symmetric import Symmetric
from synergrip.conic.rows import Earlier, Rows, items_of, nonnegative
from synergrip.linalg import Array, frozen


@dataclass(frozen=True, eq=False)
class Differences(Symmetric):
    """``|x_k + sum of weights times earlier x| <= step_k limit`` for each joint or synergy; `differences` says which.

    x are the references, unless `value` says other quantities.
    """

    couples_knots = True

    @abstractmethod
    def differences(self, times: Array) -> tuple[Array, Array]:
        """Return the steps (K,) and the weights (K, order) of knots k - 1, k - 2, ...; K = 0 when there are too few."""

    def value(self, formulation: Formulation) -> Affine:
        """Return the references, whose differences are bounded."""
        return formulation.reference

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each joint or synergy and step, in units of the bound of the longest."""
        grasp, limit = formulation.response.grasp, self.on(formulation.response.grasp).limit
        keep = np.isfinite(limit)
        step, weights = self.differences(formulation.times)
        if not len(step) or not np.any(keep):
            return []
        room = step[:, None] * limit[keep]
        unit, changing = room.max(axis=0), self.value(formulation)  # one matrix serves all steps
        matrix = changing.matrix[..., keep, :] / unit[:, None]
        known = _summed(changing.constant[:, keep], weights) / unit
        names = [name for name, kept in zip(self.names(grasp), keep, strict=True) if kept]
        result = []
        for side, sign in (("falling", 1.0), ("rising", -1.0)):
            value = Affine(frozen(sign * matrix), frozen(room / unit + sign * known))
            earlier = tuple(
                Earlier(lag + 1, frozen(sign * matrix), frozen(weights[:, lag])) for lag in range(weights.shape[1])
            )
            result.append(nonnegative(self.key, items_of(names, side), value, earlier))
        return result

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: a change bounds no value."""


def _summed(z: Array, weights: Array) -> Array:
    """Return z_k + sum of weights times earlier z (K, m) of z (T, m)."""
    count, order = weights.shape
    total = z[order:]
    for lag in range(order):
        total = total + weights[:, [lag]] * z[order - lag - 1 : order - lag - 1 + count]
    return total
