"""A set of limits of which none can be left out: together they leave no plan, without any one there may be one."""

from __future__ import annotations

from dataclasses import replace

from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.explain.asked import Asked
from synergrip.explain.least_change import solved


def clashing(asked: Asked) -> tuple[str, ...] | None:
    """Return the keys of limits that cannot hold together, with physics (friction, load, motion) as it is.

    Limits are left out one after the other; each that stays is certified to be needed, or at least not certified not
    to be. Empty, physics alone leaves no plan.

    Args:
        asked: a task without a plan.

    Returns:
        The keys; None when that all limits together leave no plan is not certified here.
    """
    limits = tuple(asked.task.limits)
    if not _none(asked, limits):
        return None
    for limit in limits:
        fewer = tuple(each for each in limits if each is not limit)
        if isinstance(limit, SlipMargin):  # without a margin its cones stay
            fewer = (replace(limit, margin=0.0), *fewer) if limit.margin else limits
        if fewer != limits and _none(asked, fewer):
            limits = fewer
    return tuple(limit.key for limit in limits if not isinstance(limit, SlipMargin) or limit.margin)


def _none(asked: Asked, limits: tuple[Limit, ...]) -> bool:
    """Return whether it is certified that no plan keeps some limits."""
    posed = asked.with_limits(limits).posed()
    return posed is not None and solved("any plan", posed.program()).infeasible
