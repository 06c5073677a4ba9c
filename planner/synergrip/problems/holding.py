"""The tables [hand], [object] and [contacts] made into a grasp."""

from __future__ import annotations

from pathlib import Path

from synergrip.errors import InputError, raise_issues
from synergrip.grasps.asked_grasp import AskedGrasp, asked_grasp, grasp_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.objects import Object, Turned, turn
from synergrip.grasps.shapes.sphere import Sphere
from synergrip.hands.folder import load_hand
from synergrip.hands.units import joint_kinds, list_misfits
from synergrip.linalg import frozen
from synergrip.problems.file_keys import in_file
from synergrip.problems.object_table import AUTO, ObjectTable
from synergrip.problems.problem_file import ProblemFile

UNPLACED = (
    '"auto" is looked for by the command line (`synergrip validate FILE` tells what it finds), and in code by '
    "place_object(...); give 3 lengths here"
)
"""What is said where a place that is still to be found is needed."""


def hand_grasp(file: ProblemFile, folder: Path) -> Grasp:
    """Return the grasp, which knows what holds what in it.

    Args:
        file: a problem file with [hand], [object] and contacts.
        folder: folder of the problem file, for a hand given as a path.

    Raises:
        InputError: an unknown hand, pad, link, posture or synergy set, an object that is still to be placed, or pads
            that do not reach it.
    """
    if file.object is not None and file.object.position == AUTO:
        raise InputError.at("object.position", UNPLACED)
    asked = asked_of(file, folder)
    try:
        return grasp_of(asked)
    except InputError as error:
        raise error.located(in_file) from None


def asked_of(file: ProblemFile, folder: Path) -> AskedGrasp:
    """Return what is to become the grasp: hand, object and contacts, whether or not they touch.

    The object has no position where the file leaves that open.

    Raises:
        InputError: an unknown hand, pad, link, posture or synergy set.
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
    wish, kinds = table.compliance.joint, joint_kinds(hand.joints)
    if not isinstance(wish, tuple) or len(wish) == len(kinds):
        issues = list_misfits("hand.compliance.joint", wish, kinds) if wish is not None else []
        raise_issues(issues)
    try:
        return asked_grasp(
            hand, _object(file.object), posture=table.posture, contacts=file.contact_list(),  # type: ignore[arg-type]
            synergies=table.synergies, close=table.close, joint_compliance=wish,
            synergy_compliance=table.compliance.synergy or 0.0, title=file.title, relative_to=folder,
            anywhere=file.object is not None and file.object.position == AUTO,
        )  # fmt: skip
    except InputError as error:
        raise error.located(in_file) from None


def _object(table: ObjectTable | None) -> Object:
    if table is None:
        raise InputError.at("object", "missing table [object]")
    shape = table.shape.value() if table.shape is not None else None
    if shape is not None and table.orientation is not None and not isinstance(shape, Sphere):
        shape = Turned(shape, turn(table.orientation.axis, table.orientation.angle))
    position = {} if table.position is None or table.position == AUTO else {"position": frozen(table.position)}
    return Object(title=table.title, mass=table.mass or 0.0, shape=shape, **position)
