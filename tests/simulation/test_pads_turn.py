"""The springs of pads in the engine are those of the plan, however far links and contacts have turned."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest
from judged_playing import Case

import synergrip
from synergrip.linalg import Array
from synergrip.simulation.model import Model, make_model
from synergrip.simulation.pad_springs import PadSprings
from synergrip.simulation.played_plan import PlayedPlan, read_played_plan

HEAVY = ("task.move[0].lift=-8 mm", "task.knots=11", "object.mass=400 g", "limits.margin=0.3 N")
"""The weight is a preload of 2 N from the start, and the pads turn by 15 degrees."""

COMPLIANCE = np.diag([1e-4, 3e-4, 7e-4, 0.5])


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


@pytest.fixture
def turned(heavy: Path, tmp_path: Path) -> tuple[PlayedPlan, Model, mujoco.MjData]:
    """Return pads that are softer along the surface than into it, on fingers turned by 0.3 rad; nothing touches."""
    data = json.loads((heavy / "plan.json").read_text())
    for contact in data["execution"]["contacts"]:
        contact["compliance"] = COMPLIANCE.tolist()
    data["execution"]["lambda_0"] = [3.0, 0.7, -1.2, 0.01, 2.0, -0.4, 1.1, -0.02]
    (tmp_path / "plan.json").write_text(json.dumps(data))
    plan = read_played_plan(tmp_path)
    model = make_model(plan, 2e-4)
    model.mujoco.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    state = mujoco.MjData(model.mujoco)
    state.qpos[model.places] = plan.q_0 + 0.3
    mujoco.mj_forward(model.mujoco, state)
    return plan, model, state


def coordinates(model: Model, dofs: Array) -> Array:
    engine = model.mujoco
    return np.asarray(engine.jnt_qposadr[engine.dof_jntid[dofs]])


def forces_of_pads(springs: PadSprings, model: Model, state: mujoco.MjData) -> Array:
    """Return the forces (n_v,) of the pads' joints, those of the engine's own springs among them."""
    mujoco.mj_forward(model.mujoco, state)
    springs.follow(state)
    springs.apply(state)
    mujoco.mj_forward(model.mujoco, state)
    return np.array(state.qfrc_spring + state.qfrc_applied)


def test_pads_that_stand_anywhere_push_as_the_law_says(turned: tuple[PlayedPlan, Model, mujoco.MjData]) -> None:
    plan, model, state = turned
    bodies = model.mujoco.geom_bodyid[[pad.geom for pad in model.pads]]
    nominal, springs = state.xpos[bodies].copy(), PadSprings(model)
    slides = np.array([pad.dofs[:3] for pad in model.pads])
    state.qpos[coordinates(model, slides)] = [[1e-4, -2e-4, 3e-4], [0.0, 1e-4, 5e-4]]
    found = forces_of_pads(springs, model, state)
    for number, pad in enumerate(model.pads):
        frame, given = pad.frame_o, (state.xpos[bodies] - nominal)[number]
        law = plan.forces_0[number][:3] - np.linalg.solve(COMPLIANCE[:3, :3], frame.T @ given)
        axes = state.xaxis[model.mujoco.dof_jntid[pad.dofs[:3]]]
        assert axes.T @ found[pad.dofs[:3]] == pytest.approx(frame @ law, rel=1e-6, abs=1e-8)
        own = axes.T @ state.qfrc_spring[pad.dofs[:3]]
        assert np.abs(own - frame @ law).max() > 0.3, "the engine's own springs do as much"
    assert state.xfrc_applied[:, 3:].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12), "couples are between bodies"
    assert np.abs(state.xfrc_applied[:, 3:]).max() > 1e-4


def test_a_pad_that_rolls_as_it_turns_about_its_hinge_pushes_as_before(
    turned: tuple[PlayedPlan, Model, mujoco.MjData],
) -> None:
    """Stuck to the object, a pad whose hinge is not along the normal rolls; the tip of the plan does not."""
    plan, model, state = turned
    springs, angle = PadSprings(model), 0.02
    springs.follow(state)
    hinges = np.array([pad.dofs[3] for pad in model.pads])
    slides = np.array([pad.dofs[:3] for pad in model.pads])
    axes = state.xaxis[model.mujoco.dof_jntid[hinges]]
    normals = np.array([pad.frame_o[:, 0] for pad in model.pads])
    radii = np.array([[pad.radius] for pad in model.pads])
    rolled = angle * np.cross(axes, -radii * normals)
    assert np.linalg.norm(rolled, axis=1).min() > 1e-5
    along = state.xaxis[model.mujoco.dof_jntid[slides]]
    state.qpos[coordinates(model, hinges)] = angle
    state.qpos[coordinates(model, slides)] = np.einsum("nij,nj->ni", along, rolled)
    found = forces_of_pads(springs, model, state)
    for number, pad in enumerate(model.pads):
        pushed, n = pad.frame_o @ plan.forces_0[number][:3], normals[number]
        assert along[number].T @ found[slides[number]] == pytest.approx(pushed, abs=1e-8)
        moment = plan.forces_0[number][3] - angle * (axes[number] @ n) / COMPLIANCE[3, 3]
        wanted = axes[number] @ (moment * n + np.cross(pad.radius * n, pushed))
        assert found[hinges[number]] == pytest.approx(wanted, abs=1e-9)
