"""How far the object may be from where it is wanted, in all or some of its six axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, Self

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.limits.symmetric import norm_usage
from synergrip.conic.rows import Rows, norm_within
from synergrip.linalg import Array
from synergrip.statics.motion import Motion

AxisName = Literal["x", "y", "z", "rx", "ry", "rz"]
AXES: tuple[AxisName, ...] = ("x", "y", "z", "rx", "ry", "rz")
"""Translations along and rotations about the palm's axes, about B."""


@dataclass(frozen=True)
class ObjectError:
    """``||D (u - wanted)|| <= limit`` over the chosen axes, D = diag(1, 1, 1, L, L, L), L the characteristic length.

    u is the whole displacement of the object, sag under load included, or the rigid part Gamma_ucs beta of it.
    """

    limit: float  # [m]
    axes: tuple[AxisName, ...] = AXES
    part: Literal["whole", "rigid"] = "whole"
    key: str = "limits.drift"
    title: str = "object drift"
    watches: ClassVar[Watches] = "motion"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return one second-order cone per knot, in units of the limit."""
        return [norm_within(self.key, "object", self._error(formulation), self.limit)]

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return the error in each of the axes, and the limit."""
        return self._error(formulation), np.full(len(self.axes), self.limit)

    def loosened(self, share: float) -> Self:
        """Return it with a limit larger by `share`."""
        return replace(self, limit=self.limit * (1 + share))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the size of the error."""
        reached = motion.du
        if self.part == "rigid":
            reached = formulation.rigid_motion(motion.dz_r)
        size = np.linalg.norm((reached - formulation.target) @ self._weights(formulation).T, axis=1)
        return norm_usage(self.title, "m", "object", size, self.limit, motion.times)

    def _error(self, formulation: Formulation) -> Affine:
        whole = formulation.displacement if self.part == "whole" else formulation.rigid
        return whole.plus(-formulation.target).after(self._weights(formulation))

    def _weights(self, formulation: Formulation) -> Array:
        """Return the rows of D (len(axes), 6) that count."""
        return axis_weights(self.axes, formulation.response.scale.length)


def axis_weights(axes: Sequence[AxisName], length: float) -> Array:
    """Return the rows of diag(1, 1, 1, L, L, L) of the named axes, (len(axes), 6)."""
    whole = np.diag([1.0] * 3 + [length] * 3)
    return whole[[AXES.index(axis) for axis in axes]]
