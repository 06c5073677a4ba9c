"""Contacts push, however little friction they have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from driven_grasp import driven, touch
from made_kinds import made_kind
from named_goals import goals
from random_tasks import random_task_on_grasp

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.question import Question
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.formulated import formulated
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import TimedTask, still


def slippery(rng: np.random.Generator, grasp: Grasp) -> Grasp:
    """The grasp with one contact of next to no friction, its load that which a push of the others leaves."""
    i = int(rng.integers(grasp.n_c))
    mu = float(10 ** rng.uniform(-9, -2))
    one = grasp.contacts[i]
    kind = made_kind(one.kind.name, mu, 0.01 * mu)
    contacts = [replace(c, kind=kind) if c is one else c for c in grasp.contacts]
    return replace(grasp, contacts=tuple(contacts))


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
def test_no_plan_lets_a_slippery_contact_pull(solver: str) -> None:
    found = {"feasible": 0, "infeasible": 0, "unknown": 0}
    for seed in range(40 if solver == "clarabel" else 6):
        rng = np.random.default_rng(seed)
        grasp, task = random_task_on_grasp(rng)
        outcome = plan(slippery(rng, grasp), task, SOLVERS[solver])
        found[outcome.verdict] += 1
        if isinstance(outcome, Plan):
            normals = outcome.motion.forces[:, grasp.normal_rows]
            assert normals.min() >= -1e-6 * max(outcome.formulation.load_size, float(np.abs(normals).max())), seed
            assert outcome.margins.min() >= task.margin - 1e-6 * np.abs(outcome.motion.forces).max(), seed
    assert min(found["feasible"], found["infeasible"]) >= 1, found
    assert found["unknown"] <= 2, found


def needle(mu: float) -> tuple[Grasp, Contact]:
    """Two fingers squeeze along x; a third, without friction to speak of, can only push the object down, along -z."""
    sides = [touch(name, "soft", [x, 0, 0], [-x, 0, 0], 0.5) for name, x in (("left", -0.02), ("right", 0.02))]
    top = touch("top", "hard", [0, 0, 0.02], [0, 0, -1], mu)
    return driven([*sides, top]), top


@pytest.mark.parametrize("mu", [1e-9, 1e-6, 1e-3, 0.05])
def test_a_contact_that_would_have_to_pull_holds_nothing(mu: float) -> None:
    """A weight hangs on a pull of the top, as no squeeze of 100 N holds it by a friction of 1e-9; or is pushed up."""
    grasp, _ = needle(mu)
    sides = tuple(replace(c, kind=c.kind.with_friction(1e-9)) if c.kind.name == "soft" else c for c in grasp.contacts)
    grasp = replace(grasp, contacts=sides)
    _, task = random_task_on_grasp(np.random.default_rng(0))
    for weight, verdict in ((-0.69, "infeasible"), (0.69, "feasible")):
        asked = replace(
            task, times=frozen([0.0]), wrench=frozen([[0, 0, weight, 0, 0, 0]]), margin=0.0,
            limits=(NormalForce(0.0, 100.0),),
            goals=goals("effort"), target=replace(task.target, kind="hold", values=frozen(np.zeros((1, 0)))),
        )  # fmt: skip
        outcome = plan(grasp, asked)
        assert outcome.verdict == verdict or (outcome.verdict == "unknown" and mu < 1e-8)
        if isinstance(outcome, Infeasible):
            assert outcome.certificate.verified


def test_a_pull_is_a_margin_that_is_missed_by_as_much() -> None:
    _, top = needle(1e-9)
    assert top.slip_margin(np.array([-0.69, 0.0, 0.0])) == pytest.approx(-0.69)
    assert top.slip_margin(np.array([0.69, 0.0, 0.0])) == pytest.approx(0.69e-9)
    assert top.slip_margin(np.array([0.0, 3.0, 4.0])) == pytest.approx(-5.0)


@pytest.mark.parametrize("mu", [1e-9, 1e-7, 1.3e-6, 1e-4, 0.03])
@pytest.mark.parametrize("goal", ["effort", "peak_force", "torque"])
def test_little_friction_takes_a_hard_squeeze_and_no_more(mu: float, goal: str) -> None:
    """Without a limit on forces, a weight W and a margin m take n = (W / 2 + m) / mu of each of two fingers."""
    fingers = [touch(name, "soft", [x, 0, 0], [-x, 0, 0], mu) for name, x in (("left", -0.02), ("right", 0.02))]
    times = frozen([0.0])
    task = TimedTask(times, frozen([[0, 0, -2.943, 0, 0, 0]]), still(times), 0.5, (), goals(goal))
    outcome = plan(driven(fingers), task)
    assert isinstance(outcome, Plan)
    assert outcome.motion.forces[:, [0, 4]] == pytest.approx((2.943 / 2 + 0.5) / mu, rel=1e-5)


@pytest.mark.parametrize("seed", [2, 45, 46])
def test_a_largest_margin_in_a_unit_far_above_all_forces_is_asked_again(seed: int) -> None:
    """Or is not called verified: what such a unit makes of the load is within the tolerances of the program."""
    rng = np.random.default_rng(seed)
    grasp, task = random_task_on_grasp(rng)
    formulation = formulated(analyse(grasp, task.wrench), task, redundancy=task.watches_references)
    usual = ask(Question(formulation, task.kept, LargestMargin()), SOLVERS["clarabel"])
    assert usual.decision.optimal
    assert not usual.coarse
    far = formulation.in_units(replace(formulation.units, force=1e9 * formulation.force_unit))
    found = ask(Question(far, task.kept, LargestMargin()), SOLVERS["clarabel"])
    if found.decision.optimal:
        margins = [each.decision.solution.x[-1] * each.question.formulation.force_unit for each in (usual, found)]
        assert abs(margins[0] - margins[1]) <= 2e-6 * formulation.load_size
