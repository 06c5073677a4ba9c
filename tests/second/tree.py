"""Where the links of a hand are: a URDF file read with the standard library, products of homogeneous transforms.

Everything has a leading axis B, the number of postures that are looked at together.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

Array = np.ndarray


@dataclass(frozen=True)
class Joint:
    """A joint of the file: the link it moves, the one it sits on, where, and how."""

    name: str
    kind: str  # revolute, prismatic, fixed
    parent: str
    child: str
    origin: Array  # (4, 4) pose of the joint in the parent link
    axis: Array  # (3,) unit vector in the frame of the joint


@dataclass(frozen=True)
class Poses:
    """Links and joint axes in the frame of the palm, of B postures."""

    links: dict[str, Array]  # (B, 4, 4) each
    places: Array  # (B, n_q, 3) a point on each joint axis
    axes: Array  # (B, n_q, 3)


def _numbers(element: ET.Element | None, key: str, default: str) -> Array:
    words = default if element is None else element.get(key, default)
    return np.array([float(word) for word in words.split()])


def _read(element: ET.Element) -> Joint:
    kind = str(element.get("type"))
    if kind not in ("revolute", "continuous", "prismatic", "fixed"):
        raise ValueError(f"this program knows no joint of type {kind}")
    origin, pose = element.find("origin"), np.eye(4)
    pose[:3, :3] = Rotation.from_euler("xyz", _numbers(origin, "rpy", "0 0 0")).as_matrix()
    pose[:3, 3] = _numbers(origin, "xyz", "0 0 0")
    axis = _numbers(element.find("axis"), "xyz", "1 0 0")
    parent, child = (str(found.get("link")) for found in (element.find("parent"), element.find("child"))
                     if found is not None)  # fmt: skip
    return Joint(str(element.get("name")), kind, parent, child, pose, axis / np.linalg.norm(axis))


class Tree:
    """The links of a URDF file below one that is the palm, with the joints in the order of q."""

    def __init__(self, text: str, root: str, joints: Sequence[str]) -> None:
        """Read the file; the order of the joints is that of `joints`."""
        above = {joint.child: joint for joint in map(_read, ET.fromstring(text).iterfind("joint"))}
        self.root, self.order, self.joints = root, tuple(joints), list[Joint]()
        reached = {root}
        while waiting := [j for j in above.values() if j.parent in reached and j.child not in reached]:
            self.joints += waiting
            reached |= {joint.child for joint in waiting}
        self.above = {joint.child: joint for joint in self.joints}
        self.slides = np.zeros(len(joints), dtype=bool)
        for joint in self.joints:
            if joint.kind != "fixed":
                self.slides[self.order.index(joint.name)] = joint.kind == "prismatic"

    def moved_by(self, link: str) -> Array:
        """Return which joints (n_q,) move a link."""
        found = np.zeros(len(self.order), dtype=bool)
        while link != self.root:
            joint = self.above[link]
            if joint.kind != "fixed":
                found[self.order.index(joint.name)] = True
            link = joint.parent
        return found

    def poses(self, q: Array) -> Poses:
        """Return where everything is at joint values (B, n_q)."""
        count = len(q)
        links = {self.root: np.tile(np.eye(4), (count, 1, 1))}
        places, axes = np.zeros((count, len(self.order), 3)), np.zeros((count, len(self.order), 3))
        for joint in self.joints:
            pose = links[joint.parent] @ joint.origin
            if joint.kind != "fixed":
                i = self.order.index(joint.name)
                places[:, i], axes[:, i] = pose[:, :3, 3], pose[:, :3, :3] @ joint.axis
                pose = pose @ _displacement(joint, q[:, i])
            links[joint.child] = pose
        return Poses(links, places, axes)


def _displacement(joint: Joint, values: Array) -> Array:
    """Return what a joint does to its link (B, 4, 4)."""
    found = np.tile(np.eye(4), (len(values), 1, 1))
    if joint.kind == "prismatic":
        found[:, :3, 3] = np.outer(values, joint.axis)
        return found
    x, y, z = joint.axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    sine, versine = np.sin(values)[:, None, None], (1 - np.cos(values))[:, None, None]
    found[:, :3, :3] += sine * cross + versine * (cross @ cross)
    return found


def read_tree(path: Path, root: str, joints: Sequence[str]) -> Tree:
    """Read the hand that a plan names; only URDF is understood."""
    if path.suffix != ".urdf":
        raise ValueError(f"this program reads URDF files, not {path.name}")
    return Tree(path.read_text(encoding="utf-8"), root, joints)
