"""What passes along the motion have come to so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from synergrip.conic.decide import Decision
from synergrip.documents.quantities import in_mm
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array
from synergrip.planning.hindrances import Hindrance
from synergrip.planning.pace import NEARER, FirstPasses, Pace
from synergrip.planning.stages import Stage
from synergrip.tasks.tracking_along import Steps
from synergrip.values import Value

TRUE, OF_FORCES = 1e-3, 1e-4
"""A promise is true when it is to this many newtons, or to this share of the largest force where that is more."""
CLOSE = 20.0
"""How many times that a promise may be off from which a pass or two make it true."""
KEPT, OF_FORCES_KEPT = 1e-3, 1e-3
"""A limit on forces is kept to this many newtons, or to this share of the largest force where that is more."""
ROUGH = 0.05
"""Share of the largest force up to which promise and truth are near each other."""
ALIKE = 0.3
"""Share of the largest force up to which forces between the knots bend as they will when promise is truth."""
NOWHERE = 1.0
"""Share of the largest force from which on a plan of the start posture is no place to begin at."""
BETTER = 0.75
"""Share of the last difference between promise and truth that a step must get below."""
FOLLOWED = 1e-5
"""[m] How near the object is brought to where it is wanted, as long as passes bring it nearer by `NEARER`."""


@dataclass(frozen=True, eq=False, repr=False)
class Walk(Value):
    """References, what they really do, and what led to them."""

    references: Array  # (T, n_z)
    executed: Execution
    gap: float
    """[N] largest difference between the contact forces promised and the true ones."""
    way: Steps | None
    """What is left of the way; None when some knots were not reached."""
    stage: Stage | None = None
    """What the goals of the last pass came to; None before the first."""
    passes: int = 0
    tried: tuple[Decision, ...] = ()
    """On the first goal, of every pass; of those taken back, too."""
    hindered: Hindrance | None = None
    """What kept the last pass from being taken; None when it was."""
    until: float | None = None
    """[s] until when the object is brought where it is wanted, by a walk of the first knots that does not go on from
    there; None for a walk of all knots."""
    stopped: bool = False
    """Whether somebody interrupted it."""
    left_out: bool = False
    """Whether goals are left for a later pass."""
    first: FirstPasses | None = None
    """What led to where the passes over all knots begin."""
    pace: Pace = field(default_factory=Pace)
    """How far the next pass goes."""
    short: int = 0
    """How many passes in a row, up to the last one, found less than the margin that is asked."""

    @property
    def interrupted(self) -> bool:
        """Whether somebody interrupted it, or the goals of its last pass."""
        return self.stopped or (self.stage is not None and self.stage.interrupted)

    @property
    def all_passes(self) -> int:
        """Passes over all knots, and those at some of them before."""
        return self.passes + (0 if self.first is None else self.first.passes)

    @property
    def true(self) -> bool:
        """Whether what was promised is what happens."""
        return self.way is not None and self.gap <= self.room

    @property
    def close(self) -> bool:
        """Whether one more pass or two make what was promised what happens."""
        return self.way is not None and self.gap <= CLOSE * self.room

    @property
    def rough(self) -> bool:
        """Whether what was promised is near what happens."""
        return self.way is not None and self.gap <= max(TRUE, ROUGH * self.largest)

    @property
    def alike(self) -> bool:
        """Whether forces between the knots bend much as they will in the end."""
        known = self.gap <= ALIKE * self.largest or (np.isinf(self.gap) and self.stage is not None)
        return self.way is not None and known

    @property
    def lost(self) -> bool:
        """Whether what was promised is nothing like what happens."""
        return bool(np.isfinite(self.gap)) and self.gap > ALIKE * self.largest

    @property
    def nowhere(self) -> bool:
        """Whether what was promised differs from what happens by about as much as there is: it leads nowhere."""
        return bool(np.isfinite(self.gap)) and self.gap > NOWHERE * self.largest

    @property
    def room(self) -> float:
        """[N] difference up to which a promise counts as what happens."""
        return room_of(self.executed.states.forces)

    @property
    def kept_to(self) -> float:
        """[N] how far beyond a limit forces may be that count as kept."""
        return kept_for(self.largest)

    @property
    def largest(self) -> float:
        """[N] The largest component of the true forces."""
        return float(np.abs(self.executed.states.forces).max(initial=0.0))

    @property
    def behind(self) -> float:
        """How far the rigid motion is behind the wanted one [m], at most; infinitely where knots were not reached."""
        return np.inf if self.way is None or self.until is not None else float(self.way.behind.max(initial=0.0))

    @property
    def there(self) -> bool:
        """Whether nothing is left of the way."""
        return self.behind < FOLLOWED

    @property
    def come(self) -> str:
        """After how many passes it is there, in words."""
        return f"after {self.all_passes} pass{'es' * (self.all_passes != 1)} along the motion"

    def after(self, before: Walk) -> Walk:
        """Return it with the passes of another one, which led nowhere, before it."""
        tried, first = (*before.tried, *self.tried), self.first or before.first
        return replace(self, passes=before.passes + self.passes, tried=tried, first=first)

    def better_than(self, other: Walk) -> bool:
        """Tell whether a pass was worth it: nearer to what was promised, or, once that is true, to what is wanted."""
        if self.way is None:
            return False
        if other.left_out and not self.left_out:
            return self.rough  # goals that are asked for the first time may go far
        if other.true:
            return self.true and self.behind < NEARER * other.behind
        return self.true or self.gap < BETTER * other.gap


def what_came(found: Walk | None, *, good: bool) -> str:
    """Return what came of a pass, in words."""
    if found is None:
        return "no answer"
    if found.way is None:
        return f"ends at instant {len(found.executed.states)}: {found.executed.why}"
    told = f"promise and truth differ by {found.gap:.3g} N, {in_mm(found.behind)} behind"
    return told if good else f"{told}, taken back"


def gap_to(promised: Array | None, forces: Array) -> float:
    """Return by how much [N] forces (K, n_l) differ from those promised (T, n_l), infinitely where these are None."""
    return np.inf if promised is None else float(np.abs(forces - promised[: len(forces)]).max(initial=0.0))


def differs(promised: Array | None, forces: Array) -> bool:
    """Return whether forces are not those that were promised."""
    return gap_to(promised, forces) > room_of(forces)


def kept_for(largest: float) -> float:
    """Return how far [N] beyond a limit forces may be that count as kept, beside the largest of them [N]."""
    return max(KEPT, OF_FORCES_KEPT * largest)


def room_of(forces: Array) -> float:
    """Return the difference [N] from forces (T, n_l) up to which a promise counts as what happens."""
    return max(TRUE, OF_FORCES * float(np.abs(forces).max(initial=0.0)))
