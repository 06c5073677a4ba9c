"""What motors need along a motion where they hold springs of the model file back, beside what contacts ask of them.

Limits count what contacts ask for alone, as the torques of a plan do. The springs that are read pull joints with
``b - K q``; so a motor has to give ``tau + K q - b`` at its joints, and ``S' (tau + K q - b)`` along its synergy.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array
from synergrip.tasks.timed_task import TimedTask

LITTLE = 1e-3
"""Share of a limit that springs may take without being told of: to about that limits are kept."""


def spring_notes(executed: Execution, torques: Array, task: TimedTask) -> Iterator[str]:
    """Yield a note for each limit that motors would not keep with the springs that they hold back.

    Args:
        executed: the references, all of whose instants were reached.
        torques: (T, n_q) that contacts ask for there.
        task: whose limits count.
    """
    grasp = executed.setting.grasp
    drives, S = executed.setting.held.hand.drives, grasp.S
    if drives is None or drives.stiffness is None:
        return
    held_back = np.array([drives.spring_torques(q) for q in executed.states.q])
    moved = np.any(S != 0, axis=1)
    for limit in task.limits:
        if isinstance(limit, JointTorque):
            yield from _missed(limit, np.where(moved, torques + held_back, 0.0), torques, grasp.joints, executed.times)
        elif isinstance(limit, ActuatorEffort):
            of_contacts, whole = torques @ S, (torques + held_back) @ S
            yield from _missed(limit, whole, of_contacts, grasp.synergies, executed.times)


def _missed(
    limit: JointTorque | ActuatorEffort, whole: Array, of_contacts: Array, names: tuple[str, ...], times: Array
) -> Iterator[str]:
    """Yield a note where values (T, m) with springs are beyond a limit, beside those of contacts alone."""
    most = np.broadcast_to(np.asarray(limit.limit, dtype=float), whole.shape)
    share, more = np.abs(whole) / most, (np.abs(whole) - np.abs(of_contacts)) / most
    k, i = np.unravel_index(int(np.argmax(np.where(more > LITTLE, share, 0.0))), share.shape)
    if share[k, i] > 1 and more[k, i] > LITTLE:
        needs, alone = abs(whole[k, i]), abs(of_contacts[k, i])
        yield (
            f"with the springs of the model file, which {limit.key} does not count, '{names[i]}' needs {needs:.4g} of "
            f"its {most[k, i]:.4g} at t = {times[k]:.3g} s, {alone:.4g} of it for contacts: no motor within this limit "
            "can do that; lower it by what springs take"
        )
