"""Margins that were saved, as they are found again beside the plan that they are of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.margin.direct import NUMBERS
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.disturbance.disturbances import Disturbances
from synergrip.margin.found import Margins
from synergrip.margin.measures import MOST_IS_WORST, Measure, Worst
from synergrip.margin.on_request import ON_REQUEST
from synergrip.margin.sensitivity.sensitivity import KINDS, Sensitivities, Sensitivity
from synergrip.margin.timing.fastest_timing import TIMING, FastestTiming
from synergrip.margin.wrench_space.quality import WrenchSpaceQuality
from synergrip.reports.data.beside_plan import found_beside
from synergrip.reports.data.margins_files import FILE
from synergrip.reports.data.saved_disturbances import disturbances_of, quality_of
from synergrip.simulation.told_values import Told


@dataclass(frozen=True, eq=False)
class KnownMargins:
    """What is known of the margins of a plan, without the plan."""

    measures: Mapping[str, Measure]
    linear: Mapping[str, Worst] | None
    """Where they are worst in the linear model of the start posture, on a hand."""
    direct: Mapping[str, DirectNumber] = field(default_factory=dict)
    on_request: Mapping[str, Mapping[str, DirectNumber]] = field(default_factory=dict)
    disturbance: Disturbances | None = None
    quality: WrenchSpaceQuality | None = None
    sensitivities: Sensitivities | None = None
    timing: FastestTiming | None = None
    interrupted: bool = False
    document: Mapping[str, Any] = field(default_factory=dict)
    """As in margins.json."""

    @classmethod
    def of(cls, found: Margins, document: Mapping[str, Any]) -> KnownMargins:
        """Return what is known of margins at hand, with their document."""
        linear = None if found.linear is None else {name: each.worst for name, each in found.linear.items()}
        return cls(
            found.measures, linear, found.direct, found.on_request, found.disturbance, found.quality,
            found.sensitivities, found.timing, found.interrupted, document,
        )  # fmt: skip


def saved_margins(folder: Path, plan: Mapping[str, Any]) -> KnownMargins | str | None:
    """Return the margins of this very plan in a folder, why those that are there are none, or None without any.

    Args:
        folder: where margins.json is looked for.
        plan: document of the plan, as in plan.json, whose digest has been judged.
    """
    return found_beside(folder / FILE, "margins", plan, margins_of)


def margins_of(document: Mapping[str, Any]) -> KnownMargins:
    """Return the margins that `margins_document` told.

    Raises:
        InputError: a value that is none.
    """
    told = Told(document, "")
    times, measures = told.array("time_s", (None,)), told.inside("measures")
    every = {name: measures.inside(name) for name in measures.values}
    linear = {name: _worst(each.inside("linear_worst")) for name, each in every.items() if each.get("linear_worst")}
    there = {name for name in ("direct", "disturbance", "quality", TIMING, *ON_REQUEST) if told.get(name) is not None}
    return KnownMargins(
        {name: _measure(name, each, times) for name, each in every.items()},
        linear if set(linear) == set(every) else None,
        direct=_numbers(told.inside("direct"), NUMBERS) if "direct" in there else {},
        on_request={name: _numbers(told.inside(name)) for name in ON_REQUEST if name in there},
        disturbance=disturbances_of(told.inside("disturbance")) if "disturbance" in there else None,
        quality=quality_of(told.inside("quality")) if "quality" in there else None,
        sensitivities=None if told.get("sensitivities") is None else _sensitivities(told),
        timing=_timing(told.inside(TIMING)) if TIMING in there else None,
        interrupted=told.get("interrupted") is True,
        document=document,
    )


def _measure(name: str, told: Told, times: Array) -> Measure:
    items = tuple(told.texts("items"))
    of = next((each for each in ("contact", "joint", "actuator") if told.get(f"per_{each}") is not None), "contact")
    rows = told.get(f"per_{of}")
    if not (isinstance(rows, list) and len(rows) == len(times) and all(isinstance(row, list) for row in rows)):
        raise told.refused(f"per_{of}", "expected a list for each of time_s")
    flat = [np.inf if value is None else value for row in rows for value in row]
    if len(set(items)) < len(items):
        raise told.refused("items", "expected different names")
    if not items or len(flat) != len(times) * len(items) or not all(isinstance(value, int | float) for value in flat):
        raise told.refused(f"per_{of}", "expected a number for each of the items, or null")
    values = frozen(np.array(flat, dtype=float).reshape(len(times), len(items)))
    return Measure(name, told.text("unit"), told.text("formula"), values, items, times, name == MOST_IS_WORST, of)  # type: ignore[arg-type]


def _worst(told: Told) -> Worst:
    name = next((told.text(each) for each in ("contact", "joint", "actuator") if told.get(each) is not None), "")
    return Worst(np.inf if told.get("value") is None else told.number("value"), name, told.number("time_s"))


def _numbers(told: Told, names: tuple[str, ...] | None = None) -> dict[str, DirectNumber]:
    """Return numbers by name; of a table that has some of `names`, where these are said."""
    for name in told.values:
        if names is not None and name not in names:
            raise told.refused(name, "is no number that margins tell")
    return {name: _number(name, told.inside(name)) for name in told.values}


def _number(name: str, told: Told) -> DirectNumber:
    if told.get("value") is None:
        return DirectNumber.none(name, "", told.text("why"))
    value, lower, upper = told.number("value"), told.perhaps("lower", Told.number), told.perhaps("upper", Told.number)
    moved = None if told.get("displacement") is None else tuple(told.array("displacement", (6,)).tolist())
    return DirectNumber(
        name, told.text("unit"), value, lower, upper, told.get("proven") is True, told.text("why"), told.text("set"),
        displacement=moved,
    )  # fmt: skip


def _sensitivities(told: Told) -> Sensitivities:
    margins, left_out = told.inside("sensitivities_of"), told.inside("sensitivities_left_out")
    rows = told.several("sensitivities") if told.get("sensitivities") else []
    return Sensitivities(
        {kind: margins.perhaps(kind, Told.number) for kind in KINDS}, tuple(_sensitivity(each) for each in rows),
        {name: left_out.text(name) for name in left_out.values}, told.get("interrupted") is True,
    )  # fmt: skip


def _sensitivity(told: Told) -> Sensitivity:
    texts = {name: told.text(name) for name in ("kind", "model", "name", "of", "direction", "per", "why", "unit")}
    left, right = told.perhaps("left", Told.number), told.perhaps("right", Told.number)
    return Sensitivity(
        **texts, at=told.perhaps("at", Told.number), step=1.0, left=left, right=right,
        differentiable=told.get("differentiable") is True,
    )  # fmt: skip


def _timing(told: Told) -> FastestTiming:
    given = 0.0 if told.get("value") is None else told.number("given_s")
    return FastestTiming(
        told.perhaps("value", Told.number), told.perhaps("lower", Told.number), told.perhaps("upper", Told.number),
        told.get("proven") is True,
        told.get("local") is True, given, told.text("why"),
    )  # fmt: skip
