"""How a plan held in a physics engine, as a part of its report, with the words of ``synergrip simulate``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from synergrip.reports.data.saved_simulation import FILE, saved_simulation
from synergrip.reports.html.charts import charts_of
from synergrip.reports.html.tables import Cell, Table, in_folder
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.simulation_picture import simulation_lines
from synergrip.reports.text.text_simulation import became, contact_cells, how_played, promised_word, sentences
from synergrip.simulation.simulation import Simulation

ANCHOR, TITLE = "physics", "In a physics engine"
ADDED_BY = "`synergrip simulate FOLDER -o FOLDER`, then `synergrip report FOLDER`, add how it holds in a physics engine"
DRAWN = ("slip margin", "slip")
"""Charts; what the object does is told by the largest distance from what was promised."""


def physics_of(document: Mapping[str, Any], beside: Path | None, folder: Path | None = None) -> Iterator[Table]:
    """Yield what became of a plan that can be played, from the simulation of it that was saved.

    Args:
        document: of the answer, as in plan.json.
        beside: folder in which a simulation is looked for, if any.
        folder: of plan.json, where it is known.
    """
    if not _playable(document):
        return
    found = None if beside is None else saved_simulation(beside, document)
    if isinstance(found, Simulation):
        yield _played(found)
    else:
        left_out = (f"{FILE} beside it {found}; it is left out.",) if found else ()
        yield Table(ANCHOR, TITLE, before=(*left_out, f"{in_folder(ADDED_BY, folder)}."))


def _playable(document: Mapping[str, Any]) -> bool:
    """Tell whether there is a plan of a hand for an object with a surface, which is what can be played."""
    told = document.get("execution") or {}
    return document["verdict"] == "feasible" and (told.get("object") or {}).get("shape") is not None


def _played(simulation: Simulation) -> Table:
    header, told = contact_cells(simulation)
    colors, last = contact_colors(simulation.contacts), len(header) - 1
    rows = tuple(
        tuple(Cell(text, 0 < i < last, color=colors[row[0]] if i == 0 else "") for i, text in enumerate(row))
        for row in told
    )
    lines, times = simulation_lines(simulation)
    charts = charts_of(times, [each for each in lines if each.title in DRAWN])
    return Table(
        ANCHOR, TITLE, header, rows, drawn=tuple(chart.svg for chart in charts),
        before=(f"{simulation.verdict}: {became(simulation)}", how_played(simulation)),
        after=(
            *(f"{label}: {said}" for label, said in sentences(simulation)),
            f"dashed below: as {promised_word(simulation)}, and limits",
        ),
    )  # fmt: skip
