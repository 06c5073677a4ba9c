"""Normals that a user states may point the wrong way: could a task that cannot be done be done with them reversed?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.errors import SynergripError
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.facing import away
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.statics.analysis import Analysis
from synergrip.tasks.timed_task import TimedTask

EVERY_SET = 5
"""Up to so many stated normals every set of them is tried; of more, each by itself, all of them, and those that point
away from the middle of the contacts."""


LITTLE = 1e-3
"""Share of the load that is little of a margin."""
PlanAgain = Callable[[Grasp | Analysis, TimedTask], Outcome]
"""Plans a task on a grasp; of a no it need not say why."""


def with_hint(outcome: Outcome, plan_again: PlanAgain) -> Outcome:
    """Return the outcome; a no that reversed normals would turn into a yes says which, and where they are stated.

    Only normals that a user states are reversed: those that follow from a surface cannot be wrong. The yes is that of
    a verified plan of the same task. What no limit on forces decides (restraint, count, direction) does not depend on
    which way a normal points. Nor is any reversed where all of them point toward the middle of the contacts and the
    hand can squeeze what it holds with all of them: what it cannot do is too much for it.

    Args:
        outcome: of a task.
        plan_again: of a task on another grasp, or on the same.
    """
    if not isinstance(outcome, Infeasible) or outcome.analysis is None or outcome.stage != "magnitude":
        return outcome
    grasp, task = outcome.analysis.grasp, replace(outcome.task, goals=(LeastEffort(),))
    largest, outward = _at_its_largest_load(task), away(grasp.contacts)
    choices = _choices(grasp.contacts, outward)
    if not choices or (not outward.any() and _holds(outcome.analysis, _squeezing(largest), plan_again)):
        return outcome
    for chosen in choices:
        other = reversed_normals(grasp, chosen)
        if all(_holds(other, each, plan_again) for each in (largest, task)):
            return replace(outcome, hints=(*outcome.hints, _advice(grasp, chosen)))
    return outcome


def reversed_normals(grasp: Grasp, chosen: tuple[int, ...]) -> Grasp:
    """Return the grasp with the normals of the chosen contacts the other way: pushing is pulling, and the reverse."""
    signs = np.ones(grasp.n_l)
    signs[[grasp.normal_rows[i] for i in chosen]] = -1
    contacts = tuple(
        replace(contact, frame=frozen(contact.frame * [-1 if i in chosen else 1, 1, 1]), normal_at="")
        for i, contact in enumerate(grasp.contacts)
    )
    return replace(
        grasp, contacts=contacts, G=frozen(grasp.G * signs), J=frozen(signs[:, None] * grasp.J),
        C_s=frozen(np.outer(signs, signs) * grasp.C_s),
        lambda_0=None if grasp.lambda_0 is None else frozen(signs * grasp.lambda_0),
    )  # fmt: skip


def _choices(contacts: Sequence[Contact], outward: Array) -> list[tuple[int, ...]]:
    """Return the sets of contacts to reverse: those first that leave the fewest pushing away from their middle.

    The statics alone would as soon have one finger of a pinch pull with the other.
    """
    stated = [i for i, contact in enumerate(contacts) if contact.normal_at]
    sizes = range(1, len(stated) + 1) if len(stated) <= EVERY_SET else (1, len(stated))
    told = tuple(i for i in stated if outward[i])
    sets = {*([told] if told else []), *(chosen for size in sizes for chosen in combinations(stated, size))}
    return sorted(sets, key=lambda chosen: (sum(outward != np.isin(range(len(contacts)), chosen)), len(chosen), chosen))


def _holds(grasp: Grasp | Analysis, task: TimedTask, plan_again: PlanAgain) -> bool:
    try:
        return isinstance(plan_again(grasp, task), Plan)
    except SynergripError:  # what is only tried must not spoil the answer
        return False


def _at_its_largest_load(task: TimedTask) -> TimedTask:
    """Return the task at the knot of its largest load alone, which is soon judged and part of the whole."""
    largest = np.argmax(np.abs(task.wrench).sum(axis=1), keepdims=True)
    return replace(task.at(largest), course=None, between="report")


def _squeezing(task: TimedTask) -> TimedTask:
    """Return a task of one knot without any load, with a margin that is next to nothing beside what it had."""
    size = float(np.abs(task.wrench[:, :3]).max()) or 1.0
    return replace(task, wrench=frozen(np.zeros_like(task.wrench)), margin=LITTLE * size, allowed=None)


def _advice(grasp: Grasp, chosen: tuple[int, ...]) -> str:
    names = ", ".join(f"'{grasp.contacts[i].name}'" for i in chosen)
    places = "; ".join(grasp.contacts[i].normal_at for i in chosen)
    normals, these, them = ("normals", "these point", "them") if len(chosen) > 1 else ("normal", "this points", "it")
    return (
        f"with the {normals} of {names} reversed the task can be done, as a verified plan shows. A normal points "
        f"toward the object, so that pushing is positive; if {these} away from it, turn {them} round by changing the "
        f"sign of {places}"
    )
