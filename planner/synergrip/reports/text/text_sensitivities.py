"""Sensitivities as text: the changes worth most, and the table of all of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from synergrip.documents.quantities import plain
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.margin.sensitivity.sensitivity import FIXED, LARGEST, START, Sensitivities, Sensitivity
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_spots import triple

HEADS = {
    LARGEST: "of the largest margin, {}, by its multipliers", FIXED: "of the worst margin, {}, with these references",
}  # fmt: skip
MEANT = "each by 1 % of a number, 1 mm of a contact or 1 deg of its normal"

SIDES = (
    "toward less, toward more: what that much more of the number does to the margin, as it is below its value and "
    "above it; where less of it is better both are negative"
)
WHOLE = ("change", "adds", "toward less", "toward more", "in", "")
"""Columns where all is told."""


def sensitivity_lines(found: Sensitivities, grasp: Grasp, *, whole: bool = False) -> Iterator[str]:
    """Yield what changes are worth most, or all of them, one margin after the other; where their tangents point."""
    named = list[Sensitivity]()
    for kind, head in HEADS.items():
        margin = found.margins[kind]
        if margin is None:
            yield from wrapped("         ", f"what changes are worth {head.format('')}: {found.left_out[kind]}")
            continue
        chosen: Sequence[Sensitivity] = found.of(kind) if whole else found.worth_most(kind)
        of = head.format(f"{plain(margin)} N")
        yield "" if kind == FIXED else f"What changes are worth most, {MEANT}" if not whole else f"Changes, {MEANT}"
        if not chosen:
            yield f"{of}: {'interrupted before it was found' if found.interrupted else 'no such change adds to it'}"
            continue
        columns = WHOLE if whole else ("change", "adds", "in")
        named += chosen
        yield of
        yield table(columns, [cells_of(each, whole=whole) for each in chosen])
    if whole and named:
        yield from wrapped("         ", SIDES)
    if grasp.held is not None:
        frames = {contact.name: contact.frame.T for contact in grasp.contacts}
        yield from (line for told in tangents(named, frames) for line in wrapped("         ", told))
    if whole:
        for name, why in found.left_out.items():
            if name not in HEADS:
                yield from wrapped("         ", f"{name}: {why}")


def tangents(named: Sequence[Sensitivity], frames: Mapping[str, Array]) -> Iterator[str]:
    """Yield a sentence about where the tangents point that changes are along or about.

    Args:
        named: the changes.
        frames: (3, 3) of each contact, rows n, t, o, in the palm frame at the start.
    """
    asked = {(each.of, each.direction.rsplit(" ", 1)[-1]) for each in named}
    told = [
        f"{name} of {contact} {triple(frame[row], 3)}"
        for contact, frame in frames.items()
        for row, name in ((1, "t"), (2, "o"))
        if (contact, name) in asked
    ]
    if told:
        yield f"in the palm frame at the start: {', '.join(told)}"


def change_of(each: Sensitivity) -> str:
    """Return a change the better way, in words."""
    sign = "+" if not each.gain or each.grows else "-"
    where = f" {each.direction}" if each.direction else ""
    of = "" if each.of in ("the object", "the task") else f" of {each.of}"
    return f"{each.name}{of}{where} {sign}{each.per}"


def cells_of(each: Sensitivity, *, whole: bool) -> tuple[str, ...]:
    """Return what a change adds and in which model; `whole` with both one-sided derivatives, and why they differ."""
    change = change_of(each)
    model = "linear model" if each.model == START else "hand that moves"
    gain = f"{plain(each.gain, 3)} N" if each.gain else "-"
    if not whole:
        return change, gain, model
    return change, gain, _side(each.left), _side(each.right), model, each.why


def _side(value: float | None) -> str:
    return "-" if value is None else f"{value:+.3g} N"
