"""A planning outcome as one JSON document."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from synergrip.conic.certificate import Certificate
from synergrip.conic.decide import Decision
from synergrip.conic.limits.limit import Usage
from synergrip.grasps.grasp import Grasp
from synergrip.plans.between import Between
from synergrip.plans.outcome import Check, Infeasible, Outcome, Plan
from synergrip.plans.repairs import repairs
from synergrip.plans.units import units_of
from synergrip.plans.verified import LIMIT
from synergrip.reports.json_analysis import refusal_document, structure_document


def outcome_document(title: str, grasp: Grasp, outcome: Outcome, notes: Sequence[str] = ()) -> dict[str, Any]:
    """Return the document of a plan, a proof of infeasibility, or an unknown; SI units throughout.

    The notes are those of the problem; a plan's own come before them.
    """
    document: dict[str, Any] = {
        "title": title,
        "verdict": outcome.verdict,
        "exit_code": outcome.exit_code,
        "structure": structure_document(grasp, outcome.analysis),
        "contacts": [c.name for c in grasp.contacts],
        "joints": list(grasp.joints),
        "synergies": list(grasp.synergies),
        "time_s": outcome.task.times.tolist(),
        "programs": [_program(decision) for decision in outcome.decisions],
        "notes": [*(outcome.notes if isinstance(outcome, Plan) else ()), *notes],
    }
    if isinstance(outcome, Plan):
        return document | _plan(outcome)
    if isinstance(outcome, Infeasible):
        return document | _infeasible(outcome)
    certificate = {"kind": "none", "verified": False}
    return document | {"why": outcome.why, "certificate": certificate}


def _plan(plan: Plan) -> dict[str, Any]:
    motion, last = plan.motion, plan.decisions[-1]
    arrays = {
        "dz_r": motion.dz_r, "alpha": plan.alpha, "beta": plan.beta, "gamma": plan.gamma, "lambda": motion.forces,
        "wrench": motion.wrench, "du": motion.du, "dq": motion.dq, "tau": motion.torques, "sigma": motion.efforts,
        "elastic_motion": plan.elastic_motion, "sag": motion.sag,
    }  # fmt: skip
    return {name: array.tolist() for name, array in arrays.items()} | {
        "margin": margin_document(plan.usages[0]),
        "largest_margin_N": plan.largest_margin,
        "force_unit_N": units_of(plan.analysis, plan.task).force,
        "limits": [usage_document(usage) for usage in plan.usages],
        "certificate": certificate_document(last.certificate) | {"solver": last.solution.solver},
        "checks": [check_document(check) for check in plan.checks],
        "between": between_document(plan.between),
    }  # fmt: skip


def _infeasible(outcome: Infeasible) -> dict[str, Any]:
    certificate = certificate_document(outcome.certificate)
    if outcome.decisions:
        certificate["solver"] = outcome.decisions[-1].solution.solver
    document: dict[str, Any] = {
        "stage": outcome.stage, "why": outcome.why, "certificate": certificate, "repairs": repairs(outcome),
        "hints": list(outcome.hints),
    }  # fmt: skip
    if outcome.clashes:
        document["clashes"] = [{"key": c.key, "share": c.share, "items": list(c.items)} for c in outcome.clashes]
    if outcome.largest_margin is not None:
        document["largest_margin_N"] = outcome.largest_margin
    return document | ({"refusal": refusal_document(outcome.refusal)} if outcome.refusal else {})


def check_document(check: Check) -> dict[str, Any]:
    """Return a check with its outcome."""
    return {"name": check.name, "error": check.error, "tolerance": check.tolerance, "passed": check.passed}


def margin_document(margins: Usage) -> dict[str, Any]:
    """Return the worst slip margin, where and when (the first of those that differ by rounding), and all of them."""
    k, i = margins.worst()
    return {
        "worst_N": float(margins.value.min()), "contact": margins.items[i], "time_s": float(margins.times[k]),
        "per_contact_N": margins.value.tolist(),
    }  # fmt: skip


def usage_document(usage: Usage) -> dict[str, Any]:
    """Return the worst value of a limit, where and when, and its bounds there."""
    k, i = usage.worst()
    return {
        "name": usage.title, "unit": usage.unit, "item": usage.items[i], "time_s": float(usage.times[k]),
        "value": float(usage.value[k, i]), "lower": _finite(usage.lower[i]), "upper": _finite(usage.upper[i]),
    }  # fmt: skip


def between_document(between: Between | None) -> dict[str, Any] | None:
    """Return how far load and wanted motion bend between the knots, and the worst value of every limit there."""
    if between is None:
        return None
    return {
        "samples": between.samples, "load_departure_N": between.load_departure,
        "path_departure_m": between.path_departure, "holds": bool(between.excess <= LIMIT),
        "limits": [usage_document(usage) for usage in between.usages],
        "worst_margin_N": float(between.usages[0].value.min()),
    }  # fmt: skip


def certificate_document(certificate: Certificate) -> dict[str, Any]:
    """Return a certificate without its ray."""
    return {
        "kind": certificate.kind, "verified": certificate.verified,
        "primal_residual": _finite(certificate.primal_residual), "dual_residual": _finite(certificate.dual_residual),
        "gap": _finite(certificate.gap),
    }  # fmt: skip


def _program(decision: Decision) -> dict[str, Any]:
    solution = decision.solution
    return {
        "goal": decision.goal, "unknowns": len(decision.program.q), "rows": len(decision.program.b),
        "cones": sum(block.cones for block in decision.program.blocks), "solver": solution.solver,
        "status": solution.status, "iterations": solution.iterations, "seconds": decision.seconds,
        "attempts": decision.attempts, "certificate": certificate_document(decision.certificate),
    }  # fmt: skip


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
