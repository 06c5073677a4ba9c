"""How planning has references executed: on the hand that moves, from the states that it knows already."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from synergrip.equilibrium.execution import Execution, execute
from synergrip.equilibrium.setting import Setting, setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array, frozen
from synergrip.statics.analysis import Analysis
from synergrip.statics.kept_dimensions import analyse_along
from synergrip.statics.motion import Motion
from synergrip.tasks.pushes import Pushing
from synergrip.tasks.timed_task import TimedTask


@dataclass(frozen=True, eq=False)
class Executor:
    """Executes references of a task on a hand; what was found last time is where it begins the next time."""

    setting: Setting
    task: TimedTask
    known: dict[int, States] = field(default_factory=dict)
    """States by the number of instants, of the last execution at as many."""

    @classmethod
    def of(cls, analysis: Analysis, task: TimedTask) -> Executor:
        """Return the executor of a task; pads with a radius roll on objects with a shape."""
        return cls(setting(analysis.grasp, "rolling", analysis.response), task)

    def run(self, times: Array, references: Array, wrench: Array, near: Motion | States | None = None) -> Execution:
        """Return the equilibria at some times (T,) that references (T, n_z) lead through, under wrenches (T, 6).

        Args:
            times: [s].
            references: from those at the start.
            wrench: on the object, about B where it starts.
            near: states near the equilibria; or a motion that is not far from them, where none was executed before.
        """
        guess = near if isinstance(near, States) else self.known.get(len(times))
        if guess is None and isinstance(near, Motion):
            guess = _states(self.setting, near)
        found = execute(self.setting, times, references, loads(self.task, times, wrench), guess=guess)
        if found.whole:
            self.known[len(times)] = found.guess
        return found


def analyses_of(execution: Execution, start: Analysis) -> tuple[Analysis, ...]:
    """Return the analysis of the grasp at every state of an execution."""
    at = execution.balance
    return analyse_along(start, G=at.G, J=at.J, points=at.arms, forces=at.states.forces)


def loads(task: TimedTask, times: Array, wrench: Array) -> Loads:
    """Return the loads at some times: pushes act on points of the object, which move with it."""
    parts = [part for part in getattr(task.course, "load", ()) if isinstance(part, Pushing)]
    factor = getattr(task.course, "factor", 1.0)
    points = np.array([part.point for part in parts]).reshape(-1, 3)
    forces = [factor * np.outer(part.share(times), part.wrench[:3]) for part in parts]
    at_points = np.stack(forces, axis=1) if forces else np.zeros((len(times), 0, 3))
    return Loads(np.array(wrench), points, at_points)


def motion_of(execution: Execution, start: Analysis, wrench: Array, sag: Array) -> Motion:
    """Return an execution of all its instants as a motion.

    Args:
        execution: whose instants were all reached.
        start: the grasp at the start.
        wrench: (T, 6) on the object.
        sag: (T, 6) the part of its displacement that the change of the load makes [m, rad].
    """
    torques, S = execution.balance.torques, start.grasp.S
    efforts, z = torques @ S, execution.references
    dz = z - (torques - execution.setting.torques) @ S @ start.grasp.C_z
    arrays = (execution.times, z, wrench, execution.states.forces, torques, efforts, execution.du, sag,
              execution.joint, dz)  # fmt: skip
    return Motion(*(frozen(array) for array in arrays))


def _states(own: Setting, motion: Motion) -> States:
    from scipy.spatial.transform import Rotation

    rotation = Rotation.from_rotvec(np.array(motion.du[:, 3:])).as_matrix()
    position = own.held.body.position + motion.du[:, :3]
    return States(np.array(own.held.q + motion.dq), np.array(position), rotation, np.array(motion.forces))
