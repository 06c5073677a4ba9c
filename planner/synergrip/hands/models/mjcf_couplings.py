"""What an MJCF file says of how its joints move together: equalities, and what its actuators and springs leave."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.drives import Drives
from synergrip.hands.hand import Coupling
from synergrip.hands.models.mjcf import Equality, Mjcf
from synergrip.hands.models.mjcf_arms import Arms, arms_of
from synergrip.hands.models.mjcf_drives import driven, pulls_of, undriven
from synergrip.hands.models.mjcf_readable import NEAR, change_of
from synergrip.hands.models.relations import AGREEMENT, Relations, couplings
from synergrip.hands.models.settling import STILL
from synergrip.linalg import Array, split


@dataclass(frozen=True, eq=False)
class Moves:
    """How the joints of a file move."""

    couplings: dict[str, Coupling]
    drives: Drives | None
    """None for a file that has no actuators and nothing to note."""
    pulls: Array
    """(n_a, n_q) joint torque per force of each actuator; of a spatial tendon with its mean moment arms."""


def mjcf_couplings(file: Mjcf) -> Moves:
    """Return what follows what, and what no actuator drives.

    Equalities between joints or tendons are linear relations A q = b. Actuators that pull at several joints through a
    tendon move them as the springs of the file have it, and joints without springs in proportion to their arms, from
    the drawing of the file (`settle`). Joints that no actuator moves are no followers; see `Drives`. Without actuators
    nothing says what drives what, and every joint that follows no other one counts as driven.

    Raises:
        InputError: a closed loop, a relation that is not linear, relations that contradict each other or nearly repeat
            each other, a pulled tendon over hinges and slides; with file and line.
    """
    for equality in file.equalities:
        _no_loop(file, equality)
    ties = [equality for equality in file.equalities if equality.kind in ("joint", "tendon")]
    spatial = [tie for tie in ties if tie.kind == "tendon" and {*tie.ends} & {*file.spatial}]
    arms = arms_of(file, _relations(file, [tie for tie in ties if tie not in spatial], file.tendons))
    for tie in spatial:
        _steady(file, tie, arms)
    relations = _relations(file, ties, arms.mean)
    pulls = pulls_of(file, arms.mean)
    names = [file.joints[joint] for joint in file.q]
    order = _order(ties, pulls)
    try:
        apart = relations.disagreement(relations.nearest(file.q_0))
        if apart.size and apart.max() > AGREEMENT:
            raise ties[int(np.argmax(apart))].element.refused("this equality contradicts the other ones")
        if not (file.actuators or file.source.actuators_left_out):
            made = couplings(names, relations, order, rigid=True)
            return Moves(_placed(file, ties, arms, made), undriven(file), pulls)
        found = driven(file, relations, arms)
    except InputError as error:
        root = file.source.lines[0]
        raise error.located(lambda issue: issue if issue.file else root.refused(issue.message).issues[0]) from None
    made = couplings(names, found.relations, order)
    return Moves(_placed(file, ties, arms, _with_rigid(made, names, relations)), found.drives, pulls)


def _placed(file: Mjcf, ties: Sequence[Equality], arms: Arms, made: dict[str, Coupling]) -> dict[str, Coupling]:
    """Return the couplings with the places of the equalities or tendons that make them."""
    return {name: replace(each, place=_place(file, ties, arms, name)) for name, each in made.items()}


def _place(file: Mjcf, ties: Sequence[Equality], arms: Arms, follower: str) -> str:
    """Return file and line of the equality or the tendon that a joint follows by, first one of which it is joint1."""
    column = [file.joints[joint] for joint in file.q].index(follower)
    held = [tie for tie in ties if _row(file, tie, arms.mean)[0][column]]
    first = [tie for tie in held if tie.kind == "joint" and tie.ends[0] == column]
    pulled = [
        file.source.place("spatial" if tendon in file.spatial else "fixed", file.tendon_names[tendon])
        for tendon in np.flatnonzero(arms.mean[:, column]).tolist()
    ]
    return next((element.place for element in [*(tie.element for tie in [*first, *held]), *pulled]), "")


def _with_rigid(made: dict[str, Coupling], names: Sequence[str], relations: Relations) -> dict[str, Coupling]:
    """Return the couplings that equalities alone make as rigid ones; a tendon lets joints part under contact."""
    free = split(relations.A).null_space
    rows = {name: np.array([-each.ratios.get(other, 0.0) for other in names]) for name, each in made.items()}
    for name, row in rows.items():
        row[names.index(name)] = 1.0
    return {name: replace(each, rigid=bool(np.linalg.norm(rows[name] @ free) < STILL)) for name, each in made.items()}


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


def _relations(file: Mjcf, ties: Sequence[Equality], tendons: Array) -> Relations:
    rows = [_row(file, tie, tendons) for tie in ties]
    A = np.array([row for row, _ in rows]).reshape(-1, len(file.q))
    return Relations(A, np.array([constant for _, constant in rows])).scaled()


def _row(file: Mjcf, equality: Equality, tendons: Array) -> tuple[Array, float]:
    """Return the row of A and the entry of b: e_1 - c_1 e_2 = c_0, with e from the values in the drawing."""
    constant, linear, *others = equality.polynomial
    if len(equality.ends) > 1 and any(others):
        raise equality.element.refused(
            "polycoef is not linear (only its first two numbers may differ from 0); a synergy is a fixed direction of q"
        )
    values = np.eye(len(file.q)) if equality.kind == "joint" else tendons
    row = values[equality.ends[0]].copy()
    if len(equality.ends) > 1:
        row -= linear * values[equality.ends[1]]
    return row, constant + float(row @ file.q_0)


def _steady(file: Mjcf, equality: Equality, arms: Arms) -> None:
    """Refuse an equality of a spatial tendon whose moment arms change over the ranges of the joints."""
    for tendon in {*equality.ends} & {*file.spatial}:
        if change_of(arms, [file.kinds[joint] for joint in file.q], tendon) > NEAR:
            raise equality.element.refused(
                f"the equality holds the spatial tendon '{file.tendon_names[tendon]}', which is not linear in the "
                f"joints (its moment arms change by more than {100 * NEAR:g} % over their ranges); leave it out and "
                "give the synergies of the hand in a file"
            )


def _order(ties: Sequence[Equality], pulls: Array) -> list[int]:
    """Return the columns of q, followers first: each joint1, then all but the first of a tendon, then from behind."""
    follows = [equality.ends[0] for equality in ties if equality.kind == "joint"]
    for pull in pulls:
        follows += np.flatnonzero(pull)[1:].tolist()
    return list(dict.fromkeys([*follows, *range(pulls.shape[1] - 1, -1, -1)]))
