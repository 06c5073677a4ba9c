"""Friction and stiffness of contacts, multiplied: keys that try other ones without rewriting contacts."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Protocol

from synergrip.documents.fields import POSITIVE, Written, named
from synergrip.documents.numbers import number
from synergrip.documents.validation import shown
from synergrip.errors import InputError, one_of
from synergrip.grasps.factors import Factors as Multiplied
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


Factor = Annotated[float, Written(lambda value: number(value, above=0), POSITIVE)]
STIFFNESS_FACTOR = "by which the stiffness of all contacts is multiplied"


class Factors(Protocol):
    """A table that holds both."""

    friction_factor: float | dict[str, float] | None
    stiffness_factor: float | None


def with_factors(grasp: Grasp, table: Factors | None, key: str) -> Grasp:
    """Return a grasp with friction and stiffness of its contacts multiplied.

    Args:
        grasp: as it is stated.
        table: what to multiply by; a number for all contacts, or some by their names; None leaves all as they are.
        key: of the table, for messages.

    Raises:
        InputError: no contact of that name.
    """
    if table is None:
        return grasp
    stiffer = table.stiffness_factor
    if stiffer is not None:
        grasp = replace(grasp.replace(C_s=grasp.C_s / stiffer), factors=Multiplied(stiffness=stiffer))
    kinds = {contact.name: contact.kind for contact in grasp.contacts}
    factor = table.friction_factor
    if factor is None:
        return grasp
    by_name = factor if isinstance(factor, dict) else dict.fromkeys(kinds, factor)
    for name in by_name:
        if name not in kinds:
            raise InputError.at(f"{key}.friction_factor.{name}", one_of(name, list(kinds)), on_key=True)
    slippery = grasp.replace(contact={name: kinds[name].slippery(value) for name, value in by_name.items()})
    return replace(slippery, factors=replace(grasp.factors, friction=by_name))
