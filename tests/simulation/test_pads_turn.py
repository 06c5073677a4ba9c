"""The springs of pads in the engine are those of the plan, however far links and contacts have turned."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest
from judged_playing import Case

import synergrip
from synergrip.simulation.model import make_model
from synergrip.simulation.pad_springs import PadSprings
from synergrip.simulation.played_plan import read_played_plan

HEAVY = ("task.move[0].lift=-8 mm", "task.knots=11", "object.mass=400 g", "limits.margin=0.3 N")
"""The weight is a preload of 2 N from the start, and the pads turn by 17 degrees."""


@pytest.fixture(scope="module")
def heavy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder, problem = tmp_path_factory.mktemp("heavy"), Case("gripper-box", HEAVY).problem
    answer = synergrip.plan(problem.grasp, problem.task.replace(linearise="along"))
    assert isinstance(answer, synergrip.Plan)
    answer.save(folder, formats="json")
    return folder


def test_a_preload_turns_with_the_contact_as_in_the_plan(heavy: Path) -> None:
    plan = read_played_plan(heavy)
    assert max(np.abs(force).max() for force in plan.forces_0) > 1.9
    found = synergrip.simulate(heavy, half_step=False)
    turned = np.abs(found.q[-1] - plan.q_0).max()
    assert turned > 0.1
    assert found.forces[0] == pytest.approx(plan.forces[0], abs=2e-3)
    assert found.forces[-1] == pytest.approx(plan.forces[-1], abs=2e-3)
    assert found.worst[0] == pytest.approx(found.promised_worst, abs=0.01)
    assert not found.differences
    assert found.likely_cause is None


def test_pads_that_stand_anywhere_push_as_the_law_says(heavy: Path, tmp_path: Path) -> None:
    """Softer along the surface than into it, a finger turned by 0.3 rad, a pad pushed aside and turned."""
    data = json.loads((heavy / "plan.json").read_text())
    compliance = np.diag([1e-4, 3e-4, 7e-4, 0.5])
    for contact in data["execution"]["contacts"]:
        contact["compliance"] = compliance.tolist()
    (tmp_path / "plan.json").write_text(json.dumps(data))
    plan = read_played_plan(tmp_path)
    model = make_model(plan, 2e-4)
    engine, state = model.mujoco, mujoco.MjData(model.mujoco)
    engine.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    state.qpos[model.places] = plan.q_0 + 0.3
    mujoco.mj_forward(engine, state)
    bodies = engine.geom_bodyid[[pad.geom for pad in model.pads]]
    nominal = state.xpos[bodies].copy()
    springs = PadSprings(model)
    slides = np.array([pad.dofs[:3] for pad in model.pads])
    state.qpos[engine.jnt_qposadr[engine.dof_jntid[slides]]] = [[1e-4, -2e-4, 3e-4], [0.0, 1e-4, 5e-4]]
    mujoco.mj_forward(engine, state)
    springs.follow(state)
    springs.apply(state)
    mujoco.mj_forward(engine, state)
    for number, pad in enumerate(model.pads):
        frame = springs.frames[number]
        law = plan.forces_0[number][:3] + np.linalg.solve(
            compliance[:3, :3], frame.T @ (nominal - state.xpos[bodies])[number]
        )
        axes = state.xaxis[engine.dof_jntid[pad.dofs[:3]]]
        pushed = axes.T @ (state.qfrc_spring + state.qfrc_applied)[pad.dofs[:3]]
        assert pushed == pytest.approx(frame @ law, rel=1e-6, abs=1e-8)
        own = axes.T @ state.qfrc_spring[pad.dofs[:3]]
        assert np.abs(own - pushed).max() > 0.3, "the engine's own springs do as much"
    forces = state.xfrc_applied[:, 3:].sum(axis=0)
    assert forces == pytest.approx(np.zeros(3), abs=1e-12), "couples are between links and object"
