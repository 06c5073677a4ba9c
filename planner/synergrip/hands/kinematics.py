"""Forward kinematics and Jacobians of a tree of links, whatever file it comes from."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from synergrip.errors import InputError, one_of
from synergrip.hands.chains import Chains
from synergrip.hands.models.tree import LinkTree
from synergrip.hands.point_motion import PointMotion, PointMotions
from synergrip.linalg import Array, frozen

SLIDE = 2
"""MuJoCo's number of a joint that slides (`mujoco.mjtJoint.mjJNT_SLIDE`)."""


@dataclass(frozen=True, eq=False)
class MujocoKinematics:
    """The `Kinematics` of a hand. Calls leave nothing behind, and threads do not disturb each other."""

    joints: tuple[str, ...]
    """Names in the order of q."""
    bodies: Mapping[str, int]
    """Link name -> number in the model."""
    model: Any
    """The compiled `mujoco.MjModel`; the palm stands still in its world frame."""
    places: tuple[int, ...]
    """Where each joint of q stands among the coordinates of the model."""

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[PointMotion, ...]:
        """Return the motion of each (link name, point in link coordinates [m]) at joint values `q` (n_q,).

        Raises:
            InputError: a link that the hand does not have, `q` not n_q finite numbers or a point not 3.
        """
        import mujoco

        values = _finite(q, len(self.joints), "q")
        self._judge(points)
        data = _SCRATCH.of.get(self)
        if data is None:
            data = _SCRATCH.of[self] = mujoco.MjData(self.model)
        data.qpos[list(self.places)] = values
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        return tuple(self._motion(data, self.bodies[link], _finite(point, 3, "point")) for link, point in points)

    def along(self, q: Array, points: Sequence[tuple[str, Array]]) -> PointMotions:
        """Return the motion of the same points at joint values `q` (T, n_q), all postures at once.

        Raises:
            InputError: a link that the hand does not have, `q` not (T, n_q) or a point not 3.
        """
        if np.ndim(q) != 2 or np.shape(q)[1] != len(self.joints):
            raise InputError.at("q", f"expected postures (T, {len(self.joints)}), got shape {np.shape(q)}")
        self._judge(points)
        places = np.array([_finite(point, 3, "point") for _, point in points]).reshape(-1, 3)
        return self.chains.motions(np.asarray(q), [self.bodies[link] for link, _ in points], places)

    @cached_property
    def chains(self) -> Chains:
        """The links as MuJoCo has them, with the joints in the order of q."""
        model = self.model
        joints = [int(np.flatnonzero(model.jnt_qposadr == place)[0]) for place in self.places]
        w, x, y, z = model.body_quat.T
        turned = 2 * np.array([
            [0.5 - y * y - z * z, x * y - w * z, x * z + w * y],
            [x * y + w * z, 0.5 - x * x - z * z, y * z - w * x],
            [x * z - w * y, y * z + w * x, 0.5 - x * x - y * y],
        ]).transpose(2, 0, 1)  # fmt: skip
        slides = (model.jnt_type[joints] == SLIDE).astype(float)
        return Chains(np.array(model.body_parentid, dtype=int), np.array(model.body_pos), turned,
                      np.array(model.jnt_bodyid[joints], dtype=int), np.array(model.jnt_axis[joints]),
                      np.array(model.jnt_pos[joints]), slides)  # fmt: skip

    def _judge(self, points: Sequence[tuple[str, Array]]) -> None:
        for link, _ in points:
            if link not in self.bodies:
                raise InputError.at("link", one_of(link, self.bodies))

    def _motion(self, data: Any, body: int, point: Array) -> PointMotion:
        import mujoco

        rotation = data.xmat[body].reshape(3, 3)
        position = data.xpos[body] + rotation @ point
        jacobian = np.zeros((6, self.model.nv))
        mujoco.mj_jac(self.model, data, jacobian[:3], jacobian[3:], position, body)
        return PointMotion(frozen(position), frozen(rotation), frozen(jacobian[:, list(self.places)]))


class _Scratch(threading.local):
    """A `mujoco.MjData` for each kinematics that this thread has asked: making one takes far longer than using it."""

    def __init__(self) -> None:
        self.of: WeakKeyDictionary[MujocoKinematics, Any] = WeakKeyDictionary()


_SCRATCH = _Scratch()


def kinematics(tree: LinkTree, joints: Sequence[str]) -> MujocoKinematics:
    """Return the kinematics of `tree` in its palm frame.

    Args:
        tree: the links.
        joints: the names of all its moving joints, in the order wanted for q.

    Raises:
        InputError: `joints` is no permutation of the moving joints; under the key ``joints``.
    """
    for index, name in enumerate(joints):
        if name not in tree.moving:
            raise InputError.at(f"joints[{index}]", one_of(name, tree.moving))
    if sorted(joints) != sorted(tree.moving):
        raise InputError.at("joints", f"expected each of {', '.join(tree.moving)} once")
    model = link_spec(tree).compile()
    places = {name: int(model.joint(f"joint:{name}").qposadr[0]) for name in tree.moving}
    bodies = {link: int(model.body(f"link:{link}").id) for link in tree.links}
    return MujocoKinematics(tuple(joints), bodies, model, tuple(places[name] for name in joints))


def link_spec(tree: LinkTree) -> Any:
    """Return the links as a `mujoco.MjSpec`; names get a prefix, link: or joint:, because "world" is taken there."""
    import mujoco

    kinds = {"hinge": mujoco.mjtJoint.mjJNT_HINGE, "slide": mujoco.mjtJoint.mjJNT_SLIDE}
    inertia = {"mass": 1.0, "inertia": [1.0, 1.0, 1.0], "explicitinertial": True}  # kinematics needs none, MuJoCo does
    spec = mujoco.MjSpec()
    bodies = {tree.root: spec.worldbody.add_body(name=f"link:{tree.root}", **inertia)}
    above = {joint.child: joint for joint in tree.joints.values()}
    for link in tree.links[1:]:
        joint = above[link]
        place = {"pos": list(joint.xyz), "quat": list(joint.quaternion)}
        bodies[link] = bodies[joint.parent].add_body(name=f"link:{link}", **place, **inertia)
        if joint.kind != "fixed":
            where = {"axis": list(joint.axis), "pos": list(joint.anchor)}
            bodies[link].add_joint(name=f"joint:{joint.name}", type=kinds[joint.kind], **where)
    return spec


def _finite(values: Array, size: int, key: str) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.shape != (size,) or not np.all(np.isfinite(array)):
        raise InputError.at(key, f"expected {size} finite numbers, got {array.tolist()}")
    return array
