"""From a URDF or MJCF file alone to a `Hand`: what the file does not say is left to the problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.drives import Drives
from synergrip.hands.follower_ranges import FollowerRanges, led
from synergrip.hands.hand import Coupling, Hand, Joint, SynergySet
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.tree import LinkTree
from synergrip.hands.synergies.matrix import JOINTS, coupling_map, drivers, joint_posture, joint_set
from synergrip.linalg import Array, frozen, split

FREE = "free"
"""The set of a hand with couplings: every joint that follows no other one, by itself."""
ZERO = "zero"
"""The posture of a hand that has no other: every joint at 0, or as near as the ranges allow."""


def bare_hand(
    name: str, tree: LinkTree, couplings: Mapping[str, Coupling], follower_ranges: FollowerRanges = "keep"
) -> Hand:
    """Return the hand that the links of a file make.

    Its joints are in the order of the file and as rigid as its springs have it (C_q), and it has no pads. Its set
    "free" has one synergy for each joint that follows no other one, with the followers: q = E q_free + e, so that
    S = E; its effort limits are the torque limits of those joints, or what their actuators give along with those of
    the followers. Joints that no motor of the file drives have no synergy.
    A hand without couplings and such joints has the set "joints" only, and so has one that no motor drives at all.

    Args:
        name: what the hand is to be called.
        tree: the links and joints.
        couplings: follower -> its drivers; in place of those of `tree`.
        follower_ranges: whether the ranges that the file states for followers count.

    Raises:
        InputError: couplings that leave no joint, that follow each other in a circle, or whose ratios are too large.
    """
    joints = tuple(
        Joint(
            name=joint.name,
            kind=joint.kind,
            lower=joint.lower,
            upper=joint.upper,
            torque_limit=joint.torque_limit,
            link=joint.child,
            place=joint.place,
        )
        for joint in tree.joints.values()
        if joint.kind != "fixed"
    )
    names = [joint.name for joint in joints]
    for joint in names:
        if any(mark in joint for mark in ',"\n\r\t'):
            raise InputError.at("", f"joint {joint!r}: a name may not hold commas, quotes or control characters")
    idle = tree.drives.idle if tree.drives else ()
    if follower_ranges == "ignore":
        joints = led(joints, couplings, *coupling_map(names, couplings))
    sets = {JOINTS: joint_set(names)}
    if (couplings or idle) and any(name not in couplings and name not in idle for name in names):
        sets = {FREE: _free(joints, couplings, tree.drives), **sets}
    elif not idle:
        _some_free(names, couplings)
    return Hand(
        name=name,
        title=tree.title or name,
        joints=joints,
        C_q=tree.drives.compliance if tree.drives else frozen(np.zeros((len(joints), len(joints)))),
        pads={},
        synergy_sets=sets,
        postures={ZERO: _zero(joints, couplings, tree.drives)},
        kinematics=kinematics(tree, names),
        couplings=dict(couplings),
        parents=tree.parents,
        drives=tree.drives,
        still=tree.still,
    )


def _some_free(names: Sequence[str], couplings: Mapping[str, Coupling]) -> None:
    if not any(name not in couplings for name in names):
        raise InputError.at("", "every joint follows another one or is locked; nothing is left to move")


def _free(joints: Sequence[Joint], couplings: Mapping[str, Coupling], drives: Drives | None) -> SynergySet:
    names = [joint.name for joint in joints]
    E, e = coupling_map(names, couplings)
    idle, resting = (drives.idle, drives.sprung) if drives else ((), {})
    free = [index for index, name in enumerate(names) if name not in couplings and name not in idle]
    S = E[:, free]
    if not (np.all(np.isfinite(S)) and np.all(np.isfinite(e))) or split(S).decision.rank < len(free):
        raise InputError.at("", "the couplings multiply to ratios that no hand has; check their numbers")
    title = "; ".join(
        filter(None, ["each joint that follows no other one", _followers(couplings), _idle(names, drives)])
    )
    limits = frozen(_efforts([joints[index].torque_limit for index in free], free, S, drives))
    offset = E @ [resting.get(name, 0.0) for name in names] + e
    free_names = tuple(names[index] for index in free)
    return SynergySet(name=FREE, title=title, synergies=free_names, S=S, offset=offset, effort_limits=limits)


def _efforts(torques: list[float], free: Sequence[int], S: Array, drives: Drives | None) -> Array:
    """Return (n_z,) the largest efforts: those of the drivers' joints, whose actuators move the followers too.

    Where the torque limit of a driver is what its actuators give there (and not what the file says of the joint), all
    counts that actuators give along the column of S: at followers too, as through a tendon over both.
    """
    if drives is None or drives.pulls is None or drives.forces is None:
        return np.array(torques)
    alone, together = (_given(drives.pulls @ motion, drives.forces) for motion in (np.eye(len(S))[:, free], S))
    return np.where(np.isclose(torques, alone), together, torques)


def _given(gains: Array, forces: Array) -> Array:
    """Return (m,) what actuators with `gains` (n_a, m) give together; infinity where none acts."""
    acting = np.abs(gains) > 1e-12 * np.abs(gains).max(initial=0.0)
    limits = np.sum(np.abs(gains) * np.where(acting, forces[:, None], 0.0), axis=0)
    return np.where(limits > 0, limits, np.inf)


def _idle(names: Sequence[str], drives: Drives | None) -> str:
    left = [f"'{name}'" for name in names if drives and name in drives.idle]
    return f"no actuator is known to drive {', '.join(left)}" if left else ""


def _followers(couplings: Mapping[str, Coupling]) -> str:
    told = [f"'{name}' follows {drivers(coupling)}" for name, coupling in couplings.items() if coupling.ratios]
    told += [f"'{name}' is locked" for name, coupling in couplings.items() if not coupling.ratios]
    return ", ".join(told)


def _zero(joints: Sequence[Joint], couplings: Mapping[str, Coupling], drives: Drives | None) -> Array:
    """Return the posture in which each free joint is at 0, or as near as its range and those of its followers allow.

    Joints that only springs hold are where these hold them, or as near as that.
    """
    names = [joint.name for joint in joints]
    E, e = coupling_map(names, couplings)
    values = {}
    for column, joint in enumerate(joints):
        if joint.name not in couplings:
            alone = [row for row in range(len(joints)) if E[row, column] and np.count_nonzero(E[row]) == 1]
            ends = [_reach(joints[row], E[row, column], e[row]) for row in alone]
            lower, upper = max(low for low, _ in ends), min(high for _, high in ends)
            if lower > upper:  # no value suits all followers; the joint itself comes first
                lower, upper = joint.lower, joint.upper
            wanted = drives.sprung.get(joint.name, 0.0) if drives else 0.0
            values[joint.name] = float(np.clip(wanted, lower, upper))
    return joint_posture(names, values, couplings)


def _reach(joint: Joint, ratio: float, offset: float) -> tuple[float, float]:
    """Return the values x of a driver for which ratio x + offset is in the range of the joint."""
    ends = [(float(end) - float(offset)) / float(ratio) for end in (joint.lower, joint.upper)]
    return min(ends), max(ends)
