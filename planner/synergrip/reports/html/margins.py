"""How sure a plan is and what would help it, as a part of its report, with the words of ``synergrip margins``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.documents.quantities import plain
from synergrip.margin.measures import Measure
from synergrip.margin.sensitivity.sensitivity import HAND, NOTHING, START, Sensitivities, Sensitivity
from synergrip.reports.data.margins_files import FILE
from synergrip.reports.data.saved_margins import KnownMargins
from synergrip.reports.html.charts import charts_of
from synergrip.reports.html.tables import Cell, Table, in_folder
from synergrip.reports.pictures.cone_sections import when_worst
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.lines import Lines
from synergrip.reports.pictures.worth import worth_bars, worth_svg
from synergrip.reports.text.part import Part
from synergrip.reports.text.text_disturbances import disturbance_part, quality_part
from synergrip.reports.text.text_margins import measures_part, numbers_part, told_value
from synergrip.reports.text.text_on_request import several_part
from synergrip.reports.text.text_sensitivities import HEADS, MEANT, SIDES, WHOLE, cells_of, tangents
from synergrip.reports.text.text_timing import how_fast

ANCHOR, TITLE = "margins", "Margins and sensitivities"
ADDED_BY = (
    "Not worked out yet: `synergrip margins FOLDER -o FOLDER`, then `synergrip report FOLDER`, add how heavy, "
    "slippery, hard and far the task may get, what is withstood, and which changes are worth most. It takes as long as "
    "some 10 to 30 plans"
)
ADDED_IN_CODE = (
    "Not worked out yet: in code `answer.report(path, margins=margins(grasp, task))` adds how heavy, slippery, hard "
    "and far the task may get, what is withstood, and which changes are worth most"
)
THERE_ARE_NONE = (
    "There are none: they are those of a plan, and there is none of this problem. `synergrip margins` says the same; "
    "which changes would give a plan, and what is proven not to help, stands under Why not"
)
UNTIL_THEN = (
    "There are none: they are those of a plan, and this motion has none. `synergrip margins` says so, too; the slip "
    "margins and the use of every limit until the motion is no longer followed stand above"
)
OF_A_CONTACT = (
    ("slip margin", "least slip margin"), ("angle to cone", "least angle to cone"),
    ("friction safety factor", "least safety factor"), ("required friction", "most required friction"),
    ("lift-off margin", "least lift-off margin"),
)  # fmt: skip
"""Measures of each contact, and what stands above their column."""
MOST_ROWS = 12
"""Changes that are told of each margin; margins.json has all of them."""


def margins_of(
    document: Mapping[str, Any], found: KnownMargins | str | None = None, folder: Path | None = None
) -> Table:
    """Return what is known of the margins of an answer, or why nothing is, and how it is added.

    Args:
        document: of the answer, as in plan.json.
        found: margins of this very plan, or why those that stand beside it are none; None without any.
        folder: of plan.json, where it is known.
    """
    if document["verdict"] != "feasible":
        known = UNTIL_THEN if document.get("true") else THERE_ARE_NONE
        return Table(ANCHOR, TITLE, before=(f"{known}.",))
    if isinstance(found, KnownMargins):
        return _told(found, document)
    left_out = (f"{FILE} beside it {found}; it is left out.",) if found else ()
    by = in_folder(ADDED_BY, folder) if (document.get("provenance") or {}).get("problem") else ADDED_IN_CODE
    return Table(ANCHOR, TITLE, before=(*left_out, f"{by}."))


def _told(found: KnownMargins, document: Mapping[str, Any]) -> Table:
    """Return the section with all that is known, the sums first."""
    who = HAND if document.get("true") else START
    parts = [_table(measures_part(found.measures, found.linear, who), numbers=("worst", "linear model"))]
    if "slip margin" in found.measures:
        parts.append(_contacts(found.measures))
    if found.direct:
        parts.append(_table(numbers_part(found.direct)))
    parts += [_table(several_part(name, several)) for name, several in found.on_request.items()]
    if found.sensitivities is not None:
        parts.append(_worth(found.sensitivities, document))
    if found.disturbance is not None:
        parts.append(_table(disturbance_part(found.disturbance)))
    if found.quality is not None:
        parts.append(_table(quality_part(found.quality)))
    if found.timing is not None:
        parts.append(Table("", "How fast the palm may go along its path", before=tuple(how_fast(found.timing))))
    stopped = ("Somebody stopped it; these numbers are finished.",) if found.interrupted else ()
    return Table(ANCHOR, TITLE, before=stopped, parts=tuple(parts))


def _table(part: Part, numbers: Sequence[str] = ()) -> Table:
    """Return a part as a table of a page; the arguments of the command line are set as such."""
    rows = tuple(
        tuple(Cell(text, head in numbers, code=head == "with") for head, text in zip(part.head, row, strict=True))
        for row in part.rows
    )
    return Table("", part.title, part.head, rows, after=part.below)


def _contacts(measures: Mapping[str, Measure]) -> Table:
    """Return how sure each contact is at its worst, and how that goes along the motion."""
    slip = measures["slip margin"]
    colors = contact_colors(slip.items)
    kinds = [(measures[name], title) for name, title in OF_A_CONTACT if name in measures]
    rows = []
    for i, name in enumerate(slip.items):
        k = when_worst(slip.value[:, i])
        worst = [each.value[:, i].max() if each.most_is_worst else each.value[:, i].min() for each, _ in kinds]
        told = [
            Cell(told_value(each, float(value)), number=True) for (each, _), value in zip(kinds, worst, strict=True)
        ]
        rows.append((Cell(name, color=colors[name]), told[0], Cell(f"{slip.times[k]:.3g} s", number=True), *told[1:]))
    head = ("contact", kinds[0][1], "when", *(title for _, title in kinds[1:]))
    lines = [] if len(slip.times) == 1 else [*_along(measures)]
    charts = charts_of(slip.times, lines)
    return Table("", "Each contact at its worst", head, tuple(rows), drawn=tuple(each.svg for each in charts))


def _along(measures: Mapping[str, Measure]) -> Iterator[Lines]:
    """Yield how much of its friction each contact uses along the motion, and how far from lifting off it is."""
    factor, lift = (measures.get(name) for name in ("friction safety factor", "lift-off margin"))
    if factor is not None and np.isfinite(factor.value).any():
        with np.errstate(divide="ignore"):
            used = np.clip(100 / factor.value, 0.0, 1000.0)
        yield Lines("friction used", "% of what holds", factor.items, used, (100.0,), of_contacts=True)
    if lift is not None and np.isfinite(lift.value).all():
        yield Lines("lift-off margin", "N", lift.items, lift.value, (0.0,), of_contacts=True)


def _worth(found: Sensitivities, document: Mapping[str, Any]) -> Table:
    """Return what changes are worth, the most first: bars to look at, and a table for each margin."""
    tables, named, drawn = list[Table](), list[Sensitivity](), list[str]()
    for kind, head in HEADS.items():
        margin = found.margins[kind]
        if margin is None:
            why = found.left_out.get(kind, "interrupted before it was found")
            tables.append(Table("", "", before=(f"What changes are worth {head.format('it')}: {why}.",)))
            continue
        under = f"what adds to the {head.format(f'{plain(margin)} N').removeprefix('of the ')}"
        every = sorted(found.of(kind), key=lambda each: (-float(f"{each.gain:.6g}"), -each.size))
        shown = [each for each in every if each.size > NOTHING * max(1.0, abs(margin))][:MOST_ROWS]
        named += shown
        tables.append(_changes(f"{under[0].upper()}{under[1:]}", shown, len(every) - len(shown)))
        drawn += [worth_svg(under, bars)] if (bars := worth_bars(found, kind)) else []
    told = [f"{SIDES}."] * bool(named) + [*tangents(named, _frames(document))]
    told += [f"{name}: {why}" for name, why in found.left_out.items() if name not in HEADS]
    below = Table("", "", before=tuple(told))
    return Table("", f"What changes are worth, {MEANT}", drawn=tuple(drawn), parts=(*tables, below))


def _changes(title: str, shown: Sequence[Sensitivity], rest: int) -> Table:
    """Return the rows of some changes; why both sides differ is told below, once for all that have it in common."""
    whys = [*dict.fromkeys(each.why for each in shown if each.why)]
    rows = []
    for each in shown:
        *cells, why = cells_of(each, whole=True)
        mark = str(whys.index(why) + 1) if why else ""
        rows.append((*(Cell(text, 1 <= i <= 3) for i, text in enumerate(cells)), Cell(mark, number=True)))
    after = [f"{number}: {why}" for number, why in enumerate(whys, start=1)]
    after += [f"{rest} more add less, or nothing; {FILE} has them."] if rest else []
    head = (*WHOLE[:-1], "note" if whys else "")
    return Table("", title, head, tuple(rows), after=tuple(after))


def _frames(document: Mapping[str, Any]) -> dict[str, Any]:
    """Return the frame of each contact of a grasp on a hand, rows n, t, o."""
    told = (document.get("execution") or {}).get("contacts") or ()
    return {each["name"]: np.array(each["frame"], dtype=float) for each in told}
