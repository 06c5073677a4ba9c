"""The tables of a problem file that say where it touches, and how: [contacts] and [[contact]]."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, create_model

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
from synergrip.errors import InputError, Issue, one_of, suggest
from synergrip.grasps.contact_at import SOFTEST
from synergrip.grasps.contacts.kinds import KINDS, PARAMETERS, described_parameter
from synergrip.grasps.matrices import MOST_CONTACTS
from synergrip.problems.contact_factors import FRICTION_FACTOR, STIFFNESS_FACTOR, Factor, FrictionFactor


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


def _model(value: object) -> str:
    if not isinstance(value, str):
        raise InputError.at("", f"expected a kind of contact, got {shown(value)}")
    if value not in KINDS:
        raise InputError.at("", one_of(value, KINDS))
    return value


Model = Annotated[str, Written(_model, {"enum": list(KINDS), "type": "string"})]
Point = Annotated[
    tuple[float, ...],
    Written(lambda value: listed(with_unit("length"), value, 3, "lengths"), array_of(unit_schema("length"), 3)),
]


def _taking(stiffness: str) -> str:
    """Return the names of the kinds that take an entry of stiffness."""
    return " and ".join(kind.name for kind in KINDS.values() if stiffness in kind.stiffnesses())


class ContactBasics(Table):
    """What can be said of one contact of any kind, or of all as a default."""

    model: Model | None = Field(
        default=None,
        description=", ".join(f"{kind.name} ({len(kind.components)})" for kind in KINDS.values())
        + ": kind of contact (force components); hard when absent",
    )
    stiffness: Stiffness | None = Field(default=None, description='stiffness along the normal, or "rigid"')
    tangential_stiffness: Stiffness | None = Field(
        default=None, description="stiffness across the normal; as along it when absent"
    )
    spin_stiffness: SpinStiffness | None = Field(
        default=None, description=f"stiffness about the normal, for {_taking('spin_stiffness')} contacts"
    )
    tilt_stiffness: SpinStiffness | None = Field(
        default=None, description=f"stiffness about the tangents, for {_taking('tilt_stiffness')} contacts"
    )
    normals: Literal["object", "pad"] | None = Field(
        default=None, description="normal toward the object's centre, or straight out of the pad"
    )


if TYPE_CHECKING:
    ContactTable = ContactBasics
else:  # the parameters are those that the kinds say they have
    ContactTable = create_model(
        "ContactTable",
        __module__=__name__,
        __base__=ContactBasics,
        __doc__="What can be said of one contact, or of all as a default.",
        **{
            each.name: (
                (Size if each.length else Positive) | None,
                Field(default=None, description=described_parameter(each)),
            )
            for each in PARAMETERS.values()
        },
    )


class ContactsTable(ContactTable):
    """Defaults for every contact, and the pads that touch."""

    at: tuple[Name, ...] = Field(
        default=(), max_length=MOST_CONTACTS, description="names of the hand's pads that touch the object"
    )
    friction_factor: FrictionFactor | None = Field(default=None, description=FRICTION_FACTOR)
    stiffness_factor: Factor | None = Field(default=None, description=STIFFNESS_FACTOR)


class ContactEntry(ContactTable):
    """One contact: a pad or a place on a link, and what differs from the defaults."""

    name: Name | None = Field(default=None, description="name of the contact; that of the pad or link when absent")
    at: Name | None = Field(default=None, description="name of the hand's pad that touches the object")
    link: Name | None = Field(default=None, description="name of the hand's link that touches; instead of a pad")
    point: Point | None = Field(default=None, description="place on the link, in its frame; its origin when absent")
    tangent: Axis | None = Field(
        default=None, description="direction in the frame of the link that t of the contact follows; chosen when absent"
    )
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
