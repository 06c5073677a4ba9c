"""The second execution by itself: closed forms, virtual work, and the plan's own linear model where all is small."""

from __future__ import annotations

import ast
import json
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import second_execution
import second_samples
from judged_execution import compared
from scipy.spatial.transform import Rotation
from second.equilibrium import Equilibrium, State
from second.jaws import cube, document, written
from second.surfaces import Ball, Cap, Mantle, Side, face_at
from second.touching import Rolled, Rolling
from second.tree import read_tree
from second_execution import between_knots, executed

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document

REPOSITORY = Path(__file__).parents[2]
BOTH = pytest.mark.parametrize("model", ["fixed", "rolling"])


@cache
def planned(name: str, *overrides: str) -> dict[str, Any]:
    problem = load_problem(name, list(overrides))
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    found = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, answer)))
    assert isinstance(found, dict)
    return found


def equilibrium_of(name: str, model: str) -> Equilibrium:
    block = planned(name)["execution"]
    return Equilibrium(block, read_tree(REPOSITORY / block["hand_file"], block["root_link"], block["joints"]), model)


def test_it_knows_nothing_of_the_package() -> None:
    own = [Path(second_execution.__file__), Path(second_samples.__file__),
           *(REPOSITORY / "tests" / "second").glob("[!t]*.py"),
           *(REPOSITORY / "tests" / "second").glob("t[!e]*.py")]  # fmt: skip
    assert {path.name for path in own} >= {"tree.py", "touching.py", "surfaces.py", "equilibrium.py"}
    for path in own:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
        assert "synergrip" not in "".join(map(ast.unparse, imports))


@BOTH
def test_jaws_squeeze_carry_and_shift_a_box(tmp_path: Path, model: str) -> None:
    c, c_t, k, c_z, squeeze, shift, weight = 1e-4, 2e-4, 3e-4, 5e-4, 0.004, 0.03, 1.2
    jaws = document(written(tmp_path), cube(0.02), 0.02, 0.005, [c, c_t, c_t, 1.0], [0.0, k, 0.0, k])
    jaws["execution"]["C_z"] = np.diag([0.0, c_z, 0.0, c_z]).tolist()
    jaws |= {"dz_r": [[0.0, squeeze + shift, 0.0, squeeze - shift]], "wrench": [[0, 0, -weight, 0, 0, 0]]}
    found = executed(jaws, tmp_path, model)
    assert found.ended is None
    normal, sag = squeeze / (c + k + c_z), c_t * weight / 2
    assert found.forces[0] == pytest.approx([normal, 0, weight / 2, 0, normal, 0, weight / 2, 0], abs=1e-7)
    assert found.du[0] == pytest.approx([shift, 0, -sag, 0, 0, 0], abs=1e-9)
    assert found.tau[0] == pytest.approx([0, normal, 0, normal], abs=1e-7)
    assert found.margins[0] == pytest.approx([0.5 * normal - weight / 2] * 2, abs=1e-7)


@BOTH
def test_what_is_stretched_at_the_start_counts_from_there(tmp_path: Path, model: str) -> None:
    c, k, squeeze, held = 1e-4, 3e-4, 0.004, 2.0
    jaws = document(written(tmp_path), cube(0.02), 0.02, 0.005, [c, c, c, 1.0], [0.0, k, 0.0, k])
    jaws["execution"] |= {"lambda_0": [held, 0, 0, 0, held, 0, 0, 0], "tau_0": [0, held, 0, held]}
    still = executed(jaws, tmp_path, model)
    assert still.forces[0] == pytest.approx([held, 0, 0, 0, held, 0, 0, 0], abs=1e-9)
    found = executed(jaws | {"dz_r": [[0.0, squeeze, 0.0, squeeze]]}, tmp_path, model)
    assert found.forces[0, [0, 4]] == pytest.approx(held + squeeze / (c + k), abs=1e-7)
    assert found.q[0] == pytest.approx([0, c * squeeze / (c + k)] * 2, abs=1e-10)


def test_a_ball_rolls_between_tips_that_part(tmp_path: Path) -> None:
    ball, tip, k, squeeze, aside = 0.03, 0.01, 2e-4, 0.01, 0.012
    far = ball + tip
    jaws = document(written(tmp_path), {"sphere": {"radius_m": ball}}, ball, tip, [0, 0, 0, 1.0], [0.0, k, 0.0, k])
    jaws |= {"time_s": [0.0, 1.0], "dz_r": [[0, squeeze, 0, squeeze], [aside, squeeze, aside, squeeze]],
             "wrench": [[0] * 6] * 2}  # fmt: skip
    found = executed(jaws, tmp_path, "rolling", parts=20)
    assert found.ended is None
    angle = np.arcsin(aside / far)  # of the line between the tips, which goes through the middle of the ball
    assert found.du[1] == pytest.approx([0, 0, 0, 0, 0, -angle * far / ball], abs=1e-8)
    normal = (squeeze - far * (1 - np.cos(angle))) / k / np.cos(angle)
    assert found.forces[1] == pytest.approx([normal, 0, 0, 0, normal, 0, 0, 0], abs=1e-5)
    assert found.tau[1] == pytest.approx([-normal * np.sin(angle), normal * np.cos(angle)] * 2, abs=1e-5)
    stuck = executed(jaws, tmp_path, "fixed", parts=20)
    assert stuck.du[1, 5] == pytest.approx(-np.arcsin(aside / ball), abs=1e-8)  # the points that stuck stay opposite


def test_a_frictionless_tip_slides_on_the_true_surface(tmp_path: Path) -> None:
    ball, tip, k, squeeze, aside = 0.03, 0.01, 2e-4, 0.01, 0.012
    jaws = document(written(tmp_path), {"sphere": {"radius_m": ball}}, ball, tip, [0, 0, 0, 1.0], [0.0, k, 0.0, k])
    block = jaws["execution"]
    left = block["contacts"][0]
    left |= {"kind": "frictionless", "compliance": [[1e-4]], "parameters": {}}
    block["contacts"][1] |= {"kind": "patch", "compliance": np.diag([1e-9] * 6).tolist(),
                             "parameters": {"friction": 9, "spin_friction_m": 9, "patch_radius_m": 9}}  # fmt: skip
    block["lambda_0"], block["C_q"] = [0.0] * 7, np.diag([0.0, k, 0.0, 1e-12]).tolist()
    jaws |= {"dz_r": [[aside, squeeze, 0.0, 0.0]]}
    found = executed(jaws, tmp_path, "rolling", first=20)
    assert found.ended is None
    apart = np.array([found.q[0, 1] - ball - tip, found.q[0, 0], 0.0]) - found.du[0, :3]
    pressed = ball + tip - np.linalg.norm(apart)
    assert found.forces[0, 0] == pytest.approx(pressed / 1e-4, rel=1e-6)
    assert found.tau[0, :2] == pytest.approx(-found.forces[0, 0] * apart[1::-1] / np.linalg.norm(apart), rel=1e-6)
    assert found.q[0, 1] == pytest.approx(squeeze - k * found.tau[0, 1], abs=1e-9)


@pytest.mark.parametrize(("face", "start", "moves"), [
    (Side(np.full(3, 0.03), np.eye(3), 0, -1.0), [-0.04, 0, 0], 0.01 * 0.7),
    (Ball(0.03), [-0.04, 0, 0], 0.04 * np.sin(0.7 * 0.01 / 0.04)),
    (Mantle(0.03, 0.05, np.array([0, 0, 1.0])), [-0.04, 0, 0], 0.04 * np.sin(0.7 * 0.01 / 0.04)),
    (Mantle(0.03, 0.05, np.array([0, 1.0, 0])), [-0.04, 0, 0], 0.01 * 0.7),
    (Cap(0.03, 0.03, np.array([-1.0, 0, 0])), [-0.04, 0, 0], 0.01 * 0.7),
])  # fmt: skip
def test_a_tip_rolls_by_its_radius_times_its_turn(face: Any, start: list[float], moves: float) -> None:
    tip = Rolling(np.zeros(3), face, 0.01, np.array(start), np.eye(3), np.eye(3))
    link = np.eye(4)[None].copy()
    link[0, :3, :3], link[0, :3, 3] = Rotation.from_rotvec([0, 0, 0.7]).as_matrix(), start
    settled = tip.stretched(link, np.zeros((1, 3)), np.eye(3)[None], tip.start()).settled
    assert isinstance(settled, Rolled)
    assert settled.centre_o[0, 1] == pytest.approx(-moves, abs=1e-10)  # the tip's left side turns down: it goes down
    assert settled.centre_o[0, 2] == pytest.approx(0.0, abs=1e-15)
    assert face.distance(settled.centre_o)[0] == pytest.approx(0.01, abs=1e-15)
    assert settled.frame_o[0, :, 0] == pytest.approx(-face.normal(settled.centre_o)[0], abs=1e-12)
    assert settled.frame_o[0, :, 2] == pytest.approx([0, 0, 1], abs=1e-12)


@BOTH
@pytest.mark.parametrize("name", ["gripper-peg", "human-glass", "dlr-ball-lift-free", "barrett-ball-lift-joints"])
def test_it_agrees_with_the_linear_plan_to_first_order(name: str, model: str) -> None:
    whole = planned(name)
    q_0, lambda_0 = (np.array(whole["execution"][key]) for key in ("q_0", "lambda_0"))
    last = [len(whole["time_s"]) - 1]
    off = []
    shares = 1 / np.array([8, 16, 32])
    if model == "rolling":  # tips touch where the surface is, to 10 um of where the plan has them: seen if all is small
        shares *= 4
    for share in shares:
        part = {**whole, "time_s": [1.0], "dz_r": share * np.array(whole["dz_r"])[last],
                "wrench": share * np.array(whole["wrench"])[last]}  # fmt: skip
        part["execution"] = {**whole["execution"], "load": {}, "lambda_0": share * lambda_0}  # it stiffens the grasp
        found = executed(part, REPOSITORY, model)
        assert found.ended is None
        forces, du, dq = (np.array(whole[key])[last] for key in ("lambda", "du", "dq"))
        off.append([
            np.abs(found.forces - share * forces).max(),
            np.abs(found.du - share * du).max(), np.abs(found.q - q_0 - share * dq).max(),
        ])  # fmt: skip
    for larger, smaller in pairwise(np.array(off)):
        assert np.all((larger / smaller > 3) & (larger / smaller < 5)), off


@pytest.mark.parametrize("name", ["gripper-peg", "human-glass", "robonaut-handle", "table2-soft-motors"])
def test_torques_do_the_work_of_the_forces(name: str) -> None:
    equilibrium, rng = equilibrium_of(name, "fixed"), np.random.default_rng(0)
    q = equilibrium.q_0 + rng.normal(scale=0.1, size=equilibrium.n_q)
    state = State(rng.normal(size=equilibrium.n_l), q, equilibrium.p_0 + 0.01, np.eye(3), equilibrium.start.settled)
    _, tau = equilibrium.held(state)
    h = 1e-6
    for j, step in enumerate(np.eye(equilibrium.n_q)):
        work = 0.0
        for contact, each, rows, part in zip(equilibrium.contacts, equilibrium.touching, equilibrium.rows,
                                             equilibrium.slices, strict=True):  # fmt: skip
            poses = equilibrium.tree.poses(np.array([q + h * step, q - h * step, q])).links[contact["link"]]
            point = poses[:, :3, :3] @ each.hand_point + poses[:, :3, 3]
            along = np.zeros(6)
            along[rows] = state.forces[part]
            turn = Rotation.from_matrix(poses[0, :3, :3] @ poses[1, :3, :3].T).as_rotvec()
            work += (each.frame_o @ along[:3]) @ (point[0] - point[1]) + (each.frame_o @ along[3:]) @ turn
        assert work / (2 * h) == pytest.approx(tau[j], abs=1e-7)


@BOTH
@pytest.mark.parametrize("name", ["gripper-bar", "human-glass", "dlr-ball-lift-free"])
def test_springs_store_the_work_that_is_done_on_them(name: str, model: str) -> None:
    """Along any way of hand and object, also where pads roll: the energy is the sum of the work at both ends."""
    equilibrium, rng = equilibrium_of(name, model), np.random.default_rng(1)
    if model == "rolling":  # the frame turns against link and object, which springs of one stiffness do not feel
        equilibrium.C_s = 1e-4 * np.eye(equilibrium.n_l)
    stiffness = np.linalg.inv(equilibrium.C_s)
    turns, shift, turn = rng.normal(scale=0.1, size=equilibrium.n_q), rng.normal(scale=0.005, size=3), [0.1, -0.2, 0.1]
    off = []
    for count in (20, 40):
        state, work = equilibrium.start, 0.0
        seen = None
        for share in np.arange(1, count + 1) / count:
            q, p = equilibrium.q_0 + share**2 * turns, equilibrium.p_0 + share * shift
            R = Rotation.from_rotvec(share * np.array(turn)).as_matrix()
            extra = Rotation.from_matrix(R @ state.R.T).as_rotvec()
            x = np.concatenate([np.zeros(equilibrium.n_l), q, p, extra])
            stretch = -equilibrium.residual(x[None], state, np.zeros(equilibrium.S.shape[1]), equilibrium.load_0)
            forces = stiffness @ (stretch[0, -equilibrium.n_l :] - equilibrium.C_s @ equilibrium.forces_0)
            settled = equilibrium.settle(x, state)
            now = State(forces, q, p, R, settled.settled)
            wrench, tau = equilibrium.held(now)
            if seen is not None:
                before, wrench_0, tau_0 = seen
                work += (tau + tau_0) / 2 @ (q - before.q) - (wrench + wrench_0) / 2 @ [*(p - before.p), *extra]
            seen, state = (now, wrench, tau), now
            if share == 1 / count:
                first = forces @ equilibrium.C_s @ forces / 2
        off.append(abs(forces @ equilibrium.C_s @ forces / 2 - first - work) / (forces @ equilibrium.C_s @ forces / 2))
    assert off[1] < 2e-3
    assert off[0] / off[1] > 3


def test_what_runs_over_an_edge_ends_there(tmp_path: Path) -> None:
    shape = {"box": {"size_m": [0.04, 0.004, 0.04], "rotation": np.eye(3).tolist()}}
    jaws = document(written(tmp_path), shape, 0.02, 0.03, [1e-5, 1e-5, 1e-5, 1.0], [0.0, 1e-4, 0.0, 1e-4])
    jaws |= {"time_s": [0.0, 0.5, 1.0], "wrench": [[0] * 6] * 3,
             "dz_r": [[0, 0.01, 0, 0.01], [0.001, 0.01, 0.001, 0.01], [0.006, 0.01, 0.006, 0.01]]}  # fmt: skip
    found = executed(jaws, tmp_path, "rolling")
    assert len(found.times) == 2
    assert found.ended is not None
    assert found.ended.startswith("not reached at 1 s: contact ")
    assert found.ended.endswith("leaves its face")
    assert executed(jaws, tmp_path, "fixed").ended is None


@BOTH
def test_a_finger_is_not_longer_than_it_is(model: str) -> None:
    found = executed(planned("gripper-box", "task.move[0].lift=500 mm", "limits.joint_range=none"), REPOSITORY, model)
    assert found.ended is not None
    assert len(found.times) < 41


@BOTH
def test_a_push_keeps_its_point_on_the_object(tmp_path: Path, model: str) -> None:
    """A force on the end of a lever turns it until it points along the force, nearly: moment = turned arm x force."""
    jaws = document(written(tmp_path), cube(0.02), 0.02, 0.005, [1e-5, 1e-5, 1e-5, 0.5], [0.0] * 4)
    arm, force = [0.0, 0.04, 0.0], [0.0, 0.0, 8.0]
    load = {"times_s": [0.0], "wrench": [[*force, *np.cross(arm, force)]],
            "forces": [{"at_m": arm, "force": [force]}]}  # fmt: skip
    jaws |= {"dz_r": [[0.0, 0.001, 0.0, 0.001]], "wrench": load["wrench"]}
    jaws["execution"]["load"] = load
    found = executed(jaws, tmp_path, model)
    assert found.ended is None
    turn = found.du[0, 3]
    assert turn > 0.05
    assert 2 * abs(found.forces[0, 3]) == pytest.approx(0.04 * 8.0 * np.cos(turn), rel=1e-3)


def test_a_promise_is_compared_with_all_that_was_reached() -> None:
    document = planned("gripper-box", "task.knots=11")
    found = executed(document, REPOSITORY, "fixed")
    finer = executed(between_knots(document, 2), REPOSITORY, "fixed")
    assert finer.margins[0] == pytest.approx(found.margins[0], abs=1e-9)
    assert len(finer.times) > 2 * len(found.times)
    same = compared(found.margins, found, found)
    assert same.same
    assert same.difference == 0.0
    assert same.keeps(found.margins.min())
    assert not same.keeps(found.margins.min() + 0.02)
    promised = found.margins.copy()
    promised[1, 1] -= 0.05  # not the worst one: at most a hundredth of the largest force, some 0.03 N, is the same
    assert compared(promised, found, found).promised == same.promised
    assert not compared(promised, found, found).same
    low = replace(finer, margins=finer.margins - 1.0)
    assert not compared(found.margins, found, low).keeps(found.margins.min())
    far = ("task.knots=11", "task.move[0].lift=500 mm", "limits.joint_range=none")
    part = executed(planned("gripper-box", *far), REPOSITORY, "fixed")
    ended = compared(np.ones((11, 2)), part, part)
    assert not ended.same
    assert not ended.keeps(-100.0)


def test_the_face_is_the_nearest_one() -> None:
    turned = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    box = {"box": {"size_m": [0.02, 0.04, 0.06], "rotation": turned.tolist()}}
    side = face_at(box, np.array([0.0, 0.012, 0.0]))
    assert side.normal(np.zeros((1, 3)))[0] == pytest.approx([0, 1, 0], abs=1e-15)
    assert side.distance(np.array([[0.0, 0.012, 0.0]]))[0] == pytest.approx(0.002)
    cylinder = {"cylinder": {"radius_m": 0.02, "height_m": 0.1, "rotation": np.eye(3).tolist()}}
    assert isinstance(face_at(cylinder, np.array([0.01, 0, -0.052])), Cap)
    assert isinstance(face_at(cylinder, np.array([0.021, 0, -0.04])), Mantle)
