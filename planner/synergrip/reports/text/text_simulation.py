"""A simulation as text: what became of each contact and of the object, beside what was promised."""

from __future__ import annotations

import numpy as np

from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_plan import verdict_word
from synergrip.simulation.simulation import Simulation

SHORT = 0.05
"""[N] by how much a margin must be below the promised one to be told of."""


def simulation_text(simulation: Simulation, color: bool = False) -> str:
    """Return the answer of ``synergrip simulate``."""
    how = "so slowly that inertia does not count" if simulation.speed == "slow" else "at the speed of the plan"
    lines = [simulation.title, f"played in MuJoCo {how}, {simulation.step:g} s a step", "", _contacts(simulation), ""]
    worst, contact, time = simulation.worst
    promised = f"{simulation.promised_worst:.4g} N promised"
    if simulation.true_worst is not None:
        promised += f", {simulation.true_worst:.4g} N at the true equilibrium"
    lines += wrapped("margin   ", f"{worst:.4g} N at least, {contact} at {time:.4g} s ({promised})")
    shift, turn = simulation.motion_error
    moved = np.linalg.norm(simulation.du[-1, :3]), np.linalg.norm(simulation.du[-1, 3:])
    said = (
        f"{1e3 * moved[0]:.4g} mm and {np.degrees(moved[1]):.3g} deg at the end; "
        f"from the plan's motion at most {1e3 * shift:.3g} mm and {np.degrees(turn):.3g} deg"
    )
    lines += wrapped("motion   ", said)
    if simulation.half_step is not None:
        margins, motion = simulation.half_step
        said = f"with half the step margins differ by {margins:.2g} N and the motion by {1e3 * motion:.2g} mm at most"
        lines += wrapped("step     ", said)
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
    short = simulation.promised_worst - simulation.worst[0]
    less = f"; the smallest margin is {short:.2g} N below the promised one" if short > SHORT else ""
    return f"every contact touched and none slipped{less}"


def _contacts(simulation: Simulation) -> str:
    header: tuple[str, ...] = ("contact", "margin", "promised", "true", "at", "slip", "spin", "")
    rows = list[tuple[str, ...]]()
    for i, name in enumerate(simulation.contacts):
        true = "" if simulation.true is None else f"{simulation.true[:, i].min():.4g} N"
        word = "lost" if name in simulation.lost else "slipped" if name in simulation.slipped else "held"
        rows.append(
            (
                name, f"{simulation.least[i]:.4g} N", f"{simulation.promised[:, i].min():.4g} N", true,
                f"{simulation.least_at[i]:.4g} s", f"{1e3 * simulation.slip[:, i].max():.2g} mm",
                f"{np.degrees(np.abs(simulation.spin[:, i]).max()):.2g} deg", word,
            )
        )  # fmt: skip
    if simulation.true is None:
        header, rows = header[:3] + header[4:], [row[:3] + row[4:] for row in rows]
    return table(header, rows, right=range(1, len(header) - 1))
