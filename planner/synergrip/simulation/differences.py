"""Where margins in the engine are not those promised, and what the likely cause is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.simulation.played_plan import PlayedPlan
from synergrip.simulation.playing import Played
from synergrip.values import Value

SAME, SHARE = 0.05, 0.02
"""How far a margin may be from the promised one [N], and the share of the largest force that is added."""


@dataclass(frozen=True)
class Difference(Value):
    """A contact whose smallest margin in the engine is not the smallest one promised."""

    contact: str
    played: float  # [N]
    promised: float  # [N]


@dataclass(frozen=True)
class Circumstances(Value):
    """What a play had in it that a plan has not."""

    friction: float
    """What all friction was multiplied by."""
    speed: str
    half_step: float | None  # [N] by how much margins differ with half the step
    sliding: Sequence[str]
    """Contacts that slipped, were lost, or were on their cone."""
    before: bool = False
    """Whether the first of them did so before anything moved."""


def allowed_difference(plan: PlayedPlan) -> float:
    """Return how far margins may be from those promised [N]."""
    return SAME + SHARE * float(np.abs(plan.forces).max(initial=0.0))


def differences(plan: PlayedPlan, least: Array) -> tuple[Difference, ...]:
    """Return the contacts whose smallest margins (n_c,) [N] are further from those promised than they may be."""
    pairs = zip(plan.names, least.tolist(), plan.margins.min(axis=0).tolist(), strict=True)
    within = allowed_difference(plan)
    return tuple(Difference(*each) for each in pairs if abs(each[1] - each[2]) > within)


def likely_cause(plan: PlayedPlan, found: Sequence[Difference], circumstances: Circumstances) -> str | None:
    """Return why margins are likely to differ; None when none does."""
    if not found:
        return None
    if plan.unchanged is False:
        return "plan.json is not as it was written, and what it claims is of other numbers: `synergrip check` judges it"
    if circumstances.friction != 1.0:
        return f"all friction was multiplied by {circumstances.friction:g}, for which nothing was promised"
    if circumstances.before:
        return "the references of the start do not hold the load of the start: that went wrong before anything moved"
    return _cause_on_the_way(plan, max(found, key=lambda each: abs(each.played - each.promised)), circumstances)


def _cause_on_the_way(plan: PlayedPlan, first: Difference, circumstances: Circumstances) -> str:
    off, own = abs(first.played - first.promised), plan.names.index(first.contact)
    true = None if plan.true_margins is None else float(plan.true_margins[:, own].min())
    half = circumstances.half_step
    if true is None:
        return "the plan was not checked on the hand that moves: it tells no true equilibrium"
    if abs(true - first.promised) > off / 2:
        return f"the hand that moves has {true:.4g} N by the plan itself; plan it along the motion"
    if half is not None and half > off / 2:
        return "the step is too long: with half of it margins are others; try --step"
    if circumstances.speed == "real":
        return "inertia, which is not in a plan: `--speed slow` leaves it out"
    if plan.contact_model == "fixed" and any(pad.radius > 0 for pad in plan.pads):
        return "contacts of the plan do not roll, and round pads do here"
    if circumstances.sliding:
        return f"forces are others from when {', '.join(circumstances.sliding)} slid"
    return "none is known; compare `lambda` of simulation.json and of plan.json"


def half_step_difference(found: Played, finer: Played) -> tuple[float, float]:
    """Return how far margins [N] and motion [m] of two plays are apart, where both have been."""
    count = min(len(found.time), len(finer.time))
    if count < 2:
        return float(np.abs(found.least - finer.least).max()), float("inf")
    order = np.argsort(finer.time, kind="stable")

    def apart(a: Array, b: Array) -> Array:
        # one value for each instant: what stands at the same time twice is a jump, whose last value counts
        return np.column_stack([np.interp(found.time, finer.time[order], column) for column in b[order].T]) - a

    margins = np.abs(finer.least - found.least).max()
    shift = np.linalg.norm(apart(found.du[:, :3], finer.du[:, :3]), axis=1).max()
    return float(margins), float(shift)
