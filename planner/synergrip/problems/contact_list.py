"""The contacts of a problem file, each with the defaults filled in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from synergrip.errors import Issue, raise_issues, repeated
from synergrip.grasps.contact_at import ContactAt, LinkPlace
from synergrip.grasps.contacts.kind import EXAMPLE_OF
from synergrip.grasps.contacts.kinds import KINDS, PARAMETERS
from synergrip.problems.contact_tables import ContactEntry, ContactsTable, ContactTable

_MOMENTS = ("spin_stiffness", "tilt_stiffness")
"""Entries of stiffness of which nothing follows from the others."""


@dataclass(frozen=True)
class _Source:
    """Where a contact is written: its pad or link, and its entry."""

    entry: ContactEntry
    key: str
    table: str


def contact_list(defaults: ContactsTable | None, entries: Sequence[ContactEntry]) -> tuple[ContactAt, ...]:
    """Return the contacts: the pads of ``contacts.at``, then the ``[[contact]]`` entries on other pads and on links.

    An entry on a pad that ``contacts.at`` lists changes that contact; values it does not give are the defaults.

    Raises:
        InputError: no contact, a name or a pad twice, a value that the contact's model needs or refuses.
    """
    shared = defaults or ContactsTable()
    issues = list(_repeated(shared, entries))
    if not shared.at and not entries:
        issues.append(Issue("no contacts; name the pads that touch the object", key="contacts.at", on_key=True))
    contacts = []
    for source in _sources(shared, entries):
        found = list(_judge(shared, source.entry, source.table))
        if not found:
            contacts.append(_complete(shared, source.entry, source.key))
        issues += [issue for issue in found if issue not in issues]
    issues += _same_names(contacts)
    raise_issues(issues)
    return tuple(contacts)


def stated_in(defaults: ContactsTable | None, entries: Sequence[ContactEntry], name: str) -> list[str]:
    """Return for each contact the key that states a value of it: that of its own entry, or of the defaults."""
    sources = _sources(defaults or ContactsTable(), entries)
    return [f"{'contacts' if getattr(each.entry, name) is None else each.table}.{name}" for each in sources]


def _sources(shared: ContactsTable, entries: Sequence[ContactEntry]) -> Iterator[_Source]:
    by_pad = {entry.at: index for index, entry in enumerate(entries) if entry.at is not None}
    for i, pad in enumerate(shared.at):
        index = by_pad.get(pad)
        entry, table = (ContactEntry(at=pad), "contacts") if index is None else (entries[index], f"contact[{index}]")
        yield _Source(entry, f"contacts.at[{i}]", table)
    for i, entry in enumerate(entries):
        if entry.at is None or entry.at not in shared.at:
            yield _Source(entry, f"contact[{i}].{'link' if entry.at is None else 'at'}", f"contact[{i}]")


def _given(shared: ContactTable, entry: ContactTable, name: str, fallback: Any = None) -> Any:
    own = getattr(entry, name)
    common = getattr(shared, name)
    return own if own is not None else common if common is not None else fallback


def _complete(shared: ContactsTable, entry: ContactEntry, key: str) -> ContactAt:
    kind = KINDS[_given(shared, entry, "model", "hard")]
    place = entry.at or LinkPlace(entry.link or "", entry.point or (0.0, 0.0, 0.0), entry.normal, entry.radius or 0.0)
    return ContactAt(
        place,
        kind.taking({each.name: _given(shared, entry, each.name) for each in kind.parameters}),
        **{name: _given(shared, entry, name) for name in kind.stiffnesses()},
        normals=_given(shared, entry, "normals", "object" if entry.normal is None else None),
        tangent=entry.tangent,
        name=entry.name or "",
        key=key,
        normal_at=f"the normal of pad '{place}' in the hand's hand.toml" if isinstance(place, str)
        else f"{key.removesuffix('link')}normal",
    )  # fmt: skip


def _judge(shared: ContactsTable, entry: ContactEntry, table: str) -> Iterator[Issue]:
    model = _given(shared, entry, "model", "hard")
    kind = KINDS[model]
    needed = {"stiffness": 'write for example "8 N/mm", or "rigid"'}
    needed |= {each.name: f"write for example {each.example}" for each in kind.parameters}
    if "friction" in needed:
        needed["friction"] += '; for no friction use model = "frictionless"'
    needed |= {name: f'write for example "{EXAMPLE_OF[name]}"' for name in kind.stiffnesses() if name in _MOMENTS}
    for name, example in needed.items():
        if _given(shared, entry, name) is None:
            yield Issue(f"missing key '{name}'; a {model} contact needs it: {example}", f"{table}.{name}", on_key=True)
    for name in (*PARAMETERS, *_MOMENTS):
        if name not in needed and getattr(entry, name) is not None:
            yield Issue(f"a {model} contact has no {name.replace('_', ' ')}", f"{table}.{name}", on_key=True)
    if entry.link is not None and entry.normal is None and _given(shared, entry, "normals") == "pad":
        message = "missing key 'normal'; normals = \"pad\" needs it: write for example \"z\""  # fmt: skip
        yield Issue(message, f"{table}.normal", on_key=True)


def _repeated(shared: ContactsTable, entries: Sequence[ContactEntry]) -> Iterator[Issue]:
    for index in repeated(shared.at):
        yield Issue(f"pad '{shared.at[index]}' is named twice", f"contacts.at[{index}]")
    pads = [entry.at for entry in entries]
    for index in repeated(pads):
        if (at := pads[index]) is not None:
            yield Issue(f"pad '{at}' is named twice (first in contact[{pads.index(at)}])", f"contact[{index}].at")


def _same_names(contacts: Sequence[ContactAt]) -> Iterator[Issue]:
    seen: dict[str, str | LinkPlace] = {}
    for contact in contacts:
        on_link = isinstance(contact.at, LinkPlace)
        if contact.name in seen and (on_link or contact.at != seen[contact.name]):
            hint = "; give each of them a name" if on_link else ""
            key = contact.key.removesuffix(".at").removesuffix(".link")
            yield Issue(f"two contacts have the name '{contact.name}'{hint}", key)
        seen.setdefault(contact.name, contact.at)
