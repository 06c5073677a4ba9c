"""What a file asks of its hand, judged though something else in the file is wrong, so that all is told at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import ValidationError

from synergrip.documents.documents import Document
from synergrip.documents.gathering import gathered
from synergrip.errors import InputError, Issue, one_of
from synergrip.grasps.asked_hand import asked_hand
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Hand
from synergrip.hands.synergies.matrix import stands_still
from synergrip.problems.file_keys import in_file
from synergrip.problems.hand_table import HandTable

OF_MODEL = ("model", "palm", "coupling", "follower_ranges")
"""Keys of [hand] that say which hand it is: nothing is judged on another one."""


def hand_issues(document: Document, known: Sequence[Issue]) -> list[Issue]:
    """Return what is wrong with the hand of a file, and with pads and links that contacts name.

    Args:
        document: of a problem file that is refused.
        known: why; values of [hand] that are refused already are judged no further.
    """
    given = document.data.get("hand")
    if not isinstance(given, dict):
        return []
    wrong = {key for key in given if any(_within(issue.key, f"hand.{key}") for issue in known)}
    try:
        table = HandTable.model_validate({key: value for key, value in given.items() if key not in wrong})
    except ValidationError:
        return []
    issues = list[Issue]()
    hand = None if wrong & set(OF_MODEL) else gathered(issues, lambda: _hand(table, document))
    if hand is None:
        return issues
    wrong |= {"posture"} if table.posture is None else set()  # one that is missing is told when all else is in order
    posture = "rest" if "posture" in wrong else table.posture
    try:
        asked_hand(
            hand, posture=posture, synergies=table.synergies, close=table.close,
            joint_compliance=table.compliance.joint, synergy_compliance=table.compliance.synergy or 0.0, links=(),
            folder=document.path.parent,
        )  # fmt: skip
    except InputError as error:
        told = map(in_file, error.issues)
        issues += [each for each in told if not any(_within(each.key, f"hand.{key}") for key in wrong)]
    places = [(key, name) for key, name in _places(document.data) if not _doubtful(key, known)]
    return [*issues, *(issue for key, name in places for issue in _unknown(hand, key, name))]


def _hand(table: HandTable, document: Document) -> Hand:
    return load_hand(
        table.model, relative_to=document.path.parent, coupling=table.coupling, follower_ranges=table.follower_ranges,
        palm=table.palm or "", key="hand.model",
    )  # fmt: skip


def _within(key: str, table: str) -> bool:
    return key == table or key.startswith((f"{table}.", f"{table}["))


def _places(data: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield the keys at which contacts name pads and links, with the names."""
    shared, entries = data.get("contacts"), data.get("contact")
    at = shared.get("at") if isinstance(shared, dict) else None
    yield from ((f"contacts.at[{i}]", pad) for i, pad in enumerate(at if isinstance(at, list) else ()))
    for i, entry in enumerate(entries if isinstance(entries, list) else ()):
        if isinstance(entry, dict):
            yield from ((f"contact[{i}].{name}", entry[name]) for name in ("at", "link") if name in entry)


def _doubtful(key: str, known: Sequence[Issue]) -> bool:
    """Tell whether the pad in a list, or anything of the entry of a contact, is refused already."""
    place = key if key.startswith("contacts") else key.rpartition(".")[0]
    return any(_within(issue.key, place) for issue in known)


def _unknown(hand: Hand, key: str, name: object) -> list[Issue]:
    """Return what is wrong with the name of a pad or link: nothing where the hand has it."""
    issues = list[Issue]()
    if isinstance(name, str) and name:
        if key.endswith(".link"):
            known = name in hand.links
            return [] if known else [Issue(stands_still(hand, name) or f"link {one_of(name, hand.links)}", key=key)]
        gathered(issues, lambda: hand.pad(name, key))
    return issues
