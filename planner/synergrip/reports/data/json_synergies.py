"""Synergy sets as one JSON document each: fitted, listed, shown, compared. SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.angles import Comparison, Side
from synergrip.hands.synergies.fitting import Fit
from synergrip.hands.synergies.pairing import Pair
from synergrip.hands.synergies.span import Span, span
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array


def fit_document(fit: Fit, written: Path | None, picture: Path | None = None) -> dict[str, Any]:
    """Return the synergy file and what stands behind it."""
    recorded, found = fit.recorded, fit.principal
    return {
        "written": str(written) if written else None,
        "picture": str(picture) if picture else None,
        **fit.file.model_dump(by_alias=True),
        "unit": SI_UNITS[recorded.kind],
        "postures": len(recorded.postures),
        "rank": found.decision.rank,
        "ambiguous": found.decision.ambiguous,
        "equal_variance": [list(group) for group in found.alike],
        "singular_values": found.singular_values.tolist(),
        "variance_shares": found.shares.tolist(),
        "cumulative_variance": np.cumsum(found.shares[: len(fit.file.synergies)]).tolist(),
        "reconstruction_rms": found.rms,
        "followers": [
            {"joint": each.joint, "follows": each.drivers, "deviation": each.deviation, "line": each.line}
            for each in recorded.followed
        ],
        "left_out": list(recorded.left_out),
        "notes": list(recorded.notes),
    }


def list_document(sets: Sequence[tuple[str, SynergySet]]) -> dict[str, Any]:
    """Return each set, given with the name of its hand."""
    return {"sets": [{"hand": hand or None, **_set_document(each, span(each.S))} for hand, each in sets]}


def show_document(hand: Hand, chosen: SynergySet, q: Array | None, picture: Path | None = None) -> dict[str, Any]:
    """Return a set whole; `q` (n_q,) is the posture asked for."""
    return {
        "hand": hand.name, "joints": list(hand.joint_names), "kinds": [joint.kind for joint in hand.joints],
        **_set_document(chosen, span(chosen.S)),
        "S": chosen.S.tolist(), "offset": chosen.offset.tolist(), "posture": None if q is None else q.tolist(),
        "picture": str(picture) if picture else None,
    }  # fmt: skip


def compare_document(pair: Pair, found: Comparison) -> dict[str, Any]:
    """Return the principal angles [rad], ascending, and what each set reproduces of the other."""
    angles = found.angles.tolist()
    return {
        "joints": list(pair.joints),
        "only_in_A": list(pair.only_first),
        "only_in_B": list(pair.only_second),
        "principal_angles": angles,
        "smallest_angle": angles[0] if angles else None,
        "largest_angle": angles[-1] if angles else None,
        "A": _side_document(pair.first, found.first),
        "B": _side_document(pair.second, found.second),
    }


def _side_document(chosen: SynergySet, side: Side) -> dict[str, Any]:
    shares = [_number(share) for share in side.shares]
    return {**_set_document(chosen, side.span), "share_in_other": _number(side.share), "inside_other": side.inside,
            "synergy_shares": shares}  # fmt: skip


def _set_document(chosen: SynergySet, found: Span) -> dict[str, Any]:
    return {
        "set": chosen.name, "title": chosen.title, "synergies": list(chosen.synergies),
        "n_z": len(chosen.synergies), "rank": found.rank, "repeated": found.repeated,
        "ambiguous": found.decision.ambiguous, "orthonormal": found.orthonormal,
        "lengths": found.norms.tolist(), "singular_values": found.singular_values.tolist(),
    }  # fmt: skip


def _number(value: float) -> float | None:
    return None if math.isnan(value) else float(value)
