"""A simulation as text: what became of each contact and of the object, beside what was promised."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from synergrip.documents.quantities import in_mm, plain
from synergrip.linalg import Array
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_plan import verdict_word
from synergrip.simulation.notes import moment
from synergrip.simulation.simulation import Simulation
from synergrip.simulation.watching import SLIPPED, SPUN


def simulation_text(simulation: Simulation, color: bool = False) -> str:
    """Return the answer of ``synergrip simulate``."""
    header, rows = contact_cells(simulation)
    cells = table(header, rows, right=range(1, len(header) - 1))
    lines = [simulation.title, how_played(simulation), "", cells, ""]
    for label, said in sentences(simulation):
        lines += wrapped(f"{label:9}", said)
    word = verdict_word("feasible" if simulation.verdict == "held" else "unknown", color)
    word = word.replace("feasible", "held").replace("unknown", simulation.verdict)
    return "\n".join([*lines, "", f"{word}  {became(simulation)}"])


def how_played(simulation: Simulation) -> str:
    """Return in which engine it was played, how fast, how finely, and with which friction."""
    how = "so slowly that inertia does not count" if simulation.speed == "slow" else "at the speed of the plan"
    friction = "" if simulation.friction == 1 else f", all friction multiplied by {simulation.friction:g}"
    return f"played in MuJoCo {how}, {simulation.step:g} s a step{friction}"


def sentences(simulation: Simulation) -> Iterator[tuple[str, str]]:
    """Yield what is told beside the contacts, each with the word that stands before it."""
    worst, contact, time = simulation.worst
    promised = f"{plain(simulation.promised_worst)} N {promised_word(simulation)}"
    if simulation.true_worst is not None:
        promised += f", {plain(simulation.true_worst)} N at the true equilibrium"
    when = moment(time, simulation.knots[0])
    yield "margin", f"{plain(worst)} N at least, {contact} {when} ({promised})"
    shift, turn = simulation.motion_error
    moved = [float(np.linalg.norm(part)) for part in np.split(simulation.du[-1], 2)]
    end = "at the end" if simulation.ended is None else "where the play was ended"
    yield (
        "motion",
        (
            f"{in_mm(moved[0], 4)} and {plain(np.degrees(moved[1]), 3)} deg {end}; "
            f"from the plan's motion at most {in_mm(shift)} and {plain(np.degrees(turn), 3)} deg"
        ),
    )
    if simulation.half_step is not None:
        margins, motion = simulation.half_step
        apart = f"margins differ by {plain(margins, 2)} N and the motion by {in_mm(motion, 2)} at most"
        yield "step", f"with half the step {apart}"
    if simulation.differences:
        yield "differs", _differs(simulation)
    for note in simulation.notes:
        yield "note", note


def promised_word(simulation: Simulation) -> str:
    """Return what a plan's own numbers are: promised, or claimed by a file that is not as it was written."""
    return "claimed" if simulation.as_written is False else "promised"


def became(simulation: Simulation) -> str:
    """Return what became of the contacts."""
    if simulation.lost:
        return _first("no touch at", simulation, simulation.lost, simulation.lost_at)
    if simulation.slipped:
        return _first("the object slipped at", simulation, simulation.slipped, simulation.slipped_at)
    if simulation.at_cone:
        parts = "; ".join(_creeping(simulation, name) for name in simulation.at_cone)
        return f"{parts}; slipped is from {1e3 * SLIPPED:g} mm or {plain(np.degrees(SPUN), 2)} deg on"
    moments = ", ".join(
        f"{name} for {plain(1e3 * time, 2)} ms"
        for name, time in zip(simulation.contacts, simulation.on_cone, strict=True)
        if time
    )
    return "every contact touched and none slipped" + (f"; at the cone for a moment: {moments}" if moments else "")


def _first(what: str, simulation: Simulation, names: Sequence[str], times: Array) -> str:
    """Return what became of contacts, and when the first of them was that far; times (n_c,)."""
    start = simulation.knots[0]
    at = [float(times[simulation.contacts.index(name)]) for name in names]
    first = min((time for time in at if not np.isnan(time)), default=None)
    when = f", first {moment(first, start)}" if first is not None else ""
    if simulation.failed_at is not None and simulation.failed_before:
        slipped = first is None or first >= start  # what is told came later than what failed first
        when += f"; the object slipped {moment(simulation.failed_at, start)}" if slipped else ""
        when += ", as pads stuck no longer and before anything moved"
    return f"{what} {', '.join(names)}{when}"


def _creeping(simulation: Simulation, name: str) -> str:
    i = simulation.contacts.index(name)
    start, end = simulation.cone_at[i]
    slid, spun = (float(each[i]) for each in simulation.crept)
    promised = simulation.promised_least[i]
    return (
        f"{name} had no margin from {plain(start, 3)} s to {plain(end, 3)} s ({plain(promised)} N "
        f"{promised_word(simulation)}) and crept {in_mm(slid, 2)} and {plain(np.degrees(spun), 2)} deg"
    )


def _differs(simulation: Simulation) -> str:
    word = promised_word(simulation)
    parts = ", ".join(
        f"{each.contact} has {plain(each.played)} N of {plain(each.promised)} N {word}"
        for each in simulation.differences
    )
    return f"{parts}: more than {plain(simulation.within, 2)} N apart; likely cause: {simulation.likely_cause}"


def contact_cells(simulation: Simulation) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Return the names of the columns and the cells of a table of the contacts."""
    header: tuple[str, ...] = ("contact", "margin", promised_word(simulation), "true", "at", "slip", "spin", "")
    rows, (slid, spun) = list[tuple[str, ...]](), simulation.crept
    for i, name in enumerate(simulation.contacts):
        true = "" if simulation.true is None else f"{plain(simulation.true[:, i].min())} N"
        words = {"lost": simulation.lost, "slipped": simulation.slipped, "at its cone": simulation.at_cone}
        word = next((word for word, names in words.items() if name in names), "held")
        rows.append(
            (
                name, f"{plain(simulation.least[i])} N", f"{plain(simulation.promised_least[i])} N", true,
                moment(float(simulation.least_at[i]), simulation.knots[0]).removeprefix("at "),
                in_mm(slid[i], 2), f"{plain(np.degrees(spun[i]), 2)} deg", word,
            )
        )  # fmt: skip
    if simulation.true is None:
        header, rows = header[:3] + header[4:], [row[:3] + row[4:] for row in rows]
    return header, rows
