"""Every joint within its range along the plan, not only at the start.

On a hand the ranges that it states bind unless a task lets them go, with ``JointRange(lower=-inf, upper=inf)``.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

import numpy as np

from synergrip.conic.arguments import OneOrEach, numbers, one_each
from synergrip.conic.bounds import within
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.dial import Dial
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.rows import Rows
from synergrip.documents.fields import Written
from synergrip.documents.naming import naming_arguments
from synergrip.documents.numbers import number
from synergrip.documents.validation import shown
from synergrip.documents.words import listed
from synergrip.errors import InputError, suggest
from synergrip.hands.units import joint_kinds, unit_of
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp
    from synergrip.grasps.held import Held

ENDS = ("start", "lower", "upper")


@naming_arguments
@dataclass(frozen=True, eq=False)
class JointRange(Limit):
    """``lower <= q + dq <= upper`` for every joint. What is not given is what the hand of the grasp says.

    Args:
        start: joint values (n_q,) at the start [rad or m], or one for all.
        lower: ends of their ranges (n_q,), or one for all; minus infinity for none.
        upper: the same; infinity for none.
        of: what the ranges are an argument of, in messages.

    Raises:
        InputError: no numbers, or a lower end above an upper one.

    Example:
        ``JointRange()`` on a hand, where it is kept without being asked for, and
        ``JointRange(lower=-np.inf, upper=np.inf)`` lets it go; ``JointRange(start=0.2, lower=-1.0, upper=1.0)`` on
        matrices
    """

    start: OneOrEach = None
    lower: OneOrEach = None
    upper: OneOrEach = None
    of: str = field(default="JointRange", repr=False)
    key = "limits.joint_range"

    def __new__(cls, *values: OneOrEach, **named: OneOrEach) -> Self:
        """Refuse one or two numbers without names, the first of which would be the start and not an end."""
        refuse_some_of(cls, values, named)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        """Judge the numbers."""
        for end in ENDS:
            value, name = getattr(self, end), f"{self.of}.{end}"
            if value is None:
                continue
            found = numbers(name, value, "joint")
            if np.any(np.isnan(found)) or (end == "start" and not np.all(np.isfinite(found))):
                worst = found[~np.isfinite(found)].ravel()[0]
                raise InputError.at(name, f"expected finite numbers{' or infinity' * (end != 'start')}, got {worst:g}")
            if np.any(found == {"lower": np.inf, "upper": -np.inf}.get(end, np.nan)):
                free = "-math.inf" if end == "lower" else "math.inf"
                raise InputError.at(name, f"no joint gets as far as {found.ravel()[0]:g}; {free} stands for no bound")
            object.__setattr__(self, end, found)
        low, high = (np.atleast_1d(0.0 if end is None else end) for end in (self.lower, self.upper))
        given = self.lower is not None and self.upper is not None
        if given and (len(low) == len(high) or 1 in (len(low), len(high))) and np.any(low > high):
            k = int(np.argmax(np.broadcast_to(low - high, (max(len(low), len(high)),)) > 0))
            pair = (float(end[k if len(end) > 1 else 0]) for end in (low, high))
            message = "the lower bound {:g} is above the upper bound {:g}; swap them".format(*pair)
            raise InputError.at(f"{self.of}.lower", message)

    def on(self, grasp: Grasp) -> Self:
        """Return it with one number for each joint, and those of the hand where none is given."""
        missing = [end for end in ENDS if getattr(self, end) is None]
        if missing and grasp.held is None:
            message = f"needs a hand with joint ranges; a grasp given as matrices states none, give {listed(missing)}"
            raise InputError.at(f"{self.of}.{missing[0]}", message)
        of_hand = {} if grasp.held is None else _stated(grasp.held)
        each: dict[str, Any] = {
            end: one_each(f"{self.of}.{end}", of_hand[end] if end in missing else getattr(self, end),
                          grasp.joints, "joint")
            for end in ENDS
        }  # fmt: skip
        return replace(self, **each)

    @property
    def lets_go(self) -> bool:
        """Whether it bounds no joint at all, whatever the hand states."""
        given = [end for end in (self.lower, self.upper) if end is not None]
        return len(given) == 2 and not any(np.any(np.isfinite(end)) for end in given)

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """How wide all ranges are, as a multiple of those that the hand states, or else of what they are."""
        if self.lets_go:
            return ()
        wide = 1.0 if grasp.held is None else _times(self, _stated(grasp.held))

        def written(value: float) -> str:
            return f"{{ wider = {value - 1:.10g} }}"

        return (Dial("joint_range", self.key, wide, "", lambda v: self.loosened(v / wide - 1), written=written),)

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each joint, in units of half its range; none where nothing gets as far."""
        names = formulation.response.grasp.joints
        start, lower, upper = self._ends(formulation)
        unit = _unit(lower, upper)
        least, most = (start + span for span in formulation.joint_span)
        lower, upper = np.where(least > lower, -np.inf, lower), np.where(most < upper, np.inf, upper)
        return within(self.key, names, formulation.joint.plus(start), lower, upper, unit)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return the joint displacements and how far they may go."""
        start, lower, upper = self._ends(formulation)
        return formulation.joint, np.maximum(upper - start, start - lower)

    def loosened(self, share: float) -> Self:
        """Return it with ranges wider by `share` of half of each; those of a hand must be filled in."""
        more = share * _unit(self.lower, self.upper)
        return replace(self, lower=frozen(self.lower - more), upper=frozen(self.upper + more))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the joint values that the motion reaches."""
        start, lower, upper = self._ends(formulation)
        grasp = formulation.response.grasp
        value = frozen(start + motion.dq)
        scale = _unit(lower, upper)
        return Usage("joint value", self.unit(grasp), grasp.joints, value, lower, upper, scale, motion.times)

    def unit(self, grasp: Grasp) -> str:
        """Return the unit of all joints; nothing when some turn and some slide."""
        return "rad" if grasp.held is None else unit_of(joint_kinds(grasp.held.hand.joints).values(), "rad", "m")

    def _ends(self, formulation: Formulation) -> tuple[Array, Array, Array]:
        own = self.on(formulation.response.grasp)
        return own.start, own.lower, own.upper


def _unit(lower: Array, upper: Array) -> Array:
    half = (upper - lower) / 2
    return np.where(np.isfinite(half) & (half > 0), half, 1.0)


def _times(ranges: JointRange, stated: dict[str, Array]) -> float:
    """Return how many times as wide all ranges are as those that are stated; 1 where not all are as many times so."""
    ratios = np.asarray(_unit(ranges.lower, ranges.upper) / _unit(stated["lower"], stated["upper"]))
    return float(ratios.mean()) if np.ptp(ratios) <= 1e-9 * ratios.max() else 1.0


def refuse_some_of(ranged: type, values: Sequence[OneOrEach], named: Collection[str]) -> None:
    """Refuse values without names where not all of `ENDS` are given: few mean the start by the first one.

    Raises:
        InputError: there are one or two, and names are missing.
    """
    if values and not {*ENDS[len(values) :]} <= {*named}:
        names = f"{ranged.__name__}(lower=..., upper=...)"
        told = "one value without a name" if len(values) == 1 else "two values without names"
        raise InputError.at(ranged.__name__, f"{told}; write {names}, or start, lower and upper in this order")


def _stated(held: Held) -> dict[str, Array]:
    """Return posture and ranges of a hand."""
    lower, upper = (frozen([getattr(joint, end) for joint in held.hand.joints]) for end in ("lower", "upper"))
    return {"start": held.q, "lower": lower, "upper": upper}


def _made(value: Any, grasp: Grasp) -> JointRange:
    if grasp.held is None:
        raise InputError.at("", "needs a [hand]; a grasp file states no joint ranges")
    if isinstance(value, float):
        return JointRange().on(grasp).loosened(value)
    return JointRange() if value == "hand" else JointRange(lower=-np.inf, upper=np.inf)


def _ranges(value: object) -> str | float:
    if isinstance(value, dict) and set(value) == {"wider"}:
        return number(value["wider"], at_least=0)
    if value in ("hand", "none"):
        return str(value)
    near = suggest(value, ["hand", "none"]) if isinstance(value, str) else ""
    raise InputError.at("", f"expected 'hand', 'none' or {{ wider = 0.05 }}, got {shown(value)}{near}")


_NOT_NEGATIVE = {"type": "number", "minimum": 0}
_WIDER = {
    "type": "object", "properties": {"wider": {**_NOT_NEGATIVE, "description": "share of every range"}},
    "required": ["wider"], "additionalProperties": False,
}  # fmt: skip
_Ranges = Annotated[Literal["hand", "none"] | float, Written(_ranges, {"anyOf": [{"enum": ["hand", "none"]}, _WIDER]})]
"""Ranges of the hand, none, or those of the hand with a share of half of each more at both ends."""


IN_FILE = FileKey(
    "joint_range", JointRange, _Ranges,
    '"hand": every joint stays within the range that the hand states, as it does when nothing is said; "none": they '
    "are let go; { wider = 0.05 }: within ranges wider by a twentieth, half of that at each end",
    _made,
)  # fmt: skip
