"""The second formulation between knots with a grasp each: straight lines, and the load's departure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from synergrip.conic.intersample import Looks
from synergrip.linalg import Array, interpolated
from synergrip.referee.maps import Expression, mapped
from synergrip.referee.model import Model
from synergrip.statics import Response
from synergrip.statics.each import EachResponse


def beside(model: Model, looks: Looks) -> Model:
    """Return the task of a model at instants between its knots; what is straight from knot to knot stays straight."""
    shares = interpolated(looks.times, model.times, np.eye(len(model.times)))
    names = [each.name for each in fields(Model)]
    own: dict[str, Any] = {name: getattr(model, name) for name in names}
    own |= {name: shares @ own[name] for name in ("dz_r", "beta", "beta_free", "gamma")}
    departure = looks.wrench - shares @ model.wrench
    force = shares @ model.force + _departed(model, shares, departure, lambda of: of.dlambda_dw)
    own |= {"times": looks.times, "wrench": looks.wrench, "target": looks.target, "force": force, "tracking": ()}
    return BesideKnots(**own, knots=model, shares=shares)


def _departed(
    model: Model, shares: Array, departure: Array, of_load: Callable[[Response | EachResponse], Array]
) -> Array:
    """Return what departures (J, 6) of the load make, by maps between those of the knots."""
    maps = np.tensordot(shares, model.maps.of(lambda at: of_load(at.response)), axes=1)
    return np.asarray(mapped(maps, departure))


@dataclass(frozen=True)
class BesideKnots(Model):
    """At J instants between T knots."""

    knots: Model | None = None
    shares: Array | None = None  # (J, T) of each knot in each instant

    @property
    def moved(self) -> Expression:
        """Object motion U dz_r (J, 6) that the references make [m, rad]."""
        return self._straight("moved")

    @property
    def sag(self) -> Array:
        """Object motion (J, 6) that the change of the load makes [m, rad]."""
        return np.asarray(self._straight("sag", lambda of: of.du_dw))

    @property
    def rigid(self) -> Expression:
        """Its rigid part Gamma_ucs beta (J, 6) [m, rad]."""
        return self._straight("rigid")

    @property
    def torque(self) -> Expression:
        """Joint torques J' lambda (J, n_q) [N m]."""
        return self._straight("torque", lambda of: of.grasp.J.T @ of.dlambda_dw)

    @property
    def effort(self) -> Expression:
        """Actuator efforts S' tau (J, n_z)."""
        return self._straight("effort", lambda of: of.grasp.S.T @ of.grasp.J.T @ of.dlambda_dw)

    @property
    def joints(self) -> Expression:
        """Joint displacements (J, n_q) [rad or m]."""
        return self._straight("joints", lambda of: of.dq_dw)

    def _straight(self, name: str, of_load: Callable[[Response | EachResponse], Array] | None = None) -> Expression:
        assert self.knots is not None
        assert self.shares is not None
        value = self.shares @ getattr(self.knots, name)
        if of_load is None:
            return value
        return value + _departed(self.knots, self.shares, self.wrench - self.shares @ self.knots.wrench, of_load)
