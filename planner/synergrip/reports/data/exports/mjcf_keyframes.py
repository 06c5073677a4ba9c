"""A plan as MJCF: the links of the hand, its pads and the object, and a keyframe for each knot.

It is written here, and not by MuJoCo, whose own writer keeps six digits.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, ElementTree, SubElement, indent

import numpy as np

from synergrip.hands.models.tree import LinkTree
from synergrip.planning.arrays import one_line
from synergrip.reports.data.exports.exported_plan import ExportedPlan, HandStates
from synergrip.simulation.geoms import GEOMS, sizes_of
from synergrip.simulation.played_plan import hand_tree
from synergrip.simulation.told_values import Told
from synergrip.vectors import quaternions

SMALL = 1e-3
"""Radius [m] with which a pad without one is drawn."""
LIGHT = ("1e-6", "1e-9")
"""[kg] and [kg m^2], which MuJoCo takes where nothing is known: it has no bodies that move without."""


def write_mjcf(plan: ExportedPlan, path: Path) -> None:
    """Write the model, which needs no other file."""
    hand = plan.hand
    assert hand is not None  # refused before
    tree = hand_tree(hand.told, hand.folder)
    root = Element("mujoco", model=plan.title)
    SubElement(root, "compiler", angle="radian", boundmass=LIGHT[0], boundinertia=LIGHT[1])
    gravity = hand.told.perhaps("gravity_m_s2", Told.array, (3,))
    SubElement(root, "option", gravity="0 0 0" if gravity is None else _numbers(gravity))
    SubElement(SubElement(root, "custom"), "text", name="about", data=json.dumps(plan.about))
    world = SubElement(root, "worldbody")
    names = _Names()
    order = _add_links(world, tree, hand, names)
    _add_object(world, hand, names)
    frames, turned = SubElement(root, "keyframe"), quaternions(hand.rotation)
    told = list(hand.told.texts("joints"))
    for k, time in enumerate(plan.times):
        joints = [hand.q[k, told.index(name)] for name in order]
        qpos = _numbers([*joints, *hand.position[k], *turned[k]])
        SubElement(frames, "key", name=f"knot_{k}", time=repr(float(time)), qpos=qpos)
    indent(root)
    with path.open("wb") as stream:
        ElementTree(root).write(stream, encoding="utf-8", xml_declaration=True)


class _Names:
    """Names of things of one kind, which MuJoCo wants to differ; "world" is its own."""

    def __init__(self) -> None:
        self._taken: dict[str, set[str]] = {"body": {"world"}}

    def free(self, kind: str, name: str) -> str:
        """Return a name that nothing of the kind has yet, the name itself if it can be."""
        taken, found, number = self._taken.setdefault(kind, set()), one_line(name), 2
        while found in taken:
            found, number = f"{one_line(name)} ({number})", number + 1
        taken.add(found)
        return found


def _add_links(world: Element, tree: LinkTree, hand: HandStates, names: _Names) -> list[str]:
    """Add the links, with sites where pads are; return the joints in the order that MuJoCo gives their values."""
    told = hand.told.texts("joints")
    ranges = dict(zip(told, hand.told.get("joint_range") or [(None, None)] * len(told), strict=False))
    bodies, made_of = {tree.root: SubElement(world, "body", name=names.free("body", tree.root))}, dict[Element, str]()
    above = {joint.child: joint for joint in tree.joints.values()}
    for link in tree.links[1:]:
        joint = above[link]
        place = {"pos": _numbers(joint.xyz), "quat": _numbers(joint.quaternion)}
        bodies[link] = SubElement(bodies[joint.parent], "body", {"name": names.free("body", link), **place})
        if joint.kind != "fixed":
            where = {"type": joint.kind, "axis": _numbers(joint.axis), "pos": _numbers(joint.anchor)}
            made = SubElement(bodies[link], "joint", {"name": names.free("joint", joint.name), **where})
            made_of[made] = joint.name
            _bound(made, ranges.get(joint.name))
    for contact in hand.told.several("contacts"):
        link = contact.text("link")
        if link not in bodies:
            raise contact.refused("link", f"the hand has no link '{one_line(link)}'")
        radius = max(contact.number("pad_radius_m"), SMALL)
        SubElement(bodies[link], "site", name=names.free("site", contact.text("name")), size=_numbers([radius]),
                   pos=_numbers(contact.array("pad_centre_m", (3,))))  # fmt: skip
    return [made_of[joint] for joint in world.iter("joint")]


def _bound(joint: Element, ends: Any) -> None:
    if (
        isinstance(ends, list | tuple)
        and len(ends) == 2
        and all(isinstance(end, int | float) for end in ends)
        and ends[0] < ends[1]
    ):
        joint.set("range", _numbers(ends))
        joint.set("limited", "true")


def _add_object(world: Element, hand: HandStates, names: _Names) -> None:
    """Add the object as a free body, with what is known of its mass and shape."""
    told = hand.told.inside("object")
    name = names.free("body", "object")
    body = SubElement(world, "body", name=name, pos=_numbers(told.array("position_m", (3,))))
    SubElement(body, "freejoint", name=names.free("joint", "object"))
    if told.get("mass_kg") is not None and told.get("inertia_kg_m2") is not None:
        inertia = told.array("inertia_kg_m2", (3, 3))
        full = [*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2]]
        SubElement(body, "inertial", pos="0 0 0", mass=repr(told.positive("mass_kg")), fullinertia=_numbers(full))
    shape = told.get("shape")
    kind = next(iter(shape), "") if isinstance(shape, dict) else ""
    if kind in GEOMS:
        sizes = sizes_of(kind, Told(shape, told.at("shape")).inside(kind))
        turned = quaternions(np.asarray(sizes.get("rotation", np.eye(3)))[None])[0]
        SubElement(body, "geom", name="object", type=kind, size=_numbers(GEOMS[kind].size(sizes)), mass="0",
                   quat=_numbers(turned), contype="0", conaffinity="0")  # fmt: skip


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
