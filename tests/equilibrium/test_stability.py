"""Hands that give way by themselves, and pads that slide off what is round: stability in closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from jaws_that_move import SOFT, wxyz
from scipy.spatial.transform import Rotation
from small_hands import hand_of, pad

from synergrip.equilibrium.execute import execute
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.states import Loads
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.making import make_grasp
from synergrip.grasps.objects import Object
from synergrip.grasps.shapes.box import Box
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.sphere import Sphere
from synergrip.hands.models.tree import TreeJoint

HALF, BAR, HINGE, SPRING = 0.02, 0.03, 1.0, 1e-5
"""Half of the object's width and the length of a bar [m], compliance of a hinge [rad/(N m)] and a contact [m/N]."""


def four_fingers(shape: Shape, kinds: tuple[ContactKind, ContactKind], *, bars: bool, radius: float = 0.0) -> Grasp:
    """Return the grasp of an object between four slides; those along x press by two bars that hinge about z."""
    joints, pads, sides = [], {}, ("a", "b", "c", "d")
    for side, yaw in zip(sides, (0.0, np.pi, np.pi / 2, -np.pi / 2), strict=True):
        column = bars and side in "ab"
        turned = Rotation.from_rotvec([0, 0, yaw])
        far = turned.apply([-HALF - radius - 2 * BAR * column, 0.0, 0.0])
        joints.append(TreeJoint(side, "slide", "palm", side, tuple(far), quaternion=wxyz(turned), lower=-1, upper=1))
        link = side
        for number, step in enumerate((0.0, BAR) if column else ()):
            name = f"{side}{number}"
            joints.append(TreeJoint(name, "hinge", link, name, (step, 0, 0), axis=(0.0, 0.0, 1.0), lower=-3, upper=3))
            link = name
        pads[side] = pad(side, link, (BAR * column, 0.0, 0.0), radius=radius)
    touches = [
        ContactAt(side, kind, **dict.fromkeys(kind.stiffnesses(), 1 / SPRING))
        for side, kind in zip(sides, (kinds[0], kinds[0], kinds[1], kinds[1]), strict=True)
    ]
    body = Object(mass=0.1, shape=shape, position=np.zeros(3))
    hand = hand_of(joints, pads)
    grasp = make_grasp(hand, body, posture=np.zeros(len(joints)), contacts=touches, joint_compliance=0.0)
    gives = [HINGE if joint.kind == "hinge" else 0.0 for joint in joints]
    return replace(grasp, C_q=np.diag(gives), lambda_0=np.zeros(grasp.n_l))


def pressed(grasp: Grasp, along: float, across: float, model: str = "fixed") -> Execution:
    """Return the grasp with normal forces [N] along x and along y."""
    forces = {"a": along, "b": along, "c": across, "d": across}
    references = [SPRING * forces.get(name, 0.0) for name in grasp.joints]
    found = execute(grasp, [0.0], [references], Loads.of(np.zeros((1, 6))), contact_model=model)  # type: ignore[arg-type]
    assert found.whole
    assert found.states.forces[0, grasp.normal_rows] == pytest.approx([along, along, across, across], rel=1e-3)
    return found


@pytest.mark.parametrize("model", ["fixed", "rolling"])
def test_columns_buckle_while_the_object_is_held_firmly(model: str) -> None:
    """Two bars between pinned ends, hinges at the foot and the middle: N = 5 k / (2 BAR)."""
    grasp = four_fingers(Box(size=(0.04, 0.04, 0.04)), (SOFT, SOFT), bars=True, radius=0.001)
    critical = 2.5 / (HINGE * BAR)
    for share in (0.5, 0.97, 1.03, 1.5, 3.0):
        found = pressed(grasp, share * critical, 10.0, model)
        assert (found.stiffness[0] > 0) == (share < 1), share
        given = found.maps.du_dw[0]
        assert np.linalg.eigvalsh(given + given.T).min() > 0  # what the object feels says nothing of it


def test_a_ball_escapes_between_pads_that_slide() -> None:
    """Pads that press with N push a ball aside with 2 N / (distance of centres); the others hold it with 2 / C_s."""
    radius, tip, soft = 0.02, 0.005, 2e-4
    grasp = four_fingers(Sphere(radius=radius), (Frictionless(), SOFT), bars=False, radius=tip)
    springs = np.array(grasp.C_s)
    held = [row for contact, rows in zip(grasp.contacts, grasp.rows, strict=True) if contact.name in "cd"
            for row in range(rows.start, rows.stop)]  # fmt: skip
    springs[held, held] *= soft / SPRING
    grasp = replace(grasp, C_s=springs)
    for share in (0.8, 0.98, 1.02, 1.3):
        force = share * (radius + tip) / (soft + SPRING)  # the centres come nearer by the squeeze
        found = execute(grasp, [0.0], [[SPRING * force, SPRING * force, 2e-3, 2e-3]], Loads.of(np.zeros((1, 6))),
                        contact_model="fixed")  # fmt: skip
        assert found.whole
        assert (found.stiffness[0] > 0) == (share < 1), share
