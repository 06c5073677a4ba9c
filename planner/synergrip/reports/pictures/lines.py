"""What an answer has over time, as lines to be drawn, in the units in which people read them.

They are made from the document of an answer (plan.json), so that a saved one shows what a new one does.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.documents.quantities import SHOWN_IN
from synergrip.linalg import Array
from synergrip.planning.arrays import measures_of
from synergrip.planning.outcome import Plan
from synergrip.planning.told import series_document, true_document

SHARES = ("joint torque", "actuator effort")
"""Limits that are shown in percent of what each joint or actuator may do, also when all may do the same."""
AXES = ("x", "y", "z")


@dataclass(frozen=True, eq=False)
class Lines:
    """Some lines over the knots."""

    title: str
    unit: str
    names: tuple[str, ...]
    """Of contacts in the order of the grasp, else what comes nearest to a bound first."""
    values: Array  # (T, m)
    bounds: tuple[float, ...] = ()
    """Levels that no line passes."""
    own: Array | None = None
    """(2, m) the least and the largest of each line, where they differ and no percentage says it; NaN for none."""
    target: Array | None = None
    """(T, m) where the lines are wanted."""
    of_contacts: bool = False
    """Whether the lines are those of contacts, which have the same colours everywhere."""

    @property
    def label(self) -> str:
        """Title with its unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title


def lines_of(document: Mapping[str, Any], wanted: Array | None = None) -> tuple[Lines, ...]:
    """Return margins, forces, every other limit, the references and the motion of the object.

    Args:
        document: of an answer.
        wanted: (T, 6) where the object is to be [m, rad].
    """
    parts = [*_contacts(document), *_limits(document), *_references(document), *_motion(document, wanted)]
    return tuple(parts)


def plan_lines(plan: Plan) -> tuple[Lines, ...]:
    """Return the lines of a plan, with where the object is wanted."""
    grasp, motion = plan.grasp, plan.motion
    document: dict[str, Any] = {
        "contacts": grasp.contact_names, "synergies": grasp.synergies,
        "limits": [series_document(usage) for usage in plan.usages], "dz_r": motion.dz_r, "du": motion.du,
        "lambda": motion.forces, **measures_of(grasp),
    }  # fmt: skip
    if plan.executed is not None:
        document["true"] = {"force_N": true_document(plan.executed, plan.usages[0])["force_N"]}
    return lines_of(document, plan.formulation.target)


def limit_lines(limit: Mapping[str, Any], contacts: Sequence[str]) -> Lines:
    """Return the lines of a limit of a document.

    Bounds that all lines have in common stay as they are. Where each line has its own, the lines are in percent: of
    the bound on their side of 0 where there are two, of the way from one to the other where both are on the same side.
    """
    names, values, own = tuple(limit["series"]["items"]), _values(limit), None
    factor, unit = SHOWN_IN.get(limit["unit"], (1.0, limit["unit"]))
    shown, bounds, of_contacts = factor * values, _levels(limit, factor), names == tuple(contacts)
    low, high = (_known(limit["series"][side]) for side in ("lower", "upper"))
    if limit["name"] in SHARES or not _common(limit):
        if np.all(low < 0) and np.all(high > 0):
            shown, unit, bounds = np.where(values >= 0, 100 * values / high, -100 * values / low), "% of limit", PERCENT
        elif np.all(high > low) and not _common(limit):
            shown, unit, bounds = 100 * (values - low) / (high - low), "% of its range", (0.0, 100.0)
        elif not _common(limit):
            own = factor * np.array([low, high])
    order = np.arange(len(names)) if of_contacts else np.argsort(-_nearness(shown, bounds, own), kind="stable")
    return Lines(
        limit["name"], unit, tuple(names[i] for i in order), shown[:, order], bounds,
        own=None if own is None else own[:, order], of_contacts=of_contacts,
    )  # fmt: skip


PERCENT = (-100.0, 100.0)


def _nearness(values: Array, bounds: Sequence[float], own: Array | None) -> Array:
    """Return how near each line comes to a bound (m,), or how large it gets where it has none."""
    if own is not None:
        return np.asarray(np.nanmax(np.stack([own[0] - values, values - own[1]]), axis=(0, 1), initial=-np.inf))
    if not bounds:
        return np.asarray(np.abs(values).max(axis=0))
    beyond = [values - bounds[-1], bounds[0] - values] if len(bounds) == 2 else [-np.abs(values - bounds[0])]
    return np.asarray(np.max(beyond, axis=(0, 1)))


def _contacts(document: Mapping[str, Any]) -> Iterator[Lines]:
    """Yield slip margins with what is asked of them, and sizes of forces where these are known as vectors."""
    names = tuple(document["contacts"])
    limits = {limit["name"]: limit for limit in document.get("limits", ()) if "series" in limit}
    if (margins := limits.get("slip margin")) is not None:
        yield Lines("slip margin", "N", names, _values(margins), _levels(margins, 1.0), of_contacts=True)
    forces = document.get("true", {}).get("force_N")
    if forces is not None:
        yield Lines("contact force", "N", names, np.linalg.norm(np.array(forces), axis=2), of_contacts=True)
    elif "lambda" in document and "normal force" not in limits:
        starts = np.cumsum([0, *(len(components) for components in document["components"])])[:-1]
        yield Lines("normal force", "N", names, np.array(document["lambda"])[:, starts], of_contacts=True)


def _limits(document: Mapping[str, Any]) -> Iterator[Lines]:
    """Yield every limit but the margins."""
    for limit in document.get("limits", ()):
        if "series" in limit and limit["name"] != "slip margin":
            yield limit_lines(limit, document["contacts"])


def _references(document: Mapping[str, Any]) -> Iterator[Lines]:
    references = document.get("dz_r") if document.get("dz_r") is not None else document.get("true", {}).get("dz_r")
    if references is not None and "synergy reference" not in {limit["name"] for limit in document.get("limits", ())}:
        values = np.array(references)
        order = np.argsort(-np.abs(values).max(axis=0), kind="stable")
        units = {*(document.get("units") or {}).get("synergies", ())}
        unit = next(iter(units)) if len(units) == 1 else None  # as different units have no axis in common
        yield Lines("synergy reference", unit or "", tuple(document["synergies"][i] for i in order), values[:, order])


def _motion(document: Mapping[str, Any], wanted: Array | None) -> Iterator[Lines]:
    du = document.get("du") if document.get("du") is not None else document.get("true", {}).get("du")
    if du is not None:
        for title, unit, part in (("object displacement", "m", slice(0, 3)), ("object rotation", "rad", slice(3, 6))):
            factor, shown = SHOWN_IN[unit]
            target = None if wanted is None else factor * wanted[:, part]
            yield Lines(title, shown, AXES, factor * np.array(du)[:, part], target=target)


def _values(limit: Mapping[str, Any]) -> Array:
    return np.array(limit["series"]["values"], dtype=float)


def _common(limit: Mapping[str, Any]) -> bool:
    """Tell whether all lines have the same bounds."""
    return all(len(set(limit["series"][side])) == 1 for side in ("lower", "upper"))


def _levels(limit: Mapping[str, Any], factor: float) -> tuple[float, ...]:
    """Return the bounds that all lines have in common."""
    sides = [set(limit["series"][side]) for side in ("lower", "upper")]
    return tuple(factor * level for side in sides if len(side) == 1 for level in side if level is not None)


def _known(bounds: Sequence[float | None]) -> Array:
    return np.array([np.nan if bound is None else bound for bound in bounds], dtype=float)
