"""How the worst margin under the references of a plan changes with a number: they stay, and the forces answer.

The slip margin of a contact is ``(W f)_0 - ||(W f)_1..||`` of its force f, the least of its cones. The worst of all
contacts and instants grows by the least of the changes of those that are worst.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from synergrip.changes.asked import Asked
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.meeting import Stuck
from synergrip.equilibrium.setting import setting
from synergrip.equilibrium.states import States
from synergrip.errors import SynergripError
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.margin.sensitivity.parameters import STEP, Parameter
from synergrip.margin.sensitivity.sensitivity import FIXED, HAND, START, Sensitivity
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Plan
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


_After = tuple[Grasp, Array]
"""A grasp, and the forces (T, n_l) there."""


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

    @cached_property
    def worst(self) -> NDArray[np.bool_]:
        """(T, n_c) where slip margins are the least, or close to it."""
        margins = self.plan.grasp.slip_margins(self.forces)
        return np.asarray(margins <= margins.min() + self.close)

    def after(self, parameter: Parameter, change: float) -> _After | None:
        """Return the grasp and the forces (T, n_l) after a change of a number; None where there are none."""
        try:
            asked = parameter.turned(change * parameter.scale)
            timed = self.plan.task if parameter.same_task else asked.timed
            grasp = at_start(asked.grasp, timed.wrench[0])
            same = parameter.same_task and parameter.same_statics
            return grasp, self.forces if same else self._forces(grasp, timed.wrench)
        except SynergripError:
            return None

    def _forces(self, grasp: Grasp, wrench: Array) -> Array:
        plan = self.plan
        if not self.on_hand:
            return forward(respond(grasp, NO_LOAD), plan.time, plan.dz_r, wrench).forces
        response = respond(grasp, NO_LOAD)
        executor = Executor(setting(grasp, "rolling", response), plan.task, response)
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
    right, left = (sign * _slowest(references, more, less, sign) for sign in (1.0, -1.0))
    same = abs(right - left) <= ALIKE * max(references.largest, abs(right), abs(left))
    return _told(parameter, references, right if same else left, right, "" if same else TIED)


def _slowest(references: References, more: _After, less: _After, sign: float) -> float:
    """Return how fast the worst slip margin changes one way [N for the scale of the parameter]."""
    forces, close, rates = references.forces, references.close, [np.inf]
    for i, rows in enumerate(references.plan.grasp.rows):
        at = references.worst[:, i]
        if np.any(at):
            contacts = (references.plan.grasp.contacts[i], more[0].contacts[i], less[0].contacts[i])
            change = (more[1][at, rows] - less[1][at, rows]) / (2 * STEP)
            rates.append(float(_rates(contacts, forces[at, rows], change, sign, close).min()))
    return min(rates)


def _rates(
    contacts: tuple[Contact, Contact, Contact], forces: Array, change: Array, sign: float, close: float
) -> Array:  # fmt: skip
    """Return how fast the slip margins (K,) of a contact change one way [N for the scale of the parameter].

    Args:
        contacts: as it is, and with a little more and a little less of the number.
        forces: (K, rows) that it carries.
        change: (K, rows) of the forces with the number.
        sign: which way.
        close: [N] up to which cones are as near.
    """
    margins, rates = [], []
    for W, more, less in zip(*(each.cones for each in contacts), strict=True):
        value, rate = forces @ W.T, sign * (change @ W.T + forces @ (more - less).T / (2 * STEP))
        tail = np.linalg.norm(value[:, 1:], axis=1)
        along = np.einsum("ki,ki->k", value[:, 1:], rate[:, 1:]) / np.maximum(tail, close)
        margins.append(value[:, 0] - tail)
        rates.append(rate[:, 0] - np.where(tail > close, along, np.linalg.norm(rate[:, 1:], axis=1)))
    pulls = forces[:, 0] < 0  # a contact that would have to pull is missed by that pull at least
    margins.append(np.where(pulls, forces[:, 0], np.inf))
    rates.append(np.where(pulls, sign * change[:, 0], np.inf))
    nearest = np.array(margins) <= np.min(margins, axis=0) + close
    return np.asarray(np.where(nearest, rates, np.inf).min(axis=0))


def _told(
    parameter: Parameter, references: References, left: float | None, right: float | None, why: str
) -> Sensitivity:  # fmt: skip
    model = HAND if references.on_hand else START
    return parameter.sensitivity(FIXED, model, (left, right), NOTHING * references.largest, why)
