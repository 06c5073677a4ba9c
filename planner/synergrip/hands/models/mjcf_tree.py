"""The links and joints of an MJCF file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from synergrip.errors import InputError, one_of
from synergrip.hands.models.mjcf import Mjcf, compiled
from synergrip.hands.models.mjcf_couplings import mjcf_couplings
from synergrip.hands.models.mjcf_palm import carried_by
from synergrip.hands.models.tree import MOST_MOVING, LinkTree, TreeJoint
from synergrip.hands.models.xml_elements import Element
from synergrip.linalg import Array

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

WORLD = 0
"""Number of the world among the bodies."""
ROUNDING = 1e-6
"""How far the length of an axis or a quaternion may be from 1."""


def mjcf_tree(root: Element, palm: str = "") -> LinkTree:
    """Return the links, joints and couplings of an MJCF file.

    The palm is the one body on the world, or the world when several hang there or that one moves. It stands still:
    its free joint is left out, and so is a body that floats (or is driven by motion capture) without joints of its own,
    an object. A body with several joints becomes a chain of links "body/joint", the last of which has its name.

    Args:
        root: the element <mujoco> of the file.
        palm: the body that is the palm instead; what it does not carry stands still and is left out.

    Raises:
        InputError: what `compiled`, `carried_by` and `mjcf_couplings` refuse, a ball joint, two hands, no moving joint,
            a range upside down; with file and line. No such palm; at the key ``palm``.
    """
    whole = compiled(root)
    if palm and palm not in whole.bodies:
        raise InputError.at("palm", f"link {one_of(palm, whole.bodies)}")
    top, carried = (whole.bodies.index(palm), []) if palm else _palm(whole)
    file, carried = carried_by(whole, top) if palm else (whole, carried)
    _judge(root, file, carried, palm)
    moves = mjcf_couplings(file)
    limits = {joint: _torque_limit(file, column, moves.pulls) for column, joint in enumerate(file.q)}
    joints = [joint for body in carried for joint in _joints(file, body, limits)]
    names = [joint.name for joint in joints]
    links = (file.bodies[top], *(joint.child for joint in joints))
    outside = (whole.bodies[body] for body in range(1, len(whole.bodies)) if body not in (top, *carried))
    still = (*outside, *(whole.joints[joint] for joint in whole.q if joint not in file.q)) if palm else ()
    title = root.attributes.get("model", "")
    return LinkTree(title, links[0], links, dict(zip(names, joints, strict=True)), moves.couplings, moves.drives, still)


def _judge(root: Element, file: Mjcf, carried: list[int], palm: str) -> None:
    """Refuse what is no hand: a ball joint, no joint that moves, too many."""
    for number, kind in enumerate(file.kinds):
        if kind == "ball" and (not palm or int(file.model.jnt_bodyid[number]) in carried):
            name = file.joints[number]
            raise _place(file, number).refused(f"joint '{name}' is a ball joint; write it as three hinges")
    below = f" below the palm '{palm}'" if palm else ""
    if not file.q:
        raise root.refused(f"the file has no joint that moves{below}")
    if len(file.q) > MOST_MOVING:
        raise root.refused(f"{len(file.q)} joints move, and a hand has at most {MOST_MOVING}")


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


def _joints(file: Mjcf, body: int, limits: Mapping[int, float]) -> Iterator[TreeJoint]:
    """Yield what holds a body to its parent: one fixed joint, or its joints as a chain."""
    from scipy.spatial.transform import Rotation

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
        yield _joint(file, joint, parent, child, *at, limits[joint])
        parent, at = child, (np.zeros(3), Rotation.identity())


def _new(name: str, names: tuple[str, ...]) -> str:
    return _new(f"{name}'", names) if name in names else name


def _joint(
    file: Mjcf, joint: int, parent: str, child: str, xyz: Array, rotation: Rotation, torque_limit: float
) -> TreeJoint:
    """Return a joint of a body that is drawn at `xyz` (3,) and `rotation` in its parent, with the joint at its ref."""
    from scipy.spatial.transform import Rotation

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
        lower, upper, torque_limit, _place(file, joint).place,
    )  # fmt: skip


def _written(xyz: Array, rotation: Rotation) -> tuple[tuple[float, ...], tuple[float, ...]]:
    return tuple(xyz.tolist()), tuple(rotation.as_quat()[[3, 0, 1, 2]].tolist())


def _torque_limit(file: Mjcf, column: int, pulls: Array) -> float:
    """Return what the joint says, or else its actuators together: the larger of the two directions."""
    joint = file.q[column]
    if file.model.jnt_actfrclimited[joint]:
        limit = np.abs(file.model.jnt_actfrcrange[joint]).max()
    else:
        arms, forces = np.abs(pulls[:, column]), np.array([actuator.force for actuator in file.actuators])
        limit = np.sum(arms[arms > 0] * forces[arms > 0])
    return float(limit) if limit > 0 else math.inf
