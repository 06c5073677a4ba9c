"""How planning has references executed: on the hand that moves, from the states that it knows already."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.equilibrium.execute import equilibria
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.setting import Setting, setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array, frozen
from synergrip.planning.beside_jumps import gone_through
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each
from synergrip.statics.kept_dimensions import analyse_along
from synergrip.statics.motion import Motion
from synergrip.statics.response import Maps, Response
from synergrip.tasks.marks import Jump
from synergrip.tasks.pushes import pushes_in, shares_in_order
from synergrip.tasks.timed_task import TimedTask
from synergrip.vectors import rotation_matrices


@dataclass(frozen=True, eq=False)
class Executor:
    """Executes references of a task on a hand."""

    setting: Setting
    task: TimedTask
    response: Response
    finely: bool = True
    """Whether contacts roll from knot to knot in as many steps as it takes to be exact; in one where it is not."""

    @classmethod
    def of(cls, analysis: Analysis, task: TimedTask) -> Executor:
        """Return the executor of a task; pads with a radius roll on objects with a shape."""
        return cls(setting(analysis.grasp, "rolling", analysis.response), task, analysis.response)

    def with_fixed_contacts(self, executed: Execution, wrench: Array) -> Execution | None:
        """Return the references of an execution where pads roll, as if these stayed where they are on link and object.

        What it costs to be wrong about rolling; None where nothing rolls.

        Args:
            executed: all of whose instants were reached.
            wrench: (T, 6) on the object, as it was executed under.
        """
        own = self.setting
        if own.contact_model != "rolling":
            return None
        fixed = replace(self, setting=setting(own.grasp, "fixed", self.response))
        return fixed.run(executed.times, executed.references, wrench, executed.states)

    def run(
        self, times: Array, references: Array, wrench: Array, near: Motion | States | Execution,
        wrong: Callable[[Array], bool] | None = None,
    ) -> Execution:  # fmt: skip
        """Return the equilibria at some times (T,) that references (T, n_z) lead through, under wrenches (T, 6).

        Where the load jumps both sides of the jump are gone through, also where the times are those of knots alone.

        Args:
            times: [s].
            references: from those at the start.
            wrench: on the object, about B where it starts.
            near: states near the equilibria, a motion not far from them, or an execution of references near these.
            wrong: whether forces (T, n_l) known to a few digits are not those that are looked for: no more are found.
        """
        guess = _states(self.setting, near) if isinstance(near, Motion) else near
        gone = gone_through(self._jumps, times, references, wrench)
        load = loads(self.task, gone.times, gone.wrench)
        return equilibria(
            self.setting, gone.times, gone.references, load, guess, wrong, finely=self.finely, asked=gone.asked
        )

    @cached_property
    def _jumps(self) -> tuple[Jump, ...]:
        """Those of the load; they count where contacts roll, which remember their way."""
        course, rolls = self.task.course, self.setting.contact_model == "rolling"
        return course.marks.jumps if course is not None and rolls else ()


def analyses_of(execution: Execution, start: Analysis) -> Each:
    """Return the analysis of the grasp at every state of an execution."""
    at = execution.balance
    return analyse_along(start, execution.maps, G=at.G, J=at.J, points=at.arms, forces=at.states.forces)


def sag_of(maps: Maps, wrench: Array, start: Analysis) -> Array:
    """Return the displacement (T, 6) that the change of the load (T, 6) makes, by the maps of each state [m, rad]."""
    change = wrench - start.grasp.w_0
    return frozen((maps.du_dw @ change[:, :, None])[:, :, 0])


def loads(task: TimedTask, times: Array, wrench: Array) -> Loads:
    """Return the loads at some times, in their order: pushes act on points of the object, which move with it."""
    parts = pushes_in(task.course)
    shares = shares_in_order([push for push, _ in parts], times)
    points = np.array([push.point for push, _ in parts]).reshape(-1, 3)
    forces = [factor * np.outer(share, push.wrench[:3]) for (push, factor), share in zip(parts, shares, strict=True)]
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
    dz = z - (torques - execution.setting.torques) @ S @ execution.setting.grasp.C_z
    arrays = (execution.times, z, wrench, execution.states.forces, torques, efforts, execution.du, sag,
              execution.joint, dz)  # fmt: skip
    return Motion(*(frozen(array) for array in arrays))


def _states(own: Setting, motion: Motion) -> States:
    rotation = rotation_matrices(motion.du[:, 3:])
    position = own.held.body.position + motion.du[:, :3]
    return States(np.array(own.held.q + motion.dq), np.array(position), rotation, np.array(motion.forces))
