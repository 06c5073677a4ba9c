"""From matrices of kinematics of one's own to a grasp."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from synergrip.documents.judging import described
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.given import given, numbered
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.grasp_judging import Judge
from synergrip.grasps.matrices import GivenContact, Matrices
from synergrip.grasps.matrix_reading import LARGEST_COMPLIANCE, unbalanced


@naming_arguments
def grasp_from_matrices(
    *,
    G: ArrayLike,
    J: ArrayLike,
    S: ArrayLike,
    contacts: Sequence[tuple[str, ContactKind] | GivenContact],
    C_s: ArrayLike,
    C_q: ArrayLike = 0.0,
    C_z: ArrayLike = 0.0,
    lambda_0: ArrayLike | None = None,
    w_0: ArrayLike | None = None,
    joints: Sequence[str] | None = None,
    synergies: Sequence[str] | None = None,
    title: str = "",
) -> Grasp:
    """Return the grasp of matrices from kinematics of one's own; SI units.

    The force components of a contact are those of its kind, such as (n, t, o) of a `HardFinger` and (n, t, o, m) of a
    `SoftFinger`: the normal n points toward the object (into it, as the force on it does), (n, t, o) is right-handed,
    and m is the moment about n.

    Args:
        G: (6, n_l) grasp matrix: in each column the force on the object of a unit of one component, and its moment
            about B.
        J: (n_l, n_q) hand Jacobian: in each row the velocity of the contact along one component, by joint.
        S: (n_q, n_z) synergy matrix.
        contacts: ``(name, kind)`` in the order of the rows of J, or a `GivenContact` where place and normal are known.
        C_s: contact compliance, a matrix (n_l, n_l) or a number for that times the identity [m/N].
        C_q: joint compliance, likewise [rad/(N m)].
        C_z: synergy compliance, likewise.
        lambda_0: (n_l,) contact forces at the start; the elastic reaction to w_0 when absent.
        w_0: (6,) external wrench at the start; what lambda_0 balances when absent.
        joints: names of the joints; q1, q2, ... when absent.
        synergies: names of the synergies; z1, z2, ... when absent.
        title: of the grasp.

    Raises:
        InputError: shapes that do not fit, numbers that are none, points or normals that contradict G, lambda_0 and w_0
            that contradict each other; each with the argument.

    Example:
        >>> from synergrip.grasps.contacts.hard_finger import HardFinger
        >>> G = np.zeros((6, 6))  # two fingers 40 mm apart on x: columns are unit forces and their moments about B
        >>> G[:3, :3], G[:3, 3:] = np.eye(3), np.diag([-1, 1, -1])
        >>> G[3:, 1:3], G[3:, 4:] = [[0, 0], [0, 0.02], [-0.02, 0]], [[0, 0], [0, 0.02], [0.02, 0]]
        >>> squeeze = [[1], [0], [0], [1], [0], [0]]
        >>> hard = HardFinger(friction=0.5)
        >>> grasp = grasp_from_matrices(
        ...     G=G, J=np.eye(6), S=squeeze, contacts=[("left", hard), ("right", hard)], C_s=1e-4
        ... )
        >>> [contact.point.round(6).tolist() for contact in grasp.contacts]
        [[-0.02, 0.0, 0.0], [0.02, 0.0, 0.0]]
    """
    judge = Judge("")
    told = _told(judge, contacts)
    judge.finish()
    n_l = sum(len(contact.kind.components) for contact in told)
    title = judge.text("title", title)
    G, J, S = judge.kinematics(G, J, S, n_l)
    stiff = judge.compliance("C_s", C_s, n_l, LARGEST_COMPLIANCE)
    start = None if lambda_0 is None else judge.array("lambda_0", lambda_0, (n_l,))
    load = None if w_0 is None else judge.array("w_0", w_0, (6,))
    judge.finish()  # what follows goes by the sizes of J and S
    n_q, n_z = J.shape[1], S.shape[1]
    matrices = Matrices(
        title=title, contacts=told, G=G, J=J, S=S, C_s=stiff, lambda_0=start, w_0=load,
        C_q=judge.compliance("C_q", C_q, n_q, LARGEST_COMPLIANCE),
        C_z=judge.compliance("C_z", C_z, n_z, LARGEST_COMPLIANCE),
    )  # fmt: skip
    if not judge.issues:
        for name, count in (("J", n_q), ("S", n_z)):
            if not count:
                judge.refuse(name, "has no columns")
    named: dict[str, Any] = {
        "joints": numbered("q", n_q) if joints is None else judge.named("joints", joints, n_q, "joint"),
        "synergies": numbered("z", n_z) if synergies is None else judge.named("synergies", synergies, n_z, "synergy"),
    }
    both = not judge.issues and matrices.lambda_0 is not None and matrices.w_0 is not None
    if both and (message := unbalanced(matrices.G, np.asarray(matrices.lambda_0), np.asarray(matrices.w_0))):
        judge.refuse("w_0", f"{message}; leave one of the two out")
    judge.finish()
    try:
        return replace(given(matrices), **named)
    except InputError as error:
        raise error.located(lambda issue: replace(issue, key=issue.key.replace(".point_m", ".point"))) from None


def _told(judge: Judge, contacts: object) -> tuple[GivenContact, ...]:
    """Return the contacts, each given as a pair or as a value."""
    example = '("C1", HardFinger(friction=0.6))'
    if isinstance(contacts, str) or not isinstance(contacts, Sequence) or not contacts:
        judge.refuse("contacts", f"expected a list such as [{example}], got {described(contacts)}")
        return ()
    found = []
    for index, each in enumerate(contacts):
        if isinstance(each, GivenContact):
            found.append(each)
        elif isinstance(each, tuple) and len(each) == 2:
            name = judge.text(f"contacts[{index}][0]", each[0], empty=False)
            if judge.one(f"contacts[{index}][1]", each[1], ContactKind, "HardFinger(friction=0.6)") and name:
                found.append(GivenContact(name=each[0], kind=each[1]))
        else:
            judge.refuse(f"contacts[{index}]", f"expected a pair such as {example}, got {described(each)}")
    judge.names("contacts", [contact.name for contact in found])
    return tuple(found)
