"""Every contact force inside a friction cone that is narrower than the true one: by an angle, or by a factor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.friction_cone import FrictionCone, friction_rows, slip_margins
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.rows import Rows
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion


@dataclass(frozen=True)
class FrictionReserve:
    """``ratio mu n >= ||(t, o)||`` at every contact, and its soft kin with ``ratio nu``.

    An angle phi to the cone is the ratio ``tan(atan(mu) - phi) / mu``, a safety factor s the ratio ``1 / s``
    (docs/theory.md).
    """

    ratios: Array
    """(n_c,) between 0 and 1."""
    key: str = "limits.safety_factor"
    title: str = "slip margin with reserve"
    watches: ClassVar[Watches] = "forces"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the friction cones of contacts with less friction."""
        return friction_rows(self._narrowed(formulation), 0.0, 0.0, self.key)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: a cone alone bounds no force."""

    def loosened(self, share: float) -> Self:
        """Return it with `share` of the reserve given up."""
        return replace(self, ratios=frozen(self.ratios + share * (1 - self.ratios)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the slip margins that contacts with less friction would have; no less than 0 is asked of them."""
        margins = slip_margins(self._narrowed(formulation), motion)
        return replace(FrictionCone(0.0).usage(formulation, motion), title=self.title, value=margins)

    def _narrowed(self, formulation: Formulation) -> Formulation:
        grasp = formulation.response.grasp
        contacts = tuple(
            replace(contact, kind=contact.kind.slippery(ratio))
            for contact, ratio in zip(grasp.contacts, np.asarray(self.ratios), strict=True)
        )
        return replace(formulation, response=replace(formulation.response, grasp=replace(grasp, contacts=contacts)))
