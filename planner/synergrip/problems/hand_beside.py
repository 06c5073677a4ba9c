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
from synergrip.problems.hand_table import HandTable
from synergrip.problems.holding import in_file

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
    return [*issues, *_places(hand, document.data)]


def _hand(table: HandTable, document: Document) -> Hand:
    return load_hand(
        table.model, relative_to=document.path.parent, coupling=table.coupling, follower_ranges=table.follower_ranges,
        palm=table.palm or "", key="hand.model",
    )  # fmt: skip


def _within(key: str, table: str) -> bool:
    return key == table or key.startswith((f"{table}.", f"{table}["))


def _places(hand: Hand, data: dict[str, Any]) -> Iterator[Issue]:
    """Yield which pads and links of contacts the hand has not."""
    shared, entries = data.get("contacts"), data.get("contact")
    at = shared.get("at") if isinstance(shared, dict) else None
    named = [(f"contacts.at[{i}]", pad) for i, pad in enumerate(at if isinstance(at, list) else ())]
    each = [(f"contact[{i}]", entry) for i, entry in enumerate(entries if isinstance(entries, list) else ())
            if isinstance(entry, dict)]  # fmt: skip
    for key, pad in [*named, *((f"{key}.at", entry.get("at")) for key, entry in each)]:
        if isinstance(pad, str) and pad and pad not in hand.pads:
            issues = list[Issue]()
            gathered(issues, lambda pad=pad, key=key: hand.pad(pad, key))  # type: ignore[misc]
            yield from issues
    for key, entry in each:
        if isinstance(link := entry.get("link"), str) and link and link not in hand.links:
            yield Issue(f"link {one_of(link, hand.links)}", key=f"{key}.link")
