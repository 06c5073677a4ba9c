"""The tables of a problem file that bound the plan, choose among plans, and state the expected answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from synergrip.errors import InputError, Issue
from synergrip.fields import (
    POSITIVE,
    Force,
    Number,
    Positive,
    Schema,
    Table,
    Whole,
    Written,
    array_of,
    bounded,
    listed,
    number,
    unit_schema,
    with_unit,
)
from synergrip.quantities import quantity
from synergrip.validation import shown

_force = with_unit("force", at_least=0)


def _force_range(value: object) -> tuple[float, float]:
    low, high = listed(_force, value, 2, "forces") if isinstance(value, list) else (0.0, _force(value))
    if low > high:
        raise InputError.at("", f"the least force {low:g} N exceeds the largest, {high:g} N")
    if high == 0:
        raise InputError.at("", "the largest normal force must be greater than 0 N")
    return low, high


def _effort(value: object) -> float:
    if isinstance(value, str):
        return bounded(quantity(value, "torque"), shown(value), above=0)
    return number(value, above=0)


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


Efforts = Annotated[
    float | tuple[float, ...] | Literal["hand"],
    Written(_each(_effort, "hand"), _each_schema([POSITIVE, unit_schema("torque")], "hand")),
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
    normal_force: ForceRange | None = Field(
        default=None, description="largest normal force of a contact, or [least, largest]"
    )
    joint_torque: Efforts | None = Field(
        default=None, description='largest torque of a joint in N m, one or one per joint; "hand": as the hand says'
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


class GoalTable(Table):
    """Which of the plans within the limits is chosen; the one of least effort when nothing is said."""

    maximise: Literal["margin"] | None = Field(default=None, description="what is to be as large as possible")
    minimise: Literal["effort", "torque", "peak_force"] | None = Field(
        default=None, description="what is to be as small as possible"
    )

    @property
    def name(self) -> Literal["margin", "effort", "torque", "peak_force"]:
        """The quantity that is maximised or minimised."""
        return self.maximise or self.minimise or "effort"

    def issues(self) -> Iterable[Issue]:
        """Refuse two goals."""
        if self.maximise and self.minimise:
            yield Issue("a plan has one goal: maximise or minimise, not both", key="minimise", on_key=True)


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
