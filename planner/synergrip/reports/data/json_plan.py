"""A planning outcome as one JSON document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from synergrip.conic.certificate import Certificate
from synergrip.conic.decide import Decision
from synergrip.explain.repairs import repairs
from synergrip.grasps.grasp import Grasp
from synergrip.planning.digest import with_digest
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.told import (
    arrays_of,
    between_document,
    check_document,
    finite,
    margin_document,
    structure_document,
    usage_document,
)
from synergrip.reports.data.json_analysis import refusal_document
from synergrip.tasks.scaling import units_of


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
        return with_digest(document | _plan(outcome))
    if isinstance(outcome, Infeasible):
        return document | _infeasible(outcome)
    certificate = {"kind": "none", "verified": False}
    return document | {"why": outcome.why, "certificate": certificate}


def _plan(plan: Plan) -> dict[str, Any]:
    motion, last = plan.motion, plan.decisions[-1]
    arrays = arrays_of(motion, (plan.alpha, plan.beta, plan.gamma), plan.analysis.spaces.Gamma_ucs)
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
    if outcome.conflicts:
        document["conflicts"] = [{"key": c.key, "share": c.share, "items": list(c.items)} for c in outcome.conflicts]
    if outcome.largest_margin is not None:
        document["largest_margin_N"] = outcome.largest_margin
    return document | ({"refusal": refusal_document(outcome.refusal)} if outcome.refusal else {})


def certificate_document(certificate: Certificate) -> dict[str, Any]:
    """Return a certificate without its ray."""
    return {
        "kind": certificate.kind, "verified": certificate.verified,
        "primal_residual": finite(certificate.primal_residual), "dual_residual": finite(certificate.dual_residual),
        "gap": finite(certificate.gap),
    }  # fmt: skip


def _program(decision: Decision) -> dict[str, Any]:
    solution = decision.solution
    return {
        "goal": decision.goal, "unknowns": len(decision.program.q), "rows": len(decision.program.b),
        "cones": sum(block.cones for block in decision.program.blocks), "solver": solution.solver,
        "status": solution.status, "iterations": solution.iterations, "seconds": decision.seconds,
        "attempts": decision.attempts, "certificate": certificate_document(decision.certificate),
    }  # fmt: skip
