"""The contacts of a problem file, each with the defaults filled in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from synergrip.errors import Issue, raise_issues, repeated
from synergrip.problems.contact_tables import ContactEntry, ContactModel, ContactsTable, ContactTable


@dataclass(frozen=True)
class LinkPlace:
    """A place on a link, in its frame."""

    link: str
    point: tuple[float, ...]  # (3,) [m]
    normal: tuple[float, ...] | None
    """(3,) unit vector in which it pushes; None for toward the object."""
    radius: float  # [m]


@dataclass(frozen=True)
class ContactSpec:
    """One contact, complete."""

    name: str
    at: str | LinkPlace
    """Pad of the hand, or a place on a link."""
    model: ContactModel
    friction: float
    """Coefficient of friction; 0 for a frictionless contact."""
    spin_friction: float  # m
    """Moment about the normal per normal force; 0 unless the contact is soft."""
    stiffness: float  # N/m
    """Along the normal; infinite when rigid."""
    tangential_stiffness: float  # N/m
    spin_stiffness: float  # N m/rad
    """About the normal; 0 unless the contact is soft."""
    normals: Literal["object", "pad"] | None
    """None when nothing is said but the normal itself: the surface's where there is one, else as stated."""
    key: str
    """The key of the file that names the pad or link."""


@dataclass(frozen=True)
class _Source:
    """Where a contact is written: its pad or link, and its entry."""

    entry: ContactEntry
    key: str
    table: str


def contact_list(defaults: ContactsTable | None, entries: Sequence[ContactEntry]) -> tuple[ContactSpec, ...]:
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


def _complete(shared: ContactsTable, entry: ContactEntry, key: str) -> ContactSpec:
    model: ContactModel = _given(shared, entry, "model", "hard")
    stiffness = _given(shared, entry, "stiffness")
    soft = model == "soft"
    return ContactSpec(
        name=entry.name or entry.at or entry.link or "",
        at=entry.at or LinkPlace(entry.link or "", entry.point or (0.0, 0.0, 0.0), entry.normal, entry.radius or 0.0),
        model=model,
        friction=0.0 if model == "frictionless" else _given(shared, entry, "friction"),
        spin_friction=_given(shared, entry, "spin_friction") if soft else 0.0,
        stiffness=stiffness,
        tangential_stiffness=_given(shared, entry, "tangential_stiffness", stiffness),
        spin_stiffness=_given(shared, entry, "spin_stiffness") if soft else 0.0,
        normals=_given(shared, entry, "normals", "object" if entry.normal is None else None),
        key=key,
    )


def _judge(shared: ContactsTable, entry: ContactEntry, table: str) -> Iterator[Issue]:
    model = _given(shared, entry, "model", "hard")
    needed = {"stiffness": 'write for example "8 N/mm", or "rigid"'}
    refused = []
    if model != "frictionless":
        needed["friction"] = "write for example 0.6; for no friction use model = \"frictionless\""  # fmt: skip
    else:
        refused.append("friction")
    if model == "soft":
        needed["spin_friction"] = 'write for example "5 mm"'
        needed["spin_stiffness"] = 'write for example "2 N m/rad"'
    else:
        refused += ["spin_friction", "spin_stiffness"]
    for name, example in needed.items():
        if _given(shared, entry, name) is None:
            yield Issue(f"missing key '{name}'; a {model} contact needs it: {example}", f"{table}.{name}", on_key=True)
    for name in refused:
        if getattr(entry, name) is not None:
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


def _same_names(contacts: Sequence[ContactSpec]) -> Iterator[Issue]:
    seen: dict[str, str | LinkPlace] = {}
    for contact in contacts:
        on_link = isinstance(contact.at, LinkPlace)
        if contact.name in seen and (on_link or contact.at != seen[contact.name]):
            hint = "; give each of them a name" if on_link else ""
            key = contact.key.removesuffix(".at").removesuffix(".link")
            yield Issue(f"two contacts have the name '{contact.name}'{hint}", key)
        seen.setdefault(contact.name, contact.at)
