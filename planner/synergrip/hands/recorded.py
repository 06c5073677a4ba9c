"""Recorded joint postures: from a CSV file to an array whose columns are the joints that move by themselves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from synergrip.cells import Cell, CellReader
from synergrip.errors import one_of
from synergrip.hands.hand import Hand
from synergrip.hands.synergies import coupling_map, drivers
from synergrip.linalg import Array, frozen

TIME = "t_s"
UNITS = {"hinge": {"_deg": math.pi / 180, "_rad": 1.0}, "slide": {"_mm": 1e-3, "_m": 1.0}}
"""Ending of a column's name -> factor to SI, for each kind of joint."""
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


@dataclass(frozen=True)
class _Column:
    joint: str
    kind: str
    factor: float
    cell: Cell
    index: int


def read_postures(path: Path, hand: Hand | None = None, *, degrees: bool = False) -> Recorded:
    """Return the postures of a CSV file.

    Args:
        path: the file. Its header names the joints; a name may end in ``_deg`` (``_mm`` for a sliding joint of
            the hand), otherwise values are rad (m). A column ``t_s``, blank lines and ``#`` lines are passed over.
        hand: whose joints they are. Each must be there, except those that follow others. Without a hand every
            column is a hinge that moves by itself.
        degrees: whether angles are degrees where the header does not say.

    Raises:
        InputError: no such file, a joint that is unknown, missing or there twice, hinges together with sliding
            joints, cells that are no finite number, ragged lines, fewer than 2 postures; with line and column.
    """
    reader = CellReader.of(path)
    rows = reader.rows()
    cells = reader.header(rows)
    columns = _columns(reader, cells, hand, degrees) if reader.is_header(cells, HEADER) else []
    reader.raise_issues()
    read = [(line, reader.numbers(line, text, len(cells))) for line, text in rows]
    if len(read) < FEWEST:
        reader.refuse(f"expected at least {FEWEST} postures below the header, got {len(read)}", cells[0])
    reader.raise_issues()
    values = np.array([row for _, row in read])[:, [column.index for column in columns]]
    return _recorded(path, columns, values * [c.factor for c in columns], tuple(line for line, _ in read), hand)


def _recorded(
    path: Path, columns: Sequence[_Column], values: Array, lines: tuple[int, ...], hand: Hand | None
) -> Recorded:
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


def _columns(reader: CellReader, header: Sequence[Cell], hand: Hand | None, degrees: bool) -> list[_Column]:
    """Return a column for each joint, in the order of the hand; what is wrong is noted in the reader."""
    found: dict[str, _Column] = {}
    for index, cell in enumerate(header):
        column = None if cell.text == TIME else _column(reader, cell, index, hand, degrees)
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


def _column(reader: CellReader, cell: Cell, index: int, hand: Hand | None, degrees: bool) -> _Column | None:
    kinds = {joint.name: joint.kind for joint in hand.joints} if hand is not None else None
    name, ending = _split(cell.text, kinds)
    if kinds is not None and name not in kinds:
        reader.refuse(f"joint {one_of(name, kinds)}", cell)
        return None
    if not name or '"' in name or not name.isprintable():
        reader.refuse("expected the name of a joint, without quotes and control characters", cell)
        return None
    kind = kinds[name] if kinds is not None else "hinge"
    if ending and ending not in UNITS[kind]:
        takes = "turns: give it in rad or deg" if kind == "hinge" else "slides: give it in m or mm"
        reader.refuse(f"joint '{name}' {takes}", cell)
        return None
    usual = {"hinge": "_deg" if degrees else "_rad", "slide": "_m"}[kind]
    return _Column(name, kind, UNITS[kind][ending or usual], cell, index)


def _split(text: str, known: dict[str, str] | None) -> tuple[str, str]:
    """Return a column's joint and its unit, as in ``index_pip`` and ``_deg``; a joint may itself be so named."""
    if known is not None and text in known:
        return text, ""
    kinds = UNITS if known is not None else ("hinge",)
    ending = next((each for kind in kinds for each in UNITS[kind] if text.endswith(each)), "")
    return text.removesuffix(ending), ending


def _judge_kinds(reader: CellReader, columns: Sequence[_Column]) -> None:
    """Refuse hinges together with sliding joints: their principal directions would depend on the units."""
    slides = [column for column in columns if column.kind == "slide"]
    if slides and len(slides) < len(columns):
        listed = ", ".join(f"'{column.joint}'" for column in slides)
        message = (
            f"sliding joints ({listed}) and hinges have no common unit, and principal directions depend on it; "
            "fit the hinges without them and without the hand: a joint that a synergy file leaves out does not move"
        )
        reader.refuse(message, slides[0].cell)
