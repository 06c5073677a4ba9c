"""A hand that holds an object, as one JSON document."""

from __future__ import annotations

from typing import Any

from synergrip.hands.spots import spots_of
from synergrip.problems.problem import Problem
from synergrip.reports.data.json_spots import posture_document


def in_order_document(problem: Problem) -> dict[str, Any]:
    """Return what a problem in order holds, SI units; with a hand its posture, pads, the object and the contacts.

    Points and normals are in the palm frame; a gap is null for an object without a shape.
    """
    document: dict[str, Any] = {"valid": True, "file": str(problem.path), "title": problem.title}
    held = problem.held
    if held is not None:
        body = held.body
        document |= posture_document(
            held.hand, held.q, spots_of(held.hand, held.q, [touch.pad for touch in held.touches])
        )
        document["object"] = {"title": body.title, "mass_kg": body.mass, "position_m": body.position.tolist()}
        document["contacts"] = [
            {
                "name": contact.name, "link": touch.pad.link, "kind": contact.kind.name,
                "point_m": (contact.point + body.position).tolist(), "normal": contact.frame[:, 0].tolist(),
                "gap_m": gap, "friction": contact.friction,
            }
            for contact, touch, gap in zip(problem.grasp.contacts, held.touches, held.gaps, strict=True)
        ]  # fmt: skip
    return document | {"notes": list(problem.notes)}
