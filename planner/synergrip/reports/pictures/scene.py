"""What is held, and the forces on it, on a panel."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.objects import Object
from synergrip.linalg import Array
from synergrip.reports.pictures.forces import ContactForces
from synergrip.reports.pictures.sheet import FAINT, GREEN, GREY, INK, VERMILION, Panel
from synergrip.reports.pictures.solids import around, outline
from synergrip.reports.pictures.view import View

MOST_TURN = 1.5 * np.pi
"""The arc of the largest spin moment on a panel [rad]."""


def draw_object(panel: Panel, view: View, body: Object, at: Array, contacts: Sequence[Contact]) -> None:
    """Draw an object translucent with its lines, its centre at `at` (3,).

    A bare mass is a cross in the polygon that its contacts make, taken in the order in which they stand around it.
    """
    near, middle = 5.0 + float(view.depth(at)), view.flat(at)
    if body.shape is None:
        panel.area(around(view.flat(at + np.array([c.point for c in contacts]))), FAINT, 0.35, near)
        panel.cross(middle, GREY, near)
        return
    edge = outline(body.shape, view) + middle
    panel.area(edge, FAINT, 0.45, near)
    panel.strokes([edge], GREY, 0.9, near)
    panel.strokes([view.flat(line) + middle for line in body.shape.lines()], GREY, 0.4, near)


def draw_forces(
    panel: Panel, view: View, contacts: Sequence[Contact], forces: ContactForces, length: float, longest: float
) -> None:
    """Draw contact points, normals and forces.

    Args:
        panel: where.
        view: from where.
        contacts: the contacts, from B.
        forces: on the object.
        length: of a normal [m].
        longest: length of the longest arrow [m].
    """
    points = forces.points
    normals = [np.array([c.point, c.point + length * c.frame[:, 0]]) for c in contacts]
    panel.strokes([view.flat(line) for line in normals], GREY, 0.8, 8.0, dashed=True)
    panel.dots(view.flat(points), INK, 5.5, 9.0, edge=0.6)
    panel.arrows(view.flat(points), view.flat(arrows(forces, longest)), VERMILION)
    for arc in spin_arcs(contacts, forces, 0.35 * length):
        flat = view.flat(arc)
        panel.strokes([flat], GREEN, 1.6, 10.0)
        panel.area(_head(flat, 0.15 * length), GREEN, 1.0, 10.0)


def draw_numbers(panel: Panel, view: View, contacts: Sequence[Contact], length: float) -> None:
    """Write the number of each contact beside it, `length` [m] out of the object."""
    for number, contact in enumerate(contacts, start=1):
        away = -view.flat(contact.frame[:, 0])
        away = away / max(float(np.linalg.norm(away)), 1e-12) * length
        panel.note(view.flat(contact.point) + away, str(number))


def arrows(forces: ContactForces, longest: float) -> Array:
    """Return arrows (n_c, 3) [m] that are proportional to the forces, the largest of them `longest`."""
    largest = forces.largest
    return forces.forces * (longest / largest) if largest > 0 else np.zeros_like(forces.forces)


def spin_arcs(contacts: Sequence[Contact], forces: ContactForces, radius: float) -> list[Array]:
    """Return an arc (n, 3) [m] about the normal of each contact with a spin moment, as long as the moment is large."""
    arcs = []
    for contact, spin in zip(contacts, forces.spins, strict=True):
        if abs(spin) > 0.02 * forces.largest_spin:
            angles = np.linspace(0.0, MOST_TURN * spin / forces.largest_spin, 40)
            circle = np.column_stack([np.cos(angles), np.sin(angles)]) @ contact.frame[:, 1:].T
            arcs.append(contact.point + radius * circle)
    return arcs


def _head(line: Array, size: float) -> Array:
    """Return the triangle (3, 2) at the end of a polyline (n, 2)."""
    along = line[-1] - line[-2]
    along = along / max(float(np.linalg.norm(along)), 1e-12) * size
    across = np.array([-along[1], along[0]]) * 0.6
    return np.array([line[-1] + along, line[-1] + across, line[-1] - across])
