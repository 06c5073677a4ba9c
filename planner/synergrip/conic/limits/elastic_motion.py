"""How far the grip may push the object beyond the rigid motion Gamma_ucs beta."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.limits.symmetric import norm_usage
from synergrip.conic.rows import Rows, norm_within
from synergrip.linalg import Array
from synergrip.statics.motion import Motion


@dataclass(frozen=True)
class ElasticMotion:
    """``||U dz_r - Gamma_ucs beta|| <= limit``: contacts' deformation under the squeeze, sag under load excluded.

    Rotations count with the grasp's characteristic length, about the contacts' centroid.
    """

    limit: float  # [m]
    key: str = "limits.elastic_motion"
    watches: ClassVar[Watches] = "forces"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return one second-order cone per knot, in units of the limit."""
        return [norm_within(self.key, "object", self._scaled(formulation), self.limit)]

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return the elastic motion and its limit."""
        return self._scaled(formulation), np.full(6, self.limit)

    def loosened(self, share: float) -> Self:
        """Return it with a limit larger by `share`."""
        return replace(self, limit=self.limit * (1 + share))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return its size."""
        elastic = motion.du - motion.sag - formulation.rigid_motion(motion.dz_r)
        size = np.linalg.norm(formulation.response.scale.twist(elastic), axis=1)
        return norm_usage("elastic motion", "m", "object", size, self.limit, motion.times)

    def _scaled(self, formulation: Formulation) -> Affine:
        return formulation.elastic.after(formulation.response.scale.motion)
