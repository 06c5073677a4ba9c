"""Friction of all contacts, or of some, multiplied: a key that tries other friction without rewriting contacts."""

from __future__ import annotations

from typing import Annotated

from synergrip.documents.fields import POSITIVE, Written, named
from synergrip.documents.numbers import number
from synergrip.documents.validation import shown
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp


def _factor(value: object) -> float | dict[str, float]:
    if isinstance(value, dict):
        return named(lambda each: number(each, above=0), value)
    if isinstance(value, str):
        raise InputError.at("", f"expected a number, or a table of contacts and numbers, got {shown(value)}")
    return number(value, above=0)


FrictionFactor = Annotated[
    float | dict[str, float],
    Written(_factor, {"anyOf": [POSITIVE, {"type": "object", "additionalProperties": POSITIVE}]}),
]
FRICTION_FACTOR = "by which friction is multiplied, spin friction too: of all contacts, or of those named"


def with_friction(grasp: Grasp, factor: float | dict[str, float] | None, key: str) -> Grasp:
    """Return a grasp with the friction of its contacts multiplied.

    Args:
        grasp: as it is stated.
        factor: for all contacts, or for some by their names; None leaves all as they are.
        key: of the problem file, for messages.

    Raises:
        InputError: no contact of that name.
    """
    if factor is None:
        return grasp
    names = [contact.name for contact in grasp.contacts]
    by_name = factor if isinstance(factor, dict) else dict.fromkeys(names, factor)
    for name in by_name:
        if name not in names:
            raise InputError.at(f"{key}.{name}", one_of(name, names), on_key=True)
    kinds = {contact.name: contact.kind for contact in grasp.contacts}
    return grasp.replace(contact={name: kinds[name].slippery(value) for name, value in by_name.items()})
