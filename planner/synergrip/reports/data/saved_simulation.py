"""A simulation that was saved, as it is found again beside the plan that it played."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.reports.data.beside_plan import found_beside
from synergrip.reports.data.simulation_files import NAMES
from synergrip.simulation.differences import Difference
from synergrip.simulation.simulation import Simulation
from synergrip.simulation.told_values import Told

FILE = NAMES[0]


def saved_simulation(folder: Path, plan: Mapping[str, Any]) -> Simulation | str | None:
    """Return the simulation of this very plan in a folder, why that which is there is none, or None without any.

    Args:
        folder: where simulation.json is looked for.
        plan: document of the plan, as in plan.json, whose digest has been judged.
    """
    return found_beside(folder / FILE, "simulation", plan, lambda data: simulation_of(data, plan))


def simulation_of(document: Mapping[str, Any], plan: Mapping[str, Any]) -> Simulation:
    """Return the simulation that `simulation_document` told, but for its model, which has a file of its own.

    Args:
        document: of the simulation.
        plan: document of the plan that was played; it has what was promised at the knots.

    Raises:
        InputError: a value that is none.
    """
    told, of_plan = Told(document, ""), Told(plan, "plan")
    names, joints = tuple(told.texts("contacts")), tuple(told.texts("joints"))
    time, knots, n_c = told.array("time_s", (None,)), of_plan.array("time_s", (None,)), len(names)
    margin, promised, differs = (told.inside(name) for name in ("margin", "promised", "differs"))
    true = told.perhaps("true", Told.inside)
    half = told.perhaps("half_step", Told.inside)
    series = (len(time), n_c)
    return Simulation(
        title=told.text("title"), contacts=names, joints=joints, speed=told.text("speed"), step=told.number("step_s"),
        friction=told.number("friction_factor"), time=time, forces=told.array("lambda", (len(time), None)),
        margin=margin.array("per_contact_N", series), promised=promised.array("per_contact_N", series),
        true=None if true is None else true.array("per_contact_N", series), slip=told.array("slip_m", series),
        spin=told.array("spin_rad", series), touching=told.array("touching", series),
        du=told.array("du", (len(time), 6)), promised_du=promised.array("du", (len(time), 6)),
        q=told.array("q", (len(time), len(joints))), least=margin.array("least_N", (n_c,)),
        least_at=margin.array("least_at_s", (n_c,)), apart=told.array("apart_s", (n_c,)),
        on_cone=told.array("on_cone_s", (n_c,)), cone_at=_with_gaps(told, "cone_at_s", (n_c, 2)),
        promised_least=promised.array("least_N", (n_c,)), promised_worst=promised.number("worst_N"),
        true_worst=None if true is None else true.number("worst_N"),
        half_step=None if half is None else (_or_nan(half, "margin_N"), _or_nan(half, "shift_m")),
        within=differs.number("more_than_N"), differences=_differences(differs),
        likely_cause=differs.perhaps("likely_cause", Told.text), notes=tuple(told.texts("notes")), model="",
        as_written=told.get("as_written"), lost_at=_with_gaps(told, "lost_at_s", (n_c,)),
        slipped_at=_with_gaps(told, "slipped_at_s", (n_c,)),
        ended=told.perhaps("ended_at_s", Told.number), knots=knots,
        knots_promised=(
            of_plan.inside("margin").array("per_contact_N", (len(knots), n_c)), of_plan.array("du", (len(knots), 6))
        ),
        plan_digest=told.text("plan_sha256"),
    )  # fmt: skip


def _differences(differs: Told) -> tuple[Difference, ...]:
    found = differs.several("contacts") if differs.get("contacts") else ()
    return tuple(Difference(each.text("contact"), each.number("played_N"), each.number("promised_N")) for each in found)


def _or_nan(told: Told, name: str) -> float:
    return np.nan if told.get(name) is None else told.number(name)


def _with_gaps(told: Told, name: str, shape: tuple[int, ...]) -> Array:
    """Return numbers of a shape, NaN in the rows that are null."""
    rows = told.get(name)
    if not isinstance(rows, list) or len(rows) != shape[0]:
        raise told.refused(name, f"expected a list of {shape[0]}")
    known = [i for i, row in enumerate(rows) if row is not None]
    found = np.full(shape, np.nan)
    if known:
        values = {name: [rows[i] for i in known]}
        found[known] = Told(values, told.key).array(name, (len(known), *shape[1:]))
    return frozen(found)
