"""What an MJCF file says of how its joints move together: equalities, and tendons that one actuator pulls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.hand import Coupling
from synergrip.hands.mjcf import Equality, Mjcf
from synergrip.hands.relations import AGREEMENT, Relations, couplings, with_pulls
from synergrip.linalg import Array


def mjcf_couplings(file: Mjcf) -> dict[str, Coupling]:
    """Return what follows what.

    Equalities between joints or fixed tendons are linear relations A q = b. A fixed tendon with an actuator says how
    its joints share one pull only when their compliances are known; they are taken to be equal, so that the joints
    move in proportion to their coefficients, from the drawing of the file, where nothing else says how they move
    (`with_pulls`).

    Raises:
        InputError: a closed loop, a relation that is not linear, relations that contradict each other or nearly repeat
            each other, a pulled tendon over hinges and slides; with file and line.
    """
    for equality in file.equalities:
        _no_loop(file, equality)
    for number in range(len(file.pulls)):
        _one_kind(file, number)
    ties = [equality for equality in file.equalities if equality.kind in ("joint", "tendon")]
    rows = [_row(file, equality) for equality in ties]
    A = np.array([row for row, _ in rows]).reshape(-1, len(file.q))
    relations = Relations(A, np.array([constant for _, constant in rows])).scaled()
    try:
        apart = relations.disagreement(relations.nearest(file.q_0))
        if apart.size and apart.max() > AGREEMENT:
            raise ties[int(np.argmax(apart))].element.refused("this equality contradicts the other ones")
        relations = with_pulls(relations, file.pulls, file.q_0)
    except InputError as error:
        root = file.source.lines[0]
        raise error.located(lambda issue: issue if issue.file else root.refused(issue.message).issues[0]) from None
    pulling = bool(np.any(np.count_nonzero(file.pulls, axis=1) > 1))  # a tendon lets joints part under contact
    found = couplings([file.joints[joint] for joint in file.q], relations, _order(file, ties), rigid=not pulling)
    return {name: replace(each, place=_place(file, ties, rows, name)) for name, each in found.items()}


def _place(file: Mjcf, ties: list[Equality], rows: list[tuple[Array, float]], follower: str) -> str:
    """Return file and line of the equality or the tendon that a joint follows by, first one of which it is joint1."""
    column = [file.joints[joint] for joint in file.q].index(follower)
    held = [tie for tie, (row, _) in zip(ties, rows, strict=True) if row[column]]
    first = [tie for tie in held if tie.kind == "joint" and tie.ends[0] == column]
    pulled = [file.source.place("fixed", file.model.tendon(i).name) for i in np.flatnonzero(file.tendons[:, column])]
    return next((element.place for element in [*(tie.element for tie in [*first, *held]), *pulled]), "")


def _no_loop(file: Mjcf, equality: Equality) -> None:
    if equality.kind in ("joint", "tendon"):
        return
    ends = [_rigid(file, body) for body in equality.ends]
    if len(set(ends)) > 1:
        names = " and ".join(f"'{file.bodies[body]}'" for body in equality.ends)
        raise equality.element.refused(
            f"<{equality.kind}> closes a loop between {names}; a hand is a tree here: leave the loop out and say with "
            '<joint joint1="..." joint2="..." polycoef="..."/> how the joints of the loop move'
        )


def _rigid(file: Mjcf, body: int) -> int:
    """Return the first body on the way to the world that turns or slides, or the world."""
    model = file.model
    moves = {int(model.jnt_bodyid[joint]) for joint in file.q}
    while body and body not in moves:
        body = int(model.body_parentid[body])
    return body


def _one_kind(file: Mjcf, actuator: int) -> None:
    """Refuse a tendon whose joints have compliances of different units, so that equal ones say nothing."""
    joints = [joint for joint, pull in zip(file.q, file.pulls[actuator], strict=True) if pull]
    if len({file.kinds[joint] for joint in joints}) > 1:
        names = ", ".join(f"'{file.joints[joint]}'" for joint in joints)
        raise file.source.lines[0].refused(
            f"one actuator pulls at hinges and slides ({names}); say with an <equality> how they move together"
        )


def _row(file: Mjcf, equality: Equality) -> tuple[Array, float]:
    """Return the row of A and the entry of b: e_1 - c_1 e_2 = c_0, with e from the values in the drawing."""
    constant, linear, *others = equality.polynomial
    if len(equality.ends) > 1 and any(others):
        raise equality.element.refused(
            "polycoef is not linear (only its first two numbers may differ from 0); a synergy is a fixed direction of q"
        )
    values = np.eye(len(file.q)) if equality.kind == "joint" else file.tendons
    row = values[equality.ends[0]].copy()
    if len(equality.ends) > 1:
        row -= linear * values[equality.ends[1]]
    return row, constant + float(row @ file.q_0)


def _order(file: Mjcf, ties: list[Equality]) -> list[int]:
    """Return the columns of q, followers first: each joint1, then all but the first of a tendon, then from behind."""
    follows = [equality.ends[0] for equality in ties if equality.kind == "joint"]
    for pull in file.pulls:
        follows += np.flatnonzero(pull)[1:].tolist()
    return list(dict.fromkeys([*follows, *range(len(file.q) - 1, -1, -1)]))
