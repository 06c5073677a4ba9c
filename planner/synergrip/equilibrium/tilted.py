"""Contacts whose normals are not those of the surface that is stated: their springs and cones lie askew on it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from synergrip.equilibrium.meeting import Meeting, Model, Placed, Slid
from synergrip.linalg import Array
from synergrip.vectors import times


@dataclass(frozen=True, eq=False, repr=False)
class Tilted(Model):
    """A model of contacts with frames that are turned by as much wherever the contacts go.

    The places of contacts, and how tips roll, are those of the surface that is stated.
    """

    level: Model
    turn: Array
    """(n, 3, 3) rotations in the axes of each contact: frames become ``frame turn``."""

    def at(self, placed: Placed, near: Array | None) -> Meeting:
        """Return the contacts of the level model, with stretches and forces along and about other axes."""
        found = self.level.at(placed, near)
        stretch = found.stretch.copy()
        for part in (slice(3), slice(3, 6)):
            stretch[..., part] = times(self.turn.mT, found.stretch[..., part])
        return replace(found, frame=found.frame @ self.turn, stretch=stretch)

    def rolled(self, placed: Placed, meeting: Meeting) -> tuple[Array, Array]:
        """Return what a small turn of a link makes of frames and arms: the same as of level ones."""
        return self.level.rolled(placed, self._level(meeting))

    def slid(self, placed: Placed, meeting: Meeting) -> Slid | None:
        """Return how normals change where pads slide: as those of the level ones."""
        return self.level.slid(placed, self._level(meeting))

    def after(self, placed: Placed, meeting: Meeting) -> Model:
        """Return the model with the instants behind it."""
        return replace(self, level=self.level.after(placed, self._level(meeting)))

    def _level(self, meeting: Meeting) -> Meeting:
        """Return contacts as the level model has them."""
        stretch = meeting.stretch.copy()
        for part in (slice(3), slice(3, 6)):
            stretch[..., part] = times(self.turn, meeting.stretch[..., part])
        return replace(meeting, frame=meeting.frame @ self.turn.mT, stretch=stretch)
