"""The tables [hand], [object] and [contacts] made into a grasp."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from synergrip.errors import InputError, Issue, one_of, raise_issues
from synergrip.grasps.closing import close, unknown_surface
from synergrip.grasps.closing_direction import closing_direction
from synergrip.grasps.contacts.kinds import contact_kind
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.grasps.matrix_reading import LARGEST_COMPLIANCE
from synergrip.grasps.objects import Box, Cylinder, Object, Shape, Sphere, Turned, turn
from synergrip.grasps.placing import Touch, place
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Hand, Pad, SynergySet
from synergrip.hands.synergies.matrix import posture, stands_still
from synergrip.hands.synergies.select import select
from synergrip.hands.undriven import judge_undriven, with_springs
from synergrip.hands.units import joint_kinds, list_misfits
from synergrip.linalg import Array, frozen
from synergrip.problems.contact_list import ContactSpec
from synergrip.problems.hand_table import HandTable
from synergrip.problems.object_table import ObjectTable, ShapeTable
from synergrip.problems.problem_file import ProblemFile


def hand_grasp(file: ProblemFile, folder: Path) -> Grasp:
    """Return the grasp, which knows what holds what in it.

    Args:
        file: a problem file with [hand], [object] and contacts.
        folder: folder of the problem file, for a hand given as a path.

    Raises:
        InputError: an unknown hand, pad, link, posture or synergy set, or pads that do not reach the object.
    """
    table = file.hand
    if table is None:
        raise InputError.at("hand", "missing table [hand]")
    hand = load_hand(
        table.model,
        relative_to=folder,
        coupling=table.coupling,
        follower_ranges=table.follower_ranges,
        palm=table.palm or "",
        key="hand.model",
    )
    body = _object(file.object)
    issues, touches = list[Issue](), list[Touch]()
    for contact in file.contact_list():
        try:
            touches.append(_touch(hand, contact, body))
        except InputError as error:
            issues += error.issues
    if table.close is not None:
        issues += unknown_surface(body)
    try:
        synergies = select(hand, table.synergies, "hand.synergies", folder)
        _judge_drives(hand, synergies, table, [touch.pad.link for touch in touches])
        q, C_q, C_z = _state(hand, table, synergies)
        direction = closing_direction(hand, synergies, table.close) if table.close is not None else None
    except InputError as error:
        raise InputError([*error.issues, *issues]) from None
    raise_issues(issues)
    if direction is not None:
        q = close(hand, q, direction, body, touches)
    placed = place(file.title, hand, synergies, q, body, touches, C_q, C_z)
    held = Held(hand, synergies, q, C_q, placed.body, tuple(touches), placed.gaps)
    return replace(placed.grasp, held=held)


def _judge_drives(hand: Hand, synergies: SynergySet, table: HandTable, touching: Sequence[str]) -> None:
    asked = not (table.synergies is None or isinstance(table.synergies, int))
    each_yields = isinstance(table.compliance.joint, tuple)
    judge_undriven(hand, synergies, touching, asked=asked, each_yields=each_yields, key="hand.synergies")


def _state(hand: Hand, table: HandTable, synergies: SynergySet) -> tuple[Array, Array, Array]:
    """Return joint values (n_q,), joint and synergy compliance of a hand."""
    if table.posture is None:
        raise InputError.at("hand.posture", f"missing; name one of {', '.join(hand.postures)}, or give joint values")
    q = posture(hand, synergies, table.posture, "hand.posture")
    C_q, wish = hand.C_q, table.compliance.joint
    if wish is not None:
        C_q = _diagonal(wish, hand.joint_names, "hand.compliance.joint", "joints")
        raise_issues(list_misfits("hand.compliance.joint", wish, joint_kinds(hand.joints)))
        if hand.drives is not None and not isinstance(wish, tuple):
            C_q = with_springs(hand, C_q)
    C_z = _diagonal(table.compliance.synergy or 0.0, synergies.synergies, "hand.compliance.synergy", "synergies")
    return q, C_q, C_z


def _touch(hand: Hand, contact: ContactSpec, body: Object) -> Touch:
    kind = contact_kind(contact.model)
    stiffness = {"n": contact.stiffness, "m": contact.spin_stiffness}
    each = tuple(stiffness.get(component, contact.tangential_stiffness) for component in kind.components)
    aimed = isinstance(contact.at, str) or contact.at.normal is not None
    return Touch(
        contact.name, _pad(hand, contact), kind, contact.friction, contact.spin_friction,
        each, contact.normals or ("pad" if body.shape is None else "object"), contact.key, aimed, _normal_at(contact),
    )  # fmt: skip


def _normal_at(contact: ContactSpec) -> str:
    """Return where the normal of a pad or of a place on a link is stated."""
    if isinstance(contact.at, str):
        return f"the normal of pad '{contact.at}' in the hand's hand.toml"
    return f"{contact.key.removesuffix('link')}normal"


def _pad(hand: Hand, contact: ContactSpec) -> Pad:
    if isinstance(contact.at, str):
        return hand.pad(contact.at, contact.key)
    place = contact.at
    if still := stands_still(hand, place.link):
        carried = ", ".join(map(repr, hand.links))
        raise InputError.at(contact.key, f"link {still}; it carries {carried}; choose a palm that carries all contacts")
    if place.link not in hand.links:
        raise InputError.at(contact.key, f"link {one_of(place.link, hand.links)}")
    normal = frozen(place.normal or np.zeros(3))
    return Pad(contact.name, place.link, frozen(place.point), normal, place.radius)


def _object(table: ObjectTable | None) -> Object:
    if table is None:
        raise InputError.at("object", "missing table [object]")
    position = frozen(table.position if table.position is not None else np.full(3, np.nan))
    shape = _shape(table.shape) if table.shape is not None else None
    if shape is not None and table.orientation is not None and not isinstance(shape, Sphere):
        shape = Turned(shape, turn(table.orientation.axis, table.orientation.angle))
    return Object(table.title or (shape.title if shape else "object"), table.mass or 0.0, position, shape)


def _shape(table: ShapeTable) -> Shape:
    if table.sphere is not None:
        return Sphere(table.sphere.radius)
    if table.box is not None:
        x, y, z = table.box.size
        return Box((x, y, z))
    if table.cylinder is not None:
        return Cylinder(table.cylinder.radius, table.cylinder.height)
    raise InputError.at("object.shape", "name one shape: sphere, box or cylinder")


def _diagonal(value: float | tuple[float, ...], names: tuple[str, ...], key: str, what: str) -> Array:
    if isinstance(value, tuple) and len(value) != len(names):
        raise InputError.at(key, f"{len(value)} values for {len(names)} {what} ({', '.join(names)})")
    if np.max(value) > LARGEST_COMPLIANCE:
        raise InputError.at(key, f"a compliance of {np.max(value):g} is too large")
    return frozen(np.diag(np.broadcast_to(np.asarray(value, dtype=float), (len(names),))))
