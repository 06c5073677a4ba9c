"""What a plan withstands beside its load: extra wrenches of any direction, in a box, or along given directions.

An extra wrench acts about B in the axes of N and is there as long as one likes: friction cones, as they are and without
any margin, and the other limits of the task hold at every knot. **Passively** the references stay those of the plan and
the hand yields; **actively** the internal forces answer, planned again inside E_s for each wrench.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.documents.judging import Arguments, as_numbers, described
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.margin.disturbance.active import End, active_along, active_box, as_radius, nearest_end
from synergrip.margin.disturbance.executed_wrench import ExecutedWrench, executed_wrench
from synergrip.margin.disturbance.passive import passive_along, passive_ball
from synergrip.margin.disturbance.policy import largest_answered
from synergrip.margin.disturbance.reacting import statics_of
from synergrip.margin.disturbance.reaction import Reaction
from synergrip.margin.disturbance.withstood import Withstood
from synergrip.planning.outcome import Plan
from synergrip.tasks.corners import box_corners
from synergrip.values import Value

AXES = tuple(tuple(sign * float(i == j) for j in range(6)) for i in range(6) for sign in (1.0, -1.0))
"""Forces along and moments about the axes of N."""


@made_by("disturbances(plan).along")
@dataclass(frozen=True, eq=False, repr=False)
class WithstoodAlong(Value):
    """How much of an extra wrench along one direction, or of a box, is withstood.

    Example:
        >>> up = disturbances(plan, directions=[(0, 0, 1, 0, 0, 0)]).along[0]  # doctest: +SKIP
        >>> up.unit, up.passive.upper, up.active.upper  # doctest: +SKIP
        ('N', 1.4470, 41.964)
    """

    wrench: Array
    """(6,) about B, axes of N: of one newton, or one newton metre where it has no force; the half-widths of a box."""
    unit: str
    """Of the sizes: "N", "N m", or nothing for the factor of a box."""
    passive: Withstood
    """References stay as they are; all limits of the task hold."""
    slip: Withstood
    """The same, where the friction cones alone are asked."""
    active: Withstood
    """Internal forces answer."""


@made_by("disturbances(plan)")
@dataclass(frozen=True, eq=False, repr=False)
class Disturbances(Value):
    """What a plan withstands beside its load; radii are those of balls by the length-scaled norm [N].

    ``||w||^2 = |f|^2 + |m|^2 / L^2``, f the force, m the moment about the centroid of the contacts, L their mean
    distance from it.

    Example:
        >>> found = disturbances(plan)  # doctest: +SKIP
        >>> found.passive.lower, found.active.lower, found.active.upper  # doctest: +SKIP
        (0.507681, 1.5016, 1.93994)
    """

    passive: Withstood
    """References stay as they are; all limits of the task hold. Exact."""
    slip: Withstood
    """The same, where the friction cones alone are asked. Exact."""
    active: Withstood
    """Internal forces answer: proven by an answer that is affine in the wrench, ended by a wrench that has none."""
    along: tuple[WithstoodAlong, ...]
    box: WithstoodAlong | None
    length: float
    """L [m]."""
    centroid: Array
    """(3,) of the contacts from B [m]: moments of the norm are about it."""
    of: str
    """Which linear model they are of: of "the start posture", or about "the true equilibria" of a hand that moves."""
    executed: ExecutedWrench | None
    """Nearly the wrench at which a contact slips first, on the hand that moves; None without a hand."""
    left_out: tuple[str, ...] = ()
    """Keys of limits that say nothing of an instant, and that all of these figures leave out: on changes from knot to
    knot, and on what adds up over time."""

    @property
    def known_share(self) -> float | None:
        """How much of the upper end of the active ball is proven to be withstood; None without an end."""
        upper = self.active.upper
        return None if upper is None else self.active.lower / upper if upper else 1.0


@naming_arguments
def disturbances(
    plan: Plan, *, directions: Sequence[Sequence[float]] | Array = AXES, box: Sequence[float] | Array | None = None
) -> Disturbances:
    """Return what a plan withstands beside its load.

    Args:
        plan: of any task.
        directions: (n, 6) of extra wrenches about B, axes of N [N, N m]; only their direction counts. By default both
            ways along and about every axis.
        box: (6,) half-widths of a box of extra wrenches [N, N m], 0 or more; what is looked for is the largest common
            factor of them.

    Raises:
        InputError: no plan, directions that are none, or half-widths that are none.

    Example:
        >>> found = disturbances(plan, box=(1, 1, 1, 0, 0, 0))  # doctest: +SKIP
        >>> found.box.passive.upper  # doctest: +SKIP
        0.2931
    """
    judge = Arguments("")
    judge.one("plan", plan, Plan, "the one that plan(grasp, task) returns where there is one")
    judge.finish()
    wrenches, widths = judged_directions(directions), judged_box(box)
    each = statics_of(plan)
    every, cones = Reaction.of(plan, each), Reaction.of(plan, each, cones_alone=True)
    ends = [active_along(every, every.scaled(wrench)) for wrench in wrenches]
    along = tuple(_along(every, cones, wrench, end) for wrench, end in zip(wrenches, ends, strict=True))
    axes = (
        ends if np.array_equal(wrenches, AXES) else [active_along(every, every.scaled(np.array(axis))) for axis in AXES]
    )
    passive, slip, scale = passive_ball(every), passive_ball(cones), plan.analysis.response.scale
    return Disturbances(
        passive, slip, _active(every, passive, [*ends, *axes]), along,
        None if widths is None else _box(every, cones, widths), scale.length, scale.centroid,
        "the start posture" if plan.executed is None else "the true equilibria", executed_wrench(plan, slip),
        tuple(limit.key for limit in plan.task.all_limits if limit.couples_knots),
    )  # fmt: skip


def _active(reaction: Reaction, passive: Withstood, known: Sequence[End]) -> Withstood:
    """Return the ball of what is withstood when internal forces answer, between an answer and a wrench without one."""
    end = nearest_end(reaction, known)
    outside = as_radius(reaction, end)
    first = int(np.argmin(np.abs(reaction.times - (outside.time_s or 0.0))))
    inside = reaction.unit * largest_answered(reaction, passive.lower / reaction.unit, end.radius, first)
    return replace(outside, lower=inside if outside.upper is None else min(inside, outside.upper))


def _along(every: Reaction, cones: Reaction, wrench: Array, end: End) -> WithstoodAlong:
    unit = "N" if np.any(wrench[:3]) else "N m"
    passive, slip = (passive_along(each, each.scaled(wrench)[None]) for each in (every, cones))
    active = replace(end.found, lower=max(end.found.lower, passive.lower))  # as it is, is an answer, too
    return WithstoodAlong(frozen(wrench), unit, passive, slip, active)


def _box(every: Reaction, cones: Reaction, widths: Array) -> WithstoodAlong:
    ends = every.scaled(box_corners(widths))
    passive, slip = (passive_along(each, ends) for each in (every, cones))
    active = active_box(every, ends)
    return WithstoodAlong(widths, "", passive, slip, replace(active, lower=max(active.lower, passive.lower)))


def judged_directions(directions: object) -> Array:
    """Return directions (n, 6) of one newton each, or of one newton metre where there is no force.

    Raises:
        InputError: something else.
    """
    found = as_numbers(directions)
    if found is None or found.ndim not in (1, 2) or found.shape[-1] != 6 or not found.size:
        wanted = "extra wrenches (n, 6): 3 forces and 3 moments each, such as (0, 0, -1, 0, 0, 0)"
        raise InputError.at("directions", f"expected {wanted}; got {described(directions)}")
    found = np.atleast_2d(found)
    if not np.all(np.isfinite(found)) or not np.all(np.any(found, axis=1)):
        raise InputError.at("directions", "expected finite numbers, not all of them 0; a direction has a length")
    found = found / np.abs(found).max(axis=1, keepdims=True)  # however large or small
    forces, moments = (np.linalg.norm(part, axis=1) for part in (found[:, :3], found[:, 3:]))
    return frozen(found / np.where(forces > 0, forces, moments)[:, None])


def judged_box(box: object) -> Array | None:
    """Return half-widths (6,) of a box, as they are given.

    Raises:
        InputError: something else.
    """
    if box is None:
        return None
    found = as_numbers(box)
    if found is None or found.shape != (6,) or not np.all(np.isfinite(found)) or np.any(found < 0) or not np.any(found):
        wanted = "6 half-widths, of 3 forces [N] and 3 moments [N m], 0 or more and not all 0"
        raise InputError.at("box", f"expected {wanted}, such as (1, 1, 1, 0, 0, 0); got {described(box)}")
    return frozen(found)
