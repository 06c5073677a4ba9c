"""The tables of a problem file that say what grasps: [hand], or [grasp] as matrices."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import Field

from synergrip.documents.fields import (
    NUMBER,
    Table,
    Text,
    Written,
    array_of,
    either,
    listed,
    named,
    unit_schema,
)
from synergrip.documents.numbers import number
from synergrip.documents.overrides import parse_override
from synergrip.documents.quantities import ratio
from synergrip.documents.validation import shown
from synergrip.errors import InputError, one_of
from synergrip.hands.follower_ranges import FollowerRanges
from synergrip.hands.synergies.select import SetChoice
from synergrip.problems.contact_factors import FRICTION_FACTOR, STIFFNESS_FACTOR, Factor, FrictionFactor


def _posture(value: object) -> str | dict[str, float]:
    if isinstance(value, dict):
        return named(either("angle", "length"), value)
    if isinstance(value, str) and value:
        return value
    raise InputError.at(
        "", f'expected the name of a posture or a table such as {{ close = "60 deg" }}, got {shown(value)}'
    )


def posture_written(text: str, key: str) -> str | dict[str, float]:
    """Return the posture of a command line: a name, or values as the inline table that a problem file takes.

    Raises:
        InputError: at `key`, a table that is none, and values without a unit.
    """
    if not text.lstrip().startswith("{"):
        return text
    try:
        value = parse_override(f"posture={text}").value
        if isinstance(value, dict):
            return _posture(value)
    except InputError as error:
        raise error.under(key) from None
    example = "'{ joint = \"60 deg\" }'"
    raise InputError.at(key, f"{shown(text)} is no table; write values as in a problem file: {example}")


def _close(value: object) -> str | dict[str, float]:
    if isinstance(value, dict) and value:
        return named(number, value)
    if isinstance(value, str) and value:
        return value
    raise InputError.at(
        "",
        "expected the name of a synergy or joint, with '-' in front for the opposite direction, or weights by name "
        f"such as {{ s1 = -1, s2 = 0.2 }}, got {shown(value)}",
    )


def _synergies(value: object) -> int | str | tuple[str, ...] | SetChoice:
    if isinstance(value, int) and not isinstance(value, bool):
        if value < 1:
            raise InputError.at("", f"expected at least 1 synergy, got {value}")
        return value
    if isinstance(value, str) and value:
        return value
    if isinstance(value, list):
        return listed(_name, value, of="names")
    if isinstance(value, dict):
        return _set_choice(value)
    raise InputError.at("", f"expected a number of synergies, a name, a file or a list of names, got {shown(value)}")


def _set_choice(value: dict[str, Any]) -> SetChoice:
    for key in value:
        if key not in ("set", "first"):
            raise InputError.at(key, one_of(key, ("set", "first")), on_key=True)
    if not isinstance(value.get("set"), str) or not value["set"]:
        raise InputError.at("", 'expected a table such as { set = "pca.toml", first = 3 }')
    first = value.get("first")
    if first is not None and (isinstance(first, bool) or not isinstance(first, int)):
        raise InputError.at("first", f"expected a whole number, got {shown(first)}")
    return SetChoice(value["set"], first)


def _name(value: object) -> str:
    if not isinstance(value, str) or not value:
        raise InputError.at("", f"expected a name, got {shown(value)}")
    return value


def _coupling(value: object) -> float | dict[str, float]:
    return named(ratio, value) if isinstance(value, dict) else ratio(value)


def _one_or_list(read: Callable[[Any], float]) -> Callable[[Any], float | tuple[float, ...]]:
    return lambda value: listed(read, value) if isinstance(value, list) else read(value)


_COMPLIANCE = unit_schema("joint compliance", "slide compliance")
_VALUES = {"type": "object", "additionalProperties": unit_schema("angle", "length")}
_RATIO = {"anyOf": [NUMBER, {"type": "string", "examples": ["1/3"]}]}
_NAME = {"type": "string", "minLength": 1}
_COUNT = {"type": "integer", "minimum": 1}
_SET_CHOICE = {
    "type": "object",
    "properties": {
        "set": {**_NAME, "description": "a set of the hand, or a synergy file"},
        "first": {**_COUNT, "description": "how many of its synergies; all when absent"},
    },
    "required": ["set"],
    "additionalProperties": False,
}

Posture = Annotated[str | dict[str, float], Written(_posture, {"anyOf": [_NAME, _VALUES]})]
Close = Annotated[
    str | dict[str, float],
    Written(_close, {"anyOf": [_NAME, {"type": "object", "additionalProperties": NUMBER, "minProperties": 1}]}),
]
Synergies = Annotated[
    int | str | tuple[str, ...] | SetChoice,
    Written(_synergies, {"anyOf": [_COUNT, _NAME, array_of(_NAME), _SET_CHOICE]}),
]
Coupling = Annotated[
    float | dict[str, float],
    Written(_coupling, {"anyOf": [*_RATIO["anyOf"], {"type": "object", "additionalProperties": _RATIO}]}),
]
JointCompliances = Annotated[
    float | tuple[float, ...],
    Written(
        _one_or_list(either("joint compliance", "slide compliance", at_least=0)),
        {"anyOf": [_COMPLIANCE, array_of(_COMPLIANCE)]},
    ),
]
SynergyCompliances = Annotated[
    float | tuple[float, ...],
    Written(_one_or_list(lambda value: number(value, at_least=0)), {"anyOf": [NUMBER, array_of(NUMBER)]}),
]


class GraspTable(Table):
    """A grasp given as matrices."""

    file: Text = Field(description="JSON file with the matrices, relative to this file")
    friction_factor: FrictionFactor | None = Field(default=None, description=FRICTION_FACTOR)
    stiffness_factor: Factor | None = Field(default=None, description=STIFFNESS_FACTOR)


class ComplianceTable(Table):
    """How far joints and synergies yield."""

    joint: JointCompliances | None = Field(
        default=None,
        description="rotation of a joint per torque, shift of a slide per force, one or one per joint (C_q)",
    )
    synergy: SynergyCompliances | None = Field(
        default=None,
        description="yield of a synergy per actuator effort in SI, one or one per synergy (C_z); 0 when absent",
    )


class HandTable(Table):
    """The hand, its posture and its synergies."""

    model: Text = Field(description="name of a bundled hand, or the folder of one")
    palm: Text | None = Field(
        default=None,
        description="link of a URDF or MJCF file that is the palm; what it does not carry stands still. The outermost "
        "link when absent",
    )
    posture: Posture | None = Field(
        default=None,
        description="name of a posture of the hand, or an angle per posture parameter, a length for slides",
    )
    close: Close | None = Field(
        default=None,
        description="the synergy, joint or weights along which the hand closes, from its posture, until all pads touch",
    )
    synergies: Synergies | None = Field(
        default=None,
        description="how many synergies, a named set, a synergy file, names, or the first of a set; "
        "the hand's default set when absent",
    )
    coupling: Coupling | None = Field(
        default=None, description='coupling ratio of the underactuated joints, such as "1/3"'
    )
    follower_ranges: FollowerRanges | None = Field(
        default=None,
        description='"ignore": joints that follow others reach as far as their couplings take them, whatever range the '
        'model file states for them; "keep" (default): that range counts',
    )
    compliance: ComplianceTable = Field(
        default_factory=ComplianceTable, description="compliance of joints and synergies"
    )
