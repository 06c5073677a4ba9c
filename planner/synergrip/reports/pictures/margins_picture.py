"""How sure a grasp is, as a picture: margins over time, forces in their cones, what is withstood, what would help."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.margin.disturbance.withstood_in_planes import withstood_in_planes
from synergrip.margin.found import Margins
from synergrip.margin.sensitivity.sensitivity import KINDS, LARGEST, Sensitivity
from synergrip.margin.timing.fastest_timing import FastestTiming
from synergrip.planning.outcome import Plan
from synergrip.reports.pictures.cone_sections import Cones, cone_strip
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.layout import MARGIN
from synergrip.reports.pictures.line_chart import HEAD, Box, draw_chart, head_of
from synergrip.reports.pictures.lines import Lines
from synergrip.reports.pictures.sheet import FAINT, GREY, INK, Panel, Sheet
from synergrip.reports.pictures.strips import LEFT, WIDTH, Strip, plain, write_strips
from synergrip.reports.pictures.worth import BAR, draw_worth, worth_bars

HIGH, ABOVE, BELOW = 2.2, 0.3, 0.5
"""Height of a chart, and the room above and below it for its labels [inch]."""
PLANES = ((0, 1), (0, 2), (1, 2))
SIDE, APART = 2.4, 0.45
"""Of a plane of directions, and between two of them [inch]."""
NAMES = 4.1
"""Room for the names of changes [inch]."""


def draw_margins(found: Margins, title: str, path: Path) -> None:
    """Draw all that is known of the margins of a plan.

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
    write_strips(path, title, under, [*_strips(found)])


def _strips(found: Margins) -> Iterator[Strip]:
    yield _over_time(found)
    yield _cones(found)
    if found.disturbance is not None:
        yield _withstood(found.plan, found.disturbance.of)
    if found.sensitivities is not None:
        bars = [each for kind in KINDS for each in worth_bars(found.sensitivities, kind)]
        yield from [_worth(bars)] if bars else []
    if found.timing is not None and found.timing.path is not None:
        yield _timing(found.timing)


def _over_time(found: Margins) -> Strip:
    """Return the chart of slip margins, with the linear model beside it and the margin that is asked for."""
    slip, asked = found.measures["slip margin"], found.plan.task.margin
    linear = None if found.linear is None else found.linear["slip margin"]
    beside = "; thin: the linear model of the start posture" if linear is not None else ""
    lines = Lines("slip margin", "N", tuple(slip.items), slip.value, (asked,), of_contacts=True)
    width = WIDTH - LEFT - MARGIN
    above = head_of(lines, slip.times, width) - HEAD + 0.1

    def draw(sheet: Sheet, top: float) -> None:
        axes = draw_chart(sheet, Box(LEFT, top + above, width, HIGH), slip.times, lines, label=False)
        if len(slip.times) == 1:
            axes.set_xlabel("slip margin [N]", fontsize=8)
            return
        if linear is not None:
            for index, color in enumerate(contact_colors(slip.items).values()):
                axes.plot(linear.times, linear.value[:, index], color=color, lw=0.7, alpha=0.8, zorder=2)
        axes.set_ylabel("slip margin [N]", fontsize=8)

    title = f"Slip margin of each contact; dashed: {asked:.4g} N, which is asked for{beside}"
    return Strip(title, above + HIGH + BELOW, draw)


def _cones(found: Margins) -> Strip:
    plan, slip = found.plan, found.measures["slip margin"]
    forces = [plan.forces[:, rows] for rows in plan.grasp.rows]
    return cone_strip(Cones(plan.grasp.contacts, forces, slip.value, slip.times))


def _legend(axes: Any) -> None:
    axes.legend(frameon=False, fontsize=7, ncols=6, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.0,
                handlelength=1.2, columnspacing=1.0)  # fmt: skip


def _withstood(plan: Plan, of: str) -> Strip:
    """Return the extra forces at which a contact slips first, in three planes."""
    planes = withstood_in_planes(plan, PLANES)
    largest = max((float(np.nanmax(np.abs(forces))) for forces in planes if not np.all(np.isnan(forces))), default=0.0)
    span = 2.4 * largest or 1.0

    def draw(sheet: Sheet, top: float) -> None:
        for index, (plane, forces) in enumerate(zip(PLANES, planes, strict=True)):
            panel = sheet.panel(MARGIN + index * (SIDE + APART), top + 0.15, SIDE, SIDE, np.zeros(2), span)
            _directions(panel, forces, ["xyz"[axis] for axis in plane], span / 2)

    about = "of the linear model of the start posture" if of == "the start posture" else "about the true equilibria"
    title = (
        f"Extra force at the origin of the object at which a contact slips first, by direction, {about}, references "
        f"as planned; the cross reaches to {largest:.4g} N"
    )
    return Strip(title, SIDE + 0.25, draw)


def _directions(panel: Panel, forces: Array, names: list[str], half: float) -> None:
    reach = half / 1.2
    panel.strokes([np.array([[-reach, 0.0], [reach, 0.0]]), np.array([[0.0, -reach], [0.0, reach]])], FAINT, 0.8)
    if not np.any(np.isnan(forces)):
        panel.area(forces, GREY, 0.2, near=2)
    panel.strokes([np.vstack([forces, forces[:1]])], INK, 1.6, near=3)
    panel.note(np.array([reach * 1.1, 0.0]), names[0])
    panel.note(np.array([0.0, reach * 1.1]), names[1])


def _worth(bars: list[Sensitivity]) -> Strip:
    """Return what changes add to the largest margin, and to the worst one under these references."""
    high = BAR * len(bars)

    def draw(sheet: Sheet, top: float) -> None:
        colors = [INK if each.kind == LARGEST else GREY for each in bars]
        draw_worth(sheet, Box(NAMES, top + 0.1, WIDTH - NAMES - MARGIN, high), bars, colors)

    title = (
        "What changes add, each by 1 % of a number, 1 mm of a contact or 1 deg of its normal: dark to the largest "
        "margin that there is, grey to the worst margin under these references"
    )
    return Strip(title, high + BELOW + 0.1, draw)


def _timing(found: FastestTiming) -> Strip:
    """Return the share of the way over time, at the fastest timing and as it is asked."""

    def draw(sheet: Sheet, top: float) -> None:
        axes = sheet.chart(LEFT, top + ABOVE, WIDTH - LEFT - MARGIN, HIGH)
        if found.given_share is not None:
            given = np.linspace(0.0, found.given_s, len(found.given_share))
            axes.plot(
                given,
                100 * found.given_share,
                color=GREY,
                lw=1.4,
                ls=(0, (4, 3)),
                label=f"as asked, {found.given_s:.4g} s",
            )
        if found.path is not None and found.share is not None:
            axes.plot(found.path.times, 100 * found.share, color=INK, lw=1.8, label=f"fastest, {found.value:.4g} s")
        axes.margins(x=0.0)
        plain(axes, "time [s]", "way of the palm [%]")
        _legend(axes)

    return Strip("The fastest timing along the path of the palm", ABOVE + HIGH + BELOW, draw)
