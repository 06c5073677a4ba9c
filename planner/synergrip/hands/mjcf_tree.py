"""The links and joints of an MJCF file."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from synergrip.hands.mjcf import Mjcf, compiled
from synergrip.hands.mjcf_couplings import mjcf_couplings
from synergrip.hands.tree import MOST_MOVING, LinkTree, TreeJoint
from synergrip.hands.xml_elements import Element
from synergrip.linalg import Array

WORLD = 0
"""Number of the world among the bodies."""
ROUNDING = 1e-6
"""How far the length of an axis or a quaternion may be from 1."""


def mjcf_tree(root: Element) -> LinkTree:
    """Return the links, joints and couplings of an MJCF file.

    The palm is the one body on the world, or the world when several hang there or that one moves. It stands still:
    its free joint is left out, and so is a body that floats (or is driven by motion capture) without joints of its own,
    an object. A body with several joints becomes a chain of links "body/joint", the last of which has its name.

    Args:
        root: the element <mujoco> of the file.

    Raises:
        InputError: what `compiled` and `mjcf_couplings` refuse, a ball joint, two hands, no moving joint, a range
            upside down; with file and line.
    """
    file = compiled(root)
    for number, kind in enumerate(file.kinds):
        if kind == "ball":
            name = file.joints[number]
            raise _place(file, number).refused(f"joint '{name}' is a ball joint; write it as three hinges")
    if not file.q:
        raise root.refused("the file has no joint that moves")
    if len(file.q) > MOST_MOVING:
        raise root.refused(f"{len(file.q)} joints move, and a hand has at most {MOST_MOVING}")
    palm, carried = _palm(file)
    joints = [joint for body in carried for joint in _joints(file, body)]
    names = [joint.name for joint in joints]
    links = (file.bodies[palm], *(joint.child for joint in joints))
    title = root.attributes.get("model", "")
    return LinkTree(title, links[0], links, dict(zip(names, joints, strict=True)), mjcf_couplings(file))


def _place(file: Mjcf, joint: int) -> Element:
    return file.source.place("joint", file.joints[joint])


def _palm(file: Mjcf) -> tuple[int, list[int]]:
    """Return the number of the palm, and those of the bodies that hang on it, parents first."""
    model = file.model
    first = [int(model.body_rootid[body]) for body in range(model.nbody)]  # the child of the world that carries it
    hands = {first[model.jnt_bodyid[joint]] for joint in file.q}
    free = {first[body] for body, kind in zip(model.jnt_bodyid, file.kinds, strict=True) if kind == "free"}
    tops = [body for body in range(1, model.nbody) if first[body] == body]
    if len(hands & free) > 1:
        names = " and ".join(f"'{file.bodies[body]}'" for body in tops if body in hands & free)
        raise file.source.lines[0].refused(f"{names} float and have joints; give one hand in a file")
    tops = [body for body in tops if body in hands or not (body in free or model.body_mocapid[body] >= 0)]
    carried = [body for body in range(1, model.nbody) if first[body] in tops]
    moves = {int(model.jnt_bodyid[joint]) for joint in file.q}
    return (tops[0], carried[1:]) if len(tops) == 1 and tops[0] not in moves else (WORLD, carried)


def _joints(file: Mjcf, body: int) -> Iterator[TreeJoint]:
    """Yield what holds a body to its parent: one fixed joint, or its joints as a chain."""
    model, name = file.model, file.bodies[body]
    parent = file.bodies[model.body_parentid[body]]
    if not (abs(np.linalg.norm(model.body_quat[body]) - 1) < ROUNDING and np.all(np.isfinite(model.body_pos[body]))):
        raise file.source.place("body", name).refused(f"body '{name}': its place or orientation is no number")
    at = model.body_pos[body], Rotation.from_quat(model.body_quat[body][[1, 2, 3, 0]])
    numbers = [joint for joint in file.q if model.jnt_bodyid[joint] == body]
    if not numbers:
        yield TreeJoint(_new(f"{name}/fixed", file.joints), "fixed", parent, name, *_written(*at))
    for joint in numbers:
        child = name if joint == numbers[-1] else _new(f"{name}/{file.joints[joint]}", file.bodies)
        yield _joint(file, joint, parent, child, *at)
        parent, at = child, (np.zeros(3), Rotation.identity())


def _new(name: str, names: tuple[str, ...]) -> str:
    return _new(f"{name}'", names) if name in names else name


def _joint(file: Mjcf, joint: int, parent: str, child: str, xyz: Array, rotation: Rotation) -> TreeJoint:
    """Return a joint of a body that is drawn at `xyz` (3,) and `rotation` in its parent, with the joint at its ref."""
    model, kind, name = file.model, file.kinds[joint], file.joints[joint]
    axis, anchor, ref = model.jnt_axis[joint], model.jnt_pos[joint], model.qpos0[model.jnt_qposadr[joint]]
    if not abs(np.linalg.norm(axis) - 1) < ROUNDING:
        raise _place(file, joint).refused(f"joint '{name}': the axis has no direction")
    if ref and kind == "slide":
        xyz = xyz - ref * rotation.apply(axis)
    elif ref:
        back = Rotation.from_rotvec(-ref * axis)
        xyz, rotation = xyz + rotation.apply(anchor - back.apply(anchor)), rotation * back
    lower, upper = model.jnt_range[joint].tolist()
    if lower > upper:
        raise _place(file, joint).refused(f"joint '{name}': the range ends below its beginning")
    if not model.jnt_limited[joint]:
        lower, upper = -math.inf, math.inf
    return TreeJoint(
        name, kind, parent, child, *_written(xyz, rotation), tuple(axis.tolist()), tuple(anchor.tolist()),
        lower, upper, _torque_limit(file, joint), _place(file, joint).place,
    )  # fmt: skip


def _written(xyz: Array, rotation: Rotation) -> tuple[tuple[float, ...], tuple[float, ...]]:
    return tuple(xyz.tolist()), tuple(rotation.as_quat()[[3, 0, 1, 2]].tolist())


def _torque_limit(file: Mjcf, joint: int) -> float:
    """Return what the joint says, or else its actuators together: the larger of the two directions."""
    if file.model.jnt_actfrclimited[joint]:
        limit = np.abs(file.model.jnt_actfrcrange[joint]).max()
    else:
        pulls = np.abs(file.pulls[:, file.q.index(joint)])
        limit = np.sum(pulls[pulls > 0] * file.forces[pulls > 0])
    return float(limit) if limit > 0 else math.inf
