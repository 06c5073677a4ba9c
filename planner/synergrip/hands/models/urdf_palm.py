"""The part of a URDF that a palm carries; the rest stands still."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from synergrip.errors import InputError, one_of
from synergrip.hands.models.xml_elements import Element


def carried_by(root: Element, palm: str, told: Collection[str] = ()) -> tuple[Element, tuple[str, ...]]:
    """Return the element <robot> with the links and joints that a link carries, and the names of the others.

    Args:
        root: the element <robot>.
        palm: name of the link.
        told: joints whose <mimic> does not count, because another file says what they follow.

    Raises:
        InputError: no such link, at the key ``palm``; a <mimic> between what the palm carries and what stands still,
            with file and line.
    """
    links = [element.attributes.get("name", "") for element in root.all("link")]
    if palm not in links:
        raise InputError.at("palm", f"link {one_of(palm, links)}")
    carried = _carried(root, palm)
    joints = {id(element): _end(element, "child") in carried for element in root.all("joint")}
    inside = {element.attributes.get("name", "") for element in root.all("joint") if joints[id(element)]}
    for element in root.all("joint"):
        _uncrossed(element, inside, palm, told)
    kept, still = list[Element](), list[str]()
    for element in root.children:
        name = element.attributes.get("name", "")
        if (element.tag == "link" and name not in carried | {palm}) or not joints.get(id(element), True):
            still.append(name)
        else:
            kept.append(element)
    return replace(root, children=kept), tuple(still)


def _end(joint: Element, tag: str) -> str:
    return joint.child(tag).attributes.get("link", "")


def _carried(root: Element, palm: str) -> set[str]:
    """Return the links that hang on the palm."""
    below: dict[str, list[str]] = {}
    for joint in root.all("joint"):
        below.setdefault(_end(joint, "parent"), []).append(_end(joint, "child"))
    carried, waiting = set[str](), [palm]
    while waiting:
        found = [link for link in below.get(waiting.pop(), []) if link not in carried | {palm}]
        carried.update(found)
        waiting += found
    return carried


def _uncrossed(joint: Element, inside: Collection[str], palm: str, told: Collection[str]) -> None:
    name = joint.attributes.get("name", "")
    for mimic in joint.all("mimic") if name not in told else ():
        driver = mimic.attributes.get("joint", "")
        if (name in inside) != (driver in inside):
            still, other = (driver, name) if name in inside else (name, driver)
            raise mimic.refused(
                f"joint '{name}' mimics '{driver}', but '{still}' stands still, because the palm '{palm}' carries only "
                f"'{other}' of the two; choose a palm above both, or leave the <mimic> out"
            )
