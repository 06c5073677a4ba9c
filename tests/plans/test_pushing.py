"""Contacts push, however little friction they have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from driven_grasp import driven, touch
from random_tasks import random_task_on_grasp

from synergrip.grasps.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.plans.outcome import Infeasible, Plan
from synergrip.plans.planning import plan
from synergrip.plans.solvers import SOLVERS


def slippery(rng: np.random.Generator, grasp: Grasp) -> Grasp:
    """The grasp with one contact of next to no friction, its load that which a push of the others leaves."""
    i = int(rng.integers(grasp.n_c))
    mu = float(10 ** rng.uniform(-9, -2))
    spin = grasp.contacts[i].spin_friction
    contacts = [replace(c, friction=mu, spin_friction=spin and 0.01 * mu) if c is grasp.contacts[i] else c
                for c in grasp.contacts]  # fmt: skip
    return replace(grasp, contacts=tuple(contacts))


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
def test_no_plan_lets_a_slippery_contact_pull(solver: str) -> None:
    found = {"feasible": 0, "infeasible": 0}
    for seed in range(60 if solver == "clarabel" else 12):
        rng = np.random.default_rng(seed)
        grasp, task = random_task_on_grasp(rng)
        outcome = plan(slippery(rng, grasp), task, SOLVERS[solver])
        found[outcome.verdict] += 1
        if isinstance(outcome, Plan):
            normals = outcome.motion.forces[:, grasp.normal_rows]
            assert normals.min() >= -1e-6 * max(outcome.situation.load_size, float(np.abs(normals).max())), seed
            assert outcome.margins.min() >= task.margin - 1e-6 * np.abs(outcome.motion.forces).max(), seed
    assert min(found.values()) >= 1, found


def needle(mu: float) -> tuple[Grasp, Contact]:
    """Two fingers squeeze along x; a third, without friction to speak of, can only push the object down, along -z."""
    sides = [touch(name, "soft", [x, 0, 0], [-x, 0, 0], 0.5) for name, x in (("left", -0.02), ("right", 0.02))]
    top = touch("top", "hard", [0, 0, 0.02], [0, 0, -1], mu)
    return driven([*sides, top]), top


@pytest.mark.parametrize("mu", [1e-9, 1e-6, 1e-3, 0.05])
def test_a_contact_that_would_have_to_pull_holds_nothing(mu: float) -> None:
    """With friction 1e-9 of the sides a weight hangs on a pull of the top: infeasible; pushed down onto it: held."""
    grasp, _ = needle(mu)
    sides = tuple(replace(c, friction=1e-9) if c.kind.name == "soft" else c for c in grasp.contacts)
    grasp = replace(grasp, contacts=sides)
    _, task = random_task_on_grasp(np.random.default_rng(0))
    for weight, verdict in ((-0.69, "infeasible"), (0.69, "feasible")):
        asked = replace(
            task, times=frozen([0.0]), wrench=frozen([[0, 0, weight, 0, 0, 0]]), margin=0.0, limits=(),
            order=("effort",), wanted=replace(task.wanted, kind="hold", values=frozen(np.zeros((1, 0)))),
        )  # fmt: skip
        outcome = plan(grasp, asked)
        assert outcome.verdict == verdict
        if isinstance(outcome, Infeasible):
            assert outcome.certificate.verified


def test_a_pull_is_a_margin_that_is_missed_by_as_much() -> None:
    _, top = needle(1e-9)
    assert top.slip_margin(np.array([-0.69, 0.0, 0.0])) == pytest.approx(-0.69)
    assert top.slip_margin(np.array([0.69, 0.0, 0.0])) == pytest.approx(0.69e-9)
    assert top.slip_margin(np.array([0.0, 3.0, 4.0])) == pytest.approx(-5.0)
