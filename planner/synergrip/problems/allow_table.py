"""The [allow] table of a problem file: values for all of which the plan is to hold."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import Field

from synergrip.documents.fields import (
    NUMBER,
    Schema,
    Table,
    Whole,
    Written,
    array_of,
    listed,
    listed_by,
    named,
    unit_schema,
    with_unit,
)
from synergrip.documents.numbers import number, number_or
from synergrip.documents.quantities import quantity
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue
from synergrip.tasks.allowances import Allowances, Interval
from synergrip.tasks.scenarios import LARGEST_SEED, Scenarios

COMPONENTS = (*[number_or("force")] * 3, *[number_or("torque")] * 3)
COMPONENT: Schema = {"anyOf": [NUMBER, unit_schema("force", "torque")]}
ALONG = '"0.5 N along x", "0.5 N along -z"'


def _ordered(values: tuple[float, ...]) -> Interval:
    low, high = values
    if low > high:
        raise InputError.at("", f"the least value {low:g} exceeds the largest, {high:g}; swap them")
    return low, high


def _friction(value: object) -> Interval | dict[str, Interval]:
    if isinstance(value, dict):
        return named(_coefficients, value)
    return _coefficients(value)


def _coefficients(value: object) -> Interval:
    return _ordered(listed(lambda each: number(each, above=0), value, 2, "coefficients, the least and the largest"))


def _masses(value: object) -> Interval:
    return _ordered(listed(with_unit("mass", above=0), value, 2, "masses, the least and the largest"))


def _share(value: object) -> float:
    share = number(value, at_least=0)
    if share >= 1:
        raise InputError.at("", f"expected a share of at least 0 and less than 1, got {shown(value)}")
    return share


def _load(value: object) -> tuple[float, ...]:
    if isinstance(value, list | tuple):
        return listed_by(COMPONENTS, value, "numbers (N, N m)")
    size, _, axis = value.partition(" along ") if isinstance(value, str) else ("", "", "")
    sign, axis = (-1.0, axis.strip()[1:]) if axis.strip().startswith("-") else (1.0, axis.strip())
    if axis not in ("x", "y", "z"):
        raise InputError.at("", f"expected 6 numbers (N, N m), or a force such as {ALONG}; got {shown(value)}")
    force = sign * quantity(size, "force")
    return (*(force * (axis == name) for name in "xyz"), 0.0, 0.0, 0.0)


def _box(value: object) -> tuple[float, ...]:
    sizes: tuple[float, ...] = listed_by(COMPONENTS, value, "numbers (N, N m)")
    if min(sizes) < 0:
        raise InputError.at("", f"expected sizes of at least 0, got {min(sizes):g}")
    return sizes


def _gap(value: object) -> float | dict[str, float]:
    read = with_unit("length", at_least=0)
    return named(read, value) if isinstance(value, dict) else read(value)


def _or_by_name(schema: Schema) -> Schema:
    return {"anyOf": [schema, {"type": "object", "additionalProperties": schema}]}


def _part(value: object) -> float:
    found = number(value, above=0)
    if found >= 1:
        raise InputError.at("", f"expected a share greater than 0 and less than 1, got {shown(value)}")
    return found


Share = Annotated[float, Written(_share, {"type": "number", "minimum": 0, "exclusiveMaximum": 1})]
Part = Annotated[float, Written(_part, {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1})]
Tilt = Annotated[float, Written(with_unit("angle", at_least=0), unit_schema("angle"))]
Distance = Annotated[float, Written(with_unit("length", at_least=0), unit_schema("length"))]


class ScenariosTable(Table):
    """Random errors of a grasp, of which the plan is to hold for a stated share."""

    position: Distance = Field(default=0.0, description="largest distance of a contact from where it is stated")
    normal: Tilt = Field(default=0.0, description="largest tilt of the normal of a contact")
    compliance: Share = Field(default=0.0, description="share by which compliances may each be less or more")
    share: Part = Field(default=0.05, description="share of all scenarios that may miss a limit")
    confidence: Part = Field(default=0.999, description="confidence that no larger share does")
    seed: Annotated[Whole, Field(ge=0, lt=LARGEST_SEED)] = Field(default=0, description="of the random samples")

    def issues(self) -> tuple[Issue, ...]:
        """Refuse a table in which nothing is random, and a normal that may point anywhere."""
        if not (self.position or self.normal or self.compliance):
            return (Issue("nothing is random; give position, normal or compliance"),)
        return (Issue("expected less than a right angle", key="normal"),) if self.normal >= math.pi / 2 else ()

    def value(self) -> Scenarios:
        """Return the scenarios."""
        return Scenarios(
            position=self.position, normal=self.normal, compliance=self.compliance, share=self.share,
            confidence=self.confidence, seed=self.seed,
        )  # fmt: skip


class AllowTable(Table):
    """Values for all of which the plan is to hold, those that the problem states among them."""

    friction: Annotated[
        Interval | dict[str, Interval] | None,
        Written(_friction, _or_by_name(array_of({"type": "number", "exclusiveMinimum": 0}, 2))),
    ] = Field(default=None, description="[least, largest] coefficient of friction, of all contacts or of those named")
    friction_share: Share = Field(
        default=0.0, description="share by which all friction may be less or more, spin friction too"
    )
    mass: Annotated[Interval | None, Written(_masses, array_of(unit_schema("mass"), 2))] = Field(
        default=None, description="[least, largest] mass of the object; gravity and inertia go with it"
    )
    load: Annotated[
        tuple[tuple[float, ...], ...],
        Written(
            lambda value: listed(_load, value, of="loads"),
            array_of({"anyOf": [{"type": "string"}, array_of(COMPONENT, 6)]}),
        ),
    ] = Field(
        default=(),
        description='loads that may act as well: 6 numbers about B, or "0.5 N along x"; each of them or none',
    )
    load_box: Annotated[tuple[float, ...], Written(_box, array_of(COMPONENT, 6))] = Field(
        default=(0.0,) * 6, description="how large each component of a further load may be, either way: 6 numbers"
    )
    contact_gap: Annotated[Any, Written(_gap, _or_by_name(unit_schema("length")))] = Field(
        default=0.0, description="how far contacts may be off along their normals, either way: all, or those named"
    )
    scenarios: ScenariosTable | None = Field(
        default=None, description="random errors of the grasp, of which the plan is to hold for a stated share"
    )

    def issues(self) -> tuple[Issue, ...]:
        """Refuse a table that allows for nothing."""
        return () if self.model_fields_set else (Issue("nothing is allowed for; leave the table out"),)

    def value(self) -> Allowances:
        """Return what is allowed for."""
        return Allowances(
            friction=self.friction, friction_share=self.friction_share, mass=self.mass, load=self.load,
            load_box=self.load_box, contact_gap=self.contact_gap,
            scenarios=None if self.scenarios is None else self.scenarios.value(),
        )  # fmt: skip
