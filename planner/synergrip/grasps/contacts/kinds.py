"""The kinds of contact there are. A new kind is one file and one line here."""

from __future__ import annotations

from synergrip.errors import InputError, one_of
from synergrip.grasps.contacts.contact import ContactKind
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.soft_finger import SoftFinger

KINDS: dict[str, ContactKind] = {kind.name: kind for kind in (HardFinger(), SoftFinger(), Frictionless())}


def contact_kind(name: str, key: str = "") -> ContactKind:
    """Return a kind by its name in files, or raise an `InputError` that lists the kinds."""
    if name not in KINDS:
        raise InputError.at(key, one_of(name, KINDS))
    return KINDS[name]
