"""What drives the joints of a model file, and what holds those that nothing drives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

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

    @property
    def idle(self) -> tuple[str, ...]:
        """Joints that are no synergies, because no motor of the file is known to move them."""
        return (*self.sprung, *self.loose)
