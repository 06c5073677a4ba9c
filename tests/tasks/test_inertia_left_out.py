"""What a load by inertia leaves out of an object that moves in a palm that moves, against its way through the world."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip import Object, Problem, load_problem
from synergrip.grasps.objects import Box
from synergrip.linalg import Array, frozen
from synergrip.tasks.inertia_left_out import left_out
from synergrip.tasks.marks import Marks
from synergrip.tasks.palm_motion import Palm

PALM = 'task.palm={ axis = "x", turn = "150 deg", inertia = true }'
LONG = 1.0


class Along:
    """A course d sin^2(pi t) with a turn about one axis, both from rest to rest."""

    way = np.array([0.01, 0.04, -0.02, 0.2, -0.3, 0.1])
    marks = Marks()

    def load_at(self, times: Array) -> Array | None:
        return None

    def target_at(self, times: Array) -> Array:
        return np.asarray(np.sin(np.pi * times)[:, None] ** 2 * self.way)


def _problem(*changes: str) -> Problem:
    return load_problem("barrett-ball-far", ["task.duration=1 s", "task.knots=5", *changes])


def _said(problem: Problem) -> list[str]:
    return [note for note in problem.notes if "inertia" in note]


def test_force_and_moment_are_those_of_the_way_of_the_object_through_the_world() -> None:
    """Momentum and angular momentum about the centre, by differences of where the object is."""
    palm, course, tensor = Palm(axis="x", turn=2.6, inertia=True).motion(0.0, LONG), Along(), Box((0.02, 0.06, 0.1))
    grasp = _problem(PALM).grasp
    held = grasp.held
    assert held is not None
    centre = np.array([0.02, -0.05, 0.11])
    body = Object(title="thing", mass=0.4, shape=tensor, position=frozen(centre))
    object.__setattr__(held, "body", body)
    times, found = left_out(palm, grasp, course, np.array([0.0, LONG]))

    def placed(time: float, share: float) -> tuple[Array, Rotation, Rotation]:
        turn = Rotation.from_rotvec([2.6 * palm.profile.at(np.array([time]))[0], 0, 0])
        moved = share * course.target_at(np.array([time]))[0]
        return turn.apply(centre + moved[:3]), turn * Rotation.from_rotvec(moved[3:]), turn

    def spin(time: float, share: float, h: float = 1e-4) -> Array:
        before, after = placed(time - h, share)[1], placed(time + h, share)[1]
        omega = (after * before.inv()).as_rotvec() / (2 * h)
        R = placed(time, share)[1].as_matrix()
        return np.asarray(0.4 * R @ np.asarray(tensor.inertia) @ R.T @ omega)

    def wrench(time: float, share: float, h: float = 1e-3) -> Array:
        a = (placed(time + h, share)[0] - 2 * placed(time, share)[0] + placed(time - h, share)[0]) / h**2
        change = (spin(time + h, share) - spin(time - h, share)) / (2 * h)
        back = placed(time, share)[2].inv()
        return np.concatenate([back.apply(-0.4 * a), back.apply(-change)])

    for k in (16, 32, 45):
        expected = wrench(times[k], 1.0) - wrench(times[k], 0.0)
        for part in (slice(0, 3), slice(3, 6)):
            within = 0.01 * float(np.abs(found[:, part]).max())
            np.testing.assert_allclose(found[k, part], expected[part], rtol=0, atol=within)


def test_it_is_told_with_a_box_of_loads_that_holds_for_it() -> None:
    problem = _problem(PALM)
    (note,) = _said(problem)
    assert "adds up to 0.176 N" in note
    box = json.loads(note.partition("load_box = ")[2].partition("]")[0] + "]")
    held = problem.grasp.held
    assert held is not None
    palm = Palm(axis="x", turn=np.radians(150), inertia=True).motion(0.0, LONG)
    assert problem.timed.course is not None
    _, found = left_out(palm, problem.grasp, problem.timed.course, np.array([0.0, LONG]))
    assert np.all(np.abs(found).max(axis=0) <= np.array(box) + 1e-9)
    assert _problem(PALM, f"allow.load_box={box}").task.allow is not None


@pytest.mark.parametrize("changes", [(), (PALM.replace("true", "false"),), (PALM, "task.move=[]")])
def test_without_inertia_or_motion_nothing_is_told(changes: tuple[str, ...]) -> None:
    assert not _said(_problem(*changes))
