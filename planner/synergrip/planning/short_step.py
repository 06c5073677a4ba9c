"""How far one pass along the motion may go: a limit of the step, not of the plan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from synergrip.conic.along import AlongPath
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.rows import Rows, norm_within
from synergrip.planning.hindrances import STEP
from synergrip.statics.motion import Motion


@dataclass(frozen=True, eq=False)
class ShortStep(Limit):
    """Joints move little in one pass, beyond what the way that is left takes: the maps hold near the path only."""

    more: float = 0.0
    """Share by which they may move more than the path has room for."""
    key = STEP
    watches = "references"

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return one second-order cone per knot."""
        assert isinstance(formulation, AlongPath)
        moved = formulation.map_of(lambda at: at.response.dq_dzr) / formulation.known.room[:, None, None]
        return [norm_within(self.key, "joints", formulation.change.after(moved).shortened, 1.0 + self.more)]

    def loosened(self, share: float) -> ShortStep:
        """Return it with more room."""
        return replace(self, more=self.more + share)

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Raise: it is a limit of a step, not of a plan."""
        raise NotImplementedError
