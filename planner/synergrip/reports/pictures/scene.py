"""What is held, and the forces on it, on a panel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.objects import Object
from synergrip.grasps.shapes.shape import Shape
from synergrip.linalg import Array
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.forces import ContactForces
from synergrip.reports.pictures.free_places import free_places
from synergrip.reports.pictures.sheet import FAINT, GREY, Panel
from synergrip.reports.pictures.solids import around, outline
from synergrip.reports.pictures.view import View

MOST_TURN = 1.5 * np.pi
"""The arc of the largest spin moment on a panel [rad]."""


def draw_object(panel: Panel, view: View, body: Object, at: Array, contacts: Sequence[Contact]) -> None:
    """Draw an object translucent with its lines, its centre at `at` (3,).

    A bare mass is a cross in the polygon that its contacts make, taken in the order in which they stand around it.
    """
    if body.shape is None:
        near = 5.0 + float(view.depth(at))
        panel.area(around(view.flat(at + np.array([c.point for c in contacts]))), FAINT, 0.35, near)
        panel.cross(view.flat(at), GREY, near)
        return
    draw_solid(panel, view, body.shape, at)


def draw_solid(panel: Panel, view: View, shape: Shape, at: Array) -> None:
    """Draw a shape translucent with its outline and lines, its centre at `at` (3,)."""
    near, middle = 5.0 + float(view.depth(at)), view.flat(at)
    edge = outline(shape, view) + middle
    panel.area(edge, FAINT, 0.45, near)
    panel.strokes([edge], GREY, 0.9, near)
    for line in shape.lines():
        for piece, in_front in front_and_back(line, view):
            panel.strokes([view.flat(piece) + middle], GREY, 0.6 if in_front else 0.25, near, dashed=not in_front)


def front_and_back(line: Array, view: View) -> Iterator[tuple[Array, bool]]:
    """Yield the pieces of a line (n, 3) on a convex solid about the origin, and whether each is on the near side."""
    near = view.depth((line[:-1] + line[1:]) / 2) >= 0
    cuts = [0, *(np.flatnonzero(near[1:] != near[:-1]) + 1), len(near)]
    for first, last in pairwise(cuts):
        yield line[first : last + 1], bool(near[first])


def draw_forces(
    panel: Panel,
    view: View,
    contacts: Sequence[Contact],
    forces: ContactForces,
    length: float,
    longest: float,
    off: float,
) -> None:
    """Draw contact points with their numbers, normals and forces, each contact in its colour.

    Args:
        panel: where.
        view: from where.
        contacts: the contacts, from B.
        forces: on the object.
        length: of a normal [m].
        longest: length of the longest arrow [m].
        off: how far from its contact a number stands [m].
    """
    colors = list(contact_colors([contact.name for contact in contacts]).values())
    points, vectors = view.flat(forces.points), view.flat(arrows(forces, longest))
    normals = [view.flat(np.array([c.point, c.point + length * c.frame[:, 0]])) for c in contacts]
    panel.strokes(normals, GREY, 0.8, 8.0, dashed=True)
    panel.arrows(points, vectors, colors)
    for point, color in zip(points, colors, strict=True):
        panel.dots(point[None], color, 6.0, 11.0, edge=0.7)
    drawn = [*normals, *(np.array([point, point + vector]) for point, vector in zip(points, vectors, strict=True))]
    for index, arc in spin_arcs(contacts, forces, 0.35 * length):
        flat = view.flat(arc)
        panel.strokes([flat], colors[index], 1.6, 10.0)
        panel.area(_head(flat, 0.15 * length), colors[index], 1.0, 10.0)
        drawn.append(flat)
    outward = -view.flat(np.array([contact.frame[:, 0] for contact in contacts]))
    for number, place in enumerate(free_places(points, outward, drawn, off), start=1):
        panel.note(place, str(number), colors[number - 1], bold=True)


def arrows(forces: ContactForces, longest: float) -> Array:
    """Return arrows (n_c, 3) [m] that are proportional to the forces, the largest of them `longest`."""
    largest = forces.largest
    return forces.forces * (longest / largest) if largest > 0 else np.zeros_like(forces.forces)


def spin_arcs(contacts: Sequence[Contact], forces: ContactForces, radius: float) -> list[tuple[int, Array]]:
    """Return which contacts have a spin moment, with an arc (n, 3) [m] about the normal as long as this is large."""
    arcs = []
    for index, (contact, spin) in enumerate(zip(contacts, forces.spins, strict=True)):
        if abs(spin) > 0.02 * forces.largest_spin:
            angles = np.linspace(0.0, MOST_TURN * spin / forces.largest_spin, 40)
            circle = np.column_stack([np.cos(angles), np.sin(angles)]) @ contact.frame[:, 1:].T
            arcs.append((index, contact.point + radius * circle))
    return arcs


def _head(line: Array, size: float) -> Array:
    """Return the triangle (3, 2) at the end of a polyline (n, 2)."""
    along = line[-1] - line[-2]
    along = along / max(float(np.linalg.norm(along)), 1e-12) * size
    across = np.array([-along[1], along[0]]) * 0.6
    return np.array([line[-1] + along, line[-1] + across, line[-1] - across])
