"""Where pads and fingertips are, for one JSON document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from synergrip.hands.hand import Hand
from synergrip.hands.spots import Spot
from synergrip.linalg import Array


def spots_document(spots: Sequence[Spot]) -> list[dict[str, Any]]:
    """Return pads and fingertips in the palm frame, SI units; null where nothing says where a pad pushes."""
    return [
        {
            "name": spot.name, "link": spot.link, "is_pad": spot.pad, "position_m": spot.position.tolist(),
            "pushes_to": None if spot.normal is None else spot.normal.tolist(),
        }
        for spot in spots
    ]  # fmt: skip


def posture_document(hand: Hand, q: Array, spots: Sequence[Spot]) -> dict[str, Any]:
    """Return a posture (n_q,) by joint, SI units, and where pads and fingertips are in it."""
    return {"posture": dict(zip(hand.joint_names, q.tolist(), strict=True)), "places": spots_document(spots)}
