"""Margins as one JSON document."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from synergrip.changes.asked import STATED
from synergrip.documents.source import Source
from synergrip.margin.direct import NUMBERS
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.margins import BESIDE
from synergrip.margin.measures import Measure
from synergrip.margin.sensitivity.sensitivity import HAND, START
from synergrip.planning.arrays import names_of
from synergrip.planning.digest import stated_digest, with_digest
from synergrip.planning.provenance import KEY as PROVENANCE
from synergrip.planning.provenance import provenance_document
from synergrip.planning.told import cases_document, finite, margin_document, notes_together, structure_document
from synergrip.reports.data.json_disturbances import disturbance_document, quality_document
from synergrip.reports.data.json_plan import outcome_document, plain
from synergrip.reports.data.json_sensitivities import sensitivities_document
from synergrip.reports.data.json_timing import timing_document


def margins_document(
    title: str, found: Margins, notes: Sequence[str] = (), source: Source | None = None, plan_digest: str | None = None
) -> dict[str, Any]:
    """Return the document of margins; SI units, angles to the cone in degrees, with its digest and that of its plan.

    Args:
        title: of the problem.
        found: its margins.
        notes: of the problem.
        source: its text, for provenance.
        plan_digest: that of the saved plan that the margins are of; else that which the plan has when it is saved.
    """
    plan = found.plan
    linear = found.linear or {}
    document = plain({
        "title": title,
        "verdict": plan.verdict,
        "exit_code": plan.exit_code,
        "plan_sha256": plan_digest or _digest_of(title, found, notes),
        PROVENANCE: provenance_document(plan, source),
        "covers": _covers(found),
        "structure": structure_document(plan.grasp, plan.analysis),
        **names_of(plan.grasp),
        "time_s": plan.time.tolist(),
        "margin": margin_document(plan.usages[0]),
        "measures": {name: _measure(each, linear.get(name)) for name, each in found.measures.items()},
        "allowances": cases_document(plan.cases, plan.formulation.allowed, plan.fresh),
        "direct": {name: _number(each) for name, each in found.direct.items()},
        **{name: {of: _number(each) for of, each in several.items()} for name, several in found.on_request.items()},
        "disturbance": None if found.disturbance is None else disturbance_document(found.disturbance),
        "quality": None if found.quality is None else quality_document(found.quality),
        **sensitivities_document(found.sensitivities),
        **({} if found.timing is None else {found.timing.name: timing_document(found.timing)}),
        "interrupted": found.interrupted,
        "notes": notes_together(plan.notes, notes),
    })  # fmt: skip
    return with_digest(document)


def _digest_of(title: str, found: Margins, notes: Sequence[str]) -> str | None:
    """Return the digest of the plan as it is saved: without the note of its margins."""
    plan = replace(found.plan, notes=tuple(note for note in found.plan.notes if note != STATED))
    return stated_digest(outcome_document(title, plan.grasp, plan, notes))


def _covers(found: Margins) -> dict[str, Any]:
    """Return which figures there are, which were not asked for or not found in time, and in which model they are."""
    there = {
        "disturbance": found.disturbance, "quality": found.quality, "sensitivities": found.sensitivities,
        "fastest_timing_s": found.timing,
    }  # fmt: skip
    names = [*found.direct, *found.on_request, *(name for name, each in there.items() if each is not None)]
    return {
        "found": names, "left": [name for name in (*NUMBERS, *BESIDE) if name not in names],
        "model": START if found.plan.executed is None else HAND, "knots": len(found.plan.time),
    }  # fmt: skip


def _measure(measure: Measure, linear: Measure | None) -> dict[str, Any]:
    return {
        "unit": measure.unit, "formula": measure.formula, "worst": _worst(measure),
        "linear_worst": None if linear is None else _worst(linear),
        "items": list(measure.items),
        f"per_{measure.of}": [[finite(value) for value in row] for row in measure.value.tolist()],
    }  # fmt: skip


def _worst(measure: Measure) -> dict[str, Any]:
    worst = measure.worst
    return {"value": finite(worst.value), measure.of: worst.name, "time_s": worst.time_s}


def _number(number: DirectNumber) -> dict[str, Any]:
    if number.value is None:
        return {"value": None, "why": number.why}
    moved = {} if number.displacement is None else {"displacement": list(number.displacement)}
    return {
        "value": number.value, "lower": number.lower, "upper": number.upper, "proven": number.proven,
        "unit": number.unit, "why": number.why, "set": number.setting, **moved,
    }  # fmt: skip
