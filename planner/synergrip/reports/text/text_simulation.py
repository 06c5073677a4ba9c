"""A simulation as text: what became of each contact and of the object, beside what was promised."""

from __future__ import annotations

import numpy as np

from synergrip.documents.quantities import in_mm, plain
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_plan import verdict_word
from synergrip.simulation.simulation import SLIPPED, SPUN, Simulation


def simulation_text(simulation: Simulation, color: bool = False) -> str:
    """Return the answer of ``synergrip simulate``."""
    how = "so slowly that inertia does not count" if simulation.speed == "slow" else "at the speed of the plan"
    lines = [simulation.title, f"played in MuJoCo {how}, {simulation.step:g} s a step", "", _contacts(simulation), ""]
    worst, contact, time = simulation.worst
    promised = f"{plain(simulation.promised_worst)} N promised"
    if simulation.true_worst is not None:
        promised += f", {plain(simulation.true_worst)} N at the true equilibrium"
    lines += wrapped("margin   ", f"{plain(worst)} N at least, {contact} at {plain(time)} s ({promised})")
    shift, turn = simulation.motion_error
    moved = [float(np.linalg.norm(part)) for part in np.split(simulation.du[-1], 2)]
    said = (
        f"{in_mm(moved[0], 4)} and {plain(np.degrees(moved[1]), 3)} deg at the end; "
        f"from the plan's motion at most {in_mm(shift)} and {plain(np.degrees(turn), 3)} deg"
    )
    lines += wrapped("motion   ", said)
    if simulation.half_step is not None:
        margins, motion = simulation.half_step
        said = (
            f"with half the step margins differ by {plain(margins, 2)} N and the motion by {in_mm(motion, 2)} at most"
        )
        lines += wrapped("step     ", said)
    if simulation.differences:
        lines += wrapped("differs  ", _differs(simulation))
    for note in simulation.notes:
        lines += wrapped("note     ", note)
    word = verdict_word("feasible" if simulation.verdict == "held" else "unknown", color)
    word = word.replace("feasible", "held").replace("unknown", simulation.verdict)
    return "\n".join([*lines, "", f"{word}  {_said(simulation)}"])


def _said(simulation: Simulation) -> str:
    if simulation.lost:
        return f"no touch at {', '.join(simulation.lost)}"
    if simulation.slipped:
        return f"the object slipped at {', '.join(simulation.slipped)}"
    if simulation.at_cone:
        parts = "; ".join(_creeping(simulation, name) for name in simulation.at_cone)
        return f"{parts}; slipped is from {1e3 * SLIPPED:g} mm or {plain(np.degrees(SPUN), 2)} deg on"
    moments = ", ".join(
        f"{name} for {plain(1e3 * time, 2)} ms"
        for name, time in zip(simulation.contacts, simulation.on_cone, strict=True)
        if time
    )
    return "every contact touched and none slipped" + (f"; at the cone for a moment: {moments}" if moments else "")


def _creeping(simulation: Simulation, name: str) -> str:
    i = simulation.contacts.index(name)
    start, end = simulation.cone_at[i]
    slid, spun = (float(each[i]) for each in simulation.crept)
    promised = simulation.promised_least[i]
    return (
        f"{name} had no margin from {plain(start, 3)} s to {plain(end, 3)} s ({plain(promised)} N promised) and "
        f"crept {in_mm(slid, 2)} and {plain(np.degrees(spun), 2)} deg"
    )


def _differs(simulation: Simulation) -> str:
    parts = ", ".join(
        f"{each.contact} has {plain(each.played)} N of {plain(each.promised)} N promised"
        for each in simulation.differences
    )
    return f"{parts}: more than {plain(simulation.within, 2)} N apart; likely cause: {simulation.likely_cause}"


def _contacts(simulation: Simulation) -> str:
    header: tuple[str, ...] = ("contact", "margin", "promised", "true", "at", "slip", "spin", "")
    rows, (slid, spun) = list[tuple[str, ...]](), simulation.crept
    for i, name in enumerate(simulation.contacts):
        true = "" if simulation.true is None else f"{plain(simulation.true[:, i].min())} N"
        words = {"lost": simulation.lost, "slipped": simulation.slipped, "at its cone": simulation.at_cone}
        word = next((word for word, names in words.items() if name in names), "held")
        rows.append(
            (
                name, f"{plain(simulation.least[i])} N", f"{plain(simulation.promised_least[i])} N", true,
                f"{plain(simulation.least_at[i])} s", in_mm(slid[i], 2), f"{plain(np.degrees(spun[i]), 2)} deg", word,
            )
        )  # fmt: skip
    if simulation.true is None:
        header, rows = header[:3] + header[4:], [row[:3] + row[4:] for row in rows]
    return table(header, rows, right=range(1, len(header) - 1))
