"""What was seen in a physics engine as a picture, dashed beside it what the plan promised."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.courses import Chart
from synergrip.reports.pictures.plan_picture import draw_charts
from synergrip.simulation.simulation import SLIPPED, Simulation

AXES = ("x", "y", "z")


def draw_simulation(simulation: Simulation, path: Path) -> None:
    """Draw margins, slip and motion over the time of the plan.

    Args:
        simulation: what was seen.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    order = np.argsort(simulation.least, kind="stable")
    names = tuple(simulation.contacts[i] for i in order)
    bounds = (0.0,) if simulation.margin.min() < 0.1 * float(np.abs(simulation.margin).max()) else ()
    slip = 1e3 * simulation.slip[:, order]
    shown = (1e3 * SLIPPED,) if slip.max() > 0.1 * 1e3 * SLIPPED else ()
    parts = (
        Chart("slip margin", "N", names, simulation.margin[:, order], bounds, simulation.promised[:, order]),
        Chart("slip", "mm", names, slip, shown),
        _motion("object displacement", "mm", 1e3, simulation, slice(0, 3)),
        _motion("object rotation", "deg", float(np.degrees(1)), simulation, slice(3, 6)),
    )
    worst, contact, time = simulation.worst
    under = (
        f"in MuJoCo, {simulation.speed}: {simulation.verdict}; smallest margin {worst:.4g} N at {contact}, "
        f"{time:.4g} s ({simulation.promised_worst:.4g} N promised); dashed: as promised, and limits"
    )
    draw_charts(parts, simulation.time, simulation.title, under, path)


def _motion(title: str, unit: str, factor: float, simulation: Simulation, part: slice) -> Chart:
    def scaled(values: Array) -> Array:
        return factor * values[:, part]

    return Chart(title, unit, AXES, scaled(simulation.du), target=scaled(simulation.promised_du))
