"""How the worst margin under the references of a plan changes with a number: they stay, and the forces answer.

The slip margin of a contact is ``(W f)_0 - ||(W f)_1..||`` of its force f, the least of its cones. The worst of all
contacts and instants grows by the least of the changes of those that are worst.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.meeting import Stuck
from synergrip.equilibrium.states import States
from synergrip.errors import SynergripError
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.margin.parameters import STEP, Parameter
from synergrip.margin.sensitivity import FIXED, HAND, START, Sensitivity
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Plan
from synergrip.statics.analysis import analyse
from synergrip.statics.motion import forward
from synergrip.statics.response import respond
from synergrip.statics.restraint import NO_LOAD
from synergrip.tasks.timing import at_start
from synergrip.values import Value

TIES, TIES_ON_HAND = 1e-5, 1e-4
"""Share of the largest force up to which contacts and instants are as bad as the worst; plans know no better."""
ALIKE = 1e-6
"""Share of the largest force, in the scale of a parameter, up to which one-sided derivatives are the same."""
NOTHING = 1e-9
"""The same that is rounding."""
LOST = "there is no equilibrium, or the grasp is refused, as soon as it changes"
TIED = "several contacts or instants are the worst, or a force is on the axis of its cone"


@dataclass(frozen=True, eq=False, repr=False)
class References(Value):
    """References of a plan, and who executes them."""

    plan: Plan
    asked: Asked
    on_hand: bool
    """Whether forces are those of the true equilibria; else those of the linear model of the start posture."""

    @cached_property
    def forces(self) -> Array:
        """(T, n_l) under the numbers as they are."""
        plan = self.plan
        if self.on_hand or plan.executed is None:
            return plan.forces
        return forward(plan.analysis.response, plan.time, plan.dz_r, plan.motion.wrench).forces

    @cached_property
    def largest(self) -> float:
        """The largest normal force [N]."""
        return float(np.abs(self.forces[:, self.plan.grasp.normal_rows]).max(initial=0.0))

    @property
    def close(self) -> float:
        """[N] up to which margins are as bad, and cones as near."""
        return self.largest * (TIES_ON_HAND if self.on_hand else TIES)

    def after(self, parameter: Parameter, change: float) -> tuple[Grasp, Array] | None:
        """Return the grasp and the forces (T, n_l) after a change of a number; None where there are none."""
        try:
            asked = parameter.turned(change * parameter.scale)
            timed = self.plan.task if parameter.same_task else asked.timed
            grasp = at_start(asked.grasp, timed.wrench[0])
            if parameter.same_task or parameter.name != "friction":
                return grasp, self._forces(grasp, timed.wrench)
        except SynergripError:
            return None
        return grasp, self.forces

    def _forces(self, grasp: Grasp, wrench: Array) -> Array:
        plan = self.plan
        if not self.on_hand:
            return forward(respond(grasp, NO_LOAD), plan.time, plan.dz_r, wrench).forces
        executor = Executor.of(analyse(grasp, NO_LOAD), plan.task)
        assert plan.executed is not None
        executed = executor.run(plan.time, plan.dz_r, wrench, near(plan.executed))
        if not executed.whole:
            raise SynergripError(executed.why)
        return executed.states.forces


def near(executed: Execution) -> States:
    """Return states to begin at: those of the first squeeze, too, where every instant has its own."""
    path, lead = executed.path.states, len(executed.path.states) - len(executed.kept)
    return path if np.array_equal(executed.kept, np.arange(lead, len(path))) else executed.states


def of_references(parameters: Sequence[Parameter], plan: Plan, asked: Asked) -> Iterator[Sensitivity]:
    """Yield how the worst margin under the plan's references changes with each number that it depends on.

    Of a plan that was executed: of the hand that moves, but where the place or the normal of a contact changes and a
    tip rolls on a surface that says itself what is where.
    """
    linear, true = (References(plan, asked, on_hand) for on_hand in (False, True))
    stuck = plan.executed is not None and isinstance(plan.executed.setting.model, Stuck)
    for each in parameters:
        if each.of_plan:
            yield _derived(each, true if plan.executed is not None and (stuck or not each.of_place) else linear)


def _derived(parameter: Parameter, references: References) -> Sensitivity:
    more, less = (references.after(parameter, change) for change in (STEP, -STEP))
    if more is None or less is None:
        return _told(parameter, references, None, None, LOST)
    forces, grasp, close = references.forces, references.plan.grasp, references.close
    changes = (more[1] - less[1]) / (2 * STEP)
    ends = []
    for sign in (1.0, -1.0):
        rates = [np.inf]
        for k, i in worst(grasp, forces, close):
            rows, around = grasp.rows[i], (more[0].contacts[i], less[0].contacts[i])
            rates.append(_rate(grasp.contacts[i], around, forces[k, rows], changes[k, rows], sign, close))
        ends.append(sign * min(rates))
    right, left = ends
    same = abs(right - left) <= ALIKE * max(references.largest, abs(right), abs(left))
    return _told(parameter, references, right if same else left, right, "" if same else TIED)


def worst(grasp: Grasp, forces: Array, close: float) -> list[tuple[int, int]]:
    """Return the instants and contacts whose slip margin is the least, or within `close` of it [N]."""
    parts = zip(grasp.contacts, grasp.rows, strict=True)
    margins = np.column_stack([contact.slip_margin(forces[:, rows]) for contact, rows in parts])
    return [(int(k), int(i)) for k, i in zip(*np.nonzero(margins <= margins.min() + close), strict=True)]


def _rate(
    contact: Contact, around: tuple[Contact, Contact], force: Array, change: Array, sign: float, close: float
) -> float:  # fmt: skip
    """Return how fast the slip margin of a contact changes one way [N for the scale of the parameter].

    Args:
        contact: as it is.
        around: the same with a little more and a little less of the number.
        force: (rows,) that it carries.
        change: (rows,) of the force with the number.
        sign: which way.
        close: [N] up to which cones are as near.
    """
    found = list[tuple[float, float]]()
    for W, more, less in zip(contact.cones, *(each.cones for each in around), strict=True):
        value, rate = W @ force, sign * (W @ change + (more - less) @ force / (2 * STEP))
        tail = float(np.linalg.norm(value[1:]))
        turn = float(value[1:] @ rate[1:]) / tail if tail > close else float(np.linalg.norm(rate[1:]))
        found.append((float(value[0]) - tail, float(rate[0]) - turn))
    if force[0] < 0:  # a contact that would have to pull
        found.append((float(force[0]), float(sign * change[0])))
    least = min(margin for margin, _ in found)
    return min(rate for margin, rate in found if margin <= least + close)


def _told(
    parameter: Parameter, references: References, left: float | None, right: float | None, why: str
) -> Sensitivity:  # fmt: skip
    model = HAND if references.on_hand else START
    return parameter.sensitivity(FIXED, model, (left, right), NOTHING * references.largest, why)
