"""What a plan withstands, and the classical figures of its grasp, as parts of a JSON document; SI units."""

from __future__ import annotations

from typing import Any

from synergrip.margin.disturbance.disturbances import Disturbances, WithstoodAlong
from synergrip.margin.disturbance.withstood import Withstood
from synergrip.margin.wrench_space.quality import WrenchSpaceQuality
from synergrip.planning.told import finite


def disturbance_document(found: Disturbances) -> dict[str, Any]:
    """Return the part of extra wrenches."""
    executed = found.executed
    return {
        "passive_N": _withstood(found.passive), "slip_N": _withstood(found.slip), "active_N": _withstood(found.active),
        "known_share": found.known_share, "linear_model": found.of,
        "left_out": list(found.left_out),
        "norm": {"length_m": found.length, "centroid_m": found.centroid.tolist()},
        "along": [{"direction": each.wrench.tolist(), **_along(each)} for each in found.along],
        "box": None if found.box is None else {"half_widths": found.box.wrench.tolist(), **_along(found.box)},
        "executed": None if executed is None else {
            "wrench": executed.wrench.tolist(), "share": executed.share, "margin_N": executed.margin,
            "contact": executed.contact, "time_s": executed.time_s, "holds": executed.holds, "why": executed.why,
        },
    }  # fmt: skip


def quality_document(found: WrenchSpaceQuality) -> dict[str, Any]:
    """Return the part of the classical figures."""
    pairs = ("epsilon", "epsilon_synergies", "epsilon_pyramids", "volume", "volume_synergies")
    each = ("epsilon_each", "epsilon_each_synergies") if found.epsilon_each is not None else ()
    numbers = ("smallest_singular_value", "isotropy", "isotropy_synergies")
    return {
        **{name: dict(zip(("lower", "upper"), getattr(found, name), strict=True)) for name in (*pairs, *each)},
        **{name: getattr(found, name) for name in numbers},
        "singular_values": found.singular_values.tolist(),
        "singular_values_synergies": found.singular_values_synergies.tolist(),
        "unit_forces": "L1", "length_m": found.length, "edges": found.edges, "why": found.why,
    }  # fmt: skip


def _along(found: WithstoodAlong) -> dict[str, Any]:
    return {
        "unit": found.unit, "passive": _withstood(found.passive), "slip": _withstood(found.slip),
        "active": _withstood(found.active),
    }  # fmt: skip


def _withstood(found: Withstood) -> dict[str, Any]:
    return {
        "lower": finite(found.lower), "upper": found.upper, "proven": found.proven, "limit": found.limit,
        "item": found.item, "time_s": found.time_s, "wrench": None if found.wrench is None else found.wrench.tolist(),
    }  # fmt: skip
