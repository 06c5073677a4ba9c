"""What is to become a grasp: a hand in a posture, an object, and pads of which nobody knows yet whether they touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from synergrip.documents.judging import Arguments, described
from synergrip.errors import InputError, Issue, one_of, raise_issues
from synergrip.grasps.asked_hand import Posture, Synergies, asked_hand
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.grasps.objects import Object
from synergrip.grasps.placing import Touch, place
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Hand, Pad, SynergySet
from synergrip.hands.posture_units import posture_doubt
from synergrip.hands.synergies.matrix import stands_still
from synergrip.linalg import Array, frozen
from synergrip.values import Value

EXAMPLE = 'ContactAt("finger1/tip", HardFinger(friction=0.6), stiffness=8e3)'


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class AskedGrasp(Value):
    """All that a grasp is made of, each by itself in order; `grasp_of` closes the hand and lets the pads touch."""

    title: str
    hand: Hand
    synergies: SynergySet
    q: Array
    """(n_q,) the posture from which the hand closes, or in which it holds the object [rad or m]."""
    closing: Array | None
    """(n_q,) joint motion of closing by 1; None for a hand that stays in its posture."""
    body: Object
    touches: tuple[Touch, ...]
    C_q: Array  # (n_q, n_q) [rad/(N m)]
    C_z: Array  # (n_z, n_z)

    def at(self, position: Array) -> AskedGrasp:
        """Return the same with the object at a position (3,) in the palm frame [m]."""
        return replace(self, body=replace(self.body, position=position))


def grasp_of(asked: AskedGrasp) -> Grasp:
    """Return the grasp that is asked for.

    Raises:
        InputError: pads that do not reach the object, or face away from it.
    """
    hand, q, touches = asked.hand, asked.q, asked.touches
    if asked.closing is not None:
        from synergrip.grasps.closing import close as closed  # hands in a given posture do without

        q = closed(hand, q, asked.closing, asked.body, touches)
    try:
        placed = place(asked.title, hand, asked.synergies, q, asked.body, touches, asked.C_q, asked.C_z)
    except InputError as error:
        said = posture_doubt(hand.joints, q)
        raise InputError([*error.issues, *([Issue(said, key="posture")] if said else [])]) from None
    held = Held(hand=hand, synergies=asked.synergies, q=q, C_q=asked.C_q, body=placed.body, touches=touches,
                gaps=placed.gaps)  # fmt: skip
    return replace(placed.grasp, held=held)


def asked_grasp(
    hand: Hand | str | Path,
    object: Object,
    *,
    posture: Posture,
    contacts: Sequence[ContactAt],
    synergies: Synergies | None = None,
    close: str | Mapping[str, float] | None = None,
    joint_compliance: float | Sequence[float] | Array | None = None,
    synergy_compliance: float | Sequence[float] | Array = 0.0,
    title: str = "",
    relative_to: str | Path | None = None,
    anywhere: bool = False,
) -> AskedGrasp:
    """Return what is to become a grasp, its parts judged each by itself; what is given is told at `make_grasp`.

    With `anywhere` the object may have no position yet though the hand closes on it.

    Raises:
        InputError: an argument that is none, unknown names, a posture outside the ranges of the joints.
    """
    judge = Arguments("")
    if not isinstance(hand, Hand):
        hand = _loaded(hand)
    body = judge.one("object", object, Object, "Object(mass=0.2, shape=Sphere(radius=0.05))")
    wanted = judge.several("contacts", contacts, ContactAt, EXAMPLE)
    if not judge.issues and not wanted:
        judge.refuse("contacts", f"no contacts; name the pads that touch the object, such as [{EXAMPLE}]")
    judge.text("title", title)
    if relative_to is not None and not isinstance(relative_to, str | Path):
        judge.refuse("relative_to", f"expected the path of a folder, got {described(relative_to)}")
    if judge.issues or body is None:
        raise InputError(judge.issues)
    touches, issues = _touches(hand, wanted, body)
    if close is not None:
        from synergrip.grasps.closing import unknown_surface

        issues += [each for each in unknown_surface(body) if not (anywhere and each.key == "object.position")]
    links = [touch.pad.link for touch in touches]
    try:
        own = asked_hand(hand, posture=posture, synergies=synergies, close=close, joint_compliance=joint_compliance,
                         synergy_compliance=synergy_compliance, links=links,
                         folder=Path(relative_to or ""))  # fmt: skip
    except InputError as error:
        raise InputError([*error.issues, *issues]) from None
    raise_issues(issues)
    return AskedGrasp(title=title, hand=hand, synergies=own.synergies, q=own.q, closing=own.closing, body=body,
                      touches=tuple(touches), C_q=own.C_q, C_z=own.C_z)  # fmt: skip


def _loaded(hand: object) -> Hand:
    if not isinstance(hand, str | Path):
        raise InputError.at("hand", f'expected a Hand such as load_hand("barrett"), got {described(hand)}')
    return load_hand(hand, key="hand")


def _touches(hand: Hand, contacts: Sequence[ContactAt], body: Object) -> tuple[list[Touch], list[Issue]]:
    """Return the pads that touch, and what is wrong with them."""
    touches, issues = list[Touch](), list[Issue]()
    for index, contact in enumerate(contacts):
        key = contact.key or f"contacts[{index}].at"
        if contact.name in {touch.name for touch in touches}:
            beside = f"contacts[{index}].name"
            issues.append(Issue(f"two contacts have the name '{contact.name}'; give each of them a name", key=beside))
            continue
        try:
            touches.append(_touch(hand, contact, body, key, f"contacts[{index}]"))
        except InputError as error:
            issues += error.issues
    return touches, issues


def _touch(hand: Hand, contact: ContactAt, body: Object, key: str, argument: str) -> Touch:
    on_pad = isinstance(contact.at, str)
    stated = contact.normal_at or (f"the normal of pad '{contact.at}'" if on_pad else f"{argument}.at.normal")
    return Touch(
        name=contact.name,
        pad=_pad(hand, contact, key),
        kind=contact.kind,
        stiffness=contact.stiffnesses,
        normals=contact.normals or ("pad" if body.shape is None else "object"),
        key=key,
        tangent=contact.tangent,
        aimed=isinstance(contact.at, str) or contact.at.normal is not None,
        normal_at=stated,
    )


def _pad(hand: Hand, contact: ContactAt, key: str) -> Pad:
    if isinstance(contact.at, str):
        return hand.pad(contact.at, key)
    spot = contact.at
    if still := stands_still(hand, spot.link):
        carried = ", ".join(map(repr, hand.links))
        raise InputError.at(key, f"link {still}; it carries {carried}; choose a palm that carries all contacts")
    if spot.link not in hand.links:
        raise InputError.at(key, f"link {one_of(spot.link, hand.links)}")
    normal = frozen(spot.normal or np.zeros(3))
    return Pad(name=contact.name, link=spot.link, point=frozen(spot.point), normal=normal, radius=spot.radius)
