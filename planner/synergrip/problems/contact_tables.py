"""The tables of a problem file that say where it touches, and how: [contacts] and [[contact]]."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Annotated, Any, Literal

from pydantic import Field

from synergrip.documents.fields import (
    Axis,
    Name,
    Positive,
    Size,
    Table,
    Written,
    array_of,
    listed,
    unit_schema,
    with_unit,
)
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, suggest
from synergrip.grasps.matrices import MOST_CONTACTS

ContactModel = Literal["hard", "soft", "frictionless"]

SOFTEST = 1e-6
"""A contact that yields a kilometre under a millinewton holds nothing [N/m, N m/rad]."""


def _rigid_or(kind: str) -> Callable[[Any], float]:
    read = with_unit(kind, above=0)

    def stiffness(value: object) -> float:
        if isinstance(value, str) and value.strip().isalpha():
            if value == "rigid":
                return math.inf
            raise InputError.at("", f"{value!r} is neither 'rigid' nor a {kind}{suggest(value, ['rigid'])}")
        result = read(value)
        if result < SOFTEST:
            raise InputError.at("", f"{shown(value)} is too soft to hold anything")
        return result

    return stiffness


def _rigid_schema(kind: str) -> dict[str, Any]:
    return {"anyOf": [unit_schema(kind), {"const": "rigid"}]}


Stiffness = Annotated[float, Written(_rigid_or("stiffness"), _rigid_schema("stiffness"))]
SpinStiffness = Annotated[float, Written(_rigid_or("spin stiffness"), _rigid_schema("spin stiffness"))]

Point = Annotated[
    tuple[float, ...],
    Written(lambda value: listed(with_unit("length"), value, 3, "lengths"), array_of(unit_schema("length"), 3)),
]


class ContactTable(Table):
    """What can be said of one contact, or of all as a default."""

    model: ContactModel | None = Field(
        default=None, description="hard (3 force components), soft (4) or frictionless (1)"
    )
    friction: Positive | None = Field(default=None, description="coefficient of friction")
    spin_friction: Size | None = Field(
        default=None, description="moment about the normal per normal force, for soft contacts"
    )
    stiffness: Stiffness | None = Field(default=None, description='stiffness along the normal, or "rigid"')
    tangential_stiffness: Stiffness | None = Field(
        default=None, description="stiffness across the normal; as along it when absent"
    )
    spin_stiffness: SpinStiffness | None = Field(
        default=None, description="stiffness about the normal, for soft contacts"
    )
    normals: Literal["object", "pad"] | None = Field(
        default=None, description="normal toward the object's centre, or straight out of the pad"
    )


class ContactsTable(ContactTable):
    """Defaults for every contact, and the pads that touch."""

    at: tuple[Name, ...] = Field(
        default=(), max_length=MOST_CONTACTS, description="names of the hand's pads that touch the object"
    )


class ContactEntry(ContactTable):
    """One contact: a pad or a place on a link, and what differs from the defaults."""

    name: Name | None = Field(default=None, description="name of the contact; that of the pad or link when absent")
    at: Name | None = Field(default=None, description="name of the hand's pad that touches the object")
    link: Name | None = Field(default=None, description="name of the hand's link that touches; instead of a pad")
    point: Point | None = Field(default=None, description="place on the link, in its frame; its origin when absent")
    normal: Axis | None = Field(
        default=None, description="where the place pushes to, in the frame of the link; to the object when absent"
    )
    radius: Size | None = Field(
        default=None, description="of a round pad about the place, which touches where the object is nearest"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse a pad and a link, neither, and a place without a link."""
        if self.at is None and self.link is None:
            yield Issue("missing key 'at' (name of a pad of the hand) or 'link' (name of a link)", "at", on_key=True)
        if self.at is not None and self.link is not None:
            yield Issue("a contact is at a pad or on a link, not both; leave 'at' or 'link' out", "link", on_key=True)
        elif self.at is not None:
            for name in ("point", "normal", "radius"):
                if getattr(self, name) is not None:
                    yield Issue(f"'{name}' goes with 'link'; a pad has its own", name, on_key=True)
