"""The links and joints of a hand, whatever file they come from."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from synergrip.hands.drives import Drives
from synergrip.hands.hand import Coupling

MOST_MOVING = 200
"""Joints that move; a file with more is no hand."""


@dataclass(frozen=True)
class TreeJoint:
    """What holds a link to its parent, and how it moves there."""

    name: str
    kind: str
    """"hinge" (rad), "slide" (m) or "fixed"."""
    parent: str
    child: str
    xyz: tuple[float, ...] = (0.0, 0.0, 0.0)
    """(3,) origin of the child frame in the parent frame, with the joint at 0 [m]."""
    quaternion: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)
    """(w, x, y, z) orientation of the child frame in the parent frame, with the joint at 0."""
    axis: tuple[float, ...] = (1.0, 0.0, 0.0)
    """(3,) unit vector in the child frame."""
    anchor: tuple[float, ...] = (0.0, 0.0, 0.0)
    """(3,) a point of the axis in the child frame [m]."""
    lower: float = -math.inf  # [rad] or [m]
    upper: float = math.inf  # [rad] or [m]
    torque_limit: float = math.inf
    """|tau| that the file allows [N m] or [N]; infinity when it states none."""
    place: str = field(default="", compare=False)
    """File and line that state the range, for messages."""


@dataclass(frozen=True)
class LinkTree:
    """A tree of links."""

    title: str
    """What the file calls the robot."""
    root: str
    """The palm: the one link that is no child."""
    links: tuple[str, ...]
    """Parents before their children."""
    joints: Mapping[str, TreeJoint]
    """By name, in file order."""
    couplings: Mapping[str, Coupling] = field(default_factory=dict)
    """Moving joints that the file makes followers of others."""
    drives: Drives | None = None
    """What it says of motors and springs, with the moving joints in file order; None when it has no motors."""
    still: tuple[str, ...] = ()
    """Links and joints that were left out because they stand still: the palm is a link below or beside them."""

    @property
    def moving(self) -> tuple[str, ...]:
        """Names of the joints that are not fixed."""
        return tuple(joint.name for joint in self.joints.values() if joint.kind != "fixed")

    @property
    def parents(self) -> dict[str, str]:
        """Link -> the link that carries it; parents before their children, the root left out."""
        above = {joint.child: joint.parent for joint in self.joints.values()}
        return {link: above[link] for link in self.links if link != self.root}


def order_of_links(root: str, joints: Mapping[str, TreeJoint]) -> Iterator[str]:
    """Yield the links that hang on `root`, parents before their children."""
    children: dict[str, list[str]] = {}
    for joint in joints.values():
        children.setdefault(joint.parent, []).append(joint.child)
    waiting = [root]
    for link in waiting:
        yield link
        waiting += children.pop(link, [])  # each link once, also where joints form a loop
