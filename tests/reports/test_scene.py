"""What is seen in three dimensions is what the plan says, and solids are whole."""

from __future__ import annotations

import contextlib
import io
import json
import socket
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.grasps.shapes.box import Box
from synergrip.grasps.shapes.cylinder import Cylinder
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.sphere import Sphere
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.view import drawn
from synergrip.reports.view.planned import MOST, scene_of
from synergrip.reports.view.scene import Scene
from synergrip.reports.view.solid import Solid, ball, cone, of_shape, ribs, rod


@cache
def planned(name: str, *overrides: str) -> tuple[Plan, dict[str, Any]]:
    problem = load_problem(name, list(overrides))
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    document = outcome_document(problem.title, problem.grasp, answer, problem.notes, problem.source)
    return answer, json.loads(json.dumps(document))


def volume(solid: Solid) -> float:
    """Return the volume that triangles enclose, above 0 when their corners are counter-clockwise from outside."""
    a, b, c = (solid.points[solid.triangles[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


@pytest.mark.parametrize(
    ("shape", "size"),
    [
        (Sphere(radius=0.03), 4 / 3 * np.pi * 0.03**3),
        (Box(size=(0.02, 0.04, 0.06)), 0.02 * 0.04 * 0.06),
        (Cylinder(radius=0.02, height=0.1), np.pi * 0.02**2 * 0.1),
    ],
    ids=["sphere", "box", "cylinder"],
)
def test_shapes_are_closed_and_as_large_as_they_are(shape: Shape, size: float) -> None:
    solid = of_shape(shape)
    edges = np.sort(solid.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert np.all(np.unique(edges, axis=0, return_counts=True)[1] == 2)
    assert 0.96 * size < volume(solid) < 1.0001 * size


def test_rods_balls_and_cones_are_of_unit_size() -> None:
    assert volume(rod()) == pytest.approx(np.pi, rel=0.02)
    assert volume(ball()) == pytest.approx(4 / 3 * np.pi, rel=0.1)
    assert np.ptp(cone().points[:, 2]) == 1.0
    assert np.linalg.norm(cone().points[:, :2], axis=1).max() == 1.0
    assert np.allclose(np.linalg.norm(ribs().points[:, :2], axis=1), ribs().points[:, 2]), "ribs lie on the cone"
    assert set(ribs().triangles.ravel()) == set(range(len(ribs().points)))


def test_copies_have_the_colours_of_everything_else_and_are_seen_through_what_is_held() -> None:
    made = dict[str, dict[str, Any]]()
    nodes = SimpleNamespace(add_batched_meshes_simple=lambda name, *_, **told: made.update({name: told}))
    drawn._several(nodes, "clear", cone(), 2, np.tile([0, 188, 255], (2, 1)), opacity=0.3)
    drawn._several(nodes, "full", cone(), 1, (0, 188, 255))
    assert made["clear"]["batched_colors"].tolist() == [[0, 128, 255]] * 2  # linear, as the viewer takes them
    assert made["clear"]["batched_opacities"].tolist() == [0.3, 0.3]
    assert made["full"]["batched_opacities"] is None  # with any, it would be hidden behind what is held


@pytest.mark.parametrize("name", ["human-ball", "gripper-box"])
def test_the_forces_that_are_seen_carry_the_object_where_it_is(name: str) -> None:
    answer, document = planned(name)
    scene = scene_of(document)
    total = scene.forces.sum(axis=1) + answer.task.wrench[:, :3]
    assert np.abs(total).max() < 1e-7
    arms = np.cross(scene.places - scene.position[:, None], scene.forces).sum(axis=1) + answer.task.wrench[:, 3:]
    if all(contact.kind.name == "hard" for contact in answer.grasp.contacts):  # no moments of their own
        assert np.abs(arms).max() < 1e-8
    assert np.allclose(scene.margins, answer.margins)
    assert np.allclose(np.linalg.norm(scene.normals, axis=2), 1.0)
    outside = -(scene.places[0] - scene.position[0]) * scene.normals[0]
    assert np.all(outside.sum(axis=1) > 0)  # normals point into the object


@pytest.mark.parametrize("name", ["human-ball", "gripper-box"])
def test_the_hand_that_is_seen_is_where_its_joints_say(name: str) -> None:
    answer, document = planned(name)
    scene, held = scene_of(document), answer.grasp.held
    assert held is not None
    assert answer.executed is not None
    k = len(scene.times) - 1
    q = answer.executed.states.q[k]
    for i, touch in enumerate(held.touches):
        motion = held.hand.kinematics.at(q, [(touch.pad.link, touch.pad.point)])[0]
        assert np.allclose(scene.pads[k, i], motion.position, atol=1e-12)
    for parent, link in ((above, link) for link, above in held.hand.parents.items()):
        ends = [each.position for each in held.hand.kinematics.at(q, [(parent, np.zeros(3)), (link, np.zeros(3))])]
        if np.linalg.norm(ends[1] - ends[0]) > 1e-6:
            assert np.abs(scene.bones[k] - np.array(ends)).max(axis=(1, 2)).min() < 1e-12


def test_gravity_turns_where_the_palm_does() -> None:
    scene = scene_of(planned("human-ball")[1])
    turned = np.degrees(np.arccos(np.clip(scene.up[0] @ scene.up[-1], -1, 1)))
    assert turned > 30  # the palm turns over
    assert np.allclose(np.linalg.norm(scene.up, axis=1), 1.0)


def test_the_object_turns_as_it_does(tmp_path: Path) -> None:
    answer, document = planned("gripper-box")
    scene = scene_of(document)
    turn = Rotation.from_matrix(scene.rotation[-1] @ scene.rotation[0].T).as_rotvec()
    first = Rotation.from_rotvec(np.array(answer.motion.du[0, 3:]))
    expected = (Rotation.from_rotvec(np.array(answer.motion.du[-1, 3:])) * first.inv()).as_rotvec()
    assert np.allclose(turn, expected, atol=1e-12)


def test_many_knots_are_thinned_from_end_to_end() -> None:
    _, document = planned("gripper-box", f"task.knots={MOST + 101}")
    scene = scene_of(document)
    assert len(scene.times) == MOST
    assert scene.left_out == 101
    assert scene.times[0] == document["time_s"][0]
    assert scene.times[-1] == document["time_s"][-1]


def test_a_grasp_of_matrices_and_a_hand_file_that_changed_are_refused() -> None:
    with pytest.raises(InputError, match="no hand to be seen"):
        scene_of(planned("tripod")[1])
    _, document = planned("gripper-box")
    other = document | {"execution": document["execution"] | {"sha256": "0" * 64}}
    with pytest.raises(InputError, match="has changed since this was planned"):
        scene_of(other)


def short(scene: Scene) -> Scene:
    """Return the ends of a scene."""
    names = [
        field
        for field, value in vars(scene).items()
        if isinstance(value, np.ndarray) and len(value) == len(scene.times)
    ]
    return replace(scene, **{name: getattr(scene, name)[[0, -1]] for name in names})


def test_the_page_is_made_on_this_machine_alone_and_in_silence(monkeypatch: pytest.MonkeyPatch) -> None:
    import viser

    seen: list[tuple[str, int]] = []
    real = viser.ViserServer

    def server(**options: Any) -> Any:
        made = real(**options)
        seen.append((made.get_host(), made.get_port()))
        return made

    monkeypatch.setattr(viser, "ViserServer", server)
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        page = drawn.page(short(scene_of(planned("gripper-box")[1])))
    assert not said.getvalue()
    ((host, port),) = seen
    assert host == "127.0.0.1"
    with socket.socket() as ours:
        assert ours.connect_ex((host, port)) != 0  # closed again
    assert len(page) < 1.2e6


def test_what_lies_along_a_direction_is_turned_there() -> None:
    directions = np.vstack([np.random.default_rng(5).normal(size=(50, 3)), [[0, 0, -2], [0, 0, 1], [1e-9, 0, -1]]])
    turned = Rotation.from_quat(drawn._upright(directions), scalar_first=True).apply([0.0, 0.0, 1.0])
    assert np.allclose(turned, directions / np.linalg.norm(directions, axis=1, keepdims=True), atol=1e-6)
