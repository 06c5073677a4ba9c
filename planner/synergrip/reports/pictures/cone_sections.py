"""The force of each contact inside its friction cone, seen along the normal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.limits.ties import first_worst
from synergrip.grasps.contacts.contact import Contact
from synergrip.linalg import Array
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.layout import LETTERS, MARGIN, size_that_fits
from synergrip.reports.pictures.sheet import FAINT, GREY, INK, Panel, Sheet
from synergrip.reports.pictures.strips import WIDTH, Strip

ACROSS, GAP, SMALLEST, LARGEST = 5, 0.2, 0.95, 2.0
"""Cross-sections in a row at most, the room between them, and how small and large one gets [inch]."""
CAPTION, NAME, UNDER = 0.4, 8.0, 7.0
"""Room above a cross-section [inch], and sizes of the letters there [points]."""
KEY_HIGH, KEY_APART = 0.2, 0.32
"""Height of the line below them that says what stands for which time, and room beside each of its texts [inch]."""
STILL = 0.02
"""A force that moves no farther in its cone is one dot: marks on each other could not be told apart."""
OUTSIDE = 1.2
"""How far outside its cone a force is drawn at most."""


@dataclass(frozen=True, eq=False)
class Cones:
    """What the cross-sections of the friction cones are drawn from."""

    contacts: Sequence[Contact]
    forces: Sequence[Array]
    """(T, rows) of each contact [N, N m]."""
    margins: Array  # (T, n_c) slip margins [N]
    times: Array  # (T,) [s]


def cone_strip(cones: Cones) -> Strip:
    """Return the friction that each contact uses, in which direction, as a share of what it has."""
    width = WIDTH - 2 * MARGIN
    title = "Force of each contact inside its friction cone; on the circle it slips"
    return Strip(
        title, 0.1 + cones_height(cones, width), lambda sheet, top: draw_cones(sheet, cones, MARGIN, top + 0.1, width)
    )


def cones_height(cones: Cones, width: float) -> float:
    """Return the height of the cross-sections in a width [inch]."""
    across, side = _grid(cones, width)
    return math.ceil(len(cones.contacts) / across) * (side + CAPTION + GAP) + KEY_HIGH


def draw_cones(sheet: Sheet, cones: Cones, left: float, top: float, width: float) -> None:
    """Draw the cross-sections in a width, from the left and the top on [inch]."""
    across, side = _grid(cones, width)
    colors = contact_colors([contact.name for contact in cones.contacts])
    told = [_told(cones, index) for index in range(len(cones.contacts))]
    size = min(size_that_fits(each, side, UNDER) for each in told)
    for index, (contact, forces) in enumerate(zip(cones.contacts, cones.forces, strict=True)):
        row, column = divmod(index, across)
        begin, above = left + column * (side + GAP), top + row * (side + CAPTION + GAP)
        sheet.write(begin, above + 0.15, _short(contact.name, side), NAME, colors[contact.name], bold=True)
        sheet.write(begin, above + 0.3, told[index], size, GREY)
        panel = sheet.panel(begin, above + CAPTION - 0.05, side, side, np.zeros(2), 2.5)
        _section(panel, contact, forces, when_worst(cones.margins[:, index]), colors[contact.name])
    _key(sheet, cones, left, top + cones_height(cones, width) - KEY_HIGH - GAP / 2, width)


def _key(sheet: Sheet, cones: Cones, left: float, top: float, width: float) -> None:
    """Say below the cross-sections what stands for which time."""
    marks = _marks(cones.times)
    panel = sheet.panel(left, top, width, KEY_HIGH, np.array([width, KEY_HIGH]) / 2, width)
    size = min(UNDER, (width - len(marks) * KEY_APART) * LETTERS / sum(len(told) for _, told in marks))
    at = 0.0
    for mark, told in marks:
        _mark(panel, np.array([at + 0.06, KEY_HIGH / 2]), mark, GREY, 1.0)
        sheet.write(left + at + 0.15, top + KEY_HIGH / 2 + 0.035, told, size, GREY)
        at += KEY_APART + len(told) * size / LETTERS


def _marks(times: Array) -> list[tuple[str, str]]:
    """Return the marks of a way through a cone, and what each stands for."""
    if len(times) == 1:
        return [("dot", "the force")]
    ends = (f"{name}, {time:.3g} s" for name, time in zip(("start", "end"), times[[0, -1]], strict=True))
    return [*zip(("ring", "square"), ends, strict=True), ("dot", "least slip margin")]


def _mark(panel: Panel, place: Array, mark: str, color: str, near: float) -> None:
    """Draw a mark at a place (2,): one inside the other where they are at the same place."""
    if mark == "dot":
        panel.dots(place[None], color, 4.5, near)
    else:
        panel.outlined(place, color, 7.0, near, square=mark == "square")


def _told(cones: Cones, index: int) -> str:
    """Return the least slip margin of a contact, and when it has it."""
    worst = when_worst(cones.margins[:, index])
    when = f", t = {cones.times[worst]:.3g} s" if len(cones.times) > 1 else ""
    return f"least {cones.margins[worst, index]:.3g} N{when}"


def _grid(cones: Cones, width: float) -> tuple[int, float]:
    """Return how many cross-sections are beside each other in a width, and how large each is [inch]."""
    most = max(1, min(ACROSS, int((width + GAP) / (SMALLEST + GAP))))
    rows = math.ceil(len(cones.contacts) / most)
    across = math.ceil(len(cones.contacts) / rows)
    return across, min((width + GAP) / across - GAP, LARGEST)


def when_worst(values: Array) -> int:
    """Return where values (T,) are first as small as they get."""
    return first_worst(-values[:, None], values[:, None])[0]


def used_friction(contact: Contact, forces: Array) -> Array | None:
    """Return (T, 2) the share of its friction that a contact uses, along the tangents t and o; None without friction.

    Spin is in the size, not in the direction: at 1 the contact slips. A force outside its cone is drawn at 1.2 at most.
    """
    head, tail, friction = contact.nearest_cone(forces)
    if not np.any(friction > 0):
        return None
    names = contact.kind.components
    tangent = np.column_stack([forces[:, names.index(each)] if each in names else 0 * tail for each in ("t", "o")])
    length = np.linalg.norm(tangent, axis=1)
    unit = np.where(length[:, None] > 0, tangent / np.where(length > 0, length, 1.0)[:, None], [1.0, 0.0])
    share = np.where(head > 0, tail / np.where(head > 0, head, 1.0), np.where(tail > 0, np.inf, 0.0))
    return np.asarray(np.minimum(share, OUTSIDE)[:, None] * unit)


def _short(name: str, width: float) -> str:
    """Return a name that fits into a width [inch]; bold letters are wider."""
    most = int(0.9 * width * LETTERS / NAME)
    return name if len(name) <= most else f"{name[: most - 1]}…"


def _section(panel: Panel, contact: Contact, forces: Array, worst: int, color: str) -> None:
    """Draw the way of a force (T, rows) through its cone."""
    turn = np.linspace(0.0, 2 * np.pi, 181)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    panel.area(circle, FAINT, 0.25)
    panel.strokes([circle], INK, 1.0, near=2)
    panel.strokes([np.array([[-1.15, 0], [1.15, 0]]), np.array([[0, -1.15], [0, 1.15]])], FAINT, 0.6, near=1)
    used = used_friction(contact, forces)
    if used is None:
        panel.note(np.array([0.0, -0.5]), "no friction")
        return
    panel.strokes([used], color, 0.9, near=4)
    if np.ptp(used, axis=0).max() > STILL:
        _mark(panel, used[-1], "square", color, near=5)
        _mark(panel, used[0], "ring", color, near=6)
    _mark(panel, used[worst], "dot", color, near=7)
    panel.note(np.array([1.17, -0.13]), "t")
    panel.note(np.array([-0.13, 1.17]), "o")
