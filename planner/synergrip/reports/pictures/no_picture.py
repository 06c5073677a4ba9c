"""A task without a plan as a picture: what the least bad forces miss, over time, and what is to blame."""

from __future__ import annotations

from pathlib import Path

from synergrip.explain.compromise import Compromise
from synergrip.explain.explanation import Explanation
from synergrip.planning.told import series_document
from synergrip.reports.pictures.lines import Lines, limit_lines
from synergrip.reports.pictures.plan_picture import draw_charts


def draw_no(known: Explanation, least: Compromise, title: str, path: Path) -> None:
    """Draw what is missing over time, what is blamed marked in its title.

    Args:
        known: why there is no plan.
        least: the motion that breaks limits by as little as possible.
        title: heading of the picture.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    parts = [Lines("missing, share of each limit or of the load", "", ("missing",), least.missing[:, None], (0.0,))]
    missed = [usage for usage in least.usages if float((usage.excess / usage.size).max()) > 0]
    contacts = least.usages[0].items  # of the friction cones
    parts += [limit_lines(series_document(usage), contacts) for usage in missed]
    draw_charts(parts, least.times, f"{title}: no plan", known.text, path)
