"""The numbers that people ask for first: how slippery, how heavy, how much load, how hard, how fast, how far."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import first_plan, posed_at
from synergrip.changes.extreme import FAR, Extreme, extreme
from synergrip.changes.turning import amplitude_dial, duration_dial, friction_dial, load_dial, mass_dial
from synergrip.conic.limits.actuator_effort import ActuatorEffort, unit_of_efforts
from synergrip.conic.limits.dial import Dial, quantity
from synergrip.conic.limits.normal_force import NormalForce, least_normal_force
from synergrip.margin.along import NEAR, Search
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.weight_alone import as_weight, is_weight
from synergrip.planning.outcome import Plan
from synergrip.planning.pace import BRIEF
from synergrip.values import Value

HEAVIEST, FACTOR = "heaviest_kg", "load_factor"
NUMBERS = (
    "critical_friction_scale", HEAVIEST, FACTOR, "least_peak_N", "least_effort", "shortest_duration_s",
    "largest_amplitude",
)  # fmt: skip
"""Names of all that are asked for, as `wanted` has them."""
AT_END = 2e-3
"""Share of a number within which the plan that is there is at its end already."""
MORE = (1e-5, 2e-3, 2e-2, 1e-1)
"""Shares by which a bound is wider than what the plan uses that is there: the first with a plan is told."""
OF_PLAN = ("force_cap", "effort")
"""What is bounded from the plan that is there on, which was not asked with that bound."""
TRIES, CLOSER, SURE = 3, 3, 7
"""How many values are tried along the motion with a few passes, if nothing else is said; how many more where a value
with a plan and one without are far from each other; and how many with all effort then, most often one: a few passes
give up where more of them find a plan. A bound is not looked for along the motion where a plan that was made without it
is as near to its end as two values that are near each other."""


@dataclass(frozen=True, eq=False, repr=False)
class Wanted(Value):
    """A number that is asked for."""

    name: str
    unit: str
    dial: Dial[Asked] | None
    """What is turned toward less room; None where there is no such thing."""
    absent: str
    """Why there is none."""
    per: float = 1.0
    """What the values of the dial are divided by."""
    tries: int = TRIES
    """How many values are tried on a hand that moves."""


def wanted(asked: Asked, plan: Plan) -> tuple[Wanted, ...]:
    """Return all numbers of a grasp and a task that has a plan."""
    timed = plan.task
    friction, mass, grasp = friction_dial(asked), mass_dial(asked), asked.grasp
    load = load_dial(asked, timed) if np.any(timed.wrench) else None
    motion = amplitude_dial(asked, timed) if np.any(timed.target.values) else None
    no_mass = "nothing in the task weighs the object" if grasp.held else "a grasp given as matrices has no object"
    return (
        Wanted("critical_friction_scale", "", friction, "no contact has friction", friction.value if friction else 1.0),
        Wanted(HEAVIEST, "kg", mass, no_mass),
        Wanted(FACTOR, "", load, "there is no load", load.value if load else 1.0),
        Wanted("least_peak_N", "N", _cap(asked, plan), ""),
        Wanted("least_effort", unit_of_efforts(grasp), _effort(asked, plan), "there is no effort"),
        Wanted(
            "shortest_duration_s", "s", duration_dial(asked, timed),
            "nothing depends on how long the task takes, or a load has times of its own",
        ),
        Wanted("largest_amplitude", "", motion, "no motion is wanted", motion.value if motion else 1.0),
    )  # fmt: skip


def _cap(asked: Asked, plan: Plan) -> Dial[Asked]:
    """Return a bound on all normal forces, from the largest of a plan on."""
    largest = float(plan.forces[:, asked.grasp.normal_rows].max())
    others = tuple(limit for limit in asked.limits if not isinstance(limit, NormalForce))
    lower = least_normal_force(asked.limits)

    (dial, *_) = NormalForce(lower=lower, upper=max(largest, lower)).dials(asked.grasp)
    return Dial(
        "force_cap", dial.key, largest, "N", lambda value: asked.with_limits((*others, dial.turned(value))),
        written=dial.written,
    )  # fmt: skip


def _effort(asked: Asked, plan: Plan) -> Dial[Asked] | None:
    """Return a bound on the effort of all actuators, from the largest of a plan on, beside those that are there."""
    largest = float(np.abs(plan.motion.efforts).max())
    if not largest:
        return None

    def turned(value: float) -> Asked:
        return asked.with_limits((*asked.limits, ActuatorEffort(value)))

    return Dial("effort", "limits.actuator_effort", largest, "", turned, written=lambda value: quantity(value, ""))


def direct(numbers: Iterable[Wanted], asked: Asked, plan: Plan) -> Iterator[DirectNumber]:
    """Yield numbers, each as it is found.

    Args:
        numbers: some of `wanted`.
        asked: what is asked, limits filled in.
        plan: of it.
    """
    posed = asked.posed(plan.analysis)
    found: dict[str, DirectNumber] = {}
    for each in numbers:
        if each.dial is None or posed is None:
            yield DirectNumber.none(each.name, each.unit, each.absent)
            continue
        if each.name == FACTOR and is_weight(asked, plan.task):
            mass = next(other for other in wanted(asked, plan) if other.name == HEAVIEST)
            assert mass.dial is not None
            heaviest = found.get(HEAVIEST) or number_of(mass, mass.dial, posed, plan)
            yield as_weight(each.name, each.dial, mass.dial, heaviest)
            continue
        found[each.name] = number_of(each, each.dial, posed, plan)
        yield found[each.name]


def number_of(of: Wanted, dial: Dial[Asked], posed: Posed, plan: Plan) -> DirectNumber:
    """Return how far one number may go.

    Args:
        of: what is asked for.
        dial: of it, what is turned.
        posed: what is asked, as a program of the start posture.
        plan: of it.
    """
    own = posed_at(dial, dial.value, posed) if dial.cause in OF_PLAN else posed
    own = posed if own is None else own
    found = extreme(dial, own, own.program())
    if found.value is None:
        return DirectNumber.none(of.name, of.unit, f"no end of it was found up to {FAR:g} times what it is")
    near = NEAR if dial.cause in OF_PLAN and plan.executed is not None else AT_END
    if abs(found.value - dial.value) < near * abs(dial.value):
        return _near(of, found, plan)
    if plan.executed is not None:
        return _along(of, found, plan)
    attained = first_plan(dial, [dial.rounded(found.value)])
    if attained is None:
        return DirectNumber.none(of.name, of.unit, "no plan verified at the end of it")
    return _ends(of, found, *attained)


def _near(of: Wanted, found: Extreme, plan: Plan) -> DirectNumber:
    """Return the number where the plan that is there is at its end: what it uses, with as little room as will do."""
    dial = found.dial
    if dial.cause not in OF_PLAN:
        return _ends(of, found, dial.value, plan)
    attained = first_plan(dial, [dial.rounded(dial.value * (1 + more)) for more in MORE], BRIEF)
    if attained is None:
        more = f"up to {MORE[-1]:.0%} more than the plan uses"
        return DirectNumber.none(of.name, of.unit, f"no plan verified with {more}")
    return _ends(of, found, *attained)


def _ends(of: Wanted, found: Extreme, value: float, plan: Plan, search: Search | None = None) -> DirectNumber:
    """Return the number that a plan attains, and where it is proven to end.

    Args:
        of: what is asked for.
        found: where the linear model of the start posture ends.
        value: that is attained.
        plan: that attains it.
        search: that found it along the motion of a hand.
    """
    dial, per = found.dial, of.per
    past = found.past if found.past is not None and (found.past - value) * (found.past - dial.value) >= 0 else None
    end = past if past is not None or search is None else search.bad
    scaled, other = value / per, None if end is None else end / per
    ends = (scaled, other) if dial.eased == "down" else (other, scaled)
    who = "a plan" if plan.executed is None else "a plan of the hand that moves"
    unit = f" {of.unit}" if of.unit else ""
    tried = "" if search is None else search.told(lambda value: f"{value / per:.4g}{unit}")
    of_start = "the other end is proven of the linear model of the start posture"
    at_end = f"that proves nothing, {of_start}" if search is not None and search.bad is not None else of_start
    proof = at_end if past is not None else "nothing is proven"
    why = f"attained by {who}{tried}; {proof}"
    return DirectNumber(of.name, of.unit, scaled, ends[0], ends[1], past is not None, why, dial.set(value), plan)


def _along(of: Wanted, found: Extreme, plan: Plan) -> DirectNumber:
    """Return the number of the hand that moves: the last value of some with a plan, and the first without."""
    dial, end = found.dial, found.value
    assert end is not None
    search = Search.of(dial, end, plan).over(of.tries)
    closer = search.best is not plan or dial.cause not in OF_PLAN
    search = (search.on(of.tries + CLOSER) if closer else search).surely(SURE)
    if search.best is plan and dial.cause in OF_PLAN:
        return _near(of, found, plan)
    return _ends(of, found, search.good, search.best, search)
