"""A problem as a notebook shows it: what holds what with which contacts, what is asked, and the limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from html import escape
from typing import TYPE_CHECKING

from synergrip.errors import shortened
from synergrip.grasps.contacts.contact import Contact
from synergrip.problems.in_short import asked_in_short, read_in_short
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
    yield "grasp", [*read_in_short(problem.grasp)]
    contacts = problem.grasp.contacts
    told = [_contact(contact) for contact in contacts[:MOST]]
    yield "contacts", [*told, *([f"and {len(contacts) - MOST} more"] if len(contacts) > MOST else [])]
    yield "task", [*asked_in_short(problem.timed)]
    yield "limits", [_limit(limit) for limit in problem.task.limits] or ["none"]
    if problem.notes:
        yield "notes", problem.notes


def _limit(limit: object) -> str:
    """Return a limit with its numbers; of many only how many there are."""
    numbers = fields(limit) if is_dataclass(limit) else ()
    told = [f"{each.name}={brief(getattr(limit, each.name))}" for each in numbers if each.repr]
    return f"{type(limit).__name__}({', '.join(told)})"


def _contact(contact: Contact) -> str:
    numbers = {each.name: getattr(contact.kind, each.name) for each in contact.kind.parameters}
    told = "".join(f", {name.replace('_', ' ')} {value:.4g}" for name, value in numbers.items())
    return f"{contact.name}: {contact.kind.title}{told}"
