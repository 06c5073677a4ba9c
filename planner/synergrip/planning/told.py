"""What is told of a plan, as plain values: the same words for those who write it and for those who check it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from synergrip.conic.allowed import Allowed
from synergrip.conic.limits.limit import Usage
from synergrip.documents.quantities import both_apart
from synergrip.equilibrium.execution import Execution
from synergrip.grasps.grasp import Grasp
from synergrip.planning.between import LIMIT, Between
from synergrip.planning.fresh_samples import FreshSamples
from synergrip.planning.in_case import InCase, worst_case
from synergrip.planning.outcome import Check
from synergrip.statics.analysis import Analysis


def structure_document(grasp: Grasp, analysis: Analysis | None) -> dict[str, Any]:
    """Return the counts and dimensions; the dimensions are null when the object is not restrained."""
    counts: dict[str, Any] = {"n_c": grasp.n_c, "n_l": grasp.n_l, "n_q": grasp.n_q, "n_z": grasp.n_z}
    if analysis is None:
        unknown = ("dim_E_s", "dim_Gamma_ucs", "dim_Gamma_zr", "singular_values", "ambiguous", "free_twists")
        return counts | dict.fromkeys(unknown)
    forces, motions, redundant = analysis.spaces.dimensions
    decisions = analysis.spaces.decisions
    return counts | {
        "dim_E_s": forces, "dim_Gamma_ucs": motions, "dim_Gamma_zr": redundant,
        "singular_values": {name: decision.singular_values.tolist() for name, decision in decisions.items()},
        "ambiguous": analysis.spaces.ambiguous,
        "characteristic_length_m": analysis.response.scale.length,
        "free_twists": analysis.response.free_twists.T.tolist(),
    }  # fmt: skip


def notes_together(own: Sequence[str], of_problem: Sequence[str]) -> list[str]:
    """Return the notes of a plan and of its problem; those that both have are told with their place in the file."""
    told = [each.partition(": ")[2] or each for each in own]
    new = (each for each, text in zip(own, told, strict=True) if not any(note.endswith(text) for note in of_problem))
    return list(dict.fromkeys([*new, *of_problem]))


def check_document(check: Check) -> dict[str, Any]:
    """Return a check with its outcome."""
    return {"name": check.name, "error": finite(check.error), "tolerance": check.tolerance, "passed": check.passed}


def margin_document(margins: Usage) -> dict[str, Any]:
    """Return the worst slip margin, where and when (the first of those that differ by rounding)."""
    k, i = margins.worst()
    return {
        "worst_N": float(margins.value.min()), "contact": margins.items[i], "time_s": float(margins.times[k]),
    }  # fmt: skip


def cases_document(
    cases: Sequence[InCase], allowed: Allowed | None, fresh: FreshSamples | None
) -> dict[str, Any] | None:
    """Return the worst slip margin over all that a task allows for, and that of every case; None without any.

    Args:
        cases: of a plan.
        allowed: of its formulation.
        fresh: samples of a grasp on a hand that it was not made with.
    """
    if not cases or allowed is None:
        return None
    least = worst_case(cases)
    every = [{"case": case.title, "worst_N": case.margin, "by_maps": case.by_maps} for case in cases]
    return margin_document(least.usages[0]) | {
        "case": least.title, "cases": every, "scenarios": _scenarios_document(allowed, fresh),
    }  # fmt: skip


def _scenarios_document(allowed: Allowed, fresh: FreshSamples | None) -> dict[str, Any] | None:
    """Return how many samples hold, and what follows for others; None where none were asked for."""
    asked = allowed.scenarios
    if asked is None:
        return None
    promised = {"seed": asked.seed, "share": asked.share, "confidence": asked.confidence}
    if fresh is None:
        return {"count": len(allowed.samples), **promised}
    return {
        "count": fresh.count, **promised, "missing": fresh.missing, "may_miss": fresh.allowed,
        "share_at_most": fresh.share, "looks": fresh.looks, "instants": fresh.instants, "made_with": fresh.made_with,
        "at": "true equilibrium",
    }  # fmt: skip


def usage_document(usage: Usage) -> dict[str, Any]:
    """Return the worst value of a limit, where and when, and its bounds there."""
    k, i = usage.worst()
    return {
        "name": usage.title, "unit": usage.unit, "item": usage.items[i], "time_s": float(usage.times[k]),
        "value": float(usage.value[k, i]), "lower": finite(usage.lower[i]), "upper": finite(usage.upper[i]),
    }  # fmt: skip


def nearest(usage: Usage) -> tuple[str, str]:
    """Return the worst value of a limit and the bound that it is nearest to or beyond, as people read them."""
    k, i = usage.worst()
    value, lower, upper = float(usage.value[k, i]), float(usage.lower[i]), float(usage.upper[i])
    bound = lower if lower - value >= value - upper else upper
    return both_apart(value, bound, usage.unit)


def series_document(usage: Usage) -> dict[str, Any]:
    """Return the worst value of a limit and all of them: at the knots, of its items, with the bounds of each.

    And the sizes that an excess is judged by, so that whoever reads them finds the same worst value, and the same on
    its bound.
    """
    ends = {"lower": usage.lower, "upper": usage.upper}
    bounds = {end: [finite(value) for value in values] for end, values in ends.items()}
    sizes = {"scale": usage.scale, "allowance": usage.allowance}
    series = {"items": list(usage.items), "values": usage.value, **bounds, **sizes}
    return usage_document(usage) | {"series": series}


def true_document(execution: Execution, margins: Usage, fixed: Execution | None = None) -> dict[str, Any]:
    """Return the true states at the knots, of references executed on the hand that moves.

    Args:
        execution: of the references.
        margins: that it keeps.
        fixed: the execution of the same with contacts that stay where they are, where they roll in the first.
    """
    radii = [touch.pad.radius or 0.0 for touch in execution.setting.held.touches]
    balance = execution.balance
    other = None if fixed is None else finite(float(fixed.margins.min()) if fixed.whole else math.inf)
    return {
        "pad_radius_m": radii, "rolls": list(execution.setting.rolls), "worst_N_if_fixed": other,
        "contact_model": execution.setting.contact_model,
        "margin": margin_document(margins) | {"per_contact_N": execution.margins},
        "lambda": execution.states.forces, "du": execution.du, "q": execution.states.q,
        "place_m": balance.meeting.place, "normal": balance.frames[..., 0], "force_N": balance.acting[:, :, 0],
        "smallest_stiffness_N_m": execution.stiffness,
    }  # fmt: skip


def between_document(between: Between | None) -> dict[str, Any] | None:
    """Return what was looked at between the knots, how far load and wish bend there, and the worst of every limit."""
    if between is None:
        return None
    return {
        "samples": between.samples, "instants": len(between.usages[0].times),
        "corners_s": list(between.corners), "exact": between.exact,
        "load_departure_N": between.load_departure, "path_departure_m": between.path_departure,
        "holds": bool(between.excess <= LIMIT), "limits": [usage_document(usage) for usage in between.usages],
        "worst_margin_N": float(between.usages[0].value.min()),
    }  # fmt: skip


def finite(value: float) -> float | None:
    """Return a number, or None for what JSON has no word for."""
    return float(value) if math.isfinite(value) else None
