"""What was seen in a physics engine as a picture, dashed beside it what the plan promised."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.lines import AXES, Lines
from synergrip.reports.pictures.plan_picture import draw_charts
from synergrip.reports.text.text_simulation import promised_word
from synergrip.simulation.notes import moment
from synergrip.simulation.simulation import Simulation
from synergrip.simulation.watching import SLIPPED


def draw_simulation(simulation: Simulation, path: Path) -> None:
    """Draw margins, slip and motion over the time of the plan; what was promised goes on where a play was ended.

    Args:
        simulation: what was seen.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    parts, times = simulation_lines(simulation)
    worst, contact, time = simulation.worst
    start, failed = float(simulation.knots[0]), simulation.failed_at
    since = "" if failed is None else f", first {moment(failed, start)}"
    under = (
        f"in MuJoCo, {simulation.speed}: {simulation.verdict}{since}; smallest margin {worst:.4g} N at {contact}, "
        f"{moment(time, start).removeprefix('at ')} ({simulation.promised_worst:.4g} N {promised_word(simulation)}); "
        f"dashed: as {promised_word(simulation)}, and limits"
    )
    draw_charts(parts, times, simulation.title, under, path)


def simulation_lines(simulation: Simulation) -> tuple[tuple[Lines, ...], Array]:
    """Return margins, slips and motion beside what was promised, and the times of both [s]."""
    slip = 1e3 * simulation.slip
    names, rest = tuple(simulation.contacts), simulation.knots > simulation.time[-1]
    margins, motion = simulation.knots_promised
    parts = (
        _chart("slip margin", "N", names, simulation.margin, (0.0,), np.vstack([simulation.promised, margins[rest]])),
        Lines("slip", "mm", names, np.vstack([slip, np.full((int(rest.sum()), len(names)), np.nan)]),
              (1e3 * SLIPPED,), of_contacts=True),
        *(
            _chart(title, unit, AXES, factor * simulation.du[:, part], (),
                   factor * np.vstack([simulation.promised_du, motion[rest]])[:, part])
            for title, unit, factor, part in (
                ("object displacement", "mm", 1e3, slice(0, 3)),
                ("object rotation", "deg", float(np.degrees(1)), slice(3, 6)),
            )
        ),
    )  # fmt: skip
    return parts, np.append(simulation.time, simulation.knots[rest])


def _chart(
    title: str, unit: str, names: tuple[str, ...], seen: Array, bounds: tuple[float, ...], target: Array
) -> Lines:
    """Return lines of what was seen (N, m) beside what was promised (N or more, m), which goes on where it ended."""
    gone = np.full((len(target) - len(seen), seen.shape[1]), np.nan)
    return Lines(title, unit, names, np.vstack([seen, gone]), bounds, target=target, of_contacts=names != AXES)
