"""From a hand, an object and places to touch it to a grasp."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.asked_grasp import asked_grasp, grasp_of
from synergrip.grasps.asked_hand import Posture, Synergies
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.objects import Object
from synergrip.hands.hand import Hand
from synergrip.linalg import Array


@naming_arguments
def make_grasp(
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
) -> Grasp:
    """Return the grasp of an object by a hand in a posture; a problem file can say no more of one.

    Args:
        hand: the hand, or what `load_hand` makes one of.
        object: what is grasped; without a position it is found from the contacts, as far as they tell.
        posture: name of a posture of the hand, values [rad or m] by name of synergy or joint, or all joint values
            (n_q,).
        contacts: where the hand touches, and how.
        synergies: how many of the default set, a named set, the path of a synergy file, names, or a set itself; the
            default set of the hand when absent.
        close: the synergy, joint or weights by name along which the hand closes from its posture until all pads touch.
        joint_compliance: C_q [rad/(N m), m/N]: one for all joints or one for each; that of the hand when absent.
        synergy_compliance: C_z, one for all synergies or one for each.
        title: of the grasp.
        relative_to: folder of a synergy file; the current one when absent.

    Returns:
        The grasp; its `held` knows the hand, the object where it is, and the pads that touch.

    Raises:
        InputError: an argument that is none, unknown names, a posture outside the ranges of the joints, pads that do
            not reach the object or face away from it; as many of them as can be found at once.

    Example:
        >>> from synergrip.grasps.contacts.hard_finger import HardFinger
        >>> from synergrip.grasps.shapes.sphere import Sphere
        >>> tips = [f"finger{i}/tip" for i in (1, 2, 3)]
        >>> grasp = make_grasp(
        ...     "barrett", Object(mass=0.2, shape=Sphere(radius=0.05)), posture="ball", synergies="motors",
        ...     contacts=[ContactAt(tip, HardFinger(friction=0.6), stiffness=8e3) for tip in tips],
        ... )
        >>> grasp.n_l, grasp.n_q, grasp.n_z
        (9, 8, 4)
    """
    asked = asked_grasp(
        hand, object, posture=posture, contacts=contacts, synergies=synergies, close=close,
        joint_compliance=joint_compliance, synergy_compliance=synergy_compliance, title=title, relative_to=relative_to,
    )  # fmt: skip
    return grasp_of(asked)
