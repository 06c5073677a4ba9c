"""A no as JSON: what is to blame, what clashes, what repairs it, when."""

from __future__ import annotations

from typing import Any

from synergrip.explain.explanation import Explanation
from synergrip.explain.repairs import Repair
from synergrip.explain.words import undone_share
from synergrip.linalg import Array
from synergrip.planning.told import finite
from synergrip.reports.data.json_missing import missing_document


def no_document(found: Explanation, times: Array) -> dict[str, Any]:
    """Return what is known of a no, always with all keys.

    Args:
        found: what is known.
        times: (T,) knots [s] of the task.
    """
    return {
        "why": {"text": found.text, "cause": found.cause},
        "conflicts": [
            {
                "limit": each.key, "share": each.share, "times_s": [float(times[k]) for k in each.knots],
                "items": [{"name": name, "side": side} for name, side in zip(each.items, each.sides, strict=True)],
            }
            for each in found.conflicts
        ],
        "repairs": [repair_document(each) for each in found.repairs],
        "missing_synergies": None if found.missing_synergies is None else missing_document(found.missing_synergies),
        "others": [repair_document(each) for each in found.others],
        "pairs": [[repair_document(each) for each in pair] for pair in found.pairs],
        "clashing": None if found.clashing is None else list(found.clashing),
        "cannot_help": list(found.cannot_help),
        "when": {
            "first_s": found.when.first_s, "intervals_s": [list(each) for each in found.when.intervals_s],
            "alone": found.when.alone, "scope": found.when.scope,
        },
        "interrupted": found.interrupted,
    }  # fmt: skip


def repair_document(repair: Repair) -> dict[str, Any]:
    """Return a change of one number."""
    return {
        "cause": repair.cause, "key": repair.key, "from": repair.was, "to": repair.to, "unit": repair.unit,
        "set": repair.set, "tried": repair.tried, "verified": repair.verified, "size": finite(repair.size),
        "proven_short": repair.proven, "undone_share": undone_share(repair),
        "least_at_start": repair.least, "in_vain": repair.in_vain,
    }  # fmt: skip
