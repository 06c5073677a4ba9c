"""Synergy sets as text for people: listed, shown, compared."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.angles import Comparison, Side
from synergrip.hands.synergies.pairing import Pair
from synergrip.hands.synergies.span import Span, span
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array
from synergrip.reports.text.tables import table, wrapped

ABREAST = 8
"""Columns of S in one block."""
TO_DEG = 180 / math.pi


def list_text(sets: Sequence[tuple[str, SynergySet]]) -> str:
    """Return a line for each set, given with the name of its hand; empty for a file by itself."""
    header = ("hand", "set", "n_z", "rank", "columns", "title")
    rows = []
    for hand, each in sets:
        found = span(each.S)
        flag = " AMBIGUOUS" if found.decision.ambiguous else ""
        rows.append((hand, each.name, str(len(each.synergies)), f"{found.rank}{flag}", _lengths(found), each.title))
    first = 0 if any(hand for hand, _ in sets) else 1
    return table(header[first:], [row[first:] for row in rows], right=(2 - first, 3 - first))


def show_text(hand: Hand, chosen: SynergySet, q: Array | None, picture: Path | None = None) -> str:
    """Return S with a row for each joint, its offset and rank, and the posture `q` (n_q,) when there is one."""
    found = span(chosen.S)
    units = [unit for kind, unit in SI_UNITS.items() if kind in {joint.kind for joint in hand.joints}]
    extra = [("offset", chosen.offset)] if np.any(chosen.offset) else []
    extra += [("posture", q)] if q is not None else []
    columns = [(name, _entries(values), "") for name, values in extra]
    for name, values, norm in zip(chosen.synergies, chosen.S.T, found.norms, strict=True):
        columns.append((name, _entries(values), _entries(norm)[0]))
    lines = wrapped("read     ", f"{hand.title} · {chosen.name}{': ' if chosen.title else ''}{chosen.title}")
    lines += [f"S        {' or '.join(units)} for a synergy at 1; q = S z + offset"]
    for start in range(0, len(columns), ABREAST):
        names, entries, norms = zip(*columns[start : start + ABREAST], strict=True)
        rows = [*zip(hand.joint_names, *entries, strict=True), ("length", *norms)]
        lines += ["", table(("joint", *names), rows, right=range(1, len(names) + 1))]
    lines += ["", f"columns  {_lengths(found)}"]
    lines += wrapped("singular ", " ".join(f"{value:.4g}" for value in _clean(found.singular_values)))
    return "\n".join([*lines, *_rank(chosen, found), *([f"drawn    {picture}"] if picture else [])])


def _rank(chosen: SynergySet, found: Span) -> Iterator[str]:
    flag = "; AMBIGUOUS: a singular value is hardly above 0" if found.decision.ambiguous else ""
    yield f"rank     {found.rank} of {len(found.norms)}{flag}"
    still = [name for name, norm in zip(chosen.synergies, found.norms, strict=True) if norm == 0]
    if still:
        yield f"         no joint is moved by {', '.join(still)}"
    if found.repeated:
        they = "synergy repeats" if found.repeated == 1 else "synergies repeat"
        it = "it becomes" if found.repeated == 1 else "they become"
        yield f"         {found.repeated} {they} what the others do; {it} redundancy (Γ_zr)"


def compare_text(pair: Pair, found: Comparison) -> str:
    """Return the principal angles between two sets, and what each reproduces of the other."""
    sides = (("A", pair.first, found.first), ("B", pair.second, found.second))
    rows = [
        (letter, each.name, str(len(each.synergies)), str(side.span.rank), _percent(side.share), each.title)
        for letter, each, side in sides
    ]
    lines = [table(("", "set", "n_z", "rank", "within the other", "title"), rows, right=(2, 3, 4)), ""]
    for letter, names in (("A", pair.only_first), ("B", pair.only_second)):
        if names:
            lines += wrapped(f"only {letter} names       ", f"{', '.join(names)}: the other one does not move them")
    lines += _angles(found)
    for (letter, each, side), other in zip(sides, "BA", strict=True):
        lines += wrapped(f"{other} reproduces of {letter}  ", _shares(each, side))
    return "\n".join(lines)


def _angles(found: Comparison) -> Iterator[str]:
    angles = ", ".join(f"{angle:.4g}" for angle in _clean(TO_DEG * found.angles, 1e-6))
    unit = " deg" if angles else "none: a set that moves no joint"
    yield from wrapped("principal angles   ", f"{angles}{unit}")
    a, b = found.first.inside, found.second.inside
    if a or b:
        relation = "A and B have the same range" if a and b else "A lies in B" if a else "B lies in A"
        yield f"                   {relation}"


def _shares(chosen: SynergySet, side: Side) -> str:
    named = zip(chosen.synergies, side.shares, strict=True)
    return ", ".join(f"{name} {_percent(share)}" for name, share in named)


def _percent(share: float) -> str:
    return "nothing to do" if math.isnan(share) else f"{_clean(np.array([100 * share]), 1e-6)[0]:.4g} %"


def _lengths(found: Span) -> str:
    if found.orthonormal:
        return "orthonormal"
    shortest, longest = f"{found.norms.min():.3g}", f"{found.norms.max():.3g}"
    return f"length {shortest}" if shortest == longest else f"length {shortest} to {longest}"


def _entries(values: Array | float) -> list[str]:
    return [f"{value:.3f}" for value in np.round(np.atleast_1d(values), 3) + 0.0]


def _clean(values: Array, floor: float = 1e-12) -> Array:
    """Return the values with 0 for those that are nothing but rounding."""
    return np.where(np.abs(values) > floor, values, 0.0)
