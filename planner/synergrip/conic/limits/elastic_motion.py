"""How far the grip may push the object beyond the rigid motion Gamma_ucs beta."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from synergrip.conic.arguments import size
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.dial import Dial
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.limits.object_error import norm_usage
from synergrip.conic.rows import Rows, norm_within
from synergrip.documents.fields import Size
from synergrip.documents.naming import naming_arguments
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.statics.motion import Motion


@naming_arguments
@dataclass(frozen=True)
class ElasticMotion(Limit):
    """``||U dz_r - Gamma_ucs beta|| <= limit``: contacts' deformation under the squeeze, sag under load excluded.

    Rotations count with the grasp's characteristic length, about the contacts' centroid.

    Args:
        limit: largest elastic motion [m].

    Raises:
        InputError: no length greater than 0.

    Example:
        ``ElasticMotion(limit=1e-3)``
    """

    limit: float
    key = "limits.elastic_motion"
    watches = "forces"

    def __post_init__(self) -> None:
        """Judge the length."""
        found = size("ElasticMotion.limit", self.limit, "a length in metres greater than 0", above=0.0)
        object.__setattr__(self, "limit", found)

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """The distance."""
        return (Dial("drift", self.key, self.limit, "m", lambda value: replace(self, limit=value)),)

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
        size = np.linalg.norm(formulation.response.scale.twist(formulation.elastic_motion(motion)), axis=1)
        return norm_usage("elastic motion", "m", "object", size, self.limit, motion.times)

    def _scaled(self, formulation: Formulation) -> Affine:
        return formulation.elastic.after(formulation.response.scale.motion)


IN_FILE = FileKey(
    "elastic_motion", ElasticMotion, Size, "how far the grip may push the object beyond its rigid motion, sag excluded",
)  # fmt: skip
