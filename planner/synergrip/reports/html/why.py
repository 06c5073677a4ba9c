"""Why there is no plan, as a part of a report, with the words of ``synergrip plan``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from shlex import quote
from typing import Any

import numpy as np

from synergrip.explain.repairs import Repair
from synergrip.explain.words import changed, values
from synergrip.reports.html.tables import Cell, Table
from synergrip.reports.text.text_no import (
    BEST,
    STOPS,
    again_words,
    clash_words,
    no_help_words,
    share_words,
    when_words,
)
from synergrip.reports.text.text_plan import HEADS

ANCHOR, TITLE = "why", "Why not"
UNKNOWN_HEADS = {
    "solver": "nothing that was solved could be verified",
    "execution": "the hand that moves does not keep what was planned",
}  # fmt: skip
"""Stage of an answer that is unknown -> what it means."""
NOT_YET = "No change that was tried has a plan yet"
CHANGES = ("change", "from", "to", "planned again", "with")


def why_of(document: Mapping[str, Any]) -> Table | None:
    """Return why there is no plan, what clashes, and the changes that were tried; None for a plan."""
    if document["verdict"] == "feasible":
        return None
    text = str((document.get("why") or {}).get("text", ""))
    return Table(ANCHOR, TITLE, before=(text, *_where(document)), parts=tuple(_parts(document)))


def headline_of(document: Mapping[str, Any]) -> list[str]:
    """Return what stands beside the verdict of an answer without a plan."""
    stage, reached = str(document.get("stage") or ""), document.get("reached")
    if document["verdict"] == "infeasible":
        return [HEADS.get(stage, stage), *_least(document, "")]
    if reached:
        until = f"t = {reached['until_s']:.3g} s"
        return [f"not reached from {until} on", *_least(document, "until then ")]
    followed = known_until(document)
    told = UNKNOWN_HEADS.get(stage, stage)
    if followed is not None:
        return [f"{told}; followed until t = {followed:.3g} s", *_least(document, "until then ")]
    return [told, *_least(document, "")]


def known_until(document: Mapping[str, Any]) -> float | None:
    """Return the last instant whose true state is known [s], where that is before the end."""
    known = (document.get("true") or {}).get("time_s") or document["time_s"]
    return float(known[-1]) if known[-1] < document["time_s"][-1] else None


def missing_of(document: Mapping[str, Any]) -> Sequence[tuple[float, float]]:
    """Return the stretches of time without a plan, or until which nothing is known [s]."""
    reached, followed = document.get("reached"), known_until(document)
    if reached or followed is not None:
        begin = float(reached["until_s"]) if reached else followed or 0.0
        return ((begin, float(document["time_s"][-1])),)
    spans = (document.get("when") or {}).get("intervals_s") or ()
    return tuple((float(begin), float(end)) for begin, end in spans)


def _least(document: Mapping[str, Any], until: str) -> Iterator[str]:
    """Yield the least slip margin of references that are no plan, as far as their true states are known."""
    margin = (document.get("true") or {}).get("margin")
    if margin:
        where = f"{margin['contact']}, t = {margin['time_s']:.3g} s"
        yield f"{until}least slip margin {margin['worst_N']:.4g} N at {where}"


def _where(document: Mapping[str, Any]) -> Iterator[str]:
    """Yield which instants have no plan."""
    late = document.get("when") or {}
    told = when_words(
        late.get("first_s"), late.get("intervals_s") or (), late.get("alone"), np.array(document["time_s"]),
        moves=late.get("scope") == "start",
    )  # fmt: skip
    if told:
        yield told


def _parts(document: Mapping[str, Any]) -> Iterator[Table]:
    if conflicts := document.get("conflicts"):
        yield Table("", "What clashes", ("limit", "share of the proof", "at"), tuple(map(_conflict, conflicts)))
    repairs, others, pairs = (document.get(name) or [] for name in ("repairs", "others", "pairs"))
    helped = any(each["verified"] for each in (*repairs, *others, *(each for pair in pairs for each in pair)))
    if repairs:
        title = "What would help" if helped else NOT_YET
        head = (*CHANGES[:-1], CHANGES[-1] * any(each["verified"] for each in repairs))
        after = tuple(no_plan_words(repairs, helped=helped))
        yield Table("", title, head, tuple(map(_change, repairs)), after=after)
    if (missing := document.get("missing_synergies")) is not None:
        yield _missing(missing)
    if others:
        too = ", too" if repairs or missing is not None else ""
        title = f"What would help{too}, tried and planned, and not the least there is"
        yield Table("", title, CHANGES, tuple(map(_change, others)))
    if pairs:
        rows = [_change(each, "and " * (k > 0)) for pair in pairs for k, each in enumerate(pair)]
        yield Table("", "Pairs of changes that help", CHANGES, tuple(rows))
    told = [*_told([*repairs, *others, *(each for pair in pairs for each in pair)], document)]
    if told:
        yield Table("", "", before=tuple(told))


def no_plan_words(repairs: Sequence[Mapping[str, Any]], *, helped: bool) -> Iterator[str]:
    """Yield what is known of changes that no plan was found with, and where more are looked for."""
    if any(each.get("tried", True) and not each["verified"] for each in repairs):
        told = "the linear model of the start posture has a plan with that value"
        yield f"Where no plan is found, {told}, and the hand that moves was tried with more."
    if not helped:
        yield "`synergrip explain PROBLEM` tries more."


def _told(changes: Sequence[Mapping[str, Any]], document: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is to be said of all changes, and of which numbers no value helps."""
    if any(each["cause"] == "joint_range" for each in changes):
        yield STOPS
    if document.get("clashing") is not None:
        yield clash_words(document["clashing"])
    if document.get("cannot_help"):
        head, words = no_help_words(document["cannot_help"], moves="execution" in document)
        yield f"{head}: {words}"
    yield from map(str, document.get("hints") or ())


def _conflict(each: Mapping[str, Any]) -> tuple[Cell, ...]:
    names = [str(item["name"]) for item in each["items"]]
    more = f" and {len(names) - BEST} more" if len(names) > BEST else ""
    return Cell(each["limit"]), Cell(share_words(each["share"]), number=True), Cell(", ".join(names[:BEST]) + more)


def _change(told: Mapping[str, Any], start: str = "") -> tuple[Cell, ...]:
    """Return the row of a change; there is a command where a plan was found with it."""
    repair = Repair(
        told["cause"], told["key"], told["from"], told["to"], told["unit"], told["set"], told["verified"],
        told["size"] or 0.0, tried=told.get("tried", True),
    )  # fmt: skip
    was, to = values(repair)
    again = again_words(repair, told.get("undone_share") or 0.0)
    command = f"--set {quote(repair.set)}" if repair.verified else ""
    return (Cell(f"{start}{changed(repair)}"), Cell(was, number=True), Cell(to, number=True), Cell(again),
            Cell(command, code=True))  # fmt: skip


def _missing(missing: Mapping[str, Any]) -> Table:
    """Return how many synergies are missing, and who has columns that would do."""
    rows = []
    for each in missing["candidates"]:
        said = each["verdict"] if not each["stage"] else f"{each['verdict']} (stage: {each['stage']})"
        names = f"all {len(each['names'])} instead" if each["whole"] else " + ".join(each["names"])
        setting = f"--set {quote(each['setting'])}" if each["setting"] else ""
        rows.append((Cell(names), Cell(each["set"]), Cell(said), Cell(setting, code=True)))
    settings = "with" if any(row[-1].text for row in rows) else ""
    return Table("", "With other synergies", ("columns", "of", "with them", settings), tuple(rows), (missing["why"],))
