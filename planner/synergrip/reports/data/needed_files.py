"""What a task comes to with k synergies, as JSON and as a table in a CSV file."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from synergrip.explain.synergies.needed_points import NeededPoint
from synergrip.explain.synergies.synergies_needed import SynergiesNeeded
from synergrip.files import atomic_path

COLUMNS = (
    "chosen", "n_z", "synergies", "verdict", "stage", "certified", "largest_margin_N", "effort_N", "peak_normal_N",
    "outside_m", "tracking_error_m", "every_subset",
)  # fmt: skip


def needed_document(needed: SynergiesNeeded) -> dict[str, Any]:
    """Return all of it; a margin that nothing bounds is null, and said to be unbounded."""
    none = needed.proven and len(needed.best) == len(needed.synergies)
    return {
        "verdict": "feasible" if needed.fewest else "infeasible" if none else "unknown",
        "set": needed.set or None, "synergies": list(needed.synergies), "by": needed.by, "model": needed.model,
        "first": [_point(point) for point in needed.first],
        "best": [_point(point) | {"every_subset": point.every} for point in needed.best],
        "fewest": needed.fewest, "proven": needed.proven,
        "minimal": [list(names) for names in needed.minimal], "all_minimal": needed.all_minimal,
        "refuted": [{"n_z": size, "looked_at": looked_at, "certified": refuted}
                    for size, (looked_at, refuted) in enumerate(needed.refuted, 1)],
        "interrupted": needed.interrupted,
    }  # fmt: skip


def _point(point: NeededPoint) -> dict[str, Any]:
    unbounded = point.largest_margin is not None and math.isinf(point.largest_margin)
    return {
        "n_z": len(point.synergies), "synergies": list(point.synergies), "verdict": point.verdict,
        "stage": point.stage or None, "certified": point.certified,
        "largest_margin_N": None if unbounded else point.largest_margin, "unbounded": unbounded,
        "effort_N": point.effort, "peak_normal_N": point.peak, "outside_m": point.outside,
        "tracking_error_m": point.tracking_error,
    }  # fmt: skip


def write_needed(needed: SynergiesNeeded, path: Path) -> None:
    """Write a line for each number of synergies, first those with the first k; figures that there are not stay empty.

    Raises:
        OSError: the file cannot be written.
    """
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(COLUMNS)
    lines.writerows(_lines(needed))
    with atomic_path(path) as temporary:
        temporary.write_text(text.getvalue(), encoding="utf-8")


def _lines(needed: SynergiesNeeded) -> Iterator[tuple[object, ...]]:
    for chosen, points in (("first", needed.first), ("best", needed.best)):
        for point in points:
            yield (
                chosen, len(point.synergies), " ".join(point.synergies), point.verdict, point.stage, point.certified,
                point.largest_margin, point.effort, point.peak, point.outside, point.tracking_error,
                point.every if chosen == "best" else "",
            )  # fmt: skip
