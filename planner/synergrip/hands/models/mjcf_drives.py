"""What the actuators and springs of an MJCF file do: what settles where, and which joints nothing drives."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.hands.drives import Drives
from synergrip.hands.models.mjcf import Mjcf
from synergrip.hands.models.mjcf_arms import Arms
from synergrip.hands.models.mjcf_readable import NEAR, Readable, readable
from synergrip.hands.models.relations import Relations
from synergrip.hands.models.settling import Settled, Springs, moves, settle
from synergrip.linalg import Array, frozen

ROUNDING = 1e-6
"""Moment arms that change less are constant."""
MOST_SPANS, MOST_TENDONS = 6, 2
"""Joints of a tendon, and tendons of a joint, that are named in a reason."""


@dataclass(frozen=True, eq=False)
class Driven:
    """What the actuators of a file do."""

    relations: Relations
    """Those that make followers: equalities, pulls, springs."""
    drives: Drives


def pulls_of(file: Mjcf, tendons: Array) -> Array:
    """Return (n_a, n_q) the joint torque per force of each actuator, with the arms (n_t, n_q) of the tendons."""
    pulls = np.zeros((len(file.actuators), len(file.q)))
    for pull, actuator in zip(pulls, file.actuators, strict=True):
        if actuator.tendon is not None:
            pull[:] = actuator.gear * tendons[actuator.tendon]
        elif actuator.joint is not None:
            pull[actuator.joint] = actuator.gear
    return pulls


def undriven(file: Mjcf) -> Drives | None:
    """Return what is to be noted of a file without actuators, whose joints count as driven."""
    if not file.springs:
        return None
    names = ", ".join(spring.name for spring in file.springs)
    note = f"the file has no actuators: every joint counts as driven, and its springs are not read ({names})"
    return Drives(frozen(np.zeros((len(file.q), len(file.q)))), notes=(note,))


def driven(file: Mjcf, relations: Relations, arms: Arms) -> Driven:
    """Return what follows what, and what is left of a file with actuators.

    Joints that spatial tendons move in a way that changes with the posture are left out, with all that is tied to them
    (`readable`).

    Args:
        file: the file.
        relations: A q = b by its equalities.
        arms: the moment arms of its tendons.

    Raises:
        InputError: a pulled tendon over hinges and slides that no spring sets against each other, pulls that nearly
            repeat each other.
    """
    pulls, springs = pulls_of(file, arms.mean), _springs(file, arms.mean, arms.offset)
    found = settle(relations, pulls, springs, file.q_0)
    rows = np.vstack([pulls, relations.A, springs.F])
    each = np.array([pulls_of(file, there) for there in arms.each]).reshape(-1, *pulls.shape)
    kinds = [file.kinds[joint] for joint in file.q]
    seen = readable(found, relations, arms, _used(file), kinds, rows, each)
    lost = list(seen.lost)
    kept = ~np.any(springs.F[:, lost] != 0, axis=1)
    pulls = pulls[~np.any(pulls[:, lost] != 0, axis=1)]
    springs = Springs(springs.F[kept], springs.g[kept])
    found = settle(relations, pulls, springs, file.q_0)
    for pull in pulls:
        _one_kind(file, pull, found)
    return Driven(found.relations or relations, _drives(file, found, arms, seen, springs))


def _springs(file: Mjcf, tendons: Array, offset: Array) -> Springs:
    """Return the springs that are read, with the arms (n_t, n_q) of the tendons."""
    read = [spring for spring in file.springs if not spring.unread]
    F, g = np.zeros((len(read), len(file.q))), np.zeros(len(read))
    for number, spring in enumerate(read):
        if spring.tendon is not None:
            F[number], g[number] = tendons[spring.tendon], spring.rest - offset[spring.tendon]
        else:
            F[number, spring.joint], g[number] = 1.0, spring.rest
    roots = np.sqrt([spring.stiffness for spring in read])
    return Springs(F * roots[:, None], g * roots)


def _one_kind(file: Mjcf, pull: Array, found: Settled) -> None:
    """Refuse a tendon that shares one pull among joints by nothing but their alike yield, which has two units."""
    joints = [joint for joint, arm, each in zip(file.q, pull, moves(found.loose), strict=True) if arm and each]
    if len({file.kinds[joint] for joint in joints}) > 1:
        names = ", ".join(f"'{file.joints[joint]}'" for joint in joints)
        raise file.source.lines[0].refused(
            f"one actuator pulls at hinges and slides ({names}); say with an <equality> how they move together"
        )


def _drives(file: Mjcf, found: Settled, arms: Arms, seen: Readable, springs: Springs) -> Drives:
    moving = moves(found.loose)
    sprung, loose = dict[str, float](), dict[str, str]()
    for column, joint in enumerate(file.q):
        name = file.joints[joint]
        if not found.idle[column]:
            continue
        if column in seen.lost:
            loose[name] = _lost(file, arms, column, seen.bending)
        elif moving[column]:
            loose[name] = "no spring holds it either"
        else:
            sprung[name] = _within(file, joint, float(found.rest[column]))
    notes = (*_unread(file), *_near(file, seen))
    forces = frozen([actuator.force for actuator in file.actuators])
    stiffness, pulled = springs.F.T @ springs.F, springs.F.T @ springs.g
    return Drives(frozen(found.compliance), sprung, loose, notes, frozen(pulls_of(file, arms.mean)), forces,
                  frozen(stiffness), frozen(pulled))  # fmt: skip


def _within(file: Mjcf, joint: int, rest: float) -> float:
    """Return where a joint rests: a spring may press it to the end of its range."""
    return float(np.clip(rest, *file.model.jnt_range[joint])) if file.model.jnt_limited[joint] else rest


def _lost(file: Mjcf, arms: Arms, column: int, bending: Sequence[int]) -> str:
    """Return why it is not known how a joint moves: the spatial tendons that pull at it, with their arms."""
    passing = [tendon for tendon in bending if arms.mean[tendon, column]]
    pulling = [
        (actuator.name, tendon) for actuator in file.actuators for tendon in passing if actuator.tendon == tendon
    ]
    told = [
        f"'{name}' pulls through the spatial tendon '{file.tendon_names[tendon]}', whose moment arms change too much "
        f"over the ranges of the joints ({_spans(file, arms, tendon)})"
        for name, tendon in pulling[:MOST_TENDONS]
    ]
    more = f", and {len(pulling) - MOST_TENDONS} more such tendons" if len(pulling) > MOST_TENDONS else ""
    reason = " and ".join(told) + more
    return reason or "tied to joints that spatial tendons pull, whose moment arms change too much"


def _spans(file: Mjcf, arms: Arms, tendon: int) -> str:
    """Return the ranges of the arm of a tendon at its joints."""
    told, columns = list[str](), np.flatnonzero(arms.mean[tendon]).tolist()
    for column in columns[:MOST_SPANS]:
        least, most = arms.span(tendon, column)
        scale, unit = (1e3, " mm") if file.kinds[file.q[column]] == "hinge" else (1.0, "")
        told.append(f"{file.joints[file.q[column]]} {scale * least:.3g} to {scale * most:.3g}{unit}")
    return ", ".join(told) + (", and so on" if len(columns) > MOST_SPANS else "")


def _unread(file: Mjcf) -> Iterator[str]:
    if file.source.actuators_left_out:
        names = ", ".join(f"'{name}'" for name in file.source.actuators_left_out)
        yield f"actuators that act at a site are not read, nor what they drive: {names}"
    for spring in file.springs:
        if spring.unread:
            yield f"the spring of {spring.name} is not read: {spring.unread}"


def _used(file: Mjcf) -> list[int]:
    """Return the spatial tendons that an actuator pulls or that hold a spring."""
    springs = [spring.tendon for spring in file.springs if not spring.unread]
    return [tendon for tendon in file.spatial if tendon in (*(each.tendon for each in file.actuators), *springs)]


def _near(file: Mjcf, seen: Readable) -> Iterator[str]:
    """Yield a note on spatial tendons that were taken as constant, though they are not quite."""
    told = {tendon: change for tendon, change in seen.change if change > ROUNDING}
    if told:
        names = ", ".join(f"'{file.tendon_names[tendon]}'" for tendon in told)
        yield (
            f"the moment arms of the spatial tendon{'s' * (len(told) > 1)} {names} change by up to "
            f"{100 * max(told.values()):.2g} % over the ranges of the joints; their means are used (up to "
            f"{100 * NEAR:g} % counts as constant)"
        )
