"""The links and joints of a URDF file, and nothing else of it.

Meshes, inertias, transmissions and mimic tags are skipped, so none of them can stop a hand from loading:
its couplings stand in hand.toml.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from synergrip.documents import read_text
from synergrip.errors import InputError, Issue, one_of
from synergrip.hands.tree import LinkTree, TreeJoint, order_of_links

KINDS = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide", "fixed": "fixed"}
"""URDF joint type -> kind; the others ("floating", "planar") move in more than one direction."""


@dataclass
class _Element:
    tag: str
    attributes: dict[str, str]
    line: int
    children: list[_Element] = field(default_factory=list)

    def all(self, tag: str) -> Iterator[_Element]:
        return (child for child in self.children if child.tag == tag)

    def child(self, tag: str) -> _Element:
        """Return the first child of that tag, or an empty one that stands for the defaults."""
        return next(self.all(tag), _Element(tag, {}, self.line))


def read_urdf(path: Path, key: str = "") -> LinkTree:
    """Read the links and joints of the URDF file at `path`.

    Args:
        path: the file.
        key: the key of another file that names this one, for a file that is missing.

    Raises:
        InputError: no such file, not XML, a document type or an entity in it, not a URDF, no moving joint,
            no tree, a joint without what its type needs; with file and line.
    """
    root = _parse(path, read_text(path, "URDF file", key))
    if root.tag != "robot":
        raise _refused(path, root, f"expected a URDF, whose outermost element is <robot>, got <{root.tag}>")
    joints: dict[str, TreeJoint] = {}
    for element in root.all("joint"):
        joint = _joint(path, element)
        if joint.name in joints:
            raise _refused(path, element, f"two joints are named '{joint.name}'")
        joints[joint.name] = joint
    names: list[str] = []
    for element in root.all("link"):
        names.append(_required(path, element, "name"))
        if names[-1] in names[:-1]:
            raise _refused(path, element, f"two links are named '{names[-1]}'")
    if all(joint.kind == "fixed" for joint in joints.values()):
        raise _refused(path, root, "the file has no joint that moves")
    return _tree(path, root, names, joints)


def _parse(path: Path, text: str) -> _Element:
    parser = expat.ParserCreate(encoding="UTF-8")
    top = _Element("", {}, 1)
    stack = [top]

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = _Element(tag, attributes, parser.CurrentLineNumber)
        stack[-1].children.append(element)
        stack.append(element)

    def refuse(*_: object) -> None:
        message = "a document type or entity declaration (<!DOCTYPE ...>) is not allowed; remove it"
        raise InputError([Issue(message, file=str(path), line=parser.CurrentLineNumber, column=1)])

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: stack.pop()
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        issue = Issue(f"not XML: {expat.ErrorString(error.code)}", file=str(path), line=error.lineno)
        raise InputError([issue]) from None
    return top.children[0]


def _refused(path: Path, element: _Element, message: str) -> InputError:
    return InputError([Issue(message, file=str(path), line=element.line, column=1)])


def _required(path: Path, element: _Element, attribute: str) -> str:
    value = element.attributes.get(attribute, "")
    if not value:
        raise _refused(path, element, f"<{element.tag}> needs the attribute '{attribute}'")
    return value


def _numbers(path: Path, element: _Element, attribute: str, default: str) -> tuple[float, ...]:
    text = element.attributes.get(attribute, default)
    count = len(default.split())
    try:
        values = tuple(float(part) for part in text.split())
    except ValueError:
        values = ()
    if len(values) != count or not all(math.isfinite(value) for value in values):
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise _refused(path, element, f"<{element.tag} {attribute}> is {text!r}; expected {wanted}")
    return values


def _joint(path: Path, element: _Element) -> TreeJoint:
    name = _required(path, element, "name")
    sort = _required(path, element, "type")
    if sort not in KINDS:
        raise _refused(path, element, f"joint '{name}': type {one_of(sort, KINDS)}")
    origin, limit = element.child("origin"), element.child("limit")
    axis = _numbers(path, element.child("axis"), "xyz", "1 0 0")
    length = math.hypot(*axis)
    if length == 0:
        raise _refused(path, element, f"joint '{name}': the axis has no direction")
    lower, upper = -math.inf, math.inf
    if sort in ("revolute", "prismatic"):
        if not any(element.all("limit")):
            raise _refused(path, element, f"joint '{name}': a {sort} joint needs <limit lower upper>")
        (lower,), (upper,) = _numbers(path, limit, "lower", "0"), _numbers(path, limit, "upper", "0")
        if lower > upper:
            raise _refused(path, limit, f"joint '{name}': the lower limit {lower:g} is above the upper limit {upper:g}")
    return TreeJoint(
        name,
        KINDS[sort],
        _required(path, element.child("parent"), "link"),
        _required(path, element.child("child"), "link"),
        _numbers(path, origin, "xyz", "0 0 0"),
        _quaternion(_numbers(path, origin, "rpy", "0 0 0")),
        tuple(part / length for part in axis),
        lower=lower,
        upper=upper,
    )


def _tree(path: Path, root: _Element, names: list[str], joints: dict[str, TreeJoint]) -> LinkTree:
    parents: dict[str, str] = {}
    for element, joint in zip(root.all("joint"), joints.values(), strict=True):
        for end in (joint.parent, joint.child):
            if end not in names:
                raise _refused(path, element, f"joint '{joint.name}': link {one_of(end, names)}")
        if joint.child in parents:
            raise _refused(path, element, f"link '{joint.child}' is the child of two joints")
        parents[joint.child] = joint.parent
    roots = [name for name in names if name not in parents]
    if len(roots) > 1:
        raise _refused(path, root, f"one link is the palm, but {', '.join(map(repr, roots))} are no child of a joint")
    order = list(order_of_links(roots[0], joints)) if roots else []
    if len(order) < len(names):
        rest = ", ".join(repr(name) for name in names if name not in order)
        raise _refused(path, root, f"the links {rest} form a loop; a hand is a tree")
    return LinkTree(root.attributes.get("name", ""), order[0], tuple(order), joints)


def _quaternion(rpy: Sequence[float]) -> tuple[float, ...]:
    """Return (w, x, y, z) of the rotation Rz(yaw) Ry(pitch) Rx(roll)."""
    (r, p, y), (sr, sp, sy) = ([f(angle / 2) for angle in rpy] for f in (math.cos, math.sin))
    return (
        y * p * r + sy * sp * sr,
        y * p * sr - sy * sp * r,
        y * sp * r + sy * p * sr,
        sy * p * r - y * sp * sr,
    )
