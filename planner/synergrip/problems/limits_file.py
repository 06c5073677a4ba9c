"""The tables of a problem file that bound the plan, choose among plans, and state the expected answer."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import ConfigDict, Field, create_model

from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.registry import LIMITS
from synergrip.documents.fields import POSITIVE, Number, Positive, Table, Whole, Written, named
from synergrip.documents.numbers import number
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, one_of, repeated


def _field(key: FileKey) -> tuple[Any, Any]:
    """Return type and description of a key under [limits]."""
    if key.default is None:
        return key.type | None, Field(default=None, description=key.description)
    return key.type, Field(default=key.default, validate_default=True, description=key.description)


if TYPE_CHECKING:

    class LimitsTable(Table):
        """A key for each limit of the registry."""

        def __getattr__(self, name: str) -> Any:
            """Return the value of a key."""

    Ordered: TypeAlias = str
    Largest: TypeAlias = str
else:
    LimitsTable = create_model(
        "LimitsTable",
        __module__=__name__,
        __base__=Table,
        __doc__="What every instant of the plan must keep.",
        **{key.name: _field(key) for key in LIMITS},
    )
    Ordered = Literal[tuple(GOALS)]
    Largest = Literal[tuple(name for name, goal in GOALS.items() if goal.maximises)]

SQUARES: tuple[str, ...] = tuple(name for name, goal in GOALS.items() if not goal.has_scalar)
"""Goals that are sums of squares, and so can be weighted."""
SMALL = (*SQUARES, *(name for name, goal in GOALS.items() if goal.has_scalar and not goal.maximises))
"""Goals that are to be small."""


def _minimised(value: object) -> str | dict[str, float]:
    if isinstance(value, str):
        if value not in SMALL:
            raise InputError.at("", one_of(value, SMALL))
        return value
    if isinstance(value, dict) and value:
        for name in value:
            if name not in SQUARES:
                raise InputError.at(name, f"{one_of(name, SQUARES)}; only sums of squares have weights", on_key=True)
        return named(lambda each: number(each, above=0), value)
    raise InputError.at("", f"expected a goal or weights such as {{ effort = 1, travel = 0.1 }}, got {shown(value)}")


_WEIGHTS = {"type": "object", "propertyNames": {"enum": list(SQUARES)}, "additionalProperties": POSITIVE}
Minimised = Annotated[str | dict[str, float], Written(_minimised, {"anyOf": [{"enum": list(SMALL)}, _WEIGHTS]})]


class GoalTable(Table):
    """Which of the plans within the limits is chosen; the one of least effort when nothing is said."""

    maximise: Largest | None = Field(default=None, description="what is to be as large as possible")
    minimise: Minimised | None = Field(
        default=None, description="what is to be as small as possible: a goal, or a weight for each of several"
    )
    order: tuple[Ordered, ...] | None = Field(
        default=None,
        min_length=1,
        description="several goals, the first one first: each chooses among the plans that are best by those before",
    )
    tie_break: bool = Field(
        default=True, description="whether what the goals leave open is settled by least effort and reconfiguration"
    )

    @property
    def names(self) -> tuple[str, ...]:
        """The goals in their order, or those of a weighted sum; what is not stated is for the planner."""
        if self.order:
            return self.order
        return tuple(self.weights) or (self.maximise or str(self.minimise or "effort"),)

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The goals in their order."""
        if self.weights:
            return (WeightedSum(tuple((GOALS[name], weight) for name, weight in self.weights.items())),)
        return tuple(GOALS[name] for name in self.names)

    @property
    def weights(self) -> Mapping[str, float]:
        """The weights of a sum of goals; empty for a single goal."""
        return self.minimise if isinstance(self.minimise, dict) else {}

    def key_of(self, name: str) -> str:
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
        elif settled and GOALS[name].watches == "forces":
            yield Issue(f"'{settled}' before it leaves no force open; put '{name}' first", key=f"order[{index}]")
        settled = settled or (name if GOALS[name].settles_forces else "")


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
