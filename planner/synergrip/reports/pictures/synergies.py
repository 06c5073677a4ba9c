"""The synergies of a hand as a picture: how each of them moves it."""

from __future__ import annotations

from pathlib import Path

from synergrip.hands.hand import Hand, SynergySet
from synergrip.linalg import Array
from synergrip.reports.pictures.bearings import HIGH, draw_bearings, draw_scale
from synergrip.reports.pictures.layout import COLUMN, MARGIN, MOST, Columns, size_that_fits, window
from synergrip.reports.pictures.legend import MOTION_NOTE, left_out
from synergrip.reports.pictures.motions import draw_motion, motions
from synergrip.reports.pictures.page import SPACE, Foot, Page
from synergrip.reports.pictures.sheet import Sheet

TITLE = 0.32  # [inch]


def draw_synergies(hand: Hand, synergies: SynergySet, q: Array, path: Path) -> None:
    """Draw the hand at `q` (n_q,) and moved by each synergy alone, into `path` (.svg, .png or .pdf).

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    moved = motions(hand, synergies, q, tuple(hand.pads.values()), MOST)
    view = moved.view()
    shown = window(view.flat(moved.points))

    def draw(sheet: Sheet, index: int, left: float, top: float) -> None:
        motion = moved.each[index]
        size = size_that_fits(motion.title, 0.9 * COLUMN, 11)
        sheet.write(left + COLUMN / 2, top + 0.2, motion.title, size, across="center", bold=True)
        panel = sheet.panel(left, top + TITLE, COLUMN, shown.height, shown.middle, shown.span)
        draw_motion(panel, view, moved.rest, motion)

    def foot(sheet: Sheet, top: float) -> None:
        wide = draw_bearings(sheet, view, MARGIN, top, None)
        draw_scale(sheet, MARGIN + wide + 0.1, top + HIGH / 2 + 0.12, shown.span / COLUMN, 0.8)

    page = Page(
        hand.title, synergies.title or synergies.name, Columns(len(moved.each)), TITLE + shown.height,
        (MOTION_NOTE + left_out(len(synergies.synergies)),), Foot(HIGH + SPACE, foot),
    )  # fmt: skip
    page.write(path, draw)
