"""Kinds of contact by name, for tests that go through several of them."""

from __future__ import annotations

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.kinds import contact_kind
from synergrip.grasps.matrices import GivenContact


def made_kind(name: str, friction: float, spin_friction: float = 0.0, **others: float) -> ContactKind:
    """The kind of a name, with those of the values that are its parameters."""
    return contact_kind(name).taking({"friction": friction, "spin_friction": spin_friction, **others})


def spin_of(contact: Contact | GivenContact) -> float:
    """The spin moment that a contact carries for each newton of normal force [m]; 0 where it carries none."""
    return float(getattr(contact.kind, "spin_friction", 0.0))
