"""Numbers of each contact and of each rigid motion, as tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from shlex import quote

import numpy as np

from synergrip.documents.quantities import in_mm, plain
from synergrip.margin.direct_number import DirectNumber
from synergrip.reports.text.part import Part

TITLES = {
    "critical_friction_per_contact": "How slippery each contact may be, the others as they are",
    "largest_amplitude_per_mode": "How far each rigid motion may go, in the place of the hold",
}
"""Name -> what stands above its table."""


def several_part(name: str, numbers: Mapping[str, DirectNumber]) -> Part:
    """Return the table of some numbers, where their other ends come from, and why there are no others."""
    there = {of: each for of, each in numbers.items() if each.value is not None}
    moves = any(each.displacement is not None for each in there.values())
    whys = dict.fromkeys(each.why for each in numbers.values())
    return Part(
        TITLES[name] if numbers else f"{TITLES[name]}: there is none",
        ("", "attained", "end", *(("moved by",) if moves else ()), "with"),
        tuple(_row(of, each) for of, each in there.items()),
        tuple(f"{', '.join(of for of, each in numbers.items() if each.why == why)}: {why}" for why in whys),
    )


def attained_cells(of: str, number: DirectNumber, told: Callable[[float], str], *more: str) -> tuple[str, ...]:
    """Return the row of a number that is attained: what it is, its value, its other end, more, and how to ask for it.

    Args:
        of: what it is.
        number: that has a value.
        told: returns a value of it with its unit.
        more: further cells.
    """
    assert number.value is not None
    grows = number.value == number.lower
    end = number.upper if grows else number.lower
    other = "-" if end is None else f"{'below' if grows else 'above'} {told(end)}"
    return of, told(number.value), other, *more, f"--set {quote(number.setting)}"


def _row(of: str, number: DirectNumber) -> tuple[str, ...]:
    moved = () if number.displacement is None else (_moved(number.displacement),)
    return attained_cells(of, number, lambda value: _told(number, value), *moved)


def _told(number: DirectNumber, value: float) -> str:
    return in_mm(value, 5) if number.unit == "m" else plain(value, 5)


def _moved(displacement: tuple[float, ...]) -> str:
    """Return translation and rotation of the object."""
    size = max(map(abs, displacement))
    shift, turn = (np.where(np.abs(part) < 1e-9 * size, 0.0, part) for part in np.reshape(displacement, (2, 3)))
    told = (", ".join(f"{value:.4g}" for value in part) for part in (1e3 * shift, np.degrees(turn)))
    return "({}) mm, ({}) deg".format(*told)
