"""Grasps of one hand in many postures, against those that are made one by one."""

from __future__ import annotations

import numpy as np
import pytest

import synergrip as sg
from synergrip.linalg import Array
from synergrip.planning.planning import plan_of_start_posture

HARD, SOFT = sg.HardFinger(friction=0.6), sg.SoftFinger(friction=0.7, spin_friction=0.01)
TASK = sg.Task(
    knots=1, loads=[sg.Gravity((0, 0, -9.81))], goals=[sg.LargestMargin()], linearise="once",
    limits=[sg.SlipMargin(0.1), sg.NormalForce(upper=20.0), sg.JointTorque("hand")],
)  # fmt: skip


def barrett(
    posture: object = "ball", *, position: Array | None = None, shape: object = None, **contact: object
) -> sg.Grasp:
    at = [
        sg.ContactAt(f"finger{i}/tip", kind, stiffness=8e3, spin_stiffness=3.0 if kind is SOFT else None, **contact)
        for i, kind in enumerate((HARD, SOFT, HARD), start=1)
    ]
    body = sg.Object(mass=0.2, shape=shape, position=position)
    return sg.make_grasp("barrett", body, posture=posture, synergies="motors", contacts=at, joint_compliance=0.02)


def postures(grasp: sg.Grasp, count: int, size: float) -> Array:
    rng = np.random.default_rng(3)
    return np.array(grasp.held.q + size * rng.uniform(-1, 1, (count, grasp.n_q)))


def same(stack: sg.GraspStack, each: list[sg.Grasp]) -> None:
    for i, one in enumerate(each):
        found = stack[i]
        for name in ("G", "J", "S", "C_s", "C_q", "C_z", "w_0"):
            assert np.allclose(getattr(found, name), getattr(one, name), rtol=0, atol=1e-14), name
        for mine, theirs in zip(found.contacts, one.contacts, strict=True):
            assert np.allclose(mine.point, theirs.point, rtol=0, atol=1e-15)
            assert np.allclose(mine.frame, theirs.frame, rtol=0, atol=1e-14)
        assert np.array_equal(found.held.q, one.held.q)
        assert np.allclose(found.held.body.position, one.held.body.position, rtol=0, atol=1e-15)


@pytest.mark.parametrize("contact", [{}, {"normals": "pad"}, {"tangent": (0.2, 0.3, 1.0)}])
@pytest.mark.parametrize("shape", [sg.Sphere(radius=0.045), None])
def test_they_are_those_that_are_made_one_by_one(shape: object, contact: dict[str, object]) -> None:
    like = barrett(shape=shape, **contact)
    q = postures(like, 6, 5e-4)
    each = [barrett(row, shape=shape, **contact, position=like.held.body.position) for row in q]
    same(sg.grasps_in_postures(like, q), each)


def test_objects_and_normals_may_differ_from_grasp_to_grasp() -> None:
    like = barrett(shape=sg.Sphere(radius=0.045))
    q = like.held.q * np.linspace(1.0, 1.06, 5)[:, None]  # all fingers alike
    each = [barrett(row, shape=sg.Sphere(radius=0.045)) for row in q]  # the ball is where the tips say
    positions = np.array([one.held.body.position for one in each])
    normals = np.array([[contact.normal for contact in one.contacts] for one in each])
    same(sg.grasps_in_postures(like, q, positions=positions), each)
    same(sg.grasps_in_postures(like, q, positions=positions, normals=3.0 * normals), each)


def test_they_are_planned_as_they_would_be_one_by_one() -> None:
    like = barrett(shape=sg.Sphere(radius=0.045))
    q = postures(like, 8, 5e-4)
    stack = sg.grasps_in_postures(like, q)
    ranges = sg.JointRange(lower=q.min(axis=0) - 0.05, upper=q.max(axis=0) - 1e-4)  # some begin beyond it
    for task in (TASK, TASK.replace(limits=[*TASK.limits, ranges])):
        for grasps in (stack, list(stack)):
            many = sg.plan_many(grasps, task)
            assert many.verified.all()
            assert not many.one_by_one.any()
            for i, one in enumerate(plan_of_start_posture(each, task) for each in stack):
                assert many.verdicts[i] == one.verdict
                if one.largest_margin is not None:
                    assert abs(many.largest_margin[i] - one.largest_margin) < 1e-5 * max(1.0, abs(one.largest_margin))
    assert len(set(many.largest_margin.round(3))) > 1


def test_part_of_a_stack_keeps_its_postures() -> None:
    like = barrett(shape=sg.Sphere(radius=0.045))
    q = postures(like, 6, 5e-4)
    part = sg.grasps_in_postures(like, q)[2:5]
    assert np.array_equal([each.held.q for each in part], q[2:5])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"q": np.zeros((2, 3))}, ["q", "(N, 8)", "(2, 3)"]),
        ({"positions": np.zeros((2, 3))}, ["positions", "(7, 3)"]),
        ({"normals": np.ones((7, 3))}, ["normals", "(7, 3, 3)"]),
        ({"normals": np.zeros((7, 3, 3))}, ["normals[0]", "must not be 0"]),
        ({"normals": -1.0}, ["q[0]", "faces away"]),
        ({"q": 0.1}, ["q[0]", "mm outside the surface", "2 more postures"]),
    ],
)
def test_what_is_wrong_is_told_with_its_posture(change: dict[str, object], words: list[str]) -> None:
    like = barrett(shape=sg.Sphere(radius=0.045))
    given: dict[str, object] = {"q": postures(like, 7, 5e-4), **change}
    if isinstance(change.get("normals"), float):
        given["normals"] = -np.broadcast_to([contact.normal for contact in like.contacts], (7, 3, 3))
    if isinstance(change.get("q"), float):
        given["q"] = like.held.q - 0.1 * np.ones((7, like.n_q))
    with pytest.raises(sg.InputError) as told:
        sg.grasps_in_postures(like, **given)
    for word in words:
        assert word in str(told.value)


def test_matrices_have_no_postures() -> None:
    with pytest.raises(sg.InputError, match="no postures"):
        sg.grasps_in_postures(sg.load_problem("tripod").grasp, np.zeros((1, 9)))
