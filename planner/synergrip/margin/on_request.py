"""Numbers that are one for each contact or each rigid motion, and so take as long as all others together."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import decided_at
from synergrip.changes.turning import contact_dials
from synergrip.conic.limits.dial import Dial, quantity
from synergrip.margin.direct import Wanted, number_of
from synergrip.margin.direct_number import DirectNumber
from synergrip.planning.outcome import Plan
from synergrip.planning.pace import BRIEF
from synergrip.tasks.hold import Hold
from synergrip.tasks.moves import ModeMove
from synergrip.tasks.task import Task

FIRST_STEPS = (1e-2, 1e-4, 1e-6)
"""Shares of the size of the grasp by which the object is moved at first along a rigid motion, until there is a plan."""
TRIES = 8
"""How many values are tried where the hand that moves does not come as far: the first step is a small one."""
SIGNS = {"forward": 1.0, "back": -1.0}


def frictions(asked: Asked, plan: Plan) -> Iterator[tuple[str, DirectNumber]]:
    """Yield the least friction of each contact by itself, the others as they are.

    Args:
        asked: what is asked, limits filled in.
        plan: of it.
    """
    posed = asked.posed(plan.analysis)
    for contact, dial in contact_dials(asked).items():
        of = Wanted("critical_friction_per_contact", "", dial, "")
        if posed is None:
            yield contact, DirectNumber.none(of.name, of.unit, "the task has no program of the start posture")
        else:
            yield contact, number_of(of, dial, posed, plan)


def amplitudes(asked: Asked, plan: Plan) -> Iterator[tuple[str, DirectNumber]]:
    """Yield how far the object may be moved along each rigid motion of the grasp alone, both ways.

    Args:
        asked: what is asked, limits filled in.
        plan: of it.
    """
    for mode in range(1, plan.analysis.spaces.Gamma_ucs.shape[1] + 1):
        for word, sign in SIGNS.items():
            yield f"mode {mode} {word}", _amplitude(asked, plan, mode, sign)


def _amplitude(asked: Asked, plan: Plan, mode: int, sign: float) -> DirectNumber:
    name, unit = "largest_amplitude_per_mode", "m"
    why = _cannot_move(asked)
    length = plan.analysis.response.scale.length
    for share in () if why else FIRST_STEPS:
        dial = _along_mode(asked, mode, sign, float(f"{share * length:.1g}"))
        begun = dial.turned(dial.value)
        posed = begun.posed(plan.analysis)
        if posed is None or not (decision := decided_at(dial, dial.value, posed)) or not decision.acceptable:
            continue
        first = begun.outcome(BRIEF)
        if isinstance(first, Plan):
            found = number_of(Wanted(name, unit, dial, "", tries=TRIES), dial, posed, first)
            return _with_displacement(found, plan, mode, sign)
    return DirectNumber.none(name, unit, why or f"no plan was found even {FIRST_STEPS[-1] * length * 1e9:.2g} nm away")


def _cannot_move(asked: Asked) -> str:
    """Return why an object cannot be asked to move along a rigid motion; empty where it can."""
    task = asked.task
    if not isinstance(task, Task):
        return "the task is given at its knots; give a Task"
    if not isinstance(task.target, Hold):
        return "the task moves the object already; see largest_amplitude"
    return "with task.knots = 1 nothing moves" if task.knots == 1 else ""


def _along_mode(asked: Asked, mode: int, sign: float, first: float) -> Dial[Asked]:
    """Return the size [m] of a move along a rigid motion, from a first one on."""

    def turned(value: float) -> Asked:
        return asked.with_task(motion_factor=1.0, target=ModeMove(mode=mode, amplitude=sign * value))

    def written(value: float) -> str:
        return f"[{{ mode = {mode}, amplitude = {quantity(sign * value, 'm')} }}]"

    return Dial("amplitude", "task.move", first, "m", turned, "down", 0.0, written=written)


def _with_displacement(number: DirectNumber, plan: Plan, mode: int, sign: float) -> DirectNumber:
    if number.value is None:
        return number
    whole = sign * number.value * plan.analysis.spaces.Gamma_ucs[:, mode - 1]
    return replace(number, displacement=tuple(map(float, whole)))


ON_REQUEST: dict[str, Callable[[Asked, Plan], Iterator[tuple[str, DirectNumber]]]] = {
    "critical_friction_per_contact": frictions,
    "largest_amplitude_per_mode": amplitudes,
}
"""Name -> what finds its numbers, each with what it is of."""
