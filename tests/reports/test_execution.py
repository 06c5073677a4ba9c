"""The `execution` of plan.json holds all that another program needs: one that knows nothing of synergrip does it."""

from __future__ import annotations

import ast
import json
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import executing_program
import numpy as np
import pytest
from executing_program import Tree, executed

from synergrip.planning.digest import unchanged
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document

REPOSITORY = Path(__file__).parents[2]
NAMES = (
    "barrett-ball-carry", "barrett-ball-roll", "dlr-ball-corners", "gripper-peg", "robonaut-handle",
    "robonaut-handle-knock", "table2-soft-joints",
)  # fmt: skip
KEYS = (
    "hand_file sha256 root_link joints q_0 S C_q C_z joint_range joint_torque followers lambda_0 tau_0 gravity_m_s2 "
    "palm object contacts load interpolation"
)
CONTACT_KEYS = "name link point_m frame kind parameters compliance pad_radius_m pad_centre_m"


@cache
def document_of(name: str) -> dict[str, Any]:
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    found = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, answer), allow_nan=False))
    assert isinstance(found, dict)
    return found


def load_of(problem: Problem, answer: Plan) -> dict[str, Any]:
    load = outcome_document("", problem.grasp, answer)["execution"]["load"]
    pushes = [{key: np.array(each[key]) for key in each} for each in load["forces"]]
    return {**load, "times_s": np.array(load["times_s"]), "wrench": np.array(load["wrench"]), "forces": pushes}


def test_the_other_program_knows_nothing_of_synergrip() -> None:
    tree = ast.parse(Path(executing_program.__file__).read_text(encoding="utf-8"))
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert "synergrip" not in "".join(map(ast.unparse, imports))


@pytest.mark.parametrize("name", NAMES)
def test_another_program_reproduces_forces_and_motion(name: str) -> None:
    document = document_of(name)
    path = REPOSITORY / document["execution"]["hand_file"]
    assert sha256(path.read_bytes()).hexdigest() == document["execution"]["sha256"]
    forces, moved = executed(document, Tree(path, document["execution"]["root_link"]))
    expected = np.array(document["lambda"])
    assert np.abs(forces - expected).max() < 1e-9 * np.abs(expected).max()
    assert np.abs(moved - np.array(document["du"])).max() < 1e-9 * max(np.abs(np.array(document["du"])).max(), 1e-3)


@pytest.mark.parametrize("name", NAMES)
def test_the_block_has_every_key_and_agrees_with_itself(name: str) -> None:
    document = document_of(name)
    block = document["execution"]
    assert set(block) == set(KEYS.split())
    assert all(set(contact) == set(CONTACT_KEYS.split()) for contact in block["contacts"])
    tree = Tree(REPOSITORY / block["hand_file"], block["root_link"])
    q = dict(zip(block["joints"], block["q_0"], strict=True))
    for contact in block["contacts"]:
        R, p, _ = tree.pose(contact["link"], q)
        away = np.linalg.norm(p + R @ contact["pad_centre_m"] - contact["point_m"])
        assert away == pytest.approx(contact["pad_radius_m"], abs=1e-9)
        assert np.array(contact["frame"]) @ np.array(contact["frame"]).T == pytest.approx(np.eye(3), abs=1e-12)
    every = np.array_equal(block["S"], np.eye(len(q)))  # each joint a synergy, followers too
    for follower in () if every else block["followers"]:
        i, j = (block["joints"].index(follower[key]) for key in ("joint", "driver"))
        alone = sum(each["joint"] == follower["joint"] for each in block["followers"]) == 1
        assert not alone or np.allclose(np.array(block["S"])[i], follower["ratio"] * np.array(block["S"])[j])
    start = np.array(document["lambda"][0]) - np.array(block["lambda_0"])
    if not np.any(document["dz_r"][0]):
        assert np.abs(start).max() < 1e-9


@pytest.mark.parametrize("name", NAMES)
def test_the_load_is_that_of_the_plan_and_has_its_corners(name: str) -> None:
    document = document_of(name)
    load, times = document["execution"]["load"], np.array(document["time_s"])
    assert load["times_s"] == sorted(load["times_s"])
    assert set(times) <= set(load["times_s"])
    at = {time: wrench for time, wrench in zip(load["times_s"], load["wrench"], strict=True)}
    assert len(at) <= len(load["times_s"])
    if len(at) == len(load["times_s"]):  # nothing jumps
        assert [at[time] for time in document["time_s"]] == document["wrench"]
    assert load["point"] == document["execution"]["object"]["position_m"]


def test_a_jump_of_the_load_stands_twice() -> None:
    push = 'task.push=[{force="1 N", direction=[1,0,0], start="0.5 s", end="1.05 s", profile="step"}]'
    problem = load_problem("barrett-ball-hold", [push])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    load = load_of(problem, answer)
    for time in (0.5, 1.05):
        there = [w[0] for t, w in zip(load["times_s"], load["wrench"], strict=True) if abs(t - time) < 1e-9]
        assert len(there) == 2
        assert abs(there[1] - there[0]) == pytest.approx(1.0)


def test_what_begins_at_the_instant_at_which_another_ends_jumps_with_it() -> None:
    push = '{{force="{} N", direction=[0,1,0], start="{} s", end="{} s", profile="step"}}'
    pushes = [push.format(1, 0.5, 1.05), push.format(2, 0.5, 1.5), push.format(0.5, 1.05, 1.5)]
    problem = load_problem("barrett-ball-hold", [f"task.push=[{','.join(pushes)}]"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    load = load_of(problem, answer)
    pushed = sum(each["force"] for each in load["forces"])
    for time, expected in ((0.5, [0.0, 3.0]), (1.05, [3.0, 3.5, 2.5]), (1.5, [2.5, 0.0])):
        there = np.abs(load["times_s"] - time) < 1e-9
        assert pushed[there, 1] == pytest.approx(expected)
        rest = load["wrench"][there, :3] - pushed[there]  # the weight, which does not jump
        assert rest == pytest.approx(np.tile(rest[0], (len(rest), 1)))


@pytest.mark.parametrize("factor", [1.0, 1.5])
def test_a_push_says_where_it_acts(factor: float) -> None:
    problem = load_problem("gripper-peg")
    answer = plan(problem.grasp, problem.task.replace(load_factor=factor))
    assert isinstance(answer, Plan)
    load = load_of(problem, answer)
    (push,) = load["forces"]
    assert push["at_m"].tolist() == [0.0, 0.0, 0.03]
    assert push["force"].min(axis=0) == pytest.approx([0.0, 0.0, -4.0 * factor])
    weight = np.array([0.0, 0.0, 0.981 * factor])
    assert load["wrench"][:, :3] - push["force"] == pytest.approx(np.tile(weight, (len(push["force"]), 1)))
    assert load["wrench"][:, 3:] == pytest.approx(np.cross(push["at_m"], push["force"]))


def test_straight_lines_follow_a_curved_load() -> None:
    problem = load_problem("human-ball")  # the palm turns over, and the weight with it
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    load = load_of(problem, answer)
    times = np.linspace(*problem.timed.times[[0, -1]], 501)
    assert problem.timed.course is not None
    true = problem.timed.course.load_at(times)
    assert true is not None
    told = np.array([np.interp(times, load["times_s"], column) for column in load["wrench"].T]).T
    coarse = np.array([np.interp(times, answer.time, column) for column in answer.motion.wrench.T]).T
    assert np.abs(told - true).max() < 0.08 * np.abs(coarse - true).max()  # four parts: a sixteenth of the distance


@pytest.mark.parametrize("start", ["", 'start="0 s", end="2 s", '])
def test_a_push_of_the_whole_task_is_on_from_its_first_line_to_its_last(start: str) -> None:
    problem = load_problem("barrett-ball-hold", [f'task.push=[{{{start}force="2 N", direction="x"}}]', "task.knots=5"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    load = load_of(problem, answer)
    assert load["wrench"][:, 0] == pytest.approx(2.0)
    assert load["forces"][0]["force"][:, 0] == pytest.approx(2.0)


@pytest.mark.parametrize(("knots", "turn"), [(2, 90), (2, 720), (3, -400)])
def test_a_load_that_turns_far_from_knot_to_knot_is_told_in_as_many_lines_as_it_takes(knots: int, turn: float) -> None:
    changes = [f"task.knots={knots}", f'task.palm={{axis="x", turn="{turn} deg"}}', "task.move=[]"]
    problem = load_problem("gripper-box", changes)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    load, times = load_of(problem, answer), np.linspace(0, 2, 1001)
    assert problem.timed.course is not None
    true = problem.timed.course.load_at(times)
    assert true is not None
    told = np.array([np.interp(times, load["times_s"], column) for column in load["wrench"].T]).T
    assert np.abs(told - true).max() < 2e-3 * np.abs(true).max()


def test_a_load_that_stays_is_not_curved_because_the_object_moves_on_a_curve() -> None:
    assert document_of("gripper-peg")["execution"]["load"]["curved_s"] == []
    assert document_of("barrett-ball-carry")["execution"]["load"]["curved_s"] == [[0.0, 0.8]]


def test_gravity_seen_from_the_palm_is_the_load() -> None:
    found = 0
    for name in ("barrett-ball-carry", "human-glass", "barrett-ball-arm", "robonaut-handle", "barrett-ball-hold"):
        block = document_of(name)["execution"]
        weight = block["object"]["mass_kg"] * np.array(block["gravity_m_s2"])
        if block["palm"] is None:
            assert np.allclose(document_of(name)["wrench"][0][:3], weight)
            continue
        found += 1
        turns = np.array([pose["rotation"] for pose in block["palm"]])
        places = np.array([pose["position_m"] for pose in block["palm"]])
        assert turns @ turns.transpose(0, 2, 1) == pytest.approx(np.tile(np.eye(3), (len(turns), 1, 1)), abs=1e-12)
        times, centre = np.array(document_of(name)["time_s"]), np.array(block["object"]["position_m"])
        path = places + turns @ centre  # of the centre of mass, in the palm frame at the start
        h = times[1] - times[0]
        pulls = (path[2:] - 2 * path[1:-1] + path[:-2]) / h**2
        wrench = np.array(document_of(name)["wrench"])[1:-1, :3]
        still = np.einsum("tji,j->ti", turns[1:-1], weight)
        moving = np.einsum("tji,tj->ti", turns[1:-1], weight - block["object"]["mass_kg"] * pulls)
        scale = np.abs(wrench).max()
        assert min(np.abs(wrench - still).max(), np.abs(wrench - moving).max()) < 0.02 * scale, name
    assert found


def test_the_digest_covers_the_block() -> None:
    document = json.loads(json.dumps(document_of("barrett-ball-roll")))
    assert unchanged(document)
    document["execution"]["q_0"][0] += 1e-15
    assert not unchanged(document)


def test_matrices_have_no_hand_to_execute() -> None:
    assert "execution" not in document_of("tripod")
