"""What a plan withstands, and the classical figures of its grasp, as text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from synergrip.documents.quantities import in_mm, plain
from synergrip.margin.disturbance.disturbances import AXES, Disturbances, WithstoodAlong
from synergrip.margin.disturbance.executed_wrench import ExecutedWrench
from synergrip.margin.disturbance.withstood import Withstood
from synergrip.margin.wrench_space.quality import WrenchSpaceQuality
from synergrip.reports.text.part import Part

NAMES = ("force along x", "force along y", "force along z", "moment about x", "moment about y", "moment about z")
SAME = 5e-5
"""Relative difference of two ends that are told as one number."""
FAR_APART = 0.05
"""The same from which on both are told to two digits."""
NONE_LEFT = 1e-5
"""[N] or [N m] below which nothing is left."""


def disturbance_part(found: Disturbances) -> Part:
    """Return what is withstood: in any direction, along and about the axes or what was asked for, in a box."""
    rows = [("any direction", *_cells("N", found.slip, found.passive, found.active))]
    every = np.array([each.wrench for each in found.along])
    if np.array_equal(every, AXES):
        pairs = zip(NAMES, found.along[::2], found.along[1::2], strict=True)
        rows += [(name, *_lesser(one, other)) for name, one, other in pairs]
    else:
        rows += [
            (_written(each.wrench), *_cells(each.unit, each.slip, each.passive, each.active)) for each in found.along
        ]
    if found.box is not None:
        box = found.box
        rows.append((f"box of {_written(box.wrench)}", *_cells("times", box.slip, box.passive, box.active)))
    title = f"What it withstands beside its load, of the linear model {_about(found)}"
    head = ("", "until it slips", "within all limits", "forces answering", "these end at")
    return Part(title, head, tuple(rows), tuple(_said(found)))


def _said(found: Disturbances) -> Iterator[str]:
    norm = f"force and moment about the middle of the contacts / {in_mm(found.length, 4)}"
    yield (
        f"any direction: a ball of extra wrenches, {norm}; axes are those of the palm through the origin of the "
        "object, the lesser of both ways is told. References stay as they are in the first two columns; in the third "
        "internal forces are planned again for each wrench"
    )
    if not found.passive.lower > NONE_LEFT and found.passive.limit:
        yield f"within all limits nothing is left: the plan uses all of {found.passive.limit}"
    if found.left_out:
        yield f"left out, for they say nothing of an instant: {', '.join(found.left_out)}"
    if found.executed is not None:
        yield _executed(found.executed)


def quality_part(found: WrenchSpaceQuality) -> Part:
    """Return the classical figures, those of the synergies beside those of any forces."""
    title = "Classical figures, free of units: normal forces of 1 together (L1), moments divided by the same length"
    rows = (
        ("epsilon quality", _pair(found.epsilon), _pair(found.epsilon_synergies)),
        *_of_each(found),
        ("volume", _pair(found.volume), _pair(found.volume_synergies)),
        (
            "smallest singular value",
            f"{found.smallest_singular_value:.4g}",
            f"{found.singular_values_synergies[-1]:.4g}",
        ),
        ("isotropy", f"{found.isotropy:.4g}", f"{found.isotropy_synergies:.4g}"),
    )
    head = ("", "any contact forces", "those that synergies and loads make")
    return Part(title, head, rows, (found.why,) if found.why else ())


def _of_each(found: WrenchSpaceQuality) -> Iterator[tuple[str, str, str]]:
    """Yield the row of normal forces of 1 each, where it was asked for."""
    if found.epsilon_each is not None and found.epsilon_each_synergies is not None:
        yield "epsilon, 1 each (L-infinity)", _pair(found.epsilon_each), _pair(found.epsilon_each_synergies)


def _about(found: Disturbances) -> str:
    return f"of {found.of}" if found.of == "the start posture" else f"about {found.of}"


def _lesser(one: WithstoodAlong, other: WithstoodAlong) -> tuple[str, ...]:
    """Return the cells of the lesser of both ways, column by column."""
    return _cells(one.unit, *(min(getattr(one, name), getattr(other, name), key=_told_size)
                              for name in ("slip", "passive", "active")))  # fmt: skip


def _told_size(found: Withstood) -> float:
    """Return what counts as the size where two are compared: of such as differ by rounding the first is the lesser."""
    return float(f"{found.lower:.6g}")


def _cells(unit: str, slip: Withstood, passive: Withstood, active: Withstood) -> tuple[str, ...]:
    return (*(_size(unit, each) for each in (slip, passive, active)), _end(active))


def _size(unit: str, found: Withstood) -> str:
    if found.upper is None:
        return "no end found" if found.proven else "not known"
    if not found.upper > NONE_LEFT:
        return f"0 {unit}"
    return f"{_ends(found.lower, found.upper)} {unit}"


def _ends(lower: float, upper: float) -> str:
    """Return a lower and an upper end, rounded away from each other where they are apart; as one number where not."""
    apart = upper - lower
    if apart <= SAME * upper:
        return f"{lower:.4g}"
    digits = 2 if apart > FAR_APART * upper else 3
    return f"{_rounded(lower, digits, np.floor):.{digits}g} to {_rounded(upper, digits, np.ceil):.{digits}g}"


def _rounded(value: float, digits: int, to: Callable[[float], float]) -> float:
    if not value > 0:
        return 0.0
    step = 10.0 ** (np.floor(np.log10(value)) + 1 - digits)
    return float(to(value / step) * step)


def _end(found: Withstood) -> str:
    """Return what ends it."""
    where = f"{found.limit} {found.item}".strip()
    return where if found.time_s is None or not where else f"{where}, t = {found.time_s:.2f} s"


def _pair(ends: tuple[float, float]) -> str:
    return _ends(*ends)


def _written(wrench: Sequence[float] | np.ndarray) -> str:
    return " ".join(f"{value:.4g}" for value in wrench)


def _executed(found: ExecutedWrench) -> str:
    what = f"on the hand that moves, {found.share:.0%} of the least extra wrench at which a contact slips"
    if found.margin is None:
        return f"{what} does not let it reach its end ({found.why})"
    if found.holds:
        return f"{what} leaves a slip margin of {plain(found.margin)} N"
    return (
        f"{what} makes '{found.contact}' slip at t = {found.time_s:.2f} s ({plain(found.margin)} N): less is withstood"
    )
