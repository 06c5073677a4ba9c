"""Equilibria in closed form: a box that is squeezed, tips that roll and slide, a column that topples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from jaws_that_move import SOFT, jaws
from scipy.spatial.transform import Rotation

from synergrip.equilibrium.execute import execute
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.setting import setting
from synergrip.equilibrium.states import Loads
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.patch_contact import PatchContact
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.shapes.box import Box
from synergrip.grasps.shapes.sphere import Sphere
from synergrip.planning.figures import stable as told_stable

CUBE = Box(size=(0.04, 0.04, 0.04))
HALF, TIP = 0.02, 0.005
MODELS = pytest.mark.parametrize("model", ["fixed", "rolling"])


def led(grasp: Grasp, *references: list[float], model: str = "rolling", wrench: object = None) -> Execution:
    load = np.zeros((len(references), 6)) if wrench is None else np.array([wrench] * len(references), dtype=float)
    times = np.arange(len(references), dtype=float)
    return execute(grasp, times, np.array(references), Loads.of(load), contact_model=model)  # type: ignore[arg-type]


@MODELS
@pytest.mark.parametrize(("c", "k"), [(1e-4, 3e-4), (0.0, 3e-4), (1e-4, 0.0)])
def test_jaws_squeeze_carry_and_shift_a_box(model: str, c: float, k: float) -> None:
    c_t, squeeze, shift, weight = 2e-4, 0.004, 0.03, 1.2
    grasp = jaws(CUBE, HALF, TIP, C_s=[c, c_t, c_t, 1.0], C_q=[k, 0, 0] * 2)
    references = [squeeze + shift, 0, 0, squeeze - shift, 0, 0]
    found = led(grasp, references, model=model, wrench=[0, 0, -weight, 0, 0, 0])
    assert found.whole, found.why
    normal = squeeze / (c + k)
    assert found.states.forces[0] == pytest.approx([normal, 0, weight / 2, 0] * 2, abs=1e-9)
    assert found.du[0] == pytest.approx([shift, 0, -c_t * weight / 2, 0, 0, 0], abs=1e-12)
    assert found.balance.torques[0] == pytest.approx([normal, 0, 0] * 2, abs=1e-9)
    assert found.joint[0] == pytest.approx(np.array(references) - k * found.balance.torques[0], abs=1e-12)
    assert found.margins[0] == pytest.approx([0.5 * normal - weight / 2] * 2, abs=1e-9)
    assert found.residual < 1e-12


def test_synergies_yield_as_joints_do() -> None:
    in_joints = jaws(CUBE, HALF, TIP, C_s=[1e-4] * 3 + [1.0], C_q=[3e-4, 1e-4, 0.1] * 2)
    in_synergies = replace(in_joints, C_q=np.zeros((6, 6)), C_z=in_joints.C_q)
    one, two = (led(g, [0.004, 0.001, 0.1, 0.005, 0.002, 0.3]) for g in (in_joints, in_synergies))
    for name in ("q", "position", "rotation", "forces"):
        assert getattr(one.states, name) == pytest.approx(getattr(two.states, name), abs=1e-12)


@MODELS
@pytest.mark.parametrize(("load", "stable"), [(0.0, True), (40.0, True), (60.0, False)])
def test_a_column_under_a_load_topples(model: str, load: float, stable: bool) -> None:
    """Springs k at x = -a and a, each put in by s: 2 k a (a - s) about z, less what a load on top at height h takes."""
    a, s, h, c = HALF, 0.002, 0.15, 1e-4
    grasp = jaws(None, a, 0.0, C_s=[c, c, c, 1e-6], C_q=[0.0] * 6)
    point, force = np.array([[0.0, h, 0.0]]), np.array([0.0, -load, 0.0])
    loads = Loads(np.hstack([force, np.cross(point[0], force)])[None], point, force[None, None])
    found = execute(grasp, [0.0], np.array([[s, 0, 0, s, 0, 0]]), loads, contact_model=model)  # type: ignore[arg-type]
    assert found.whole, found.why
    assert found.du[0] == pytest.approx([0, -c * load / 2, 0, 0, 0, 0], abs=1e-12)
    about_z = 2 * a * (a - s) / c - h * load
    assert (about_z > 0) == stable
    expected = about_z / found.setting.length**2  # the softest direction
    assert found.stiffness[0] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("load", "stable"), [(4 - 1e-6, True), (4.0, False), (4 + 1e-6, False)])
def test_a_column_under_just_the_load_that_topples_it_is_not_stable(load: float, stable: bool) -> None:
    """Sizes that are exact in binary numbers: at 2 a (a - s) / (c h) the tangent has no inverse at all."""
    a, s, h, c = 0.5, 0.25, 1.0, 2.0**-4
    grasp = jaws(None, a, 0.0, C_s=[c, c, c, 2.0**-10], C_q=[0.0] * 6)
    point, force = np.array([[0.0, h, 0.0]]), np.array([0.0, -load, 0.0])
    loads = Loads(np.hstack([force, np.cross(point[0], force)])[None], point, force[None, None])
    found = execute(grasp, [0.0], np.array([[s, 0, 0, s, 0, 0]]), loads, contact_model="fixed")
    assert found.whole, found.why
    assert (found.stiffness[0] > 0) == stable
    assert told_stable(found).passed == stable


@pytest.mark.parametrize("preload", [0.0, 50.0])
def test_forces_at_the_start_stiffen_the_grasp(preload: float) -> None:
    """Forces of the start turn with the object, points stay: 2 a (a / c + N) about z instead of 2 a (a / c - N)."""
    a, c = HALF, 1e-4
    grasp = replace(jaws(CUBE, a, 0.0, C_s=[c, c, c, 1e-6], C_q=[0.0] * 6), lambda_0=np.array([preload, 0, 0, 0] * 2))
    found = led(grasp, [0.0] * 6, wrench=[0, 0, 0, 0, 0, 0.3], model="fixed")
    angle = found.du[0, 5]
    assert 2 * a * (a / c + preload) * np.sin(angle) == pytest.approx(0.3, rel=1e-9)


def test_a_tip_that_turns_rolls_by_its_radius_times_its_angle() -> None:
    grasp = jaws(CUBE, HALF, TIP, C_s=[1e-4] * 3 + [1.0], C_q=[0.0] * 6)
    turn, squeeze = 1.2, 0.001
    found = led(grasp, [squeeze, 0, 0, squeeze, 0, 0], [squeeze, 0, turn, squeeze, 0, -turn])
    assert found.whole, found.why
    assert found.du[1] == pytest.approx([0, TIP * turn, 0, 0, 0, 0], abs=1e-12)
    assert found.states.forces[1] == pytest.approx([squeeze / 1e-4, 0, 0, 0] * 2, abs=1e-7)
    assert found.balance.arms[1] == pytest.approx(
        np.array([[-HALF + squeeze, -TIP * turn, 0], [HALF - squeeze, -TIP * turn, 0]]), abs=1e-12
    )  # the tips are rigid, the springs at their centres are shorter


def test_a_ball_rolls_between_tips_that_part() -> None:
    """The line between the tips turns by an angle and the ball by (r + tip) / r of it: as one gear on another."""
    ball, tip, k, squeeze, aside = 0.03, 0.01, 2e-4, 0.01, 0.012
    grasp = jaws(Sphere(radius=ball), ball, tip, C_s=[0, 1e-7, 1e-7, 1.0], C_q=[k, 0, 0] * 2)
    far, off = ball + tip, []
    angle = np.arcsin(aside / far)
    for count in (31, 61):
        steps = [[squeeze, share * aside, 0] * 2 for share in np.linspace(0, 1, count)]
        found = led(grasp, *steps)
        assert found.whole, found.why
        off.append(found.du[-1, 5] + angle * far / ball)
        assert np.delete(found.du[-1], 5) == pytest.approx(np.zeros(5), abs=1e-10)
    assert abs(off[0]) < 1e-7
    assert off[0] / off[1] == pytest.approx(4, rel=0.1)  # the way is gone in steps, with an error of the second order
    normal = (squeeze - far * (1 - np.cos(angle))) / k / np.cos(angle)
    assert found.states.forces[-1] == pytest.approx([normal, 0, 0, 0] * 2, abs=1e-5)
    stuck = led(grasp, *steps, model="fixed")
    assert stuck.du[-1, 5] == pytest.approx(-np.arcsin(aside / ball), abs=1e-9)  # points that stuck stay opposite


@MODELS
def test_a_patch_lies_flat_on_a_ball_between_round_pads_that_part(model: str) -> None:
    """Points that stick stay opposite; what the ball turns against the jaws bends the patches about the tangents."""
    ball, tip, k, squeeze, aside, tilt = 0.03, 0.01, 2e-4, 0.01, 0.012, 0.4
    kind = PatchContact(friction=9, spin_friction=9, patch_radius=9)
    C_s = [0, 1e-9, 1e-9, 1.0, tilt, tilt]
    grasp = jaws(Sphere(radius=ball), ball, tip, C_s=C_s, C_q=[k, 0, 0] * 2, kind=kind)
    found = led(grasp, *([squeeze, share * aside, 0] * 2 for share in np.linspace(0, 1, 11)), model=model)
    assert found.whole, found.why
    assert not any(found.setting.rolls)
    angle = np.arcsin(aside / ball)
    assert found.du[-1] == pytest.approx([0, 0, 0, 0, 0, -angle], abs=1e-5)  # springs along t give by 35 nm
    about_z = found.balance.frames[-1][:, 2]  # of axes n, t, o of each contact the part along z
    moments = found.states.forces[-1].reshape(2, 6)[:, 3:]
    along_z = (about_z * moments).sum(axis=1)
    assert np.abs(along_z) == pytest.approx([angle / tilt] * 2, rel=1e-5)
    normal = (squeeze - ball * (1 - np.cos(angle))) / k  # what the slides give way by
    assert found.balance.torques[-1][[0, 3]] == pytest.approx([normal] * 2, rel=1e-5)


def test_round_pads_roll_beside_a_patch_that_lies_flat() -> None:
    kind = PatchContact(friction=9, spin_friction=9, patch_radius=9)
    soft = jaws(CUBE, HALF, TIP, C_s=[1e-4] * 3 + [1.0], C_q=[0.0] * 6)
    flat = jaws(CUBE, HALF, TIP, C_s=[1e-4] * 3 + [1.0] * 3, C_q=[0.0] * 6, kind=kind)
    assert setting(_one_of_each(soft, flat)).rolls == (True, False)
    assert setting(_one_of_each(soft, flat), "fixed").rolls == (False, False)


@MODELS
def test_a_tip_without_friction_slides_on_the_true_surface(model: str) -> None:
    ball, tip, c, k, squeeze, aside = 0.03, 0.01, 1e-4, 2e-4, 0.01, 0.012
    kinds = Frictionless(), PatchContact(friction=9, spin_friction=9, patch_radius=9)
    two = [jaws(Sphere(radius=ball), ball, tip, C_s=np.eye(2 * n), C_q=[k, 0, 0, 0, 0, 0], kind=kind)
           for kind, n in zip(kinds, (1, 6), strict=True)]  # fmt: skip
    mixed = _one_of_each(two[0], two[1])
    grasp = replace(mixed, C_s=np.diag([c, *[1e-9] * 6]))
    found = led(grasp, [squeeze, 0, 0, 0, 0, 0], [squeeze, aside, 0, 0, 0, 0], model=model)
    assert found.whole, found.why
    q = found.states.q[1]
    apart = np.array([q[0] - ball - tip, q[1], 0.0]) - found.du[1, :3]
    pressed = ball + tip - np.linalg.norm(apart)
    normal = found.states.forces[1, 0]
    assert normal == pytest.approx(pressed / c, rel=1e-9)
    assert found.balance.torques[1, :2] == pytest.approx(-normal * apart[:2] / np.linalg.norm(apart), rel=1e-9)
    assert q[0] == pytest.approx(squeeze - k * found.balance.torques[1, 0], abs=1e-12)


def _one_of_each(left: Grasp, right: Grasp) -> Grasp:
    """Return a grasp with the left contact of one and the right contact of the other."""
    assert left.held is not None
    assert right.held is not None
    touches = (left.held.touches[0], right.held.touches[1])
    n = left.rows[0].stop
    return replace(
        left, contacts=(left.contacts[0], right.contacts[1]), held=replace(left.held, touches=touches),
        G=np.hstack([left.G[:, left.rows[0]], right.G[:, right.rows[1]]]),
        J=np.vstack([left.J[left.rows[0]], right.J[right.rows[1]]]),
        C_s=np.eye(n + 6), lambda_0=np.zeros(n + 6),
    )  # fmt: skip


@pytest.mark.parametrize("model", ["rolling", "fixed"])
def test_a_tip_that_rolls_over_an_edge_ends_there_by_name(model: str) -> None:
    grasp = jaws(Box(size=(0.04, 0.004, 0.04)), HALF, 0.03, C_s=[1e-5] * 3 + [1.0], C_q=[1e-4, 0, 0] * 2)
    steps = [[0.01, 0, turn, 0.01, 0, -turn] for turn in (0.0, 0.03, 0.1, 0.2)]
    found = led(grasp, *steps, model=model)
    if model == "fixed":
        assert found.whole
        return
    assert len(found.states) == len(found.du) == len(found.margins) == 2  # 0.9 mm rolled of 2; 3 mm would be over
    assert found.why == "contact 'left' runs over the edge of its face there"
    assert found.times.shape == (4,)


def test_a_turned_hand_does_the_same_turned() -> None:
    turned = Rotation.from_rotvec([0.4, -0.9, 0.3])
    R = turned.as_matrix()
    values = {"C_s": [1e-4, 2e-4, 2e-4, 1.0], "C_q": [3e-4, 1e-4, 1e-2] * 2, "kind": SOFT}
    for model in ("fixed", "rolling"):
        steps = [[0.004, 0, 0.1, 0.004, 0, 0], [0.005, 0.002, 0.3, 0.004, 0.001, -0.2]]
        wrench = np.array([0.3, -0.2, -1.0, 0.002, 0.001, -0.003])
        one = led(jaws(CUBE, HALF, TIP, **values), *steps, model=model, wrench=wrench)  # type: ignore[arg-type]
        there = np.hstack([R @ wrench[:3], R @ wrench[3:]])
        other = led(jaws(CUBE, HALF, TIP, turned=turned, **values), *steps, model=model, wrench=there)  # type: ignore[arg-type]
        assert one.whole
        assert np.abs(one.du[:, 3:]).max() > 0.01
        assert other.states.forces == pytest.approx(one.states.forces, abs=1e-8)
        assert other.joint == pytest.approx(one.joint, abs=1e-11)
        for part in (slice(0, 3), slice(3, 6)):
            assert other.du[:, part] == pytest.approx(one.du[:, part] @ R.T, abs=1e-11)
        assert other.stiffness == pytest.approx(one.stiffness, rel=1e-8)


def test_lengths_in_another_unit_are_the_same_motion() -> None:
    """Everything ten times as long under the same forces: compliances of lengths ten times, of turns a tenth."""
    one = jaws(CUBE, HALF, TIP, C_s=[1e-4, 2e-4, 2e-4, 1.0], C_q=[3e-4, 1e-4, 1e-2] * 2)
    far = jaws(Box(size=(0.4, 0.4, 0.4)), 10 * HALF, 10 * TIP, C_s=[1e-3, 2e-3, 2e-3, 0.1], C_q=[3e-3, 1e-3, 1e-3] * 2)
    step, scale = np.array([0.004, 0.001, 0.2, 0.004, 0, -0.1]), np.array([10.0, 10, 1] * 2)
    a = led(one, step.tolist(), wrench=[0.1, 0, -1, 0, 0, 0.001])
    b = led(far, (scale * step).tolist(), wrench=[0.1, 0, -1, 0, 0, 0.01])
    assert a.whole
    assert b.du == pytest.approx(a.du * [10, 10, 10, 1, 1, 1], abs=1e-10)
    assert b.states.forces == pytest.approx(a.states.forces * np.array([1, 1, 1, 10] * 2), abs=1e-8)
