"""Joints that no motor of a model file drives: what is said of them, and what has to be said by the problem."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.arm import palm_of
from synergrip.hands.drives import Drives
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import JOINTS
from synergrip.hands.unbalanced import stated_otherwise
from synergrip.hands.units import joint_kinds, synergy_kinds, torque_unit
from synergrip.linalg import Array, frozen

HELD = 0.01
"""Share of a torque or effort limit that springs may take of motors without a note."""
MOST_NAMED = 12
"""Joints named in a message."""
MOST_REASONS = 3
"""Reasons given in a message."""


def carrying(hand: Hand, links: Collection[str]) -> tuple[str, ...]:
    """Return the joints that carry one of some links."""
    above = {link for each in links for link in hand.carriers(each)}
    return tuple(joint.name for joint in hand.joints if joint.link in above)


def judge_undriven(
    hand: Hand, synergies: SynergySet, touching: Collection[str], *, asked: bool, each_yields: bool, key: str
) -> None:
    """Refuse a grasp through joints of which nothing says how they move and how far they yield.

    Args:
        hand: the hand.
        synergies: the chosen set.
        touching: the links that touch the object.
        asked: whether the problem names the set, or its synergies.
        each_yields: whether the problem gives the compliance of each joint.
        key: where the problem would name the synergies.

    Raises:
        InputError: there are such joints; with the reason of each, and what to write.
    """
    drives = hand.drives
    if drives is None or not drives.idle:
        return
    moved = _moved(hand, synergies)
    carriers = carrying(hand, touching)
    open_ones = [name for name in carriers if name in drives.loose]
    if not asked and synergies.name == JOINTS:
        open_ones = [*open_ones, *(name for name in drives.idle if name not in (*open_ones, *hand.couplings))]
    elif asked:
        open_ones = [name for name in open_ones if name not in moved and not each_yields]
    elif each_yields:
        open_ones = []
    if open_ones:
        raise InputError.at(key, _message(hand, open_ones, palm_of(hand, touching)))


def with_springs(hand: Hand, C_q: Array) -> Array:
    """Return C_q (n_q, n_q) with the yield of the hand's own springs at the joints that only springs hold."""
    own = np.array([hand.drives is not None and name in hand.drives.sprung for name in hand.joint_names])
    return frozen(np.where(own[:, None] | own, np.where(own[:, None] & own, hand.C_q, 0.0), C_q))


def undriven_notes(hand: Hand, synergies: SynergySet, q: Array, C_q: Array) -> Iterator[str]:
    """Yield what was taken for something else in the model file, and what becomes of joints that no motor drives.

    Args:
        hand: the hand.
        synergies: the chosen set.
        q: (n_q,) joint values [rad or m].
        C_q: (n_q, n_q) the joint compliance that is used.
    """
    drives = hand.drives
    if drives is None:
        return
    yield from drives.notes
    other = stated_otherwise(drives, C_q)
    if other.any():
        names = [name for name, each in zip(hand.joint_names, other, strict=True) if each]
        yield f"hand.compliance.joint stands in place of what the springs of the model file say of {_listed(names)}"
    moved = [name for name in drives.idle if name in _moved(hand, synergies)]
    if moved:
        yield f"the synergies move {_listed(moved)}, which no actuator of the model file is known to drive"
    sprung = [name for name in drives.sprung if name not in moved]
    if sprung:
        yield f"no actuator of the model file drives {_listed(sprung)}: no synergy moves them, springs hold them"
    loose = [name for name in drives.loose if name not in moved]
    if loose:
        yield f"no actuator of the model file is known to drive {_listed(loose)}: no synergy moves them"
    yield from _against_springs(hand, drives, synergies, q)


def _against_springs(hand: Hand, drives: Drives, synergies: SynergySet, q: Array) -> Iterator[str]:
    """Yield a note when motors hold springs back by more than a small share of what they can."""
    torques = drives.spring_torques(q)
    largest = np.array([joint.torque_limit for joint in hand.joints])
    by_joints = np.max(np.abs(torques) / largest, initial=0.0, where=np.any(synergies.S != 0, axis=1))
    efforts = synergies.S.T @ torques
    by_motors = np.max(np.abs(efforts) / synergies.effort_limits, initial=0.0)
    if (share := max(by_joints, by_motors)) > HELD:
        kinds = synergy_kinds(synergies, joint_kinds(hand.joints).values()).items()
        pulls = [
            f"'{name}' with {effort:.3g} {torque_unit([kind])}"
            for (name, kind), effort in zip(kinds, efforts, strict=True)
            if effort
        ]
        more = f" and {len(pulls) - MOST_NAMED} more" if len(pulls) > MOST_NAMED else ""
        yield (
            f"motors hold springs of the model file in this posture: {', '.join(pulls[:MOST_NAMED])}{more}, up to "
            f"{share:.0%} of what they can. Limits of torques and efforts count what contacts ask for alone: of +-m a "
            "motor that springs ask for e can give contacts -m - e to m - e"
        )


def _moved(hand: Hand, synergies: SynergySet) -> tuple[str, ...]:
    return tuple(name for name, row in zip(hand.joint_names, synergies.S, strict=True) if np.any(row))


def _message(hand: Hand, names: Sequence[str], palm: tuple[str, tuple[str, ...]]) -> str:
    reasons = dict[str, list[str]]()
    for name in names:
        reason = hand.drives.loose.get(name, "only its spring holds it") if hand.drives else ""
        reasons.setdefault(reason, []).append(name)
    told = "; ".join(f"{_listed(each)}: {reason}" for reason, each in list(reasons.items())[:MOST_REASONS])
    more = "; and so on" if len(reasons) > MOST_REASONS else ""
    more = "; ".join([more, *(hand.drives.notes if hand.drives else ())])
    arm = f'; or hand.palm = "{palm[0]}", to leave out what is above that link' if {*names} & {*palm[1]} else ""
    return (
        f"no actuator of the model file is known to drive {_listed(names)} ({told}{more}). Write how they move: "
        'synergies = "mine.toml", a synergy file with these joints; or names of joints that actuators drive each '
        f'by itself, as in synergies = ["{names[0]}"]; or, where nothing drives them, how far each joint yields: '
        f"a list in compliance.joint (in code joint_compliance), 0 for a locked one{arm}. Or change the model file: an "
        "actuator, a stiffness, a <fixed> tendon in place of a <spatial> one, with its moment arms as coef"
    )


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(f"'{name}'" for name in names[:MOST_NAMED])
    return shown + (f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else "")
