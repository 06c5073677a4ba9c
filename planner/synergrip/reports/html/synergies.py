"""What the synergies control, as a part of a report: Theorem 1, reachable motions, and what each does by itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from synergrip.documents.quantities import plain
from synergrip.reports.data.json_control import KEY
from synergrip.reports.html.tables import Cell, Table
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.text.text_analysis import combination
from synergrip.reports.text.unbroken import freed
from synergrip.statics.twists import describe_displacement

NAMES = (
    ("dim_E_s", "contact forces that they control (E_s)"),
    ("dim_Gamma_ucs", "rigid motions of the object that they can produce (Γ_ucs)"),
    ("dim_Gamma_zr", "what is left over: hand motions without effect on object and forces (Γ_zr)"),
)

WHERE = "At the start posture, in axes of the palm; B is the origin of the object."


def synergies_of(document: Mapping[str, Any]) -> Iterator[Table]:
    """Yield what the synergies control; nothing where the object is not restrained."""
    counts = document.get("structure") or {}
    if counts.get("dim_E_s") is None:
        return
    rows = tuple((Cell(text), Cell(str(counts[key]), number=True)) for key, text in NAMES)
    total = " + ".join(str(counts[key]) for key, _ in NAMES)
    after = f"Theorem 1 of the paper: {total} = {counts['n_z']} synergies; the hand has {counts['n_q']} joints."
    parts = _parts(document) if KEY in document else ()
    yield Table("synergies", "What the synergies control", ("", "dimensions"), rows, after=(after,), parts=tuple(parts))


def _parts(document: Mapping[str, Any]) -> Iterator[Table]:
    told, names = document[KEY], tuple(document["synergies"])
    if told["motions"]:
        rows = [(Cell(str(number), number=True), Cell(each["text"]), Cell(_sum(each["references"], names)))
                for number, each in enumerate(told["motions"], start=1)]  # fmt: skip
        yield Table(
            "", "Motions of the object that they can make", ("Γ_ucs", "motion", "by"), tuple(rows), after=(WHERE,)
        )
    if told["redundant"]:
        sums = [_sum(each, names) for each in told["redundant"]]
        left = tuple((Cell(str(number), number=True), Cell(text)) for number, text in enumerate(sums, start=1))
        yield Table("", "Sums of synergies that move no contact", ("Γ_zr", "synergies"), left)
    yield _each(document)


def _each(document: Mapping[str, Any]) -> Table:
    """Return what a step of each synergy does to the object and at the contacts, from the start posture."""
    length, colors = document["structure"]["characteristic_length_m"], contact_colors(document["contacts"])
    rows = []
    for each in document[KEY]["each"]:
        step = f"{1 if each['unit'] else each['step']:g} {each['unit']}".strip()
        share = each["squeezing_share"]
        squeezes = "moves no contact" if share is None else f"{plain(100 * share, 2)} %" if share else "none"
        forces = [Cell(f"{plain(force, 3)} N" if force else "0", number=True) for force in each["internal_N"]]
        moved = describe_displacement(np.array(each["motion"]), length) if any(each["motion"]) else "none"
        rows.append((Cell(each["name"]), Cell(step, number=True), Cell(moved), Cell(squeezes), *forces))
    head = ("synergy", "step", "moves the object by", "of it squeezes", *(f"force at {name}" for name in colors))
    after = (
        "Each by itself, from the start posture, in the linear model: sizes of the forces that it adds; of its motion "
        "at the contacts what no rigid motion of the object follows squeezes."
    )
    return Table("", "What each synergy does by itself", head, tuple(rows), after=(after,))


def _sum(references: Sequence[float], names: tuple[str, ...]) -> str:
    return freed(combination(np.array(references), names))
