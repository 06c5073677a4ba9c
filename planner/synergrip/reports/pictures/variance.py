"""Explained variance as a picture: how much of the recorded postures each synergy accounts for."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.layout import MARGIN
from synergrip.reports.pictures.page import SPACE, Heading
from synergrip.reports.pictures.sheet import BLUE, INK, SKY, Sheet, write_picture

WIDEST, HEIGHT, EACH, LABELS = 12.0, 3.6, 0.55, 0.75  # [inch]
MOST_LABELLED = 16
"""With more synergies than this the sums are not written at their points."""


def draw_variance(shares: Array, path: Path, title: str) -> None:
    """Draw the share (n_z,) of each synergy, 0 to 1, as bars and their running sum as a line.

    Args:
        shares: explained variance, first that of the first synergy.
        path: ends in .svg, .png or .pdf.
        title: heading of the picture.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    count = len(shares)
    width = float(np.clip(EACH * count + 2 * LABELS, 6.5, WIDEST))
    heading = Heading.of(title, "", width)
    top = heading.height + SPACE

    def draw(sheet: Sheet) -> None:
        heading.write(sheet)
        axes = sheet.chart(LABELS, top, width - LABELS - MARGIN, HEIGHT)
        numbers, percent = np.arange(1, count + 1), 100 * np.asarray(shares)
        total = np.cumsum(percent)
        axes.bar(numbers, percent, width=0.7, color=SKY, label="each")
        axes.plot(numbers, total, color=BLUE, marker="o", ms=5, lw=2, label="together")
        if count <= MOST_LABELLED:
            for number, value in zip(numbers, total, strict=True):
                axes.annotate(f"{value:.3g}", (number, value), (0, 7), textcoords="offset points", ha="center",
                              fontsize=9, color=INK)  # fmt: skip
        axes.set(xlim=(0.4, count + 0.6), ylim=(0, 110), xlabel="synergies", ylabel="explained variance [%]")
        axes.set_xticks(numbers[:: 1 + count // 25])
        axes.set_yticks(range(0, 101, 20))
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(frameon=False, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)

    write_picture(path, width, top + HEIGHT + LABELS, draw)
