"""What of a grasp can hardly be meant: too much friction, contacts on an edge, a posture in another unit."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from synergrip.documents.quantities import in_g, in_mm
from synergrip.errors import Issue
from synergrip.grasps.contacts.contact import contact_frame
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.objects import Object
from synergrip.grasps.shapes.shape import Shape
from synergrip.hands.posture_units import posture_doubt
from synergrip.linalg import Array

MOST_FRICTION = 2.0
"""Coefficient of friction that hardly any pair of dry surfaces exceeds."""
NEAR = 1e-3
"""Nearer than this to an edge a contact is on it, as far as hands are placed [m]."""
LIGHTEST, HEAVIEST = 1.0, 25000.0
"""Densities that objects have [kg/m^3]: more than air has, and less than osmium and iridium have."""
EARTH = 9.81
"""[m/s^2]"""
OTHER_UNIT = 100.0
"""Factor between masses of one object from which on one of them is in another unit."""
MUCH = 0.2
"""Share of an object by which no contact gives under its weight."""
STEPS, WAYS = 10, 16
"""Distances and directions in which an edge is looked for."""
BEND = np.cos(np.radians(30))
"""Cosine of the angle between normals from which on there is an edge between their places."""


def grasp_doubts(grasp: Grasp, friction_at: Callable[[int, str], str] = lambda place, name: name) -> Iterator[Issue]:
    """Yield what can hardly be meant, each with its key: that of the problem file where there is one.

    Args:
        grasp: the grasp.
        friction_at: the key of a parameter of a contact, by its place among the contacts.
    """
    yield from _too_much_friction(grasp, friction_at)
    if grasp.held is not None:
        yield from _on_edges(grasp)
        yield from list(_unlikely_mass(grasp.held.body)) or _soft_contacts(grasp, grasp.held.body)
        if said := posture_doubt(grasp.held.hand.joints, grasp.held.q):
            yield Issue(said, key="posture")


def _too_much_friction(grasp: Grasp, friction_at: Callable[[int, str], str]) -> Iterator[Issue]:
    """Yield one for each key and value, with the contacts that have it."""
    found: dict[tuple[str, float], list[str]] = {}
    for place, contact in enumerate(grasp.contacts):
        for name in ("friction", "cross_friction"):
            value = float(getattr(contact.kind, name, 0.0))
            if value > MOST_FRICTION:
                found.setdefault((friction_at(place, name), value), []).append(f"'{contact.name}'")
    for (key, value), names in found.items():
        where = f"contact{'s' if len(names) > 1 else ''} {', '.join(names)}"
        message = (
            f"a coefficient of friction of {value:.4g} ({where}) is above {MOST_FRICTION:g}: rubber on dry, rough "
            "surfaces has about 1; neither an angle nor a percentage is meant"
        )
        yield Issue(message, key=key)


def _on_edges(grasp: Grasp) -> Iterator[Issue]:
    held = grasp.held
    if held is None or held.body.shape is None:
        return
    for contact, touch in zip(grasp.contacts, held.touches, strict=True):
        distance = edge_distance(held.body.shape, contact.point)
        if distance is not None:
            message = (
                f"contact '{contact.name}' is {in_mm(distance, 2)} or less from an edge of the "
                f"{held.body.shape.title}: a pad that is placed a little otherwise touches another face, or none"
            )
            yield Issue(message, key=touch.key or "contacts")


def _unlikely_mass(body: Object) -> Iterator[Issue]:
    """Yield a mass that no solid of this shape has."""
    if body.mass and (said := mass_doubt(body, body.mass)):
        yield Issue(said, key="object.mass")


def mass_doubt(body: Object, mass: float) -> str:
    """Return why an object can hardly have a mass [kg], by the box around its shape or the mass that is stated."""
    if body.shape is not None:
        density = mass / float(np.prod(extents(body.shape)))
        if LIGHTEST < density < HEAVIEST:
            return ""
        than = f"more than {HEAVIEST:g}: no solid" if density > 1 else f"less than {LIGHTEST:g}, as air: nothing"
        return (
            f"{in_g(mass)} in the box around the {body.shape.title} are {density:.3g} kg/m^3, {than} "
            "that hands hold is so; is it in another unit?"
        )
    if not body.mass or 1 / OTHER_UNIT < mass / body.mass < OTHER_UNIT:
        return ""
    return (
        f"{mass:.4g} kg are {mass / body.mass:.3g} times the object's own mass, {body.mass:.4g} kg: in code masses are "
        "in kg; is it in another unit?"
    )


def _soft_contacts(grasp: Grasp, body: Object) -> Iterator[Issue]:
    """Yield contacts that give by much of the object under its weight alone."""
    if body.shape is None or not body.mass:
        return
    gives = np.diag(grasp.C_s)[np.asarray(grasp.normal_rows)] * body.mass * EARTH
    size, most = float(extents(body.shape).max()), int(np.argmax(gives))
    if gives[most] > MUCH * size:
        message = (
            f"contact '{grasp.contacts[most].name}' gives by {in_mm(gives[most], 4)} under the object's weight, "
            f'and that is {in_mm(size, 4)} large: stiffness is in N/m, or with its unit, as "8 N/mm"'
        )
        yield Issue(message, key="contacts.stiffness")


def extents(shape: Shape) -> Array:
    """Return the sizes (3,) of a shape along the axes of B [m]."""
    return np.array([float((shape.farthest(axis) - shape.farthest(-axis)) @ axis) for axis in np.eye(3)])


def edge_distance(shape: Shape, point: Array) -> float | None:
    """Return how far [m] an edge is from a point (3,) of the surface, rounded up to a tenth of `NEAR`.

    Returns:
        None when there is none within `NEAR`: nowhere around does the normal of the surface turn by 30 degrees.
    """
    gap, outward = shape.surface(point)
    frame = contact_frame(outward)
    angles = 2 * np.pi * np.arange(WAYS) / WAYS
    ways = np.column_stack([np.cos(angles), np.sin(angles)]) @ frame[:, 1:].T  # (WAYS, 3)
    distances = NEAR * np.arange(1, STEPS + 1) / STEPS
    around = point - gap * outward + distances[:, None, None] * ways
    bent = np.any(shape.surface(around)[1] @ outward < BEND, axis=1)
    return float(distances[int(np.argmax(bent))]) if np.any(bent) else None
