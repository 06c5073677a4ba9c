"""The links, joints and mimic tags of a URDF file, and nothing else of it.

Meshes, inertias and transmissions are skipped, so none of them can stop a hand from loading.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.errors import MOST_NAMES, InputError, one_of, shortened
from synergrip.hands.hand import Coupling
from synergrip.hands.models.foreign_files import refuse_macros
from synergrip.hands.models.tree import MOST_MOVING, LinkTree, TreeJoint, order_of_links
from synergrip.hands.models.urdf_palm import carried_by
from synergrip.hands.models.xml_elements import Element, read_xml
from synergrip.hands.synergies.matrix import coupling_map

KINDS = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide", "fixed": "fixed"}
"""URDF joint type -> kind."""
LARGEST = 1e6
"""[m, rad or 1] Larger numbers are no place or ratio of a joint."""
MOST_ELEMENTS = 5000
MANY_WAYS = ("floating", "planar")
"""Types that move in more than one direction."""


def read_urdf(path: Path, key: str = "", told: Collection[str] = ()) -> LinkTree:
    """Read the URDF file at `path`; the other arguments and errors are those of `read_xml` and `urdf_tree`."""
    root = read_xml(path, "URDF file", key)
    if root.tag != "robot":
        raise root.refused(f"expected a URDF, whose outermost element is <robot>, got <{root.tag}>")
    return urdf_tree(root, told)


def urdf_tree(root: Element, told: Collection[str] = (), palm: str = "") -> LinkTree:
    """Return the links and joints of a URDF.

    Args:
        root: its element <robot>.
        told: joints whose <mimic> is passed over, because another file says what they follow.
        palm: the link that is the palm, when it is not the outermost one; what it does not carry is left out.

    Raises:
        InputError: no moving joint, no tree, a joint without what its type needs, a <mimic> that cannot be; with
            file and line. What `carried_by` refuses.
    """
    if palm:
        part, still = carried_by(root, palm, told)
        return replace(urdf_tree(part, told), still=still)
    _plain(root)
    joints: dict[str, TreeJoint] = {}
    for element in root.all("joint"):
        joint = _joint(element)
        if joint.name in joints:
            raise element.refused(f"two joints are named '{joint.name}'")
        joints[joint.name] = joint
    links: dict[str, Element] = {}
    for element in root.all("link"):
        if element.required("name") in links:
            raise element.refused(f"two links are named '{element.attributes['name']}'")
        links[element.attributes["name"]] = element
    moving = sum(joint.kind != "fixed" for joint in joints.values())
    if moving == 0:
        raise root.refused("the file has no joint that moves")
    if moving > MOST_MOVING:
        raise root.refused(f"{moving} joints move, and a hand has at most {MOST_MOVING}")
    order = _order(root, list(links), joints)
    title = root.attributes.get("name", "")
    return LinkTree(title, order[0], tuple(order), joints, _couplings(root, joints, told))


def _plain(root: Element) -> None:
    """Refuse macros, and files that would take minutes."""
    refuse_macros(root)
    if len(root.children) > MOST_ELEMENTS:
        raise root.refused(f"the file has {len(root.children)} links, joints and the like; give the hand alone")


def _numbers(element: Element, attribute: str, default: str, below: float = LARGEST_NUMBER) -> tuple[float, ...]:
    element.check_length(attribute)
    text = element.attributes.get(attribute, default)
    count = len(default.split())
    try:
        values = tuple(float(part) for part in text.split())
    except ValueError:
        values = ()
    if len(values) != count or not all(math.isfinite(value) for value in values):
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise element.refused(f"<{element.tag} {attribute}> is {text!r}; expected {wanted}")
    if not all(abs(value) < below for value in values):
        raise element.refused(f"<{element.tag} {attribute}> is {text!r}; expected numbers below {below:g}")
    return values


def _joint(element: Element) -> TreeJoint:
    name, sort = element.required("name"), element.required("type")
    if sort in MANY_WAYS:
        raise element.refused(
            f"joint '{name}' is {sort}: it moves in more than one direction; the palm stands still and every other "
            "joint turns or slides, so remove it with the link it hangs on"
        )
    if sort not in KINDS:
        raise element.refused(f"joint '{name}': type {one_of(sort, KINDS)}")
    origin = element.child("origin")
    axis = _numbers(element.child("axis"), "xyz", "1 0 0")
    length = math.hypot(*axis)
    if length == 0 and sort != "fixed":
        raise element.refused(f"joint '{name}': the axis has no direction")
    lower, upper = _range(element, name, sort)
    return TreeJoint(
        name,
        KINDS[sort],
        element.child("parent").required("link"),
        element.child("child").required("link"),
        _numbers(origin, "xyz", "0 0 0", LARGEST),
        _quaternion(_numbers(origin, "rpy", "0 0 0")),
        tuple(part / length for part in axis) if length else (1.0, 0.0, 0.0),
        lower=lower,
        upper=upper,
        torque_limit=_effort(element.child("limit")),
        place=element.child("limit").place,
    )


def _range(element: Element, name: str, sort: str) -> tuple[float, float]:
    if sort not in ("revolute", "prismatic"):
        return -math.inf, math.inf
    if not any(element.all("limit")):
        raise element.refused(f"joint '{name}': a {sort} joint needs <limit lower upper>")
    limit = element.child("limit")
    (lower,), (upper,) = _numbers(limit, "lower", "0"), _numbers(limit, "upper", "0")
    if lower > upper:
        raise limit.refused(f"joint '{name}': the lower limit {lower:g} is above the upper limit {upper:g}")
    return lower, upper


def _effort(limit: Element) -> float:
    """Return the torque limit; published files write 0, a negative number or inf when they know none."""
    if limit.attributes.get("effort", "").strip().lower() in ("", "inf", "+inf"):
        return math.inf
    (effort,) = _numbers(limit, "effort", "0")
    return effort if effort > 0 else math.inf


def _order(root: Element, names: list[str], joints: dict[str, TreeJoint]) -> list[str]:
    """Return the links, parents before their children."""
    parents: dict[str, str] = {}
    there = set(names)
    for element, joint in zip(root.all("joint"), joints.values(), strict=True):
        for end in (joint.parent, joint.child):
            if end not in there:
                raise element.refused(f"joint '{joint.name}': link {one_of(end, names)}")
        if joint.child in parents:
            raise element.refused(f"link '{joint.child}' is the child of two joints")
        parents[joint.child] = joint.parent
    roots = [name for name in names if name not in parents]
    if len(roots) > 1:
        raise root.refused(f"one link is the palm, but {_listed(roots)} are no child of a joint")
    order = list(order_of_links(roots[0], joints)) if roots else []
    if len(order) < len(names):
        reached = set(order)
        rest = [name for name in names if name not in reached]
        raise root.refused(f"the links {_listed(rest)} form a loop; a hand is a tree")
    return order


def _listed(names: Sequence[str]) -> str:
    some = ", ".join(repr(shortened(name)) for name in names[:MOST_NAMES])
    return some if len(names) <= MOST_NAMES else f"{some}, ... ({len(names)} links)"


def _couplings(root: Element, joints: dict[str, TreeJoint], told: Collection[str]) -> dict[str, Coupling]:
    """Return what the <mimic> of each moving joint says."""
    moving = [name for name, joint in joints.items() if joint.kind != "fixed"]
    tags = {
        element.attributes["name"]: element.child("mimic")
        for element in root.all("joint")
        if any(element.all("mimic")) and element.attributes["name"] in moving
    }
    couplings: dict[str, Coupling] = {}
    for name, mimic in tags.items():
        if name in told:
            continue
        driver = mimic.required("joint")
        if driver in joints and driver not in moving:
            raise mimic.refused(f"joint '{name}' mimics '{driver}', which is fixed")
        if driver not in moving:
            raise mimic.refused(f"joint '{name}' mimics a joint that is not there: {one_of(driver, moving)}")
        (ratio,), (offset,) = _numbers(mimic, "multiplier", "1", LARGEST), _numbers(mimic, "offset", "0", LARGEST)
        couplings[name] = Coupling({driver: ratio}, offset, rigid=True, place=mimic.place)
    try:
        coupling_map(moving, couplings)
    except InputError as error:  # nothing but a loop is left to refuse
        raise tags[error.issues[0].key.removesuffix(".joint")].refused(error.issues[0].message) from None
    return couplings


def _quaternion(rpy: Sequence[float]) -> tuple[float, ...]:
    """Return (w, x, y, z) of the rotation Rz(yaw) Ry(pitch) Rx(roll)."""
    (r, p, y), (sr, sp, sy) = ([f(angle / 2) for angle in rpy] for f in (math.cos, math.sin))
    return (
        y * p * r + sy * sp * sr,
        y * p * sr - sy * sp * r,
        y * sp * r + sy * p * sr,
        sy * p * r - y * sp * sr,
    )
