"""The types of the keys in problem and hand files: quantities with units, numbers, tables."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    model_validator,
)
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from synergrip.documents.numbers import bounded, number, unit_vector
from synergrip.documents.quantities import EXAMPLES, UNITS, kind_of, quantity, ratio, without_unit
from synergrip.documents.validation import MOST_JUDGED, refusing, shown
from synergrip.errors import InputError, Issue, raise_issues

Schema = dict[str, Any]

LONGEST_NAME = 500  # characters
SCHEMA_VERSION = 1  # of problem and grasp files

NUMBER: Schema = {"type": "number"}
POSITIVE: Schema = {"type": "number", "exclusiveMinimum": 0}


class Table(BaseModel):
    """A table of a file: unknown keys are refused, values cannot be changed."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)  # built for what a file has

    def issues(self) -> Iterable[Issue]:
        """Return what is wrong between the keys of this table; their keys are relative to it."""
        return ()

    @model_validator(mode="after")
    def _judge(self) -> Table:
        found = tuple(islice(self.issues(), MOST_JUDGED))
        if found:
            raise PydanticCustomError("issues", "see issues", {"issues": found})
        return self


@dataclass(frozen=True)
class Written:
    """A type by the function that reads it from the file, and by its JSON Schema."""

    read: Callable[[Any], Any]
    schema: Schema = field(hash=False)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validate with `read`."""
        return core_schema.no_info_plain_validator_function(refusing(self.read))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> Schema:
        """Describe with `schema`."""
        return dict(self.schema)


def listed(
    read: Callable[[Any], Any], value: object, length: int | None = None, of: str = "numbers"
) -> tuple[Any, ...]:
    """Return the entries of a list, each read by `read`, with all their issues at once."""
    if not isinstance(value, list | tuple):
        raise InputError.at("", f"expected a list of {length or 'one or more'} {of}, got {shown(value)}")
    if (len(value) != length) if length is not None else not value:
        raise InputError.at("", f"expected {length or 'one or more'} {of}, got {len(value)}")
    return _each([(f"[{index}]", read, entry) for index, entry in enumerate(value)])


def listed_by(reads: Sequence[Callable[[Any], Any]], value: object, of: str) -> tuple[Any, ...]:
    """Return the entries of a list, each read by its own function, with all their issues at once."""
    entries = listed(lambda entry: entry, value, len(reads), of)
    return _each([(f"[{index}]", *pair) for index, pair in enumerate(zip(reads, entries, strict=True))])


def named(read: Callable[[Any], Any], value: dict[str, Any]) -> dict[str, Any]:
    """Return a table of names, each value read by `read`, with all their issues at once."""
    return dict(zip(value, _each([(key, read, entry) for key, entry in value.items()]), strict=True))


def _each(entries: list[tuple[str, Callable[[Any], Any], Any]]) -> tuple[Any, ...]:
    results, issues = [], list[Issue]()
    for key, read, entry in entries:
        try:
            results.append(read(entry))
        except InputError as error:
            issues += error.under(key).issues
    raise_issues(issues)
    return tuple(results)


def with_unit(kind: str, *, above: float = -math.inf, at_least: float = -math.inf) -> Callable[[Any], float]:
    """Return the function that reads a quantity of `kind` (a key of `UNITS`) in SI units."""
    return lambda value: bounded(quantity(value, kind), shown(value), above=above, at_least=at_least)


class Measured(float):
    """A number in SI units that remembers the kind of quantity it was written as (a key of `UNITS`), and its text.

    Whether a value is an angle or a length depends on the joint that it is for, which its file may not know.
    """

    kind: str
    text: str

    def __new__(cls, value: float, kind: str = "", text: str = "") -> Self:
        """Return `value`, written as `text`, of `kind`."""
        made = super().__new__(cls, value)
        made.kind, made.text = kind, text
        return made


def either(
    turning: str, sliding: str, *, above: float = -math.inf, at_least: float = -math.inf
) -> Callable[[Any], Measured]:
    """Return the function that reads a quantity of the kind `turning`, or of `sliding` as slides have it."""

    def read(value: object) -> Measured:
        kind = kind_of(value, (turning, sliding))
        if kind is None:
            try:
                quantity(value, turning)
            except InputError as error:
                message = f"{error.issues[0].message}; a slide takes a {sliding} such as {without_unit(value, sliding)}"
                raise InputError.at("", message) from None
        found = kind or turning
        return Measured(
            bounded(quantity(value, found), shown(value), above=above, at_least=at_least), found, str(value)
        )

    return read


def unit_schema(*kinds: str) -> Schema:
    """Return the JSON Schema of a quantity of one of the `kinds`."""
    units = "|".join(re.escape(unit).replace("\\ ", " ") for kind in kinds for unit in UNITS[kind])
    pattern = rf"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*({units})\s*$"
    return {"type": "string", "pattern": pattern, "examples": [EXAMPLES[kind] for kind in kinds]}


def _axis(value: object) -> tuple[float, ...]:
    if isinstance(value, str):
        if value not in ("x", "y", "z"):
            raise InputError.at("", f"{value!r} is not 'x', 'y', 'z' or a list of 3 numbers")
        return tuple(float(value == name) for name in "xyz")
    direction: tuple[float, ...] = listed(number, value, 3)
    if not any(direction):
        raise InputError.at("", "an axis needs a direction; all 3 numbers are 0")
    return unit_vector(direction)


def _version(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise InputError.at("", f"expected {SCHEMA_VERSION}, got {shown(value)}")
    if value > SCHEMA_VERSION:
        message = f"written for schema {value}; this synergrip reads schema {SCHEMA_VERSION}: upgrade synergrip"
        raise InputError.at("", message)
    return value


def _plain_name(value: str) -> str:
    """Return a name that can stand in the header of a CSV file."""
    if len(value) > LONGEST_NAME:
        raise InputError.at("", f"a name has at most {LONGEST_NAME} characters, got {len(value):,}")
    if any(mark in ',"\u2028\u2029' or unicodedata.category(mark).startswith("C") for mark in value):
        raise InputError.at("", f"a name may not hold commas, quotes or control characters, got {shown(value)}")
    return value


def array_of(schema: Schema, length: int | None = None) -> Schema:
    """Return the JSON Schema of a list."""
    count = {"minItems": 1} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": schema, **count}


Text = Annotated[str, Field(min_length=1)]
Name = Annotated[
    str,
    Field(min_length=1, json_schema_extra={"pattern": r'^[^,"\x00-\x1f\x7f-\x9f]+$'}),
    AfterValidator(refusing(_plain_name)),
]
Whole = Annotated[int, Field(strict=True)]
Number = Annotated[float, Written(number, NUMBER)]
NotNegative = Annotated[float, Written(lambda value: number(value, at_least=0), {"type": "number", "minimum": 0})]
Positive = Annotated[float, Written(lambda value: number(value, above=0), POSITIVE)]
Version = Annotated[int, Written(_version, {"const": SCHEMA_VERSION})]
Ratio = Annotated[float, Written(ratio, {"anyOf": [NUMBER, {"type": "string", "examples": ["1/3"]}]})]
Vector = Annotated[tuple[float, ...], Written(lambda value: listed(number, value, 3), array_of(NUMBER, 3))]
Axis = Annotated[tuple[float, ...], Written(_axis, {"anyOf": [{"enum": ["x", "y", "z"]}, array_of(NUMBER, 3)]})]

Length = Annotated[float, Written(with_unit("length"), unit_schema("length"))]
Size = Annotated[float, Written(with_unit("length", above=0), unit_schema("length"))]
Angle = Annotated[float, Written(with_unit("angle"), unit_schema("angle"))]
Mass = Annotated[float, Written(with_unit("mass", above=0), unit_schema("mass"))]
Time = Annotated[float, Written(with_unit("time", above=0), unit_schema("time"))]
Force = Annotated[float, Written(with_unit("force", at_least=0), unit_schema("force"))]
JointValue = Annotated[float, Written(either("angle", "length"), unit_schema("angle", "length"))]
JointEffort = Annotated[float, Written(either("torque", "force"), unit_schema("torque", "force"))]
