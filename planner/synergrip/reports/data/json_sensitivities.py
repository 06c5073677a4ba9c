"""Sensitivities as values of a JSON document."""

from __future__ import annotations

from typing import Any

from synergrip.margin.sensitivity.sensitivity import Sensitivities, Sensitivity


def sensitivities_document(found: Sensitivities | None) -> dict[str, Any]:
    """Return the entries of the document of margins; derivatives in SI units, and as they are told."""
    if found is None:
        return {}
    return {
        "sensitivities": [_each(each) for each in found.each],
        "sensitivities_of": dict(found.margins),
        "sensitivities_left_out": dict(found.left_out),
        "worth_most": {
            kind: [[each.name, each.of, each.direction] for each in found.worth_most(kind)] for kind in found.margins
        },
    }  # fmt: skip


def _each(each: Sensitivity) -> dict[str, Any]:
    place = each.direction != ""
    by = {"1 mm": "N/m", "1 deg": "N/rad"}.get(each.per, "N")
    return {
        "kind": each.kind, "model": each.model, "name": each.name, "of": each.of, "direction": each.direction,
        "at": each.at, "value": each.value, "unit": each.unit, "per": each.per, "derivative": each.derivative,
        "derivative_unit": by, "relative": not place, "left": each.left, "right": each.right,
        "differentiable": each.differentiable, "why": each.why, "gain": each.gain,
    }  # fmt: skip
