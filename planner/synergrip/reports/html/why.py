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
        return [f"{HEADS.get(stage, stage)} (stage: {stage})", *_least(document, "")]
    if reached:
        until = f"t = {reached['until_s']:.3g} s"
        return [f"not reached from {until} on (stage: {stage})", *_least(document, "until then ")]
    return [f"stage: {stage}", *_least(document, "")]


def missing_of(document: Mapping[str, Any]) -> Sequence[tuple[float, float]]:
    """Return the stretches of time without a plan [s]."""
    reached = document.get("reached")
    if reached:
        return ((float(reached["until_s"]), float(document["time_s"][-1])),)
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
    if repairs:
        yield Table("", "What would help", CHANGES, tuple(map(_change, repairs)))
    if (missing := document.get("missing_synergies")) is not None:
        yield _missing(missing)
    if others:
        title = "Also tried and planned, and not the least there is"
        yield Table("", title, CHANGES, tuple(map(_change, others)))
    if pairs:
        rows = [_change(each, "and " * (k > 0)) for pair in pairs for k, each in enumerate(pair)]
        yield Table("", "Pairs of changes that help", CHANGES, tuple(rows))
    told = [*_told([*repairs, *others, *(each for pair in pairs for each in pair)], document)]
    if told:
        yield Table("", "", before=tuple(told))


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
