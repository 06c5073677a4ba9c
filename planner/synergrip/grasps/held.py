"""What holds the object of a grasp: a hand in a posture."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.grasps.clearance import collision_notes
from synergrip.grasps.objects import Object
from synergrip.grasps.pad_overlaps import overlap_notes
from synergrip.grasps.placing import Touch
from synergrip.hands.arm import arm_notes
from synergrip.hands.coupling_notes import parted_notes
from synergrip.hands.follower_ranges import contradictions
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import ranges_of_followers
from synergrip.hands.undriven import undriven_notes
from synergrip.linalg import Array
from synergrip.values import ByContent


@dataclass(frozen=True, kw_only=True, eq=False)
class Held(ByContent):
    """What holds the object: a hand in a posture."""

    hand: Hand
    synergies: SynergySet
    q: Array
    """(n_q,) joint values [rad or m]."""
    C_q: Array
    """(n_q, n_q) joint compliance."""
    body: Object
    """The object, where it is."""
    touches: tuple[Touch, ...]
    """The pads that touch, in the order of the contacts."""
    gaps: tuple[float | None, ...]
    """Distance of each pad from the surface, > 0 outside [m]; None for an object without a shape."""

    def __repr__(self) -> str:
        """Return hand, object and pads, in one line."""
        pads = ", ".join(touch.pad.name for touch in self.touches)
        return f"<Held: hand {self.hand.name!r} holds {self.body.title!r}; pads {pads}>"

    @property
    def notes(self) -> tuple[str, ...]:
        """What is doubtful about it, though it is no error."""
        touching = [touch.pad.link for touch in self.touches]
        read = undriven_notes(self.hand, self.synergies, self.q, self.C_q)
        arm = arm_notes(self.hand, self.synergies, touching)
        parted = parted_notes(self.hand, self.q)
        ranges = contradictions(ranges_of_followers(self.hand))
        inside = collision_notes(self.hand, self.q, self.body, self.touches)
        return (*read, *arm, *ranges, *parted, *inside, *overlap_notes(self.hand, self.q, self.touches))
