"""Recorded joint postures: from a CSV file to an array whose columns are the joints that move by themselves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from synergrip.documents.csv_cells import Cell, CellReader
from synergrip.errors import one_of
from synergrip.hands.hand import Hand
from synergrip.hands.synergies.column_names import UNITS, beside_joints, joint_and_unit, may_count
from synergrip.hands.synergies.doubts import NOTHING, counts, doubts, left_out_notes, refuse_endless, refuse_numbers
from synergrip.hands.synergies.matrix import coupling_map, drivers
from synergrip.hands.synergies.meant_units import Column, refuse_unit, unit_notes
from synergrip.hands.synergies.sheet import Sheet, is_number
from synergrip.hands.units import joint_kinds
from synergrip.linalg import Array, frozen

HEADER = "a header with the names of the joints, then a posture on each line"
FEWEST = 2
"""Postures: one has no variance."""


@dataclass(frozen=True)
class Followed:
    """A recorded joint that follows others; it is left out because its coupling says where it is."""

    joint: str
    drivers: str
    """Names of what it follows, as text."""
    deviation: float
    """[rad or m] How far the records are from the coupling where they are farthest from it."""
    line: int
    """Where that is in the file."""


@dataclass(frozen=True, eq=False)
class Recorded:
    """Postures of the joints that move by themselves."""

    path: Path
    joints: tuple[str, ...]
    """In the order of q of the hand, or of the file when there is no hand."""
    postures: Array
    """(N, n) joint values [rad], or [m] when the joints slide."""
    lines: tuple[int, ...]
    """(N) The line of the file that each posture stands on."""
    kind: str
    """What all the joints are: "hinge" or "slide"."""
    followed: tuple[Followed, ...]
    left_out: tuple[str, ...] = ()
    """Names of the columns that are no joints."""
    notes: tuple[str, ...] = ()
    """What is doubtful about the records, or was understood in one of several ways."""


def read_postures(path: Path, hand: Hand | None = None, *, degrees: bool = False) -> Recorded:
    """Return the postures of a CSV file.

    Args:
        path: the file. Its header names the joints; a name may end in ``_deg`` or ``[deg]`` (``_mm`` for a sliding
            joint of the hand), otherwise values are rad (m). Cells are parted as `Sheet` tells. Columns of times,
            counters and the like are left out; blank lines and comments are passed over.
        hand: whose joints they are. Each must be there, except those that follow others. Without a hand every
            column is a hinge that moves by itself.
        degrees: whether angles are degrees where the header does not say.

    Raises:
        InputError: no such file, numbers in place of names, a joint that is unknown, missing or there twice, hinges
            together with sliding joints, cells that are no finite number, ragged lines, fewer than 2 postures, values
            whose unit must be another one; with line and column.
    """
    sheet = Sheet.of(path, HEADER)
    refuse_numbers(sheet, hand)
    sheet.reader.raise_issues()
    beside = {index: what for index, cell in enumerate(sheet.header) if (what := _beside(sheet, index, cell, hand))}
    columns = _columns(sheet, beside, hand, degrees)
    sheet.reader.raise_issues()
    rows, lines = _rows(sheet, columns, beside), tuple(number for number, _ in sheet.rows)
    refuse_unit(sheet.reader, columns, rows, lines, hand)
    refuse_endless(sheet.reader, columns, rows, hand)
    sheet.reader.raise_issues()
    left = {sheet.header[i].text or f"column {i + 1}": what for i, what in beside.items() if what != NOTHING}
    notes = (*left_out_notes(left), *unit_notes(columns, rows, lines), *doubts(columns, rows, hand))
    return replace(_recorded(path, columns, rows, lines, hand), left_out=tuple(left), notes=notes)


def _rows(sheet: Sheet, columns: Sequence[Column], beside: Mapping[int, str]) -> Array:
    """Return the (N, n) values of the columns as they are written."""
    if len(sheet.rows) < FEWEST:
        message = f"expected at least {FEWEST} postures below the header, got {len(sheet.rows)}"
        sheet.reader.refuse(message, sheet.header[0])
    sheet.reader.raise_issues()
    times = [index for index, what in beside.items() if what == "time"]
    rows = sheet.numbers([column.index for column in columns], times)
    sheet.reader.raise_issues()
    return np.array(rows)


def _beside(sheet: Sheet, index: int, cell: Cell, hand: Hand | None) -> str:
    """Return what a column is that is no joint; empty for a joint."""
    last = len(sheet.header) - 1
    if hand is not None and joint_and_unit(cell.text, joint_kinds(hand.joints))[0] in hand.joint_names:
        return ""
    if what := beside_joints(cell.text):
        return what
    if sheet.rows and not any(sheet.column(index)):
        return "empty" if cell.text or index < last else NOTHING  # which each line has that ends in a delimiter
    texts = list(sheet.column(index)) if may_count(cell.text) and (cell.text or index == 0) else []
    if len(texts) >= FEWEST and counts(texts):
        return "a counter"
    return "a label" if not cell.text and index == 0 and texts and not any(map(is_number, texts)) else ""


def _recorded(
    path: Path, columns: Sequence[Column], rows: Array, lines: tuple[int, ...], hand: Hand | None
) -> Recorded:
    values = rows * [column.factor for column in columns]
    free = [i for i, column in enumerate(columns) if hand is None or column.joint not in hand.couplings]
    joints, kind = tuple(columns[i].joint for i in free), columns[free[0]].kind
    followed: tuple[Followed, ...] = ()
    if hand is not None:
        known = {column.joint: values[:, i] for i, column in enumerate(columns)}
        followed = tuple(_followed(hand, joint, known, lines) for joint in known if joint in hand.couplings)
    return Recorded(path, joints, frozen(values[:, free]), lines, kind, followed)


def _followed(hand: Hand, joint: str, known: dict[str, Array], lines: tuple[int, ...]) -> Followed:
    """Compare the (N,) records of a follower with what its coupling makes of the joints that it follows."""
    E, e = coupling_map(hand.joint_names, hand.couplings)
    row = hand.joint_names.index(joint)
    expected = e[row] + sum((k * known[name] for k, name in zip(E[row], hand.joint_names, strict=True) if k), 0.0)
    apart = np.abs(known[joint] - expected)
    return Followed(joint, drivers(hand.couplings[joint]), float(apart.max()), lines[int(np.argmax(apart))])


def _columns(sheet: Sheet, beside: Mapping[int, str], hand: Hand | None, degrees: bool) -> list[Column]:
    """Return a column for each joint, in the order of the hand; what is wrong is noted in the reader."""
    found: dict[str, Column] = {}
    reader, header = sheet.reader, sheet.header
    for index, cell in enumerate(header):
        column = None if index in beside else _column(reader, cell, index, hand, degrees)
        if column is not None and column.joint in found:
            reader.refuse(f"joint '{column.joint}' is there twice", cell)
        elif column is not None:
            found[column.joint] = column
    if not found and not reader.issues:
        reader.refuse("the header names no joint", header[0])
    if hand is None or reader.issues:
        return list(found.values())
    free = [name for name in hand.joint_names if name not in hand.couplings]
    missing = [f"'{name}'" for name in free if name not in found]
    if not free:
        reader.refuse("no joint of this hand moves by itself", header[0])
    if missing:
        reader.refuse(f"missing column{'s' if len(missing) > 1 else ''} {', '.join(missing)}", header[0])
    else:
        _judge_kinds(reader, [found[name] for name in free])
    return [found[name] for name in hand.joint_names if name in found]


def _column(reader: CellReader, cell: Cell, index: int, hand: Hand | None, degrees: bool) -> Column | None:
    kinds = joint_kinds(hand.joints) if hand is not None else None
    name, unit = joint_and_unit(cell.text, kinds)
    if kinds is not None and name not in kinds:
        reader.refuse(f"joint {one_of(name, kinds)}", cell)
        return None
    if not name or any(mark in name for mark in '",') or not name.isprintable():
        reader.refuse("expected the name of a joint, without commas, quotes and control characters", cell)
        return None
    kind = kinds[name] if kinds is not None else "hinge"
    if unit and unit not in UNITS[kind]:
        takes = "turns: give it in rad or deg" if kind == "hinge" else "slides: give it in m or mm"
        reader.refuse(f"joint '{name}' {takes}", cell)
        return None
    usual = {"hinge": "deg" if degrees else "rad", "slide": "m"}[kind]
    return Column(name, kind, unit or usual, bool(unit), cell, index)


def _judge_kinds(reader: CellReader, columns: Sequence[Column]) -> None:
    """Refuse hinges together with sliding joints: their principal directions would depend on the units."""
    slides = [column for column in columns if column.kind == "slide"]
    if slides and len(slides) < len(columns):
        listed = ", ".join(f"'{column.joint}'" for column in slides)
        message = (
            f"sliding joints ({listed}) and hinges have no common unit, and principal directions depend on it; "
            "fit the hinges without them and without the hand: a joint that a synergy file leaves out does not move"
        )
        reader.refuse(message, slides[0].cell)
