"""How large an extra wrench may be, between what is withstood for certain and where something gives way."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.documents.naming import made_by
from synergrip.linalg import Array, frozen
from synergrip.margin.disturbance.reaction import Reaction
from synergrip.values import Value


@made_by("disturbances(plan)")
@dataclass(frozen=True, eq=False, repr=False)
class Withstood(Value):
    """The size of extra wrenches that is withstood, and what ends it.

    Example:
        >>> ball = disturbances(plan).passive  # doctest: +SKIP
        >>> ball.lower, ball.upper, ball.limit, ball.item  # doctest: +SKIP
        (0.507681, 0.507682, 'friction cone', 'finger1/tip')
    """

    lower: float
    """Proven to be withstood."""
    upper: float | None
    """Just beyond it something gives way; None where no end was found."""
    limit: str = ""
    """What gives way: the friction cone, or a limit of the task by its key; "free motion" where nothing resists."""
    item: str = ""
    """Of which contact, joint or synergy."""
    time_s: float | None = None
    wrench: Array | None = None
    """(6,) about B, axes of N [N, N m]: at `upper`, where it gives way."""
    proven: bool = True
    """Whether both ends are: by multipliers for the lower one, by a wrench and, where forces may answer, a certificate
    for the upper one."""


NO_END = Withstood(np.inf, None)


def none_of_it(reaction: Reaction, towards: Array) -> Withstood:
    """Return that an extra wrench moves the object where no contact resists, however small it is."""
    return Withstood(0.0, 0.0, "free motion", "object", None, frozen(0.0 * reaction.wrench(towards)))


def scaled(found: Withstood, factor: float) -> Withstood:
    """Return it measured in another unit, of which it is that many times as many."""
    return replace(found, lower=factor * found.lower, upper=None if found.upper is None else factor * found.upper)
