"""The tables of a problem file that say what grasps what: hand, object, contacts."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Annotated, Any, Literal

from pydantic import Field

from synergrip.errors import InputError, Issue, suggest
from synergrip.fields import (
    NUMBER,
    Mass,
    Name,
    Positive,
    Size,
    Table,
    Text,
    Written,
    array_of,
    listed,
    named,
    number,
    unit_schema,
    with_unit,
)
from synergrip.quantities import ratio
from synergrip.validation import shown

ContactModel = Literal["hard", "soft", "frictionless"]


def _posture(value: object) -> str | dict[str, float]:
    if isinstance(value, dict):
        return named(with_unit("angle"), value)
    if isinstance(value, str) and value:
        return value
    raise InputError.at(
        "", f'expected the name of a posture or a table such as {{ close = "60 deg" }}, got {shown(value)}'
    )


def _synergies(value: object) -> int | str | tuple[str, ...]:
    if isinstance(value, int) and not isinstance(value, bool):
        if value < 1:
            raise InputError.at("", f"expected at least 1 synergy, got {value}")
        return value
    if isinstance(value, str) and value:
        return value
    if isinstance(value, list):
        return listed(_name, value, of="names")
    raise InputError.at("", f"expected a number of synergies, a name or a list of names, got {shown(value)}")


def _name(value: object) -> str:
    if not isinstance(value, str) or not value:
        raise InputError.at("", f"expected a name, got {shown(value)}")
    return value


def _coupling(value: object) -> float | dict[str, float]:
    return named(ratio, value) if isinstance(value, dict) else ratio(value)


def _one_or_list(read: Callable[[Any], float]) -> Callable[[Any], float | tuple[float, ...]]:
    return lambda value: listed(read, value) if isinstance(value, list) else read(value)


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


_COMPLIANCE = unit_schema("joint compliance")
_ANGLES = {"type": "object", "additionalProperties": unit_schema("angle")}
_RATIO = {"anyOf": [NUMBER, {"type": "string", "examples": ["1/3"]}]}
_NAME = {"type": "string", "minLength": 1}

Posture = Annotated[str | dict[str, float], Written(_posture, {"anyOf": [_NAME, _ANGLES]})]
Synergies = Annotated[
    int | str | tuple[str, ...],
    Written(_synergies, {"anyOf": [{"type": "integer", "minimum": 1}, _NAME, array_of(_NAME)]}),
]
Coupling = Annotated[
    float | dict[str, float],
    Written(_coupling, {"anyOf": [*_RATIO["anyOf"], {"type": "object", "additionalProperties": _RATIO}]}),
]
JointCompliances = Annotated[
    float | tuple[float, ...],
    Written(_one_or_list(with_unit("joint compliance", at_least=0)), {"anyOf": [_COMPLIANCE, array_of(_COMPLIANCE)]}),
]
SynergyCompliances = Annotated[
    float | tuple[float, ...],
    Written(_one_or_list(lambda value: number(value, at_least=0)), {"anyOf": [NUMBER, array_of(NUMBER)]}),
]
Stiffness = Annotated[float, Written(_rigid_or("stiffness"), _rigid_schema("stiffness"))]
SpinStiffness = Annotated[float, Written(_rigid_or("spin stiffness"), _rigid_schema("spin stiffness"))]


class GraspTable(Table):
    """A grasp given as matrices."""

    file: Text = Field(description="JSON file with the matrices, relative to this file")


class ComplianceTable(Table):
    """How far joints and synergies yield."""

    joint: JointCompliances | None = Field(
        default=None, description="rotation of a joint per torque, one or one per joint (C_q)"
    )
    synergy: SynergyCompliances | None = Field(
        default=None,
        description="yield of a synergy per actuator effort in SI, one or one per synergy (C_z); 0 when absent",
    )


class HandTable(Table):
    """The hand, its posture and its synergies."""

    model: Text = Field(description="name of a bundled hand, or the folder of one")
    posture: Posture | None = Field(
        default=None, description="name of a posture of the hand, or an angle per posture parameter"
    )
    synergies: Synergies | None = Field(
        default=None, description="how many synergies, a named set, or names; the hand's default set when absent"
    )
    coupling: Coupling | None = Field(
        default=None, description='coupling ratio of the underactuated joints, such as "1/3"'
    )
    compliance: ComplianceTable = Field(
        default_factory=ComplianceTable, description="compliance of joints and synergies"
    )


class SphereTable(Table):
    """A ball."""

    radius: Size = Field(description="radius")


class BoxTable(Table):
    """A box."""

    size: Annotated[
        tuple[float, ...],
        Written(lambda v: listed(with_unit("length", above=0), v, 3, "lengths"), array_of(unit_schema("length"), 3)),
    ] = Field(description="length of the three edges")


class CylinderTable(Table):
    """A cylinder."""

    radius: Size = Field(description="radius")
    height: Size = Field(description="height")


class ShapeTable(Table):
    """Exactly one shape."""

    sphere: SphereTable | None = Field(default=None, description="a ball")
    box: BoxTable | None = Field(default=None, description="a box")
    cylinder: CylinderTable | None = Field(default=None, description="a cylinder")

    def issues(self) -> Iterable[Issue]:
        """Refuse none and more than one."""
        given = [name for name in ("sphere", "box", "cylinder") if getattr(self, name) is not None]
        if not given:
            yield Issue("name one shape: sphere, box or cylinder")
        for name in given[1:]:
            yield Issue(f"an object has one shape; '{given[0]}' is given already", key=name, on_key=True)


class ObjectTable(Table):
    """The grasped object."""

    title: str = Field(default="", description="name of the object, for people")
    shape: ShapeTable | None = Field(default=None, description="exactly one of sphere, box and cylinder")
    mass: Mass | None = Field(default=None, description="mass; needed for gravity")
    position: Annotated[
        tuple[float, ...] | None,
        Written(lambda v: listed(with_unit("length"), v, 3, "lengths"), array_of(unit_schema("length"), 3)),
    ] = Field(default=None, description="centre of the object in the palm frame")


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

    at: tuple[Name, ...] = Field(default=(), description="names of the hand's pads that touch the object")


class ContactEntry(ContactTable):
    """One contact: a pad, and what differs from the defaults."""

    name: Name | None = Field(default=None, description="name of the contact; that of the pad when absent")
    at: Name = Field(description="name of the hand's pad that touches the object")
