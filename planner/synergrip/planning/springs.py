"""What motors need where they hold springs of the model file back, or are helped by them, beside what contacts ask for.

Limits and goals count what contacts ask for alone, as the torques of a plan do. The springs that are read pull joints
with ``b - K q``; so a motor has to give ``tau + K q - b`` at its joints, and ``S' (tau + K q - b)`` along its synergy.
A motor of +-m that springs ask for e can give contacts ``-m - e`` to ``m - e``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_holding import LeastHolding
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.sustained import so_far
from synergrip.conic.limits.sustained_effort import SustainedEffort
from synergrip.conic.limits.sustained_torque import SustainedTorque
from synergrip.conic.limits.symmetric import Symmetric
from synergrip.conic.limits.ties import first_worst
from synergrip.equilibrium.execution import Execution
from synergrip.grasps.grasp import Grasp
from synergrip.hands.undriven import HELD
from synergrip.hands.units import joint_kinds, synergy_kinds, torque_unit
from synergrip.linalg import Array
from synergrip.tasks.timed_task import TimedTask

LITTLE = 1e-3
"""Share of a limit that springs may take without being told of: to about that limits are kept."""
MOST_NAMED = 6
"""Joints or synergies that a note names."""
COUNTED = (JointTorque, ActuatorEffort, SustainedTorque, SustainedEffort)
"""Limits of what motors give."""


@dataclass(frozen=True)
class _Item:
    """A joint or synergy."""

    name: str
    unit: str

    def amount(self, value: float) -> str:
        return f"{value:.4g} {self.unit}"


def spring_notes(executed: Execution, torques: Array, task: TimedTask) -> Iterator[str]:
    """Yield a note for each limit that motors would not keep with the springs, and for goals that do not count them.

    Args:
        executed: the references, all of whose instants were reached.
        torques: (T, n_q) that contacts ask for there.
        task: whose limits and goals count.
    """
    grasp, times = executed.setting.grasp, executed.times
    drives = executed.setting.held.hand.drives
    if drives is None or drives.stiffness is None:
        return
    held_back = _of_motors(grasp, np.array([drives.spring_torques(q) for q in executed.states.q]))
    for limit in task.limits:
        if not isinstance(limit, COUNTED):
            continue
        alone, springs = (_as_counted(limit, grasp, each) for each in (torques, held_back))
        items, most = _items(grasp, limit.of), np.broadcast_to(np.asarray(limit.limit, dtype=float), alone.shape)
        if isinstance(limit, JointTorque | ActuatorEffort):
            yield from _missed(limit, alone, springs, most, items, times)
        else:
            hold = len(times) < 2 or not np.any(task.target.values)
            yield from _missed_in_the_mean(limit, alone, springs, most, items, times, hold)
    yield from _of_goals(task, grasp, torques, held_back)


def limits_with_springs(grasp: Grasp, task: TimedTask) -> Iterator[str]:
    """Yield for each limit of motors what it leaves contacts with the springs of the start posture, where it matters.

    It is for answers other than plans, of which no motion tells.
    """
    drives = grasp.held.hand.drives if grasp.held is not None else None
    if drives is None or drives.stiffness is None or grasp.held is None:
        return
    held_back = _of_motors(grasp, drives.spring_torques(grasp.held.q)[None])
    for limit in task.limits:
        if not isinstance(limit, JointTorque | ActuatorEffort):
            continue
        (springs,) = _as_counted(limit, grasp, held_back)
        most = np.broadcast_to(np.asarray(limit.on(grasp).limit, dtype=float), springs.shape)
        told = [
            f"'{item.name}' for {item.amount(e)}, which of its {item.amount(m)} leaves contacts {_room(m, e, item)}"
            for item, e, m in zip(_items(grasp, limit.of), springs, most, strict=True)
            if abs(e) > HELD * m
        ]
        if told:
            more = f"; and {len(told) - MOST_NAMED} more" if len(told) > MOST_NAMED else ""
            yield (
                f"{limit.key} counts what contacts ask for alone, and springs of the model file ask "
                f"{'; '.join(told[:MOST_NAMED])}{more} (at the start). This answer does not count it"
            )


def _of_motors(grasp: Grasp, torques: Array) -> Array:
    """Return torques (T, n_q) of springs at the joints that synergies move, and 0 elsewhere."""
    return np.where(np.any(grasp.S != 0, axis=1), torques, 0.0)


def _as_counted(limit: Symmetric, grasp: Grasp, torques: Array) -> Array:
    """Return what a limit counts of joint torques (T, n_q): these, or their efforts (T, n_z)."""
    return torques if limit.of == "joint" else torques @ grasp.S


def _items(grasp: Grasp, of: str) -> tuple[_Item, ...]:
    if grasp.held is None:
        return ()
    joints = joint_kinds(grasp.held.hand.joints)
    kinds = joints if of == "joint" else synergy_kinds(grasp.held.synergies, joints.values())
    return tuple(_Item(name, torque_unit([kind])) for name, kind in kinds.items())


def _room(most: float, springs: float, item: _Item) -> str:
    """Return what a motor of +-most can give contacts where springs ask for some of it."""
    return f"{-most - springs:.4g} to {item.amount(most - springs)}"


def _missed(
    limit: Symmetric, alone: Array, springs: Array, most: Array, items: tuple[_Item, ...], times: Array
) -> Iterator[str]:
    """Yield a note where values (T, m) with springs are beyond a limit, beside those of contacts alone."""
    whole = alone + springs
    share, more = np.abs(whole) / most, (np.abs(whole) - np.abs(alone)) / most
    beyond = np.where((share > 1) & (more > LITTLE), share, 0.0)
    if beyond.any():
        k, i = first_worst(beyond, beyond)
        item = items[i]
        yield (
            f"with the springs of the model file, which {limit.key} does not count, '{item.name}' needs "
            f"{item.amount(whole[k, i])} at t = {times[k]:.3g} s, {item.amount(alone[k, i])} of it for contacts: more "
            f"than its {item.amount(most[k, i])}, which leave contacts {_room(most[k, i], springs[k, i], item)} there"
        )


def _missed_in_the_mean(
    limit: Symmetric, alone: Array, springs: Array, most: Array, items: tuple[_Item, ...], times: Array, hold: bool
) -> Iterator[str]:
    """Yield a note where the root of the mean square over the time is beyond a limit with springs."""
    without, whole = (so_far(times, each, goes_on=hold).max(axis=0) for each in (alone, alone + springs))
    share, more = whole / most[0], (whole - without) / most[0]
    beyond = np.where((share > 1) & (more > LITTLE), share, 0.0)
    if beyond.any():
        _, i = first_worst(beyond[None], beyond[None])
        item = items[i]
        yield (
            f"with the springs of the model file, which {limit.key} does not count, '{item.name}' needs "
            f"{item.amount(whole[i])} of its {item.amount(most[0, i])} over the time, {item.amount(without[i])} for "
            "contacts alone: no motor within this limit can do that"
        )


def _of_goals(task: TimedTask, grasp: Grasp, torques: Array, held_back: Array) -> Iterator[str]:
    """Yield a note where a goal makes little of torques or efforts that springs change."""
    for goal in task.goals:
        of = goal.of if isinstance(goal, LeastHolding | LeastEffort) else "contact"
        if of == "contact":
            continue
        alone, springs = (each if of == "torque" else each @ grasp.S for each in (torques, held_back))
        if np.abs(springs).max(initial=0.0) > HELD * np.abs(alone).max(initial=0.0):
            yield (
                f"the goal '{goal.name}' counts what contacts ask for alone: with "
                "the springs of the model file another plan may cost motors less"
            )
