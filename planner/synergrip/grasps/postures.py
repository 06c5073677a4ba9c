"""Many postures of one hand about an object, and where and how its pads touch it in each."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.held import Held
from synergrip.linalg import Array, frozen
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Postures(Value):
    """N postures."""

    q: Array  # (N, n_q) joint values [rad or m]
    position: Array  # (N, 3) of the object frame B, palm frame [m]
    frames: Array  # (N, n_c, 3, 3) of the contacts, columns n, t, o

    def taken(self, places: Any) -> Postures:
        """Return some of them."""
        return Postures(self.q[places], self.position[places], self.frames[places])

    def contacts(self, contacts: tuple[Contact, ...], place: int) -> tuple[Contact, ...]:
        """Return contacts as their frames are in one of them."""
        return tuple(
            replace(contact, frame=frozen(frame)) for contact, frame in zip(contacts, self.frames[place], strict=True)
        )

    def held(self, held: Held | None, place: int) -> Held | None:
        """Return what holds the object in one of them; gaps between pads and surface are not known."""
        if held is None:
            return None
        body = replace(held.body, position=frozen(self.position[place]))
        return replace(held, q=frozen(self.q[place]), body=body, gaps=(None,) * len(held.gaps))
