"""A planning outcome as one JSON document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from synergrip.conic.certificate import Certificate
from synergrip.conic.decide import Decision
from synergrip.documents.source import Source
from synergrip.equilibrium.execution import Execution
from synergrip.grasps.grasp import Grasp
from synergrip.planning.arrays import ARRAYS, measures_of, names_of
from synergrip.planning.digest import with_digest
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.provenance import KEY as PROVENANCE
from synergrip.planning.provenance import provenance_document
from synergrip.planning.told import (
    between_document,
    cases_document,
    check_document,
    finite,
    margin_document,
    notes_together,
    series_document,
    structure_document,
    true_document,
)
from synergrip.problems.in_short import asked_in_short
from synergrip.reports.data.execution import KEY as EXECUTION
from synergrip.reports.data.execution import execution_document
from synergrip.reports.data.json_analysis import refusal_document
from synergrip.reports.data.json_control import KEY as CONTROL
from synergrip.reports.data.json_control import control_document
from synergrip.tasks.scaling import units_of

if TYPE_CHECKING:
    from synergrip.explain.explanation import Explanation


def outcome_document(
    title: str,
    grasp: Grasp,
    outcome: Outcome,
    notes: Sequence[str] = (),
    source: Source | None = None,
    known: Explanation | None = None,
) -> dict[str, Any]:
    """Return the document of a plan, a proof of infeasibility, or an unknown; SI units throughout.

    The notes are those of the problem; a plan's own come before them. The source is its text, for provenance.
    Of a no, what is known of it is its short form when that is None.
    """
    document: dict[str, Any] = {
        "title": title,
        "verdict": outcome.verdict,
        "exit_code": outcome.exit_code,
        "structure": structure_document(grasp, outcome.analysis),
        **names_of(grasp),
        "asked": [*asked_in_short(outcome.task)],
        "time_s": outcome.task.times.tolist(),
        PROVENANCE: provenance_document(outcome, source),
        "programs": [_program(decision) for decision in outcome.decisions],
        "notes": notes_together(outcome.notes, notes),
    }
    if outcome.analysis is not None:
        document[CONTROL] = control_document(outcome.analysis)
    if (execution := execution_document(outcome)) is not None:
        document[EXECUTION] = execution
    if isinstance(outcome, Plan):
        return with_digest(plain(document | _plan(outcome)))
    from synergrip.reports.data.json_no import no_document  # of plans nothing of this is needed, nor loaded

    known = known or outcome.explanation
    document["exit_code"] = known.exit_code(outcome.exit_code)
    if known.interrupted:
        from synergrip.explain.words import INTERRUPTED

        document["notes"] = [*document["notes"], INTERRUPTED]
    if isinstance(outcome, Infeasible):
        return with_digest(plain(document | _infeasible(outcome) | no_document(known, outcome.task.times)))
    certificate, reached = {"kind": "none", "verified": False}, outcome.reached
    told = None if reached is None else {
        "until_s": reached.until_s, "nearest_pose": reached.pose.tolist(), "because": reached.because,
        "off_m": reached.off_m,
    }  # fmt: skip
    document |= {"stage": outcome.stage, "certificate": certificate, "reached": told}
    document |= no_document(known, outcome.task.times)
    if outcome.executed is not None:
        document |= _true(outcome, outcome.executed)
    return with_digest(plain(document))


def _plan(plan: Plan) -> dict[str, Any]:
    last = plan.decisions[-1]
    document: dict[str, Any] = {"margin": margin_document(plan.usages[0]), **measures_of(plan.grasp)}
    for each in ARRAYS:
        place = document.setdefault(each.key, {}) if each.inside else document
        place[each.inside or each.key] = each.of(plan.moved)
    if plan.executed is not None:
        first = None if plan.first_passes is None else vars(plan.first_passes)
        document["true"] = true_document(plan.executed, plan.usages[0], plan.fixed) | {
            "programs": len(plan.decisions), "iterations": plan.executed.iterations, "passes": plan.passes,
            "first_passes": first,
        }  # fmt: skip
    return document | {
        "largest_margin_N": plan.largest_margin,
        "force_unit_N": units_of(plan.analysis, plan.task).force,
        "limits": [series_document(usage) for usage in plan.usages],
        "certificate": certificate_document(last.certificate)
        | {"solver": last.solution.solver, "scope": "path" if plan.passes else "start"},
        "checks": [check_document(check) for check in plan.checks],
        "between": between_document(plan.between),
        "allowances": cases_document(plan.cases, plan.formulation.allowed, plan.fresh),
    }  # fmt: skip


def _true(unknown: Unknown, executed: Execution) -> dict[str, Any]:
    """Return what references that are no plan really do, at the knots until the motion is no longer followed."""
    true = true_document(executed, unknown.usages[0])
    return {
        "true": {"time_s": executed.times, "dz_r": executed.references} | true,
        "limits": [series_document(usage) for usage in unknown.usages],
    }  # fmt: skip


def _infeasible(outcome: Infeasible) -> dict[str, Any]:
    certificate = certificate_document(outcome.certificate) | {"scope": "start"}
    if outcome.decisions:
        certificate["solver"] = outcome.decisions[-1].solution.solver
    document: dict[str, Any] = {
        "stage": outcome.stage, "certificate": certificate, "hints": list(outcome.hints),
    }  # fmt: skip
    if outcome.largest_margin is not None:
        document["largest_margin_N"] = outcome.largest_margin
    return document | ({"refusal": refusal_document(outcome.refusal)} if outcome.refusal else {})


def plain(value: Any) -> Any:
    """Return a document with its arrays as lists."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    if isinstance(value, list):
        return [plain(each) for each in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


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
