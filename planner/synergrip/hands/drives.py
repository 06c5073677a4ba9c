"""What drives the joints of a model file, and what holds those that nothing drives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from synergrip.linalg import Array
from synergrip.values import ByContent


@dataclass(frozen=True, eq=False)
class Drives(ByContent):
    """What a model file says of motors and springs, for the joints that no motor moves."""

    compliance: Array
    """(n_q, n_q) yield of the joints to torques, by springs that no motor holds [rad/(N m)]."""
    sprung: Mapping[str, float] = field(default_factory=dict)
    """Joint that springs alone hold -> where they hold it [rad or m]."""
    loose: Mapping[str, str] = field(default_factory=dict)
    """Joint of which the file does not say how it moves, and how far it yields -> why not, as a clause."""
    notes: tuple[str, ...] = ()
    """What was taken for something else, or not read, though it is no error."""
    pulls: Array | None = None
    """(n_a, n_q) joint torque per force of each actuator; None when nothing says what an effort is."""
    forces: Array | None = None
    """(n_a,) largest force of each actuator; infinity when none is stated."""
    stiffness: Array | None = None
    """(n_q, n_q) of all springs that are read, those of joints that motors hold, too [N m/rad]; None when not known."""
    pulled: Array | None = None
    """(n_q,) joint torques of these springs with all joints at 0 [N m]."""

    def spring_torques(self, q: Array) -> Array:
        """Return what (n_q,) joints have to carry beside contacts so that springs do not move them from q [N m]."""
        if self.stiffness is None or self.pulled is None:
            return np.zeros(len(q))
        return np.asarray(self.stiffness @ q - self.pulled)

    @property
    def idle(self) -> tuple[str, ...]:
        """Joints that are no synergies, because no motor of the file is known to move them."""
        return (*self.sprung, *self.loose)
