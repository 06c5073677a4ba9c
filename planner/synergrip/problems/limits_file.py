"""The tables of a problem file that bound the plan, choose among plans, and state the expected answer."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal, cast

from pydantic import ConfigDict, Field

from synergrip.documents.fields import (
    POSITIVE,
    Force,
    Number,
    Positive,
    Schema,
    Size,
    Table,
    Whole,
    Written,
    array_of,
    either,
    listed,
    named,
    number,
    unit_schema,
    with_unit,
)
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, one_of, repeated
from synergrip.tasks.timed_task import EFFORTS, FORCE_GOALS, GoalName

_force = with_unit("force", at_least=0)
_written_effort = either("torque", "force", above=0)


def _force_range(value: object) -> tuple[float, float]:
    low, high = listed(_force, value, 2, "forces") if isinstance(value, list) else (0.0, _force(value))
    if low > high:
        raise InputError.at("", f"the least force {low:g} N exceeds the largest, {high:g} N")
    if high == 0:
        raise InputError.at("", "the largest normal force must be greater than 0 N")
    return low, high


def _effort(value: object) -> float:
    return _written_effort(value) if isinstance(value, str) else number(value, above=0)


def _positive(value: object) -> float:
    return number(value, above=0)


def _each(read: Callable[[Any], float], word: str = "") -> Callable[[Any], Any]:
    """Return the function that reads one bound for all, a list of them, or the `word`."""

    def bounds(value: object) -> float | str | tuple[float, ...]:
        if isinstance(value, list):
            return listed(read, value)
        if word and value == word:
            return word
        if word and isinstance(value, str) and value.strip().isalpha():
            raise InputError.at(
                "", f"expected '{word}', a number, a torque such as \"1.5 N m\" or a list, got {value!r}"
            )
        return read(value)

    return bounds


def _each_schema(one: list[Schema], word: str = "") -> Schema:
    words: list[Schema] = [{"const": word}] if word else []
    return {"anyOf": [*words, *one, array_of({"anyOf": one})]}


ReserveAngle = Annotated[float, Written(with_unit("angle", above=0), unit_schema("angle"))]
SafetyFactor = Annotated[float, Written(lambda value: number(value, at_least=1), {"type": "number", "minimum": 1})]
Efforts = Annotated[
    float | tuple[float, ...] | Literal["hand"],
    Written(_each(_effort, "hand"), _each_schema([POSITIVE, unit_schema("torque", "force")], "hand")),
]
References = Annotated[float | tuple[float, ...], Written(_each(_positive), _each_schema([POSITIVE]))]
ForceRange = Annotated[
    tuple[float, float],
    Written(_force_range, {"anyOf": [unit_schema("force"), array_of(unit_schema("force"), 2)]}),
]


class LimitsTable(Table):
    """What every instant of the plan must keep."""

    margin: Force = Field(
        default="0 N", validate_default=True, description="distance of every contact force to its friction cone"
    )
    margin_angle: ReserveAngle | None = Field(
        default=None, description="angle that every contact force keeps to its friction cone"
    )
    safety_factor: SafetyFactor | None = Field(
        default=None, description="factor by which friction may be smaller than stated before a contact slips"
    )
    normal_force: ForceRange | None = Field(
        default=None, description="largest normal force of a contact, or [least, largest]"
    )
    joint_torque: Efforts | None = Field(
        default=None,
        description="largest torque of a joint in N m, force of a slide in N, one or one per joint; "
        '"hand": as the hand says',
    )
    actuator_effort: Efforts | None = Field(
        default=None, description='largest effort of a synergy, one or one per synergy; "hand": as the hand says'
    )
    synergy_reference: References | None = Field(
        default=None, description="largest change of a synergy reference, one or one per synergy"
    )
    synergy_rate: References | None = Field(
        default=None, description="largest change of a synergy reference per second, one or one per synergy"
    )
    synergy_acceleration: References | None = Field(
        default=None, description="largest acceleration of a synergy reference, per s^2, one or one per synergy"
    )
    joint_range: Literal["hand"] | None = Field(
        default=None, description='"hand": every joint stays within the range that the hand states'
    )
    elastic_motion: Size | None = Field(
        default=None, description="how far the grip may push the object beyond its rigid motion, sag excluded"
    )
    drift: Size | None = Field(
        default=None, description="how far the object may be from where it is wanted, sag under load included"
    )


SQUARES = ("effort", "torque", "actuator", "steady", "references", "travel", "smooth", "centred")
"""Goals that are sums of squares, and so can be weighted."""
SMALL = (*SQUARES, "peak_force")
Ordered = Literal[
    "margin", "peak_force", "effort", "torque", "actuator", "steady", "references", "travel", "smooth", "centred"
]


def _minimised(value: object) -> str | dict[str, float]:
    if isinstance(value, str):
        if value not in SMALL:
            raise InputError.at("", one_of(value, SMALL))
        return value
    if isinstance(value, dict) and value:
        for name in value:
            if name not in SQUARES:
                raise InputError.at(name, f"{one_of(name, SQUARES)}; only sums of squares have weights", on_key=True)
        return named(_positive, value)
    raise InputError.at("", f"expected a goal or weights such as {{ effort = 1, travel = 0.1 }}, got {shown(value)}")


_WEIGHTS = {"type": "object", "propertyNames": {"enum": list(SQUARES)}, "additionalProperties": POSITIVE}
Minimised = Annotated[str | dict[GoalName, float], Written(_minimised, {"anyOf": [{"enum": list(SMALL)}, _WEIGHTS]})]


class GoalTable(Table):
    """Which of the plans within the limits is chosen; the one of least effort when nothing is said."""

    maximise: Literal["margin"] | None = Field(default=None, description="what is to be as large as possible")
    minimise: Minimised | None = Field(
        default=None, description="what is to be as small as possible: a goal, or a weight for each of several"
    )
    order: tuple[Ordered, ...] | None = Field(
        default=None,
        min_length=1,
        description="several goals, the first one first: each chooses among the plans that are best by those before",
    )

    @property
    def names(self) -> tuple[GoalName, ...]:
        """The goals in their order; those that are not stated are for the planner."""
        if self.order:
            return self.order
        return (self.maximise or ("weighted" if self.weights else cast(GoalName, self.minimise or "effort")),)

    @property
    def weights(self) -> Mapping[GoalName, float]:
        """The weights of a sum of goals; empty for a single goal."""
        return self.minimise if isinstance(self.minimise, dict) else {}

    def key_of(self, name: GoalName) -> str:
        """Return the key under which a goal is stated."""
        if self.order:
            return f"order[{self.order.index(name)}]"
        return f"minimise.{name}" if name in self.weights else "maximise" if self.maximise else "minimise"

    def issues(self) -> Iterable[Issue]:
        """Refuse two ways of stating goals, a goal twice, and goals of force when no force is open any more."""
        given = [name for name in ("maximise", "minimise", "order") if getattr(self, name)]
        for name in given[1:]:
            yield Issue(self._choice(given[0], name), key=name, on_key=True)
        yield from _order_issues(self.order or ())

    def _choice(self, first: str, second: str) -> str:
        """Return what to drop of two ways in which the goal is given, and how to have both."""
        kept = {
            "maximise": 'maximise = "margin"',
            "minimise": f"the weights of {', '.join(self.weights)}"
            if self.weights
            else f'minimise = "{self.minimise}"',
            "order": f"order = {_toml(self.order or ())}",
        }
        single = [self.minimise] if isinstance(self.minimise, str) else []
        joined = list(dict.fromkeys([*([self.maximise] if self.maximise else []), *(self.order or ()), *single]))
        both = "several goals are written as order = [...]"
        if not self.weights and not any(_order_issues(joined)):
            both = f"for all of them write only order = {_toml(joined)}"
        return (
            f"the goal is given already by '{first}': drop '{second}' to keep {kept[first]}, or '{first}' to keep "
            f"{kept[second]}; {both} (--set goal={{...}} replaces the whole table)"
        )


def _order_issues(order: Sequence[str]) -> Iterator[Issue]:
    """Yield what is wrong with goals in order."""
    settled, twice = "", set(repeated(order))
    for index, name in enumerate(order):
        if index in twice:
            yield Issue(f"'{name}' is listed twice", key=f"order[{index}]")
        elif settled and name in FORCE_GOALS:
            yield Issue(f"'{settled}' before it leaves no force open; put '{name}' first", key=f"order[{index}]")
        settled = settled or (name if name in EFFORTS else "")


def _toml(names: Sequence[str]) -> str:
    return json.dumps(list(names))


class OutputTable(Table):
    """What is written besides the answer on the screen."""

    write: tuple[Literal["json", "csv", "npz"], ...] = Field(default=(), description="formats of the written plan")


class ExpectTable(Table):
    """The expected answer, for problems that test the planner; further keys are allowed."""

    model_config = ConfigDict(extra="allow")

    verdict: Literal["feasible", "infeasible", "unknown"] | None = Field(default=None, description="expected verdict")
    stage: Literal["data", "restraint", "count", "direction", "magnitude"] | None = Field(
        default=None, description="expected stage of the refusal"
    )
    dims: Annotated[tuple[Whole, ...], Field(min_length=3, max_length=3)] | None = Field(
        default=None, description="expected dimensions of E_s, Gamma_ucs and Gamma_zr"
    )
    dim_E_s: Whole | None = Field(default=None, description="expected dimension of E_s")
    dim_Gamma_ucs: Whole | None = Field(default=None, description="expected dimension of Gamma_ucs")
    dim_Gamma_zr: Whole | None = Field(default=None, description="expected dimension of Gamma_zr")
    margin_worst_N: Number | None = Field(default=None, description="expected worst margin in N")
    peak_normal_N: Number | None = Field(default=None, description="expected largest normal force in N")
    tolerance: Positive | None = Field(default=None, description="relative tolerance of the expected numbers")
