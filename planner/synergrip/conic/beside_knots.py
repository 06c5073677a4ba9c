"""A formulation between knots that each have a grasp of their own: what is straight from knot to knot stays straight.

With one grasp for all knots forces and motions are straight lines between knots because the references are. With one
for each, neither the bases nor the maps of two knots have anything to say of each other's unknowns; what is on a
straight line between them is every quantity itself. What the load there departs by from its own straight line comes
through the maps of the load, between those of the knots.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from synergrip.conic.affine import Affine, times
from synergrip.conic.each_knot import Statics
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.linalg import Array, frozen, interpolated


def fields_of(formulation: Formulation) -> dict[str, Any]:
    """Return what every formulation has, by name, to make one of another kind of it."""
    return {each.name: getattr(formulation, each.name) for each in fields(Formulation)}


def beside(formulation: Formulation, looks: Looks) -> Formulation:
    """Return the formulation at instants between the knots, under a wrench and with a wish (J, 6) of their own.

    The matrices of its quantities are those of the knots: at an instant, what these make of the unknowns counts by the
    share of each knot in it, as `Rows.inside` says.
    """

    def moved(part: Affine) -> Affine:
        return replace(part, constant=frozen(interpolated(looks.times, formulation.times, part.constant)))

    own = fields_of(formulation) | {
        "times": looks.times, "wrench": looks.wrench, "target": looks.target, "alpha": moved(formulation.alpha),
        "beta": moved(formulation.beta), "gamma": moved(formulation.gamma),
    }  # fmt: skip
    return Formulation(**own) if formulation.each is None else BesideKnots(**own, at_knots=formulation)


@dataclass(frozen=True)
class BesideKnots(Formulation):
    """At J instants between T knots; ``matrix`` of a quantity is (T, m, n_v) and ``constant`` (J, m)."""

    at_knots: Formulation | None = None

    @cached_property
    def force(self) -> Affine:
        """Contact forces lambda (n_l) [N, N m]."""
        return self._straight("force", lambda at: -at.response.right_inverse)

    @cached_property
    def torque(self) -> Affine:
        """Joint torques tau = J' lambda (n_q) [N m]."""
        return self._straight("torque", lambda at: -at.response.grasp.J.mT @ at.response.right_inverse)

    @cached_property
    def effort(self) -> Affine:
        """Actuator efforts sigma = S' tau (n_z)."""
        return self._straight(
            "effort", lambda at: -(at.response.grasp.J @ at.response.grasp.S).mT @ at.response.right_inverse
        )

    @cached_property
    def reference(self) -> Affine:
        """Synergy references dz_r (n_z)."""
        return self._straight("reference")

    @cached_property
    def joint(self) -> Affine:
        """Joint displacements dq (n_q) from the start [rad or m]."""
        return self._straight("joint", lambda at: at.response.dq_dw)

    @cached_property
    def displacement(self) -> Affine:
        """Object displacement du (6) from the start, sag under load included [m, rad]."""
        return self._straight("displacement", lambda at: at.response.du_dw)

    @cached_property
    def rigid(self) -> Affine:
        """Rigid part Gamma_ucs beta of the object displacement (6) [m, rad]."""
        return self._straight("rigid")

    @cached_property
    def elastic(self) -> Affine:
        """What the references move the object beyond the rigid motion (6) [m, rad]."""
        return self._straight("elastic")

    def _straight(self, name: str, of_load: Callable[[Statics], Array] | None = None) -> Affine:
        """Return a quantity on straight lines between the knots, and what the departure of the load adds to it."""
        assert self.at_knots is not None
        known, knots = getattr(self.at_knots, name), self.at_knots
        constant = interpolated(self.times, knots.times, known.constant)
        if of_load is not None:
            maps = knots.map_of(of_load)
            here = interpolated(self.times, knots.times, maps.reshape(len(maps), -1)).reshape(-1, *maps.shape[1:])
            constant = constant + times(here, self.wrench - interpolated(self.times, knots.times, knots.wrench))
        return Affine(known.matrix, frozen(np.asarray(constant)))
