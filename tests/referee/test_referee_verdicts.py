"""The referee's own verdicts: wanted motions, a closed form, another solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from named_goals import goals
from random_tasks import hand_like_grasp, random_task_on_grasp

from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.grasps.contacts.contact import contact_frame
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.grasp import grasp_matrix
from synergrip.linalg import frozen
from synergrip.planning.planning import plan
from synergrip.referee.judge import referee
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import Target, TimedTask, still


def test_the_referee_judges_wanted_motions() -> None:
    seed = next(s for s in range(100) if random_task_on_grasp(np.random.default_rng(s))[1].target.kind == "modes")
    grasp, task = random_task_on_grasp(np.random.default_rng(seed))
    analysis = analyse(grasp)
    inside = task.target.values @ analysis.spaces.Gamma_ucs.T
    same = replace(task, target=Target("motion", frozen(inside)))
    assert referee(analysis, same).verdict == referee(analysis, task).verdict == plan(grasp, same).verdict
    away = np.linalg.svd(analysis.spaces.Gamma_ucs, full_matrices=True)[0][:, -1]
    leaving = replace(task, target=Target("motion", frozen(inside + 1e-3 * away)))
    assert referee(analysis, leaving).verdict == plan(grasp, leaving).verdict == "infeasible"


def test_the_referee_equals_a_closed_form() -> None:
    """Three fingers at 120 degrees that close as one, no load: the weakest joint bounds the force, mu the margin."""
    grasp = hand_like_grasp(np.random.default_rng(1))
    angles = [0.0, 2 * np.pi / 3, 4 * np.pi / 3]
    contacts = tuple(
        replace(
            grasp.contacts[0], name=f"C{i}", kind=HardFinger(friction=0.5),
            point=frozen([0.02 * np.cos(a), 0.02 * np.sin(a), 0.0]),
            frame=contact_frame(np.array([-np.cos(a), -np.sin(a), 0.0])),
        )
        for i, a in enumerate(angles)
    )  # fmt: skip
    G = grasp_matrix(contacts)
    J = np.zeros((9, 3))
    J[[0, 3, 6], range(3)] = 0.05
    grasp = replace(
        grasp, contacts=contacts, G=G, J=frozen(J), S=frozen(np.ones((3, 1))), C_s=frozen(1e-3 * np.eye(9)),
        C_q=frozen(np.zeros((3, 3))), C_z=frozen([[0.0]]), joints=("a", "b", "c"), synergies=("close",),
        lambda_0=None, w_0=frozen(np.zeros(6)),
    )  # fmt: skip
    times = frozen([1.0])
    torque = JointTorque(frozen([0.2, 0.3, 0.4]))
    task = TimedTask(times, frozen(np.zeros((1, 6))), still(times), 0.0, (torque,), goals("margin"))
    answer = referee(analyse(grasp), task)
    assert answer.verdict == "feasible"
    assert answer.largest_margin == pytest.approx(0.5 * 0.2 / 0.05, rel=1e-8)
    assert answer.dz_r is not None
    np.testing.assert_allclose(answer.dz_r, [[1e-3 * 4.0 / 0.05]], rtol=1e-7)


def test_another_solver_judges_alike() -> None:
    for seed in range(4):
        grasp, task = random_task_on_grasp(np.random.default_rng(seed))
        analysis = analyse(grasp)
        first, other = referee(analysis, task), referee(analysis, task, "SCS")
        assert first.verdict == other.verdict
        if first.objective is not None and other.objective is not None:
            assert other.objective == pytest.approx(first.objective, rel=1e-5)
