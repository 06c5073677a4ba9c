"""What a document of an answer has over time, as lines to be drawn, in the units in which people read them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.documents.quantities import SHOWN_IN
from synergrip.linalg import Array

SHARES = ("joint torque", "actuator effort")
"""Limits that are shown in percent of what each joint or actuator may do."""
AXES = ("x", "y", "z")


@dataclass(frozen=True, eq=False)
class Lines:
    """Some lines over the knots."""

    title: str
    unit: str
    names: tuple[str, ...]
    values: Array  # (T, m)
    bounds: tuple[float, ...] = ()
    """Levels that no line passes."""
    of_contacts: bool = False
    """Whether the lines are those of contacts, which have the same colours everywhere."""


def lines_of(document: Mapping[str, Any]) -> tuple[Lines, ...]:
    """Return margins, forces, every other limit, the references and the motion of the object."""
    return tuple([*_contacts(document), *_limits(document), *_references(document), *_motion(document)])


def _contacts(document: Mapping[str, Any]) -> Iterator[Lines]:
    """Yield slip margins with what is asked of them, and sizes of forces where these are known as vectors."""
    names = tuple(document["contacts"])
    for limit in document.get("limits", ()):
        if "series" in limit and limit["name"] == "slip margin":
            yield Lines("slip margin", "N", names, _values(limit), _levels(limit, 1.0), of_contacts=True)
    forces = document.get("true", {}).get("force_N")
    if forces is not None:
        yield Lines("contact force", "N", names, np.linalg.norm(np.array(forces), axis=2), of_contacts=True)


def _limits(document: Mapping[str, Any]) -> Iterator[Lines]:
    """Yield every limit but the margins: in percent where each joint has its own, else as it is."""
    contacts = tuple(document["contacts"])
    for limit in document.get("limits", ()):
        if "series" not in limit or limit["name"] == "slip margin":
            continue
        names, values = tuple(limit["series"]["items"]), _values(limit)
        if limit["name"] in SHARES and (shares := _shares(limit, values)) is not None:
            order = np.argsort(-np.abs(shares).max(axis=0), kind="stable")
            yield Lines(limit["name"], "% of limit", tuple(names[i] for i in order), shares[:, order], (-100.0, 100.0))
            continue
        factor, unit = SHOWN_IN.get(limit["unit"], (1.0, limit["unit"]))
        own = names == contacts
        order = np.arange(len(names)) if own else np.argsort(-np.abs(values).max(axis=0), kind="stable")
        shown = factor * values[:, order]
        yield Lines(limit["name"], unit, tuple(names[i] for i in order), shown, _levels(limit, factor), of_contacts=own)


def _references(document: Mapping[str, Any]) -> Iterator[Lines]:
    references = document.get("dz_r") or document.get("true", {}).get("dz_r")
    if references is not None:
        values = np.array(references)
        order = np.argsort(-np.abs(values).max(axis=0), kind="stable")
        yield Lines("synergy reference", "", tuple(document["synergies"][i] for i in order), values[:, order])


def _motion(document: Mapping[str, Any]) -> Iterator[Lines]:
    du = document.get("du") or document.get("true", {}).get("du")
    if du is not None:
        for title, unit, part in (("object displacement", "m", slice(0, 3)), ("object rotation", "rad", slice(3, 6))):
            factor, shown = SHOWN_IN[unit]
            yield Lines(title, shown, AXES, factor * np.array(du)[:, part])


def _values(limit: Mapping[str, Any]) -> Array:
    return np.array(limit["series"]["values"], dtype=float)


def _levels(limit: Mapping[str, Any], factor: float) -> tuple[float, ...]:
    """Return the bounds that all lines have in common."""
    sides = [set(limit["series"][side]) for side in ("lower", "upper")]
    return tuple(factor * level for side in sides if len(side) == 1 for level in side if level is not None)


def _shares(limit: Mapping[str, Any], values: Array) -> Array | None:
    """Return values in percent of the bound on their side; None where a side of one has none, or 0."""
    lower, upper = (_known(limit["series"][side]) for side in ("lower", "upper"))
    if np.any(~np.isfinite(upper)) or np.any(upper <= 0) or np.any(~np.isfinite(lower)) or np.any(lower >= 0):
        return None
    return np.where(values >= 0, 100 * values / upper, -100 * values / lower)


def _known(bounds: Sequence[float | None]) -> Array:
    return np.array([np.nan if bound is None else bound for bound in bounds], dtype=float)
