"""A problem as a notebook shows it: what holds what with which contacts, what is asked, and the limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from synergrip.conic.limits.friction_cone import FRICTION
from synergrip.conic.limits.limit import Limit
from synergrip.documents.quantities import plain, read_as
from synergrip.errors import shortened
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.problems.in_short import asked_in_short, read_in_short
from synergrip.tasks.gravity import Gravity
from synergrip.values import brief

if TYPE_CHECKING:
    from synergrip.problems.problem import Problem

MOST, LONG = 12, 160
"""Contacts that are listed, and letters of a line."""


def problem_html(problem: Problem) -> str:
    """Return a problem as HTML; what comes from the user is escaped."""
    title = f"<p><b>{escape(shortened(problem.name))}</b>: {escape(shortened(problem.title, LONG))}</p>"
    rows = "".join(
        f"<tr><th>{escape(name)}</th><td>{'<br>'.join(escape(shortened(each, LONG)) for each in told)}</td></tr>"
        for name, told in _rows(problem)
    )
    return f"{title}<table>{rows}</table>"


def _rows(problem: Problem) -> Iterator[tuple[str, Sequence[str]]]:
    """Yield what each row is about, and its lines."""
    grasp = problem.grasp
    yield "grasp", [*read_in_short(grasp)]
    if grasp.held is not None:
        yield "object at", [_place(grasp.held.body.position)]
    contacts = grasp.contacts
    told = [_contact(contact) for contact in contacts[:MOST]]
    yield "contacts", [*told, *([f"and {len(contacts) - MOST} more"] if len(contacts) > MOST else [])]
    yield "task", [*asked_in_short(problem.timed)]
    for load in problem.task.loads:
        if isinstance(load, Gravity):
            vector = ", ".join(plain(each, 3) for each in load.acceleration)
            yield "gravity", [f"({vector}) m/s² in the palm frame at the start"]
    limits = [limit.on(grasp) for limit in problem.task.limits]
    yield "limits", [line for limit in limits for line in _limit(limit, grasp)] or ["none"]
    if problem.notes:
        yield "notes", problem.notes


def _place(position: Array) -> str:
    return f"({', '.join(plain(1e3 * each, 4) for each in position)}) mm in the palm frame"


def _limit(limit: Limit, grasp: Grasp) -> Iterator[str]:
    """Yield the keys of a limit in a file with their values; of different ones for joints or synergies the largest."""
    dials = limit.dials(grasp)
    each = getattr(limit, "limit", None)
    most = "up to " if isinstance(each, np.ndarray) and len(set(each.ravel().tolist())) > 1 else ""
    for dial in dials:
        ranges = f"{'' if dial.value == 1 else f'{plain(dial.value)} times '}the ranges of the hand"
        value = ranges if dial.cause == "joint_range" else most + read_as(dial.value, dial.unit)
        yield f"{dial.key} = {value}"
    if not dials:  # friction alone, or a limit of the user's own
        yield limit.key if limit.key == FRICTION else f"{limit.key} {_numbers(limit)}".rstrip()


def _numbers(limit: object) -> str:
    """Return the arguments of a limit; of many only how many there are."""
    numbers = fields(limit) if is_dataclass(limit) else ()
    return ", ".join(brief(getattr(limit, each.name)) for each in numbers if each.repr)


def _contact(contact: Contact) -> str:
    numbers = [
        (each.name.replace("_", " "), read_as(getattr(contact.kind, each.name), "m" if each.length else "", 4))
        for each in contact.kind.parameters
    ]
    told = "".join(f", {name} {value}" for name, value in numbers)
    return f"{contact.name}: {contact.kind.title}{told}"
