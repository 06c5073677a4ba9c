"""The analysis of a grasp as one JSON document."""

from __future__ import annotations

from typing import Any

from synergrip.errors import MotionCountError, MotionDirectionError, NotRestrainedError, Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.planning.accuracy import accuracy_notes
from synergrip.planning.free import free_dimensions
from synergrip.planning.told import structure_document
from synergrip.statics.analysis import Analysis
from synergrip.tasks.control import ControlError


def analysis_document(analysis: Analysis) -> dict[str, Any]:
    """Return structure, maps, bases and Theorem 1 of a grasp, SI units."""
    response, spaces, grasp = analysis.response, analysis.spaces, analysis.grasp
    maps = ("dlambda_dzr", "du_dzr", "dq_dzr", "dtau_dzr", "dsigma_dzr", "dz_dzr", "dlambda_dw", "du_dw", "dq_dw")
    known = {name: response.accuracy[name] for name in maps}
    bases = ("E_s", "Gamma_ucs", "Gamma_zcs", "Gamma_zr")
    kinds = [(contact.name, contact.kind) for contact in grasp.contacts]
    return {
        "title": grasp.title,
        "contacts": [{"name": name, "kind": kind.name, "components": list(kind.components)} for name, kind in kinds],
        "joints": list(grasp.joints),
        "synergies": list(grasp.synergies),
        "structure": structure_document(grasp, analysis),
        "maps": {name: getattr(response, name).tolist() for name in maps},
        "accuracy": {name: {"error": each.error, "sensitivity": each.sensitivity} for name, each in known.items()},
        "notes": [*free_dimensions(analysis), *accuracy_notes(response)],
        "bases": {name: getattr(spaces, name).tolist() for name in bases},
        "theorem1": {"M": analysis.coordinates.M.tolist(), "condition": analysis.coordinates.condition},
        "grasp": {name: getattr(grasp, name).tolist() for name in ("G", "J", "S", "C_s", "C_q", "C_z", "w_0")},
    }  # fmt: skip


def unrestrained_document(grasp: Grasp, refusal: NotRestrainedError) -> dict[str, Any]:
    """Return what can be said of a grasp that leaves the object a free motion."""
    return {"title": grasp.title, "structure": structure_document(grasp, None), **refused_document(refusal)}


def refused_document(refusal: Refusal) -> dict[str, Any]:
    """Return what is said of any question that is refused before a program is solved."""
    return {
        "verdict": "infeasible", "exit_code": refusal.exit_code, "stage": refusal.stage, "why": str(refusal),
        "refusal": refusal_document(refusal),
    }  # fmt: skip


def refusal_document(refusal: Refusal) -> dict[str, Any]:
    """Return the numbers that explain a refusal, SI units."""
    if isinstance(refusal, NotRestrainedError):
        return {"free_twists": refusal.free_twists.T.tolist(), "unsupported_wrench": refusal.unsupported.tolist()}
    if isinstance(refusal, MotionDirectionError):
        return {"residual": refusal.residual.tolist(), "time_s": refusal.time_s, "share": refusal.share,
                "size_m": refusal.size}  # fmt: skip
    if isinstance(refusal, MotionCountError):
        return {"asked": refusal.asked, "n_z": refusal.available, "directions": refusal.directions.T.tolist()}
    if isinstance(refusal, ControlError):
        return {"asked": refusal.asked, "available": refusal.available}
    return {}
