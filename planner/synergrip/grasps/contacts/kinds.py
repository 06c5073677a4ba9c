"""The kinds of contact there are. A new kind is one file and one line here."""

from __future__ import annotations

from synergrip.errors import InputError, one_of
from synergrip.grasps.contacts.elliptic_soft_finger import EllipticSoftFinger
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.kind import ContactKind, Parameter
from synergrip.grasps.contacts.patch_contact import PatchContact
from synergrip.grasps.contacts.soft_finger import SoftFinger

KINDS: dict[str, type[ContactKind]] = {
    kind.name: kind for kind in (HardFinger, SoftFinger, Frictionless, EllipticSoftFinger, PatchContact)
}

PARAMETERS: dict[str, Parameter] = {each.name: each for kind in KINDS.values() for each in kind.parameters}
"""Of all kinds, by name: what a file may say of a contact."""


def described_parameter(parameter: Parameter) -> str:
    """Return what a parameter means, and which contacts have it, where not all but the frictionless ones do."""
    owners = [kind.name for kind in KINDS.values() if parameter.name in {each.name for each in kind.parameters}]
    few = len(owners) < sum(bool(kind.parameters) for kind in KINDS.values())
    return f"{parameter.meaning}, for {' and '.join(owners)} contacts" if few else parameter.meaning


def contact_kind(name: str, key: str = "") -> type[ContactKind]:
    """Return a kind by its name in files, or raise an `InputError` that lists the kinds."""
    if name not in KINDS:
        raise InputError.at(key, one_of(name, KINDS))
    return KINDS[name]
