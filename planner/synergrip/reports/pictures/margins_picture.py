"""How sure a grasp is, as a picture: slip margins over time, and the force of each contact inside its friction cone."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.linalg import Array
from synergrip.margin.found import Margins
from synergrip.margin.measures import ALIKE, Measure
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.layout import MARGIN
from synergrip.reports.pictures.page import SPACE, UNDER, Heading
from synergrip.reports.pictures.sheet import FAINT, GREY, INK, Panel, Sheet, write_picture

WIDTH, LEFT, HIGH = 9.0, 0.75, 2.2
"""Of the sheet, the room left of a chart, and the height of a chart [inch]."""
ABOVE, BELOW = 0.45, 0.6
"""Room above and below a chart for its labels [inch]."""
ACROSS, GAP = 5, 0.2
"""Cross-sections in a row at most, and the room between them [inch]."""
CAPTION = 0.42
"""Room above a cross-section for the name of its contact and its margin [inch]."""


@dataclass(frozen=True)
class Part:
    """A part of the sheet, over its whole width."""

    title: str
    height: float  # [inch]
    draw: Callable[[Sheet, float], None]
    """Draws it below so much from the top [inch]."""


def draw_margins(found: Margins, title: str, path: Path) -> None:
    """Draw the slip margins of a plan over time, and where in its cone the force of each contact is.

    Args:
        found: the margins.
        title: heading of the picture.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    worst = found.measures["slip margin"].worst
    who = "linear model of the start posture" if found.linear is None else "hand that moves"
    under = f"smallest slip margin {worst.value:.4g} N at {worst.name}, t = {worst.time_s:.2f} s, of the {who}"
    heading = Heading.of(title, under, WIDTH)
    parts = (_over_time(found), _sections(found))

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        top = heading.height + SPACE
        for part in parts:
            sheet.write(MARGIN, top + 0.15, part.title, UNDER)
            part.draw(sheet, top + 0.15)
            top += part.height

    write_picture(path, WIDTH, heading.height + SPACE + sum(part.height for part in parts), fill)


def _over_time(found: Margins) -> Part:
    """Return the chart of slip margins, with the linear model beside it and the margin that is asked for."""
    slip, asked = found.measures["slip margin"], found.plan.task.margin
    linear = None if found.linear is None else found.linear["slip margin"]
    beside = "; thin: the linear model of the start posture" if linear is not None else ""

    def draw(sheet: Sheet, top: float) -> None:
        axes = sheet.chart(LEFT, top + ABOVE, WIDTH - LEFT - MARGIN, HIGH)
        _lines(axes, slip, linear)
        axes.axhline(asked, color=INK, lw=1.0, ls=(0, (4, 3)), zorder=1)
        low = min(0.0, asked, float(slip.value.min()))
        high = axes.get_ylim()[1]
        axes.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=8)
        axes.set_xlabel("time [s]", fontsize=8)
        axes.set_ylabel("slip margin [N]", fontsize=8)
        axes.legend(frameon=False, fontsize=7, ncols=6, loc="lower left", bbox_to_anchor=(0.0, 1.0),
                    borderaxespad=0.0, handlelength=1.2, columnspacing=1.0)  # fmt: skip

    return Part(f"Slip margin of each contact; dashed: {asked:.4g} N, which is asked for{beside}",
                ABOVE + HIGH + BELOW, draw)  # fmt: skip


def _lines(axes: Any, slip: Measure, linear: Measure | None) -> None:
    colors, marker = contact_colors(slip.items), "o" if len(slip.times) == 1 else None
    for index, name in enumerate(slip.items):
        width = min(1.5 + 0.9 * (len(slip.items) - 1 - index), 5.0)  # of lines on each other all are seen
        axes.plot(slip.times, slip.value[:, index], color=colors[name], lw=width, marker=marker, label=name, zorder=3)
        if linear is not None:
            axes.plot(linear.times, linear.value[:, index], color=colors[name], lw=0.7, alpha=0.7, zorder=2)
    axes.margins(x=0.0 if len(slip.times) > 1 else 0.1)


def first_worst(values: Array) -> int:
    """Return where values (T,) are first as small as they get."""
    least = float(values.min())
    return int(np.nonzero(values <= least + ALIKE * abs(least))[0][0])


def _sections(found: Margins) -> Part:
    """Return the cross-sections: the friction that each contact uses, in which direction, as a share of what it has."""
    grasp, slip = found.plan.grasp, found.measures["slip margin"]
    pairs = list(zip(grasp.contacts, grasp.rows, strict=True))
    across = min(ACROSS, len(pairs))
    side = min((WIDTH - 2 * MARGIN + GAP) / across - GAP, 2.2)
    colors = contact_colors(slip.items)

    def draw(sheet: Sheet, top: float) -> None:
        for index, (contact, rows) in enumerate(pairs):
            row, column = divmod(index, across)
            left, above = MARGIN + column * (side + GAP), top + 0.1 + row * (side + CAPTION + GAP)
            worst = first_worst(slip.value[:, index])
            sheet.write(left, above + 0.15, _short(contact.name, side), 8.0, colors[contact.name], bold=True)
            told = f"least {slip.value[worst, index]:.3g} N, t = {slip.times[worst]:.3g} s"
            sheet.write(left, above + 0.3, told, 7.0, GREY)
            panel = sheet.panel(left, above + CAPTION - 0.05, side, side, np.zeros(2), 2.5)
            _section(panel, contact, found.plan.forces[:, rows], worst, colors[contact.name])

    rows = math.ceil(len(pairs) / across)
    title = "Force of each contact inside its friction cone (circle: slips); dot: where the margin is least"
    return Part(title, 0.3 + rows * (side + CAPTION + GAP), draw)


def _short(name: str, width: float) -> str:
    """Return a name that fits into a width [inch]."""
    most = int(width * 138 / 8 * 0.9)
    return name if len(name) <= most else f"{name[: most - 1]}…"


def _section(panel: Panel, contact: Contact, forces: Array, worst: int, color: str) -> None:
    """Draw the way of a force (T, rows) through its cone, seen along the normal."""
    turn = np.linspace(0.0, 2 * np.pi, 181)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    panel.area(circle, FAINT, 0.25)
    panel.strokes([circle], INK, 1.0, near=2)
    panel.strokes([np.array([[-1.15, 0], [1.15, 0]]), np.array([[0, -1.15], [0, 1.15]])], FAINT, 0.6, near=1)
    used = used_friction(contact, forces)
    if used is None:
        panel.note(np.array([0.0, -0.5]), "no friction")
        return
    panel.strokes([used], color, 1.6, near=4)
    panel.dots(used[worst][None], color, 7.0, near=5, edge=0.8)
    panel.note(np.array([1.2, -0.12]), "t")
    panel.note(np.array([-0.12, 1.17]), "o")


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
    return np.asarray(np.minimum(share, 1.2)[:, None] * unit)
