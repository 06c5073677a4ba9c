"""What a user's own contact frames say: normals toward the object, n, t, o right-handed; what is odd is noted."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import synergrip as sg

HARD = sg.HardFinger(friction=0.5)
SOFT = sg.SoftFinger(friction=0.5, spin_friction=0.01)
SQUEEZE = [[1], [0], [0], [0], [1], [0], [0], [0]]
TASK = sg.Task(loads=[sg.Wrench((0, 0, -1, 0, 0, 0))], limits=[sg.SlipMargin(0.1)])


def pinch(left: np.ndarray, right: np.ndarray, **others: Any) -> sg.Grasp:
    """Two fingers 40 mm apart on x, whose frames have these columns n, t, o."""
    columns = []
    for frame, x in ((left, -0.02), (right, 0.02)):
        forces = np.vstack([frame, np.cross([x, 0, 0], frame.T).T])
        columns += [forces, np.concatenate([np.zeros(3), frame[:, 0]])[:, None]]
    values = {"contacts": [("left", SOFT), ("right", SOFT)], "C_s": np.diag([1e-4, 1e-4, 1e-4, 1.0] * 2), **others}
    return sg.grasp_from_matrices(G=np.hstack(columns), J=np.eye(8), S=SQUEEZE, **values)


TOWARD = np.eye(3), np.diag([-1.0, 1.0, -1.0])
AWAY = TOWARD[1], TOWARD[0]
LEFT_HANDED = np.diag([1.0, 1.0, -1.0]), np.diag([-1.0, 1.0, 1.0])


def notes(grasp: sg.Grasp) -> list[str]:
    answer = sg.plan(grasp, TASK)
    assert isinstance(answer, sg.Plan)
    return [note for note in answer.notes if "normals" in note or "left-handed" in note]


def test_outward_normals_and_left_handed_frames_are_noted_in_the_plan() -> None:
    assert notes(pinch(*TOWARD)) == []
    (outward,) = notes(pinch(*AWAY))
    assert "the normals of all contacts point away from the middle" in outward
    (left,) = notes(pinch(LEFT_HANDED[0], TOWARD[1]))
    assert "(n, t, o) of left is left-handed" in left
    (both,) = notes(pinch(*LEFT_HANDED))
    assert "of left, right is left-handed" in both


def test_a_left_handed_frame_plans_the_same_forces_with_one_sign_changed() -> None:
    """G and J say the same of it: that is why it is noted and not refused."""
    right, left = (sg.plan(pinch(*frames), TASK) for frames in (TOWARD, LEFT_HANDED))
    assert isinstance(right, sg.Plan)
    assert isinstance(left, sg.Plan)
    assert left.forces == pytest.approx(right.forces * [1, 1, -1, 1, 1, 1, -1, 1], abs=1e-6)


def test_a_grasp_whose_normals_follow_from_the_object_has_no_such_note() -> None:
    problem = sg.load_problem("barrett-ball-hold")
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Plan)
    assert not any("normals" in note or "left-handed" in note for note in answer.notes)


def test_the_normal_of_a_contact_is_the_first_column_of_its_frame() -> None:
    left, right = pinch(*TOWARD).contacts
    assert left.normal == pytest.approx([1, 0, 0])
    assert right.normal == pytest.approx([-1, 0, 0])
    assert not left.normal.flags.writeable


def test_a_grasp_without_a_title_shows_none() -> None:
    assert repr(pinch(*TOWARD)).startswith("<Grasp: contacts left (soft), right (soft); ")
    assert repr(pinch(*TOWARD, title="two")).startswith("<Grasp 'two': contacts left")


def test_pads_that_do_not_reach_are_told_that_the_hand_can_close() -> None:
    tips = [sg.ContactAt(f"finger{i}/tip", HARD, stiffness=8e3) for i in (1, 2, 3)]
    small = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.02), position=(0, 0, 0.1))
    with pytest.raises(sg.InputError, match=r'outside the surface .* let the hand close .* close = "NAME"'):
        sg.make_grasp("barrett", small, posture="ball", synergies="motors", contacts=tips)
