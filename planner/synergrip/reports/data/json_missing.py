"""Synergies that are missing, as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from synergrip.explain.synergies.missing_synergies import MissingSynergies


def missing_document(missing: MissingSynergies) -> dict[str, Any]:
    """Return the keys of ``missing_synergies``: columns [n_q][count] as in S, and who has columns that do."""
    candidates = [
        {"set": each.set, "names": list(each.names), "verdict": each.verdict, "stage": each.stage or None,
         "why": each.why or None, "setting": each.setting or None, "whole": each.whole} for each in missing.candidates
    ]  # fmt: skip
    return {
        "count": missing.count, "proven": missing.proven, "columns": missing.columns.tolist(),
        "joints": list(missing.joints), "verdict": missing.verdict or None, "candidates": candidates,
        "why": missing.why, "notes": list(missing.notes),
    }  # fmt: skip
